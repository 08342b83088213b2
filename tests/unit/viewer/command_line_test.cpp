// Scenes as one line, and that every field of a scene survives being written.
#include "command_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

using namespace forelock::samples;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

class Dice {
 public:
  explicit Dice(uint32_t seed) : engine_(seed) {}
  bool coin() { return engine_() % 2 == 0; }
  uint32_t whole(uint32_t low, uint32_t high) { return low + static_cast<uint32_t>(engine_() % (uint64_t{high} - low + 1)); }
  double real(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
  float single(double low, double high) { return static_cast<float>(real(low, high)); }
  glm::dvec3 point(double reach) { return {real(-reach, reach), real(-reach, reach), real(-reach, reach)}; }
  glm::dvec3 color() { return {real(0, 1), real(0, 1), real(0, 1)}; }

 private:
  std::mt19937_64 engine_;
};

SceneLight randomLight(Dice& dice) {
  SceneLight light;
  light.kind = dice.whole(0, 2);
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    light.azimuth_deg = dice.real(-360, 360);
    light.elevation_deg = dice.real(-90, 90);
  } else {
    light.position = dice.point(10);
    light.range_m = dice.coin() ? 0.0 : dice.real(0, 100);
    light.source_radius_mm = dice.real(0.1, 100);
  }
  if (light.kind == FLK_LIGHT_SPOT) {
    light.target = dice.point(10);
    light.outer_angle_deg = dice.real(1, 90);
    light.inner_angle_deg = light.outer_angle_deg * dice.real(0, 0.99);
  }
  light.color = dice.color();
  light.intensity = dice.real(0, 100);
  light.shadow = dice.coin();
  light.shadow_size = 2 * dice.whole(32, 4096);
  return light;
}

SceneAsset randomAsset(Dice& dice) {
  SceneAsset asset;
  asset.source = dice.coin() ? "groom:curly" : "/it's a \"file\".tfx";
  FlkMaterial& m = asset.material;
  asset.color_given = dice.coin();
  for (int i = 0; i < 3 && asset.color_given; ++i) m.color[i] = dice.single(0, 1);
  m.opacity_root = dice.single(0, 1), m.opacity_tip = dice.single(0, 1);
  m.width_scale = dice.coin() ? 1.0f : dice.single(0, 100);
  m.diffuse = dice.single(0, 1000), m.specular_r = dice.single(0, 1000), m.exponent_r = dice.single(0, 1e6);
  m.specular_trt = dice.single(0, 1), m.exponent_trt = dice.single(0, 100);
  m.cuticle_tilt = dice.single(-0.78, 0.78), m.shadow_opacity = dice.single(0, 1), m.fibre_spacing = dice.single(1e-6, 1);
  if (dice.coin()) {
    for (float& c : m.tip_color) c = dice.single(0, 1);
    m.tip_blend = dice.coin() ? 0.0f : dice.single(0, 1);
  }
  asset.width_mm = dice.coin() ? 0.0 : dice.real(0, 10);
  asset.position = dice.point(1e6);
  asset.turn_deg = dice.real(-360, 360);
  asset.scale = std::exp(dice.real(-13, 13));
  asset.follow = {dice.whole(0, 1023), dice.real(0, 100), dice.real(0, 1000), dice.whole(0, 0xffffffffu)};
  asset.root_image = dice.coin() ? "" : "/scalp.png";
  asset.points_per_strand = dice.coin() ? 0 : dice.whole(2, 65536);
  asset.ignore_colors = dice.coin();
  return asset;
}

