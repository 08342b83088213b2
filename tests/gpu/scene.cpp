#include "scene.h"

#include "asset_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace forelock::test {

samples::HeadlessHost& host() {
  static std::unique_ptr<samples::HeadlessHost> shared = [] {
    samples::HeadlessOptions options;
    options.validation = std::getenv("FORELOCK_NO_VALIDATION") == nullptr;
    std::string error;
    auto made = samples::HeadlessHost::create(options, error);
    if (!made) {
      ADD_FAILURE() << "a GPU test needs a device: " << error;
      std::exit(1);
    }
    return made;
  }();
  return *shared;
}

// Every GPU test: no message of the validation layers.
class ValidationListener : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo&) override {
    for (const std::string& message : host().validationMessages()) ADD_FAILURE() << message;
    host().validationMessages().clear();
    host().messages().clear();
  }
};
static const bool kListening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);
  return true;
}();

void StrandArrays::add(const std::vector<std::array<float, 3>>& points, float radius) {
  for (const auto& p : points) {
    positions.insert(positions.end(), p.begin(), p.end());
    radii.push_back(radius);
  }
  first_vertex.push_back(uint32_t(radii.size()));
}

const StrandArrays& caseStrands(const AssetCase& asset, bool thinned) {
  static std::map<std::pair<std::string, bool>, StrandArrays> loaded;
  const auto found = loaded.find({asset.name, thinned});
  if (found != loaded.end()) return found->second;
  std::string source = asset.source;
  StrandArrays strands;
  const std::string prefix = "hairdata:";
  const bool external = source.starts_with(prefix);
  if (external) source = hairdata(source.substr(prefix.size()));
  if (!external || std::filesystem::exists(source)) strands = loadStrands(source, thinned ? asset.stride : 1);
  return loaded[{asset.name, thinned}] = strands;
}

StrandArrays loadStrands(const std::string& source, uint32_t stride) {
  const samples::OpenedAsset opened = samples::openAsset(source);
  FlkStrands strands{};
  EXPECT_EQ(flkAssetGetStrands(opened.asset.get(), &strands), FLK_SUCCESS);
  StrandArrays arrays;
  for (uint32_t s = 0; s < strands.strand_count; s += stride) {
    for (uint32_t v = strands.first_vertex[s]; v < strands.first_vertex[s + 1]; ++v) {
      arrays.positions.insert(arrays.positions.end(), strands.positions + v * 3, strands.positions + v * 3 + 3);
      arrays.radii.push_back(strands.radii[v]);
    }
    arrays.first_vertex.push_back(uint32_t(arrays.radii.size()));
  }
  return arrays;
}

std::string hairdata(const std::string& file) { return std::string(FORELOCK_HAIRDATA) + "/" + file; }

ViewSpec frameStrands(const StrandArrays& strands, int width, int height) {
  double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
  for (std::size_t i = 0; i < strands.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], double(strands.positions[i]));
    high[i % 3] = std::max(high[i % 3], double(strands.positions[i]));
  }
  ViewSpec view;
  view.width = width, view.height = height;
  view.target = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  const double radius =
      std::sqrt(std::pow(high[0] - low[0], 2) + std::pow(high[1] - low[1], 2) + std::pow(high[2] - low[2], 2)) / 2;
  view.projection.tan_half_y = 0.3;
  const double distance = radius / 0.3;
  view.eye = {view.target.x + 0.45 * distance, view.target.y + 0.2 * distance, view.target.z + 0.87 * distance};
  view.projection.near_plane = distance * 0.05;
  view.projection.far_plane = distance * 4;
  return view;
}

ViewSpec storedView(const char* name) {
  const samples::Recipe recipe = samples::openRecipe("groom:paper-load");
  for (const samples::RecipeCamera& camera : recipe.cameras) {
    if (camera.name != name) continue;
    ViewSpec view;
    view.width = int(camera.width), view.height = int(camera.height);
    view.eye = {camera.eye.x, camera.eye.y, camera.eye.z};
    view.target = {camera.target.x, camera.target.y, camera.target.z};
    view.up = {camera.up.x, camera.up.y, camera.up.z};
    view.projection.tan_half_y = std::tan(camera.vertical_fov_deg * 3.14159265358979323846 / 360);
    view.projection.near_plane = camera.near_m, view.projection.far_plane = camera.far_m;
    return view;
  }
  ADD_FAILURE() << "paper-load has no camera " << name;
  return {};
}

