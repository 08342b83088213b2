// A scene in a JSON file: what `forelock preview` and `forelock plan` draw. docs/scene.md explains every key.
// SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"
#include "scene_keys.h"
#include "scene_light.h"
#include "strand_color.h"

#include <forelock/render.h>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

// Brown hair with narrower highlights and softer shadows than flkMaterialDefault, whose weights are those of a
// real-time sample of 2018.
FlkMaterial pictureMaterial();

// Strands beside each strand of an asset.
struct SceneFollow {
  uint32_t count = 0;
  double radius_mm = 1.0;  // where a unit is a metre
  double spread_tip = 1.0;
  uint32_t seed = 1;
  bool operator==(const SceneFollow&) const = default;
};

struct SceneAsset {
  std::string source;  // as on the command line: a file or groom:NAME
  FlkMaterial material = pictureMaterial();
  bool color_given = false;  // material.color is meant: else it is pictureMaterial's, and an asset with colours of its own has white
  double width_mm = 0.0;  // diameter of the widest vertex where a unit is a metre; 0: as the asset has it
  glm::dvec3 position{0.0, 0.0, 0.0};  // (m)
  double turn_deg = 0.0;               // about the up axis
  double scale = 1.0;
  SceneFollow follow;
  std::string root_image;      // path; empty: none
  uint32_t points_per_strand = 0;  // of a PLY file of bare points; 0: none
  bool ignore_colors = false;  // leave the asset's vertex colours out
};

// Opaque triangles beside the hair.
struct SceneMesh {
  std::string source;  // path of a glTF or GLB file
  glm::dvec3 position{0.0, 0.0, 0.0};  // (m)
  double turn_deg = 0.0;               // about the up axis
  double scale = 1.0;
  std::optional<glm::dvec3> color;     // linear; none: the file's
};

// Hair fades in between two view depths.
struct SceneNearFade {
  double start_m = 0.0, end_m = 0.0;
};

// A disc of the picture in which hair is let through.
struct SceneLens {
  double center[2] = {0.5, 0.5};  // share of width and height, from the upper left
  double radius = 0.15;           // share of the height
  double feather = 0.05;          // likewise
  double inside = 0.1;            // what is left of opacity
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
  std::vector<SceneMesh> meshes;
  std::vector<SceneLight> lights = std::vector<SceneLight>(1);
  glm::dvec3 ambient{0.06, 0.065, 0.075};  // radiance from everywhere, times the exposure
  std::optional<SceneSky> sky;             // added to it, at most one of the two
  std::optional<Harmonics> ambient_sh;     // (world)
  double exposure = 0.0;                 // what all light is multiplied by; 0: chosen from a small first picture
  SceneCamera camera;
  uint32_t width = 0, height = 0;        // 0: the stored camera's, else 1024 x 1024
  std::optional<glm::dvec3> background;  // linear; none: transparent
  std::optional<bool> head;              // none: where a groom lies on the bust
  uint32_t method = FLK_METHOD_CORE_TAIL;
  uint32_t k = 0, k_sort = 0;            // as in FlkFrame
  uint32_t payload = FLK_PAYLOAD_DEFAULT;
  uint32_t display = FLK_DISPLAY_SHADED;
  StrandColoring coloring = StrandColoring::none;  // other than none: display is FLK_DISPLAY_SHADED
  uint32_t tail = FLK_TAIL_DEFAULT;
  uint32_t core_taps = 0;                // as in FlkFrame
  uint32_t low_shade = FLK_LOW_SHADE_DEFAULT;
  uint32_t capture = FLK_CAPTURE_DEFAULT;
  std::optional<SceneNearFade> near_fade;
  std::optional<SceneLens> lens;
};

// Throws SceneError.
Scene parseScene(const std::string& text);

// Throws SceneError, also when the file cannot be read. Relative paths of sources start at the scene's folder.
Scene loadScene(const std::string& path);

// A scene that parseScene reads back as it was, numbers to the last bit; of a light what its kind has, of a camera that is placed the
// field of view of its place. Throws SceneError where a name is not UTF-8.
std::string writeScene(const Scene& scene, bool one_line = false);

// --scene takes a file, or a scene itself: sources of such a one start at the working folder.
inline bool isInlineScene(const std::string& argument) { return !argument.empty() && argument[0] == '{'; }

// Names as the command and scene files spell them; in the order of the FLK_... values.
const std::vector<std::string>& methodNames();
const std::vector<std::string>& payloadNames();
const std::vector<std::string>& displayNames();  // then those of coloringNames() from its second
void setShown(Scene& scene, uint32_t index);      // by an index of displayNames()
const std::string& shownName(const Scene& scene);
const std::vector<std::string>& tailNames();
const std::vector<std::string>& lowShadeNames();
const std::vector<std::string>& captureNames();

}  // namespace forelock::samples
