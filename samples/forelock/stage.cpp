// SPDX-License-Identifier: MIT
#include "stage.h"

#include "bust.h"
#include "colored_stage.h"
#include "commands.h"
#include "image.h"
#include "progress.h"
#include "stray.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kWidestShare = 1.0 / 25.0;  // of a strand's mean length: where a file has no widths
constexpr size_t kMostSeen = 1u << 20;  // points for framing: one in so many is left out beyond

void placeAsset(const SceneAsset& asset, UpAxis up, double matrix[16]) {
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
    flkAssetGetStrands(asset.opened.asset.get(), &strands);
    const double* m = asset.world_from_hair;
    const std::vector<uint8_t> stray = findStrayStrands(strands);
    if (!stray.empty()) {
      const auto count = static_cast<uint64_t>(std::count(stray.begin(), stray.end(), uint8_t{1}));
      stage.notes.push_back(asset.opened.label + ": " + groupedDigits(count) + (count == 1 ? " strand lies" : " strands lie") +
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
  flkAssetGetStrands(asset.opened.asset.get(), &strands);
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
    stage.notes.push_back(asset.opened.label + ": strands hang along -" + (z_up ? "y" : "z") + "; if that is down, use --up " +
                          (z_up ? "y" : "z"));
  }
}

glm::dvec3 mean(const float* rgb, size_t count) {
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < count; ++i) {
    sum += glm::dvec3(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1));
}

void loadRootImage(const std::string& path, StagedAsset& asset) {
  if (!asset.info.has_root_uvs) {
    throw AssetError(FLK_ERROR_INVALID_ARGUMENT,
                     asset.opened.label + ": has no root UVs, which root_image needs: .tfx files and grooms have them");
  }
  Image image;
  try {
    image = readImage(path);
  } catch (const std::runtime_error& error) {
    throw AssetError(FLK_ERROR_IO, path + ": " + error.what());
  }
  asset.root_pixels.resize(size_t{3} * image.width * image.height);
  for (size_t i = 0; i < asset.root_pixels.size(); ++i) {
    const float value = image.rgba[i / 3 * 4 + i % 3];
    asset.root_pixels[i] = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
  }
  asset.root_image = {asset.root_pixels.data(), image.width, image.height};
}

// What a centimetre or millimetre is taken for where the library suspects that it is the asset's unit; else 1.
double suspectedUnit(const SceneAsset& wanted, const StagedAsset& asset) {
  const std::vector<AssetFinding> findings = findingsOf(asset.opened);
  const bool suspect = std::any_of(findings.begin(), findings.end(), [](const AssetFinding& f) { return f.code == "UNIT_SUSPECT"; });
  if (!suspect || wanted.scale != 1.0) {
    return 1.0;
  }
  // The library looks at the farthest coordinate: of strands astray, or far from the origin, that is no size of the hair.
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened.asset.get(), &strands);
  const std::vector<uint8_t> stray = findStrayStrands(strands);
  glm::vec3 low(1e30f), high(-1e30f);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    for (uint32_t v = strands.first_vertex[s]; (stray.empty() || stray[s] == 0) && v < strands.first_vertex[s + 1]; ++v) {
      const glm::vec3 p(strands.positions[size_t{3} * v], strands.positions[size_t{3} * v + 1], strands.positions[size_t{3} * v + 2]);
      low = glm::min(low, p), high = glm::max(high, p);
    }
  }
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  return size <= 10.0f ? 1.0 : size > 1000.0f ? 1000.0 : 100.0;
}