Scene::Scene(const StrandArrays& strands, const FlkMaterial& look, const ViewSpec& spec, uint32_t flags, uint32_t seed)
    : view_spec(spec), material(look) {
  FlkStrands arrays{};
  arrays.type = FLK_TYPE_STRANDS;
  arrays.strand_count = strands.strands();
  arrays.vertex_count = uint32_t(strands.radii.size());
  arrays.first_vertex = strands.first_vertex.data();
  arrays.positions = strands.positions.data();
  arrays.radii = strands.radii.data();
  FlkAsset asset = nullptr;
  EXPECT_EQ(flkAssetCreate(&arrays, nullptr, &asset), FLK_SUCCESS);
  FlkHairDesc desc{};
  desc.type = FLK_TYPE_HAIR;
  desc.asset = asset;
  desc.material = &material;
  desc.flags = flags;
  desc.shuffle_seed = seed;
  EXPECT_EQ(host().createHair(desc, &hair), FLK_SUCCESS);
  FlkViewDesc view_desc{};
  view_desc.type = FLK_TYPE_VIEW;
  view_desc.pool_budget = uint64_t(1) << 30;
  EXPECT_EQ(flkViewCreate(host().context(), &view_desc, &view), FLK_SUCCESS);

  camera = reference::makeCamera(spec.eye, spec.target, spec.up, spec.projection, spec.width, spec.height);
  reference::Hair twin;
  FlkStrands held{};
  flkAssetGetStrands(asset, &held);
  for (uint32_t s = 0; s < held.strand_count; ++s) {
    std::vector<reference::Vec3> points;
    std::vector<double> radii;
    for (uint32_t v = held.first_vertex[s]; v < held.first_vertex[s + 1]; ++v) {
      points.push_back({held.positions[v * 3], held.positions[v * 3 + 1], held.positions[v * 3 + 2]});
      radii.push_back(held.radii[v]);
      thickest = std::max(thickest, held.radii[v]);
    }
    reference::addStrand(twin.strands, points, radii);
  }
  flkAssetDestroy(asset);
  reference_scene.hairs.push_back(std::move(twin));
  setWidthScale(material.width_scale);
}

Scene::~Scene() {
  flkViewDestroy(view);
  flkHairDestroy(hair);
}

void Scene::setWidthScale(float scale) {
  material.width_scale = scale;
  EXPECT_EQ(flkHairSetMaterial(hair, &material), FLK_SUCCESS);
  reference::Material& m = reference_scene.hairs[0].material;
  for (int i = 0; i < 3; ++i) m.color[i] = material.color[i];
  m.opacity_root = material.opacity_root, m.opacity_tip = material.opacity_tip, m.width_scale = scale;
  m.kd = material.diffuse, m.kr = material.specular_r, m.exponent_r = material.exponent_r;
  m.kt = material.specular_trt, m.exponent_trt = material.exponent_trt, m.cuticle_tilt = material.cuticle_tilt;
  m.shadow_opacity = material.shadow_opacity, m.fibre_spacing = material.fibre_spacing;
}

float Scene::widthScaleFor(double width_px) const {
  const auto& e = view_spec.eye;
  const auto& t = view_spec.target;
  const double distance = std::sqrt(std::pow(e.x - t.x, 2) + std::pow(e.y - t.y, 2) + std::pow(e.z - t.z, 2));
  const double scale =
      view_spec.height / 2.0 / view_spec.projection.tan_half_y / (view_spec.projection.orthographic ? 1.0 : distance);
  return float(width_px / (2.0 * double(thickest) * scale));
}

void Scene::setLight(const double to_light_vs[3], double radiance, uint32_t shadow_size, uint32_t shadow_cover) {
  // View to world: the transpose of the rotation.
  const double* v = camera.view_from_world;
  double d[3];
  for (int i = 0; i < 3; ++i)
    d[i] = v[i * 4] * to_light_vs[0] + v[i * 4 + 1] * to_light_vs[1] + v[i * 4 + 2] * to_light_vs[2];
  light_ = {};
  for (int i = 0; i < 3; ++i) light_.direction[i] = float(d[i]), light_.radiance[i] = float(radiance);
  light_.casts_shadow = shadow_size != 0;
  light_.shadow_size = shadow_size;
  light_.shadow_cover = shadow_cover;
  lit_ = true;
  reference::Light twin;
  double l = 0;
  for (int i = 0; i < 3; ++i) l += double(light_.direction[i]) * light_.direction[i];
  l = std::sqrt(l);
  twin.direction_to_light = {light_.direction[0] / l, light_.direction[1] / l, light_.direction[2] / l};
  for (int i = 0; i < 3; ++i) twin.radiance[i] = light_.radiance[i];
  twin.shadow = shadow_size != 0;
  twin.shadow_size = int(shadow_size);
  twin.cover_width = shadow_cover == FLK_SHADOW_COVER_WIDTH;
  reference_scene.lights = {twin};
}

void Scene::noLight() {
  lit_ = false;
  reference_scene.lights.clear();
}

