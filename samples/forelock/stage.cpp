// SPDX-License-Identifier: MIT
#include "stage.h"

#include "bust.h"
#include "colored_stage.h"
#include "commands.h"
#include "progress.h"
#include "stray.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr size_t kMostSeen = 1u << 20;  // points for framing: one in so many is left out beyond

// Of an asset or a mesh.
template <class Placed>
void place(const Placed& asset, UpAxis up, double matrix[16]) {
  const double c = std::cos(asset.turn_deg * kDegree) * asset.scale;
  const double s = std::sin(asset.turn_deg * kDegree) * asset.scale;
  std::fill(matrix, matrix + 16, 0.0);
  matrix[0] = matrix[5] = matrix[10] = asset.scale;
  matrix[15] = 1.0;
  if (up == UpAxis::Z) {
    matrix[0] = matrix[5] = c, matrix[1] = s, matrix[4] = -s;
  } else {
    matrix[0] = matrix[10] = c, matrix[2] = -s, matrix[8] = s;
  }
  for (int i = 0; i < 3; ++i) {
    matrix[12 + i] = asset.position[i];
  }
}

void collectSeen(Stage& stage) {
  size_t vertices = 0;
  for (const StagedAsset& asset : stage.assets) {
    vertices += asset.info.vertex_count;
  }
  const size_t step = vertices / kMostSeen + 1;
  for (const StagedAsset& asset : stage.assets) {
    FlkStrands strands = {};
    flkAssetGetStrands(asset.opened->asset.get(), &strands);
    const double* m = asset.world_from_hair;
    const std::vector<uint8_t> stray = findStrayStrands(strands);
    if (!stray.empty()) {
      const auto count = static_cast<uint64_t>(std::count(stray.begin(), stray.end(), uint8_t{1}));
      stage.notes.push_back(asset.opened->label + ": " + groupedDigits(count) + (count == 1 ? " strand lies" : " strands lie") +
                            " so far off that the picture leaves " + (count == 1 ? "it" : "them") + " outside; first is strand " +
                            std::to_string(std::find(stray.begin(), stray.end(), uint8_t{1}) - stray.begin()));
    }
    uint32_t strand = 0;
    for (size_t v = 0; v < strands.vertex_count; v += step) {
      while (v >= strands.first_vertex[strand + 1]) {
        ++strand;
      }
      if (!stray.empty() && stray[strand] != 0) {
        continue;
      }
      const float* p = strands.positions + 3 * v;
      glm::dvec3 world(m[12], m[13], m[14]);
      for (int column = 0; column < 3; ++column) {
        world += glm::dvec3(m[4 * column], m[4 * column + 1], m[4 * column + 2]) * static_cast<double>(p[column]);
      }
      stage.seen.emplace_back(world);
    }
    const double widest = static_cast<double>(asset.info.max_radius * asset.material.width_scale) +
                          static_cast<double>(asset.follow.radius * std::max(asset.follow.spread_tip, 1.0f)) *
                              (asset.follow.count > 0 ? 1.0 : 0.0);
    stage.radius = std::max(stage.radius, widest * std::cbrt(std::fabs(m[0] * (m[5] * m[10] - m[6] * m[9]) -
                                                                       m[1] * (m[4] * m[10] - m[6] * m[8]))));
  }
  if (*stage.scene.head) {
    float low[3], high[3];
    headBounds(low, high);
    for (int corner = 0; corner < 8; ++corner) {
      stage.seen.emplace_back((corner & 1) ? high[0] : low[0], (corner & 2) ? high[1] : low[1],
                              (corner & 4) ? high[2] : low[2]);
    }
  }
}

// Strands that hang along another axis than the one that was named: told, never turned.
void noteUpAxis(Stage& stage, const StagedAsset& asset) {
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  glm::dvec3 fall(0.0);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    const float* root = strands.positions + size_t{3} * strands.first_vertex[s];
    const float* tip = strands.positions + size_t{3} * (strands.first_vertex[s + 1] - 1);
    const glm::dvec3 d = glm::dvec3(tip[0], tip[1], tip[2]) - glm::dvec3(root[0], root[1], root[2]);
    const double length = glm::length(d);
    fall += length > 0.0 ? d / length : d;
  }
  fall /= strands.strand_count;
  const bool z_up = stage.scene.camera.up == UpAxis::Z;
  const double along = z_up ? fall.z : fall.y, other = z_up ? fall.y : fall.z;
  const float* low = asset.info.min_bounds;
  const float* high = asset.info.max_bounds;
  const int up = z_up ? 2 : 1, or_up = z_up ? 1 : 2;  // hair that is combed back is not as long as it is high
  if (other < -0.5 && std::fabs(along) < 0.35 && high[or_up] - low[or_up] > high[up] - low[up]) {
    stage.notes.push_back(asset.opened->label + ": strands hang along -" + (z_up ? "y" : "z") + "; if that is down, use --up " +
                          (z_up ? "y" : "z"));
  }
}