// What an asset looks like by itself and by what the scene wants of it.
void stageLook(const SceneAsset& wanted, StagedAsset& asset, std::vector<std::string>& notes) {
  asset.material = wanted.material;
  asset.follow = {wanted.follow.count, static_cast<float>(wanted.follow.radius_mm * 1e-3),
                  static_cast<float>(wanted.follow.spread_tip), wanted.follow.seed};
  asset.flags = wanted.ignore_colors ? FLK_HAIR_IGNORE_COLORS : 0;
  const double unit = suspectedUnit(wanted, asset);
  double scale = static_cast<double>(asset.material.width_scale);
  const double diameter_mm = 2e3 * static_cast<double>(asset.info.max_radius);
  if (wanted.width_mm > 0.0) {
    scale = std::min(wanted.width_mm / diameter_mm, 1e6);
  } else if (!asset.info.has_radii) {
    // The default width is for so many strands: with follow strands there are more.
    const double strands = static_cast<double>(asset.info.strand_count);
    const double all = strands * (1.0 + static_cast<double>(wanted.follow.count));
    scale *= std::max(1.0, 1e5 / all) / std::max(1.0, 1e5 / strands) * unit;
    const double widest = kWidestShare * static_cast<double>(asset.info.mean_length) * 1e3 / diameter_mm;
    if (scale > widest) {  // of a few strands the rule makes ribbons wider than long
      scale = widest;
      notes.push_back(asset.opened.label + ": so few strands would be " + shortNumber(diameter_mm * unit) +
                      " mm wide by the default, drawn are " + shortNumber(diameter_mm * widest) + " mm, 1/25 of their mean length");
    }
  }
  if (unit != 1.0) {
    const bool widths = wanted.width_mm <= 0.0 && !asset.info.has_radii;
    asset.material.fibre_spacing *= static_cast<float>(unit);
    asset.follow.radius *= static_cast<float>(unit);
    notes.push_back(asset.opened.label + ": coordinates suggest " + (unit > 100.0 ? "millimetres" : "centimetres") + ", so " +
                    (widths ? "the default width and what shadows take for the distance of fibres are " : "what shadows take for the distance of fibres is ") +
                    shortNumber(unit) + " times as large as for metres; `forelock convert --scale` makes it metres");
  }
  asset.material.width_scale = static_cast<float>(scale);
  asset.width_mm = diameter_mm * scale;

  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened.asset.get(), &strands);
  const bool own_colors = strands.colors && !wanted.ignore_colors;
  if (!wanted.root_image.empty()) {
    loadRootImage(wanted.root_image, asset);
  }
  if (!wanted.color_given && (own_colors || asset.root_image.width > 0)) {
    std::fill(asset.material.color, asset.material.color + 3, 1.0f);
  }
  const FlkMaterial& m = asset.material;
  const double tip = 0.5 * static_cast<double>(m.tip_blend);
  asset.reflectance = glm::mix(glm::dvec3(m.color[0], m.color[1], m.color[2]),
                               glm::dvec3(m.tip_color[0], m.tip_color[1], m.tip_color[2]), tip);
  if (own_colors) {
    asset.reflectance *= mean(strands.colors, strands.vertex_count);
  }
  if (asset.root_image.width > 0) {
    asset.reflectance *= mean(asset.root_pixels.data(), asset.root_pixels.size() / 3);
  }
}

}  // namespace