Scene randomScene(uint32_t seed) {
  Dice dice(seed);
  Scene scene;
  for (uint32_t i = dice.whole(0, 3); i-- > 0;) scene.assets.push_back(randomAsset(dice));
  scene.lights.clear();
  for (uint32_t i = dice.whole(0, 4); i-- > 0;) scene.lights.push_back(randomLight(dice));
  scene.ambient = {dice.real(0, 1000), dice.real(0, 1e-3), dice.real(0, 1)};
  if (dice.coin()) {
    scene.sky = SceneSky{dice.color(), dice.color(), dice.color(), dice.real(0, 1000)};
  } else if (dice.coin()) {
    scene.ambient_sh = Harmonics{};
    for (glm::dvec3& c : *scene.ambient_sh) c = dice.point(1000);
  }
  scene.exposure = dice.coin() ? 0.0 : std::exp(dice.real(-20, 13));
  SceneCamera& camera = scene.camera;
  camera.name = dice.coin() ? "" : "front";
  camera.azimuth_deg = dice.real(-360, 360), camera.elevation_deg = dice.real(-90, 90);
  camera.up = dice.coin() ? UpAxis::Y : UpAxis::Z;
  camera.vertical_fov_deg = dice.real(1, 150), camera.margin = dice.real(0.1, 100);
  if (dice.coin()) {
    Camera placed;
    placed.eye = dice.point(1e6), placed.target = dice.point(1), placed.up = dice.point(2);
    placed.vertical_fov = camera.vertical_fov_deg * kDegree;
    placed.orthographic = dice.coin();
    if (placed.orthographic) placed.view_height = std::exp(dice.real(-20, 20));
    placed.near_m = std::exp(dice.real(-20, 5)), placed.far_m = placed.near_m * (1.0 + std::exp(dice.real(-5, 11)));
    placed.reversed_depth = dice.coin();
    camera.placed = placed;
  }
  if (dice.coin()) scene.width = dice.whole(1, 16384), scene.height = dice.whole(1, 16384);
  if (dice.coin()) scene.background = dice.color();
  if (dice.coin()) scene.head = dice.coin();
  scene.method = dice.whole(0, 5);
  scene.k = dice.coin() ? FLK_K_NONE : dice.whole(0, 32);
  scene.k_sort = dice.whole(0, 32);
  scene.payload = dice.whole(0, 1);
  setShown(scene, dice.whole(0, static_cast<uint32_t>(displayNames().size()) - 1));
  scene.tail = dice.whole(0, 3), scene.low_shade = dice.whole(0, 2), scene.capture = dice.whole(0, 2);
  const uint32_t taps[] = {0, 1, 4, 9, 25};
  scene.core_taps = taps[dice.whole(0, 4)];
  if (dice.coin()) scene.near_fade = SceneNearFade{dice.real(0, 1), dice.real(1.1, 1e6)};
  if (dice.coin()) {
    scene.lens = SceneLens{{dice.real(-10, 10), dice.real(-10, 10)}, dice.real(0, 10), dice.real(0.001, 10), dice.real(0, 1)};
  }
  return scene;
}

void expectSame(const SceneAsset& a, const SceneAsset& b) {
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.color_given, b.color_given);
  const FlkMaterial &m = a.material, &n = b.material;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(m.color[i], n.color[i]);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(m.tip_color[i], n.tip_color[i]);
  EXPECT_EQ(m.opacity_root, n.opacity_root);
  EXPECT_EQ(m.opacity_tip, n.opacity_tip);
  EXPECT_EQ(m.width_scale, n.width_scale);
  EXPECT_EQ(m.diffuse, n.diffuse);
  EXPECT_EQ(m.specular_r, n.specular_r);
  EXPECT_EQ(m.exponent_r, n.exponent_r);
  EXPECT_EQ(m.specular_trt, n.specular_trt);
  EXPECT_EQ(m.exponent_trt, n.exponent_trt);
  EXPECT_EQ(m.cuticle_tilt, n.cuticle_tilt);
  EXPECT_EQ(m.shadow_opacity, n.shadow_opacity);
  EXPECT_EQ(m.fibre_spacing, n.fibre_spacing);
  EXPECT_EQ(m.tip_blend, n.tip_blend);
  static_assert(sizeof(FlkMaterial) == 18 * sizeof(float), "another field of materials: compare it above");
  EXPECT_EQ(a.width_mm, b.width_mm);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.turn_deg, b.turn_deg);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.follow, b.follow);
  EXPECT_EQ(a.root_image, b.root_image);
  EXPECT_EQ(a.points_per_strand, b.points_per_strand);
  EXPECT_EQ(a.ignore_colors, b.ignore_colors);
}

