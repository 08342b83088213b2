// What the reference renders: strands, materials, lights, cameras.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace forelock::reference {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

// What a hair is made of; colours linear, factors and exponents as in methods.md section 5.
struct Material {
  double color[3] = {0.5, 0.5, 0.5};
  double opacity_root = 1, opacity_tip = 1;  // [0, 1], linear in the arc-length fraction
  double width_scale = 1;                    // multiplies every radius
  double kd = 1;
  double kr = 0, exponent_r = 1;
  double kt = 0, exponent_trt = 1;
  double cuticle_tilt = 0;     // radian
  double shadow_opacity = 0.5; // opacity of one fibre, `a` of section 4
  double fibre_spacing = 1e-4; // metre, `s` of section 4
  double tip_color[3] = {0.5, 0.5, 0.5};
  double tip_blend = 0;        // [0, 1] share of tip_color at the tip, linear in the arc-length fraction
};

// Polylines, root first. Strand i owns the vertices first_vertex[i] .. first_vertex[i + 1] - 1.
struct Strands {
  std::vector<uint32_t> first_vertex{0};
  std::vector<Vec3> positions;   // world, metre
  std::vector<double> radii;     // metre, before width_scale
  std::vector<double> fraction;  // arc length from the root over the strand's length; setFractions fills it
  std::vector<Vec3> colors{};    // linear RGB per vertex, a factor of the material's; empty: 1

  size_t count() const { return first_vertex.size() - 1; }
};

void setFractions(Strands& strands);
// Appends one strand and its fractions; its colours are 1 where the strands before have any.
void addStrand(Strands& strands, std::span<const Vec3> positions, std::span<const double> radii);
void addStrand(Strands& strands, std::span<const Vec3> positions, double radius);

struct Hair {
  Strands strands;
  Material material;
  uint32_t slot = 0;  // [0, 62], unique in the scene
};

// Colours that vary along or between its strands: a frame with such a hair keeps the colour in every node.
bool hasColors(const Hair& hair);
bool hasColors(const struct Scene& scene);

// Linear RGB, row 0 at v = 0.
struct ColorImage {
  int width = 0, height = 0;
  std::vector<Vec3> texels{};
};
// Bilinear between texel centres, clamped at the border.
Vec3 sampleColor(const ColorImage& image, double u, double v);
// Multiplies the vertex colours of strand i by the image at root_uv[i].
void applyRootColors(Strands& strands, const ColorImage& image, std::span<const std::array<double, 2>> root_uv);

// Matrices are column-major; view_from_world is a rigid motion; clip space is Vulkan's (conventions.md).
struct Camera {
  double view_from_world[16] = {};
  double clip_from_view[16] = {};
  int width = 0, height = 0;
};

// A shadow map of the host, compared at the four texels around a fragment (section 4).
struct HostShadow {
  int width = 0, height = 0;
  std::vector<float> values{};         // row-major
  double texel_from_world[16] = {};    // column-major, projective: texel position (centres at +0.5) and compared value
  int left = 0, top = 0, right = 0, bottom = 0;  // the light's texels: right and bottom are beyond the last
  double bias = 0;                     // in the unit of the values
  bool reversed = false;               // lit where the value is not less
};

enum class LightKind { directional, point, spot };

// Section 4. radiance of a point or spot light is what arrives at one metre.
struct Light {
  Vec3 direction_to_light{0, 1, 0};  // directional: unit, world
  double radiance[3] = {1, 1, 1};
  bool shadow = false;
  int shadow_size = 1024;  // texels along an edge
  bool cover_width = false;  // strands keep of a texel's chances what they cover of it
  LightKind kind = LightKind::directional;
  Vec3 position{};            // point, spot: world, metre
  double range = 0;           // metre, where the window closes; 0: none
  double source_radius = 0;   // metre; nearer than this it grows no brighter
  Vec3 axis{0, -1, 0};        // spot: unit, world, from the light to the scene
  double inner_angle = 0, outer_angle = 0.785398163397448;  // spot: half angles, radian
  std::optional<HostShadow> host_shadow{};
  std::vector<double> visibility{};  // a factor per pixel of the target, row-major; empty: 1
};

// Bit b of word (layer * tiles_y + y) * tiles_x + x: light 32 layer + b reaches the pixels of tile (x, y).
struct LightTiles {
  int tile_size = 0;  // pixels along an edge; 0: every light reaches every pixel
  int tiles_x = 0, tiles_y = 0;
  std::vector<uint32_t> words{};
};

// The cheap shade of section 5.
enum class LowShade { plain, mean_lobes, lobes };

struct Scene {
  std::vector<Hair> hairs;  // in submission order
  std::vector<Light> lights;
  double ambient[3] = {0, 0, 0};
  // Nine coefficients of three channels; world space, order 00, 1-1, 10, 11, 2-2, 2-1, 20, 21, 22.
  std::optional<std::array<std::array<double, 3>, 9>> ambient_sh{};
  LightTiles light_tiles{};
  int core_taps = 25;  // of a full shade: 1, 4, 9 or 25
  LowShade low_shade = LowShade::plain;
};

// Projections of conventions.md. The depth range is standard or reversed; offset moves the centre, in NDC.
struct Projection {
  bool orthographic = false;
  bool reversed = false;
  double tan_half_y = 0.5;  // perspective: tangent of half the vertical angle; orthographic: half the height, metre
  double near_plane = 0.01, far_plane = 100;
  double offset_x = 0, offset_y = 0;
  double pixel_aspect = 1;  // width of a pixel over its height, in metre
};
Camera makeCamera(Vec3 eye, Vec3 target, Vec3 up, const Projection& projection, int width, int height);

// Pixel position of the world point, and its depth along -z; the depth may be anything, the rest is valid before
// the camera only.
struct Projected {
  double x, y, depth;
};
Projected project(const Camera& camera, Vec3 world);
// The world point at the pixel position (centres at +0.5) and depth.
Vec3 unproject(const Camera& camera, double x, double y, double depth);
double nearPlane(const Camera& camera);
bool isPerspective(const Camera& camera);

}  // namespace forelock::reference