Stage openStage(const Scene& scene) {
  Stage stage;
  stage.scene = scene;
  bool on_bust = false;
  const RecipeCamera* stored = nullptr;
  std::string known;
  for (const SceneAsset& wanted : scene.assets) {
    StagedAsset& asset = stage.assets.emplace_back();
    {
      Progress progress("opening " + wanted.source);
      asset.opened = openAsset(wanted.source, [&](uint64_t done, uint64_t total) { progress.update(done, total); });
    }
    printMessages(*asset.opened.messages, false);
    flkAssetGetInfo(asset.opened.asset.get(), &asset.info);
    stageLook(wanted, asset, stage.notes);
    placeAsset(wanted, scene.camera.up, asset.world_from_hair);
    on_bust = on_bust || (asset.opened.recipe && asset.opened.recipe->drape_on_bust);
  }
  for (const StagedAsset& asset : stage.assets) {  // only now, because the list no longer moves
    if (!asset.opened.recipe) {
      continue;
    }
    for (const RecipeCamera& camera : asset.opened.recipe->cameras) {
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
  if (!scene.head) {
    stage.scene.head = on_bust;
  }
  collectSeen(stage);
  for (const StagedAsset& asset : stage.assets) {
    if (!asset.opened.recipe && !stage.scene.camera.placed) {
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
  if (*stage.scene.head && !wanted.placed) {  // no part of the bust is cut off by the planes
    float low[3], high[3];
    bustBounds(low, high);
    const glm::dvec3 middle(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]));
    const double reach = 0.5 * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const double depth = glm::dot(camera.eye - middle, cameraBasis(camera).back);
    camera.near_m = std::max(std::min(camera.near_m, depth - reach), 0.01 * camera.near_m);
    camera.far_m = std::max(camera.far_m, depth + reach);
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
  desc.asset = asset.opened.asset.get();
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
      throw AssetError(result, asset.opened.label + ": no hair can be made of it, " + flkResultName(result));
    }
    hairs.push_back(std::move(hair));
  }
  return hairs;
}

StagedFrame::StagedFrame(const Stage& stage, const Camera& camera, const std::vector<Hair>& hairs, double exposure,
                         uint32_t width, uint32_t height)
    : frame(frameDesc()), ambient_sh{}, modifiers{} {
  const Scene& scene = stage.scene;
  const bool lit = scene.coloring == StrandColoring::none;  // else colours are seen as they are
  for (const SceneLight& wanted : lit ? scene.lights : std::vector<SceneLight>()) {
    FlkLight& light = lights.emplace_back();
    light.kind = wanted.kind;
    const glm::dvec3 towards = towardsLight(wanted, camera);
    for (int i = 0; i < 3; ++i) {
      light.direction[i] = static_cast<float>(towards[i]);
      light.radiance[i] = static_cast<float>(wanted.color[i] * wanted.intensity * exposure);
      light.position[i] = wanted.position[i];
    }
    light.range = static_cast<float>(wanted.range_m);
    light.source_radius = static_cast<float>(wanted.source_radius_mm * 1e-3);
    light.inner_angle = static_cast<float>(wanted.inner_angle_deg * kDegree);
    light.outer_angle = static_cast<float>(wanted.outer_angle_deg * kDegree);
    light.casts_shadow = wanted.shadow ? 1 : 0;
    light.shadow_size = wanted.shadow_size;
  }
  Harmonics harmonics;
  if (lit && stageHarmonics(stage, harmonics)) {
    for (size_t i = 0; i < 27; ++i) {
      ambient_sh[i] = static_cast<float>(harmonics[i / 3][static_cast<int>(i % 3)] * exposure);
    }
    frame.ambient_sh = ambient_sh;
  }
  if (scene.near_fade) {
    FlkOpacityModifier& fade = modifiers[frame.opacity_modifier_count++];
    fade.kind = FLK_OPACITY_NEAR_FADE;
    fade.start = static_cast<float>(scene.near_fade->start_m);
    fade.end = static_cast<float>(scene.near_fade->end_m);
  }
  if (scene.lens) {
    FlkOpacityModifier& lens = modifiers[frame.opacity_modifier_count++];
    lens.kind = FLK_OPACITY_LENS;
    lens.center[0] = static_cast<float>(scene.lens->center[0] * width);
    lens.center[1] = static_cast<float>(scene.lens->center[1] * height);
    lens.radius = static_cast<float>(scene.lens->radius * height);
    lens.feather = static_cast<float>(scene.lens->feather * height);
    lens.inside = static_cast<float>(scene.lens->inside);
  }
  frame.opacity_modifiers = modifiers;
  for (int i = 0; i < 3; ++i) {
    frame.ambient[i] = lit ? static_cast<float>(scene.ambient[i] * exposure) : 1.0f;
  }
  for (const Hair& hair : hairs) {
    handles.push_back(hair);
  }
  viewMatrix(camera, frame.view_from_world);
  projectionMatrix(camera, stage.aspect(), frame.clip_from_view);
  frame.reversed_depth = camera.reversed_depth ? 1 : 0;
  frame.hairs = handles.data();
  frame.hair_count = static_cast<uint32_t>(handles.size());
  frame.lights = lights.data();
  frame.light_count = static_cast<uint32_t>(lights.size());
  frame.method = scene.method;
  frame.k = scene.k;
  frame.k_sort = scene.k_sort;
  frame.payload = scene.payload;
  frame.display = scene.display;
  frame.tail = scene.tail;
  frame.core_taps = scene.core_taps;
  frame.low_shade = scene.low_shade;
  frame.capture = scene.capture;
  frame.timestamps = 1;
}

std::string methodText(const Scene& scene) {
  const std::string capture = scene.capture == FLK_CAPTURE_DEFAULT ? "" : ", capture by " + captureNames()[scene.capture];
  if (scene.display != FLK_DISPLAY_SHADED || scene.coloring != StrandColoring::none) {
    return "colours show " + shownName(scene) + capture;
  }
  std::string text = methodNames()[scene.method];
  const uint32_t k = scene.k == FLK_K_NONE ? 0 : scene.k == 0 ? 8 : scene.k;
  const uint32_t k_sort = scene.k_sort == 0 ? std::max(8u, k) : scene.k_sort;
  const bool has_core = scene.method == FLK_METHOD_CORE_TAIL || scene.method == FLK_METHOD_CORE_ONLY;
  const bool has_tail = scene.method == FLK_METHOD_CORE_TAIL || scene.method == FLK_METHOD_ALL_LOW;
  if (has_core) {
    text += ", k " + std::to_string(k);
  }
  if (has_core || has_tail || scene.method == FLK_METHOD_FORWARD) {
    text += ", k_sort " + std::to_string(k_sort);
  }
  if (has_tail && scene.tail == FLK_TAIL_LIST) {
    text += ", tail in list order";
  }
  if (has_tail && scene.tail == FLK_TAIL_ONCE) {
    text += ", tail shaded once";
  }
  if (has_tail && scene.low_shade != FLK_LOW_SHADE_DEFAULT) {
    text += ", cheap shade with " + lowShadeNames()[scene.low_shade];
  }
  if (scene.core_taps != 0 && scene.core_taps != 25 && scene.method != FLK_METHOD_ALL_LOW) {
    text += ", " + std::to_string(scene.core_taps) + (scene.core_taps == 1 ? " tap" : " taps");
  }
  if (scene.payload == FLK_PAYLOAD_PAPER && scene.method != FLK_METHOD_HARD) {
    text += ", payload of the paper";
  }
  return text + capture;
}

}  // namespace forelock::samples