void expectSame(const SceneLight& a, const SceneLight& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.azimuth_deg, b.azimuth_deg);
  EXPECT_EQ(a.elevation_deg, b.elevation_deg);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.range_m, b.range_m);
  EXPECT_EQ(a.source_radius_mm, b.source_radius_mm);
  EXPECT_EQ(a.inner_angle_deg, b.inner_angle_deg);
  EXPECT_EQ(a.outer_angle_deg, b.outer_angle_deg);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.shadow, b.shadow);
  EXPECT_EQ(a.shadow_size, b.shadow_size);
}

void expectSame(const SceneCamera& a, const SceneCamera& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.azimuth_deg, b.azimuth_deg);
  EXPECT_EQ(a.elevation_deg, b.elevation_deg);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.margin, b.margin);
  ASSERT_EQ(a.placed.has_value(), b.placed.has_value());
  if (!a.placed) {
    EXPECT_EQ(a.vertical_fov_deg, b.vertical_fov_deg);
    return;
  }
  EXPECT_EQ(a.placed->eye, b.placed->eye);
  EXPECT_EQ(a.placed->target, b.placed->target);
  EXPECT_EQ(a.placed->up, b.placed->up);
  EXPECT_EQ(a.placed->orthographic, b.placed->orthographic);
  EXPECT_EQ(a.placed->vertical_fov, b.placed->vertical_fov);
  EXPECT_EQ(a.placed->view_height, b.placed->view_height);
  EXPECT_EQ(a.placed->near_m, b.placed->near_m);
  EXPECT_EQ(a.placed->far_m, b.placed->far_m);
  EXPECT_EQ(a.placed->reversed_depth, b.placed->reversed_depth);
}

void expectSame(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.assets.size(), b.assets.size());
  for (size_t i = 0; i < a.assets.size(); ++i) expectSame(a.assets[i], b.assets[i]);
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (size_t i = 0; i < a.lights.size(); ++i) expectSame(a.lights[i], b.lights[i]);
  expectSame(a.camera, b.camera);
  EXPECT_EQ(a.ambient, b.ambient);
  ASSERT_EQ(a.sky.has_value(), b.sky.has_value());
  if (a.sky) {
    EXPECT_EQ(a.sky->top, b.sky->top);
    EXPECT_EQ(a.sky->horizon, b.sky->horizon);
    EXPECT_EQ(a.sky->bottom, b.sky->bottom);
    EXPECT_EQ(a.sky->intensity, b.sky->intensity);
  }
  EXPECT_EQ(a.ambient_sh, b.ambient_sh);
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.head, b.head);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.k, b.k);
  EXPECT_EQ(a.k_sort, b.k_sort);
  EXPECT_EQ(a.payload, b.payload);
  EXPECT_EQ(a.display, b.display);
  EXPECT_EQ(a.coloring, b.coloring);
  EXPECT_EQ(a.tail, b.tail);
  EXPECT_EQ(a.core_taps, b.core_taps);
  EXPECT_EQ(a.low_shade, b.low_shade);
  EXPECT_EQ(a.capture, b.capture);
  ASSERT_EQ(a.near_fade.has_value(), b.near_fade.has_value());
  if (a.near_fade) {
    EXPECT_EQ(a.near_fade->start_m, b.near_fade->start_m);
    EXPECT_EQ(a.near_fade->end_m, b.near_fade->end_m);
  }
  ASSERT_EQ(a.lens.has_value(), b.lens.has_value());
  if (a.lens) {
    EXPECT_EQ(a.lens->center[0], b.lens->center[0]);
    EXPECT_EQ(a.lens->center[1], b.lens->center[1]);
    EXPECT_EQ(a.lens->radius, b.lens->radius);
    EXPECT_EQ(a.lens->feather, b.lens->feather);
    EXPECT_EQ(a.lens->inside, b.lens->inside);
  }
}

std::string shellSays(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  return text;
}

}  // namespace