void Scene::expose(double mean, const reference::FragmentLists& lists) {
  const reference::Image image =
      reference::resolve(reference_scene, camera, reference::renderShadowMaps(reference_scene), lists, {});
  double sum = 0;
  std::size_t pixels = 0;
  for (const reference::Pixel& p : image.pixels)
    if (p.fragments) sum += (p.rgb[0] + p.rgb[1] + p.rgb[2]) / 3, ++pixels;
  const double factor = mean * double(pixels) / sum;
  for (int i = 0; i < 3; ++i) {
    light_.radiance[i] = float(light_.radiance[i] * factor);
    reference_scene.lights[0].radiance[i] = light_.radiance[i];
  }
}

FlkFrame Scene::frame(FlkFrame frame) {
  std::copy(camera.view_from_world, camera.view_from_world + 16, frame.view_from_world);
  for (int i = 0; i < 16; ++i) frame.clip_from_view[i] = float(camera.clip_from_view[i]);
  // FORELOCK_TEST_CAPTURE=compute runs a whole test program the other way.
  static const char* const wanted = std::getenv("FORELOCK_TEST_CAPTURE");
  if (wanted && std::string(wanted) == "compute" && frame.capture == FLK_CAPTURE_DEFAULT) frame.capture = FLK_CAPTURE_COMPUTE;
  frame.reversed_depth = view_spec.projection.reversed;
  frame.hairs = &hair;
  frame.hair_count = 1;
  frame.lights = &light_;
  frame.light_count = lit_;
  return frame;
}

std::vector<float> Scene::render(FlkFrame frame) {
  samples::HeadlessHost& h = host();
  EXPECT_TRUE(h.resize(uint32_t(view_spec.width), uint32_t(view_spec.height)));
  frame = this->frame(frame);
  for (int attempt = 0; attempt < 2; ++attempt) {  // a list that was too short has grown for the second
    const FlkResult result = h.render(view, frame, &plan);
    EXPECT_EQ(result, FLK_SUCCESS) << flkResultName(result) << " " << (h.messages().empty() ? "" : h.messages().back());
    EXPECT_EQ(h.statistics(view, statistics), FLK_SUCCESS);
    if (statistics.overflow_fragments == 0) break;
  }
  EXPECT_EQ(statistics.overflow_fragments, 0u);
  return h.readColor();
}

reference::Image Scene::toImage(const std::vector<float>& rgba) const {
  reference::Image image;
  image.width = view_spec.width, image.height = view_spec.height;
  image.pixels.resize(rgba.size() / 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    reference::Pixel& p = image.pixels[i];
    for (int c = 0; c < 3; ++c) p.rgb[c] = double(rgba[i * 4 + std::size_t(c)]);
    p.transmittance = 1 - double(rgba[i * 4 + 3]);
    p.fragments = rgba[i * 4 + 3] > 0;
  }
  return image;
}

reference::ShadowMap Scene::readShadowMap() {
  FlkShadowMap gpu{};
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 0, &gpu), FLK_SUCCESS);
  reference::ShadowMap map = reference::shadowFrame(reference::boundingSphere(reference_scene),
                                                    reference_scene.lights[0].direction_to_light, int(gpu.size));
  const std::vector<float> values = host().readShadowMap(gpu);
  for (std::size_t i = 0; i < values.size(); ++i)
    map.depth[i] = values[i] >= 1.0f ? std::numeric_limits<float>::infinity() : values[i] * gpu.depth_range;
  return map;
}

reference::FragmentLists Scene::gather(std::span<const double> host_depth) const {
  reference::GatherOptions options;
  options.host_depth = host_depth;
  return reference::gatherFragments(reference_scene, camera, options);
}

reference::Image Scene::referenceImage(const reference::ResolveOptions& options,
                                       const std::vector<reference::ShadowMap>& maps) const {
  return reference::resolve(reference_scene, camera, maps, gather(), options);
}

double mapDifference(const reference::ShadowMap& a, const reference::ShadowMap& b, double tolerance) {
  std::size_t covered = 0, off = 0;
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    const bool in_a = std::isfinite(a.depth[i]), in_b = std::isfinite(b.depth[i]);
    if (!in_a && !in_b) continue;
    ++covered;
    off += in_a != in_b || std::abs(double(a.depth[i]) - double(b.depth[i])) > tolerance;
  }
  return covered ? 100.0 * double(off) / double(covered) : 0;
}

void writeFailure(const std::string& name, const reference::Image& actual, const reference::Image& expected) {
  reference::Image difference = actual;
  for (std::size_t i = 0; i < actual.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      difference.pixels[i].rgb[c] = std::abs(actual.pixels[i].rgb[c] - expected.pixels[i].rgb[c]);
  reference::writePfm(name + "-actual.pfm", actual);
  reference::writePfm(name + "-expected.pfm", expected);
  reference::writePfm(name + "-difference.pfm", difference);
}

}  // namespace forelock::test
