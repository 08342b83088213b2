// A scene in a JSON file: what `forelock preview` and `forelock plan` draw. docs/scene.md explains every key.
// SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"

#include <forelock/render.h>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::samples {

// What is wrong with a scene, as one sentence that names the key, the value and the range.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Brown hair with narrower highlights and softer shadows than flkMaterialDefault, whose weights are those of a
// real-time sample of 2018.
FlkMaterial pictureMaterial();

struct SceneAsset {
  std::string source;  // as on the command line: a file or groom:NAME
  FlkMaterial material = pictureMaterial();
  double width_mm = 0.0;  // diameter of the widest vertex where a unit is a metre; 0: as the asset has it
  glm::dvec3 position{0.0, 0.0, 0.0};  // (m)
  double turn_deg = 0.0;               // about the up axis
  double scale = 1.0;
};

// Directions are seen from the camera: azimuth 0 shines along the view, negative comes from the left.
struct SceneLight {
  double azimuth_deg = -42.0;
  double elevation_deg = 44.0;
  glm::dvec3 color{1.0, 0.97, 0.93};  // linear
  bool shadow = true;
  uint32_t shadow_size = 2048;
};

struct SceneCamera {
  std::string name;              // of a camera that the groom stores; empty: framed
  double azimuth_deg = 32.0;
  double elevation_deg = 8.0;
  UpAxis up = UpAxis::Y;
  double vertical_fov_deg = 24.0;
  double margin = 1.06;          // 1.06 leaves 6 % around the hair
  std::optional<Camera> placed;  // by eye and target
};

struct Scene {
  std::vector<SceneAsset> assets;
  SceneLight light;
  glm::dvec3 ambient{0.06, 0.065, 0.075};  // share of the light's radiance
  double exposure = 0.0;                 // radiance of the light; 0: chosen from a small first picture
  SceneCamera camera;
  uint32_t width = 0, height = 0;        // 0: the stored camera's, else 1024 x 1024
  std::optional<glm::dvec3> background;  // linear; none: transparent
  std::optional<bool> head;              // none: where a groom lies on the bust
  uint32_t method = FLK_METHOD_CORE_TAIL;
  uint32_t k = 0, k_sort = 0;            // as in FlkFrame
  uint32_t payload = FLK_PAYLOAD_DEFAULT;
  uint32_t display = FLK_DISPLAY_SHADED;
};

// Throws SceneError.
Scene parseScene(const std::string& text);

// Throws SceneError, also when the file cannot be read. Relative paths of sources start at the scene's folder.
Scene loadScene(const std::string& path);

// A scene that parseScene reads back as it was.
std::string writeScene(const Scene& scene);

// Names as the command and scene files spell them; in the order of the FLK_... values.
const std::vector<std::string>& methodNames();
const std::vector<std::string>& payloadNames();
const std::vector<std::string>& displayNames();

// "c08040" or "#c08040" to linear. False: not six hexadecimal digits.
bool parseHexColor(const std::string& text, glm::dvec3& linear);
std::string hexColor(const glm::dvec3& linear);

}  // namespace forelock::samples