TEST(SceneRoundTrip, EveryFieldOfRandomScenes) {
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    const Scene scene = randomScene(seed);
    expectSame(scene, parseScene(writeScene(scene, seed % 2 == 0)));
    if (HasFailure()) FAIL() << "seed " << seed << "\n" << writeScene(scene);
  }
}

TEST(SceneRoundTrip, TheDefault) { expectSame(Scene{}, parseScene(writeScene(Scene{}))); }

// Fields of view that are no multiple of a degree's float: all within the last bit.
TEST(SceneRoundTrip, FieldsOfViewThatNeverWereDegrees) {
  Dice dice(1);
  int exact = 0;
  for (int i = 0; i < 1000; ++i) {
    Scene scene;
    scene.camera.placed = Camera{};
    const double fov = scene.camera.placed->vertical_fov = dice.real(0.02, 2.6);
    const double back = parseScene(writeScene(scene)).camera.placed->vertical_fov;
    EXPECT_LE(std::fabs(back - fov), std::nextafter(fov, 9.0) - fov);
    exact += back == fov;
  }
  RecordProperty("exact_of_1000", exact);
  EXPECT_GT(exact, 700);
}

TEST(SceneRoundTrip, ColorsAreHexWhereThatIsExact) {
  const Scene scene = parseScene(R"({"background": "#2a2d31", "assets": [{"source": "a", "material":
      {"color": [0.25, 0.5, 0.125], "tip_color": "#d8a860"}}]})");
  const std::string text = writeScene(scene, true);
  EXPECT_NE(text.find("\"background\":\"#2a2d31\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"color\":[0.25,0.5,0.125]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"tip_color\":\"#d8a860\""), std::string::npos) << text;
  EXPECT_THROW(parseScene(R"({"background": [0, 0, 1.5]})"), SceneError);
  EXPECT_THROW(parseScene(R"({"background": [0, 0]})"), SceneError);
}

TEST(SceneRoundTrip, NamesThatAreNotUtf8AreRefused) {
  Scene scene;
  scene.assets.push_back({});
  scene.assets[0].source = "/a\xff.tfx";
  EXPECT_THROW(writeScene(scene), SceneError);
}

TEST(CommandLine, ShellsReadBackWhatIsQuoted) {
  for (const std::string text : {"plain", "", "two words", "it's", "''", "a\"b$HOME`x`\\", "*?[a]~#!&;|<>(){}", "line\nline"}) {
    EXPECT_EQ(shellSays("printf %s: " + shellQuoted(text)), text + ":");
  }
  EXPECT_EQ(shellQuoted("/home/a_b-c.png"), "/home/a_b-c.png");
}

TEST(CommandLine, IsTheSceneWithAbsolutePaths) {
  Scene scene = randomScene(5);
  scene.assets.resize(2);
  scene.assets[0].source = "groom:curly";
  scene.assets[0].root_image = "maps/it's.png";
  scene.assets[1].source = "./hair/../a.tfx";
  scene.assets[1].root_image.clear();
  scene.meshes.assign(1, SceneMesh{});
  scene.meshes[0].source = "./hair/head.glb";
  scene.camera.placed = Camera{};
  scene.camera.name = "front";
  const std::string line = commandLine(scene, "my picture.png");
  EXPECT_EQ(line.rfind("forelock preview --scene '{", 0), 0u) << line;
  EXPECT_EQ(line.substr(line.size() - 20), " -o 'my picture.png'") << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
  // What the shell makes of the fourth word.
  const std::string words = shellSays("set -- " + line + "; printf %s \"$4\"");
  const Scene back = parseScene(words);
  const std::string here = std::filesystem::current_path().string();
  scene.assets[0].root_image = here + "/maps/it's.png";
  scene.assets[1].source = here + "/a.tfx";
  scene.meshes[0].source = here + "/hair/head.glb";
  scene.camera.name.clear();
  expectSame(scene, back);
}

TEST(CommandLine, OutIsNoOption) {
  EXPECT_NE(commandLine(Scene{}, "-x.png").find(" -o ./-x.png"), std::string::npos);
}
