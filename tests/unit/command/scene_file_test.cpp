// Scene files: what is read, what is refused and how it is said, and that a written scene reads back as it was.
#include "scene_file.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace forelock::samples;

namespace {

std::string faultOf(const std::string& text) {
  try {
    parseScene(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST(SceneFile, SaysKeyValueAndRange) {
  EXPECT_EQ(faultOf("[1]"), "the scene must be an object { ... }");
  EXPECT_EQ(faultOf("{\n\"light\": }").rfind("not valid JSON (line 2", 0), 0u) << faultOf("{\n\"light\": }");
  EXPECT_EQ(faultOf(R"({"lamp": 1})").rfind("lamp is no key of a scene; known here: assets, light", 0), 0u);
  EXPECT_EQ(faultOf(R"({"light": {"hue": 1}})").rfind("light.hue is no key of a scene", 0), 0u);
  EXPECT_EQ(faultOf(R"({"light": 3})"), "light must be an object { ... }");
  EXPECT_EQ(faultOf(R"({"light": {"shadow": 1}})"), "light.shadow is 1, must be true or false");
  EXPECT_EQ(faultOf(R"({"light": {"color": "red"}})"), "light.color is \"red\", must be sRGB as \"#rrggbb\"");
  EXPECT_EQ(faultOf(R"({"size": [0, 10]})"), "size is [0,10], must be two whole numbers in [1, 16384]");
  EXPECT_EQ(faultOf(R"({"method": "best"})"), "method is \"best\", must be one of core_tail, exact, forward");
  EXPECT_EQ(faultOf(R"({"assets": [{}]})"), "assets[0].source is missing");
  EXPECT_EQ(faultOf(R"({"assets": [{"source": "a", "material": {"opacity_tip": 2}}]})"),
            "assets[0].material.opacity_tip is 2, must be a number in [0, 1]");
  EXPECT_EQ(faultOf(R"({"camera": {"eye": [0, 0, 1]}})"), "camera.target is missing");
  EXPECT_EQ(faultOf(R"({"camera": {"near": 1}})"), "camera.near belongs to a camera with eye, which is missing");
  EXPECT_EQ(faultOf(R"({"camera": {"eye": [0, 0, 1], "target": [0, 0, 1]}})"),
            "camera.target is the same as camera.eye, must differ");
}

TEST(SceneFile, ZeroKIsNone) {
  EXPECT_EQ(parseScene("{}").k, 0u);
  EXPECT_EQ(parseScene(R"({"k": 0})").k, FLK_K_NONE);
  EXPECT_EQ(parseScene(R"({"k": 5})").k, 5u);
}

TEST(SceneFile, WrittenScenesReadBack) {
  const std::string text = R"({"assets": [{"source": "groom:long-wavy", "turn": 30, "material":
      {"color": "#c9a26b", "opacity_tip": 0.4, "width_mm": 0.2, "exponent_r": 33.3}}],
      "camera": {"eye": [1, 2, 3], "target": [0, 0, 0.5], "vertical_fov": 20, "near": 0.2, "far": 9, "up": "z"},
      "light": {"azimuth": 10, "shadow": false}, "size": [80, 100], "background": "#2a2d31", "head": false, "k": 0,
      "method": "exact", "show": "depth", "payload": "paper", "exposure": 3})";
  const Scene scene = parseScene(text);
  ASSERT_TRUE(scene.camera.placed);
  EXPECT_EQ(scene.camera.placed->up, glm::dvec3(0, 0, 1));
  EXPECT_NEAR(scene.camera.placed->vertical_fov, 0.3490658503988659, 1e-15);
  EXPECT_EQ(scene.display, static_cast<uint32_t>(FLK_DISPLAY_DEPTH));
  const std::string written = writeScene(scene);
  EXPECT_EQ(writeScene(parseScene(written)), written);
  EXPECT_EQ(writeScene(parseScene(writeScene(Scene{}))), writeScene(Scene{}));
}

TEST(SceneFile, ColorsAreSrgb) {
  glm::dvec3 linear;
  ASSERT_TRUE(parseHexColor("#ff8000", linear));
  EXPECT_EQ(linear.x, 1.0);
  EXPECT_NEAR(linear.y, 0.21586, 1e-5);  // IEC 61966-2-1 of 128/255
  EXPECT_EQ(linear.z, 0.0);
  for (const char* text : {"#000000", "#0a0b0c", "#7f80fe", "#ffffff"}) {
    ASSERT_TRUE(parseHexColor(text, linear));
    EXPECT_EQ(hexColor(linear), text);
  }
  for (const char* text : {"", "#12345", "12345g", "#1234567", "red"}) {
    EXPECT_FALSE(parseHexColor(text, linear)) << text;
  }
}