// With a progress bar on the terminal, unless there is somebody else to tell.
template <class Read>
auto readWith(const std::string& source, const ProgressFunction& progress, const Read& read) {
  if (progress) {
    return read(progress);
  }
  Progress bar("opening " + source);
  return read([&](uint64_t done, uint64_t total) { bar.update(done, total); });
}

// No part of a box is cut off by the camera's planes.
void enclose(const glm::dvec3& low, const glm::dvec3& high, double nearest, Camera& camera) {
  const double reach = 0.5 * glm::length(high - low);
  const double depth = glm::dot(camera.eye - 0.5 * (low + high), cameraBasis(camera).back);
  camera.near_m = std::max(std::min(camera.near_m, depth - reach), nearest);
  camera.far_m = std::max(camera.far_m, depth + reach);
}

}  // namespace

void placeAsset(const SceneAsset& wanted, UpAxis up, StagedAsset& asset) { place(wanted, up, asset.world_from_hair); }

void placeMesh(const SceneMesh& wanted, UpAxis up, StagedMesh& mesh) {
  place(wanted, up, mesh.world_from_mesh);
  mesh.albedo = wanted.color ? glm::vec3(*wanted.color) : mesh.read->albedo;
  const double* m = mesh.world_from_mesh;
  mesh.low = glm::vec3(std::numeric_limits<float>::max());
  mesh.high = -mesh.low;
  for (size_t v = 0; v < mesh.read->vertices(); ++v) {
    const float* p = &mesh.read->positions[3 * v];
    for (int axis = 0; axis < 3; ++axis) {
      const double at = m[axis] * static_cast<double>(p[0]) + m[4 + axis] * static_cast<double>(p[1]) + m[8 + axis] * static_cast<double>(p[2]);
      mesh.low[axis] = std::min(mesh.low[axis], static_cast<float>(at + m[12 + axis]));
      mesh.high[axis] = std::max(mesh.high[axis], static_cast<float>(at + m[12 + axis]));
    }
  }
}

std::shared_ptr<const OpenedAsset> findOpen(const OpenFiles& files, const SceneAsset& wanted) {
  for (const auto& [asset, opened] : files.assets) {
    if (asset.source == wanted.source && asset.points_per_strand == wanted.points_per_strand) {
      return opened;
    }
  }
  return nullptr;
}

std::shared_ptr<const OpaqueMesh> findOpen(const OpenFiles& files, const SceneMesh& wanted) {
  for (const auto& [mesh, read] : files.meshes) {
    if (mesh.source == wanted.source) {
      return read;
    }
  }
  return nullptr;
}

std::string passWork(const FlkPassInfo& pass) {
  if (pass.indices > 0) {
    return groupedDigits(pass.indices) + " indices";
  }
  if (pass.segments > 0) {
    return groupedDigits(pass.segments) + " segments";
  }
  if (pass.groups[0] > 0) {
    return groupedDigits(uint64_t{pass.groups[0]} * pass.groups[1] * pass.groups[2]) + " workgroups";
  }
  return "fills and barriers";
}

Stage openStage(const Scene& scene, const ProgressFunction& progress, const OpenFiles& open) {
  Stage stage;
  stage.scene = scene;
  bool on_bust = false;
  const RecipeCamera* stored = nullptr;
  std::string known;
  for (const SceneAsset& wanted : scene.assets) {
    StagedAsset& asset = stage.assets.emplace_back();
    asset.opened = findOpen(open, wanted);
    if (!asset.opened) {
      asset.opened = std::make_shared<OpenedAsset>(readWith(wanted.source, progress, [&](const ProgressFunction& tell) {
        return openAsset(wanted.source, tell, {wanted.points_per_strand, true});  // copied, for --watch: its exporter may be at it
      }));
      printMessages(*asset.opened->messages, false);
    }
    flkAssetGetInfo(asset.opened->asset.get(), &asset.info);
    stageLook(wanted, asset, stage.notes);
    placeAsset(wanted, scene.camera.up, asset);
    on_bust = on_bust || (asset.opened->recipe && asset.opened->recipe->drape_on_bust);
  }
  for (const StagedAsset& asset : stage.assets) {  // only now, because the list no longer moves
    if (!asset.opened->recipe) {
      continue;
    }
    for (const RecipeCamera& camera : asset.opened->recipe->cameras) {
      known += " " + camera.name;
      stored = !stored && camera.name == scene.camera.name ? &camera : stored;
    }
  }
  if (!scene.camera.name.empty() && !stored) {
    throw UsageError("no camera named " + scene.camera.name + "; " +
                     (known.empty() ? "this asset stores none" : "stored are:" + known));
  }
  if (stored) {
    stage.scene.camera.placed = fromRecipeCamera(*stored);
  }
  if (scene.width == 0) {
    stage.scene.width = stored ? stored->width : 1024;
    stage.scene.height = stored ? stored->height : 1024;
  }
  for (const SceneMesh& wanted : scene.meshes) {
    StagedMesh& mesh = stage.meshes.emplace_back();
    mesh.read = findOpen(open, wanted);
    if (!mesh.read) {
      mesh.read = std::make_shared<OpaqueMesh>(
          readWith(wanted.source, progress, [&](const ProgressFunction& tell) { return readMesh(wanted.source, tell); }));
    }
    placeMesh(wanted, scene.camera.up, mesh);
  }
  if (!scene.head) {
    stage.scene.head = on_bust;
  }
  collectSeen(stage);
  for (const StagedAsset& asset : stage.assets) {
    if (!asset.opened->recipe && !stage.scene.camera.placed) {
      noteUpAxis(stage, asset);
    }
  }
  stage.legend = displayLegend(scene.display);
  if (scene.coloring != StrandColoring::none) {
    return coloredStage(stage, scene.coloring);
  }
  return stage;
}

Camera stageCamera(const Stage& stage, uint32_t turn, uint32_t turns) {
  const SceneCamera& wanted = stage.scene.camera;
  Camera camera = wanted.placed ? *wanted.placed
                                : framePoints({stage.seen, stage.radius}, wanted.azimuth_deg * kDegree,
                                              wanted.elevation_deg * kDegree, wanted.up,
                                              wanted.vertical_fov_deg * kDegree, stage.aspect(), wanted.margin, turns);
  if (turn > 0) {
    const double angle = 360.0 * kDegree * turn / turns;
    glm::dvec3 axis(0.0);
    if (!wanted.placed) {  // the middle of what is framed, as in framePoints
      glm::vec3 low = stage.seen[0], high = stage.seen[0];
      for (const glm::vec3& p : stage.seen) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
      axis = glm::dvec3(low + high) * 0.5;
    } else {
      axis = wanted.placed->target;
    }
    const int a = wanted.up == UpAxis::Z ? 0 : 2, b = wanted.up == UpAxis::Z ? 1 : 0;
    for (glm::dvec3* point : {&camera.eye, &camera.target}) {
      const glm::dvec3 d = *point - axis;
      (*point)[a] = axis[a] + d[a] * std::cos(angle) - d[b] * std::sin(angle);
      (*point)[b] = axis[b] + d[a] * std::sin(angle) + d[b] * std::cos(angle);
    }
  }
  if (!wanted.placed) {
    const double nearest = 0.01 * camera.near_m;
    if (*stage.scene.head) {
      float low[3], high[3];
      bustBounds(low, high);
      enclose({low[0], low[1], low[2]}, {high[0], high[1], high[2]}, nearest, camera);
    }
    for (const StagedMesh& mesh : stage.meshes) {
      enclose(glm::dvec3(mesh.low), glm::dvec3(mesh.high), nearest, camera);
    }
  }
  return camera;
}

glm::dvec3 towardsLight(const SceneLight& light, const Camera& camera) {
  if (light.kind != FLK_LIGHT_DIRECTIONAL) {
    return light.kind == FLK_LIGHT_SPOT ? glm::normalize(light.position - light.target) : glm::dvec3(0.0);
  }
  const double azimuth = light.azimuth_deg * kDegree, elevation = light.elevation_deg * kDegree;
  const CameraBasis basis = cameraBasis(camera);
  return basis.right * (std::sin(azimuth) * std::cos(elevation)) + basis.up * std::sin(elevation) +
         basis.back * (std::cos(azimuth) * std::cos(elevation));
}

bool stageHarmonics(const Stage& stage, Harmonics& harmonics) {
  const Scene& scene = stage.scene;
  if (scene.sky) {
    harmonics = skyHarmonics(*scene.sky, scene.camera.up == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
  } else if (scene.ambient_sh) {
    harmonics = *scene.ambient_sh;
  }
  return scene.sky || scene.ambient_sh;
}

FlkHairDesc stagedHairDesc(const StagedAsset& asset) {
  FlkHairDesc desc = hairDesc();
  desc.asset = asset.opened->asset.get();
  desc.material = &asset.material;
  desc.flags = asset.flags;
  desc.follow = asset.follow;
  desc.root_image = asset.root_image.width > 0 ? &asset.root_image : nullptr;
  return desc;
}

std::vector<Hair> planHairs(FlkContext context, const Stage& stage) {
  std::vector<Hair> hairs;
  for (const StagedAsset& asset : stage.assets) {
    Hair hair;
    const FlkResult result = create(context, stagedHairDesc(asset), hair);
    if (result != FLK_SUCCESS || flkHairSetTransform(hair, asset.world_from_hair) != FLK_SUCCESS) {
      throw AssetError(result, asset.opened->label + ": no hair can be made of it, " + flkResultName(result));
    }
    hairs.push_back(std::move(hair));
  }
  return hairs;
}

}  // namespace forelock::samples
