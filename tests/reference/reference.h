// Forelock's reference renderer: docs/methods.md in float64, plain and without quantisation unless asked for.
// It shares no code with the SDK or the shaders. Nothing here depends on the number of threads.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
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
};

// Polylines, root first. Strand i owns the vertices first_vertex[i] .. first_vertex[i + 1] - 1.
struct Strands {
  std::vector<uint32_t> first_vertex{0};
  std::vector<Vec3> positions;   // world, metre
  std::vector<double> radii;     // metre, before width_scale
  std::vector<double> fraction;  // arc length from the root over the strand's length; setFractions fills it

  size_t count() const { return first_vertex.size() - 1; }
};

void setFractions(Strands& strands);
// Appends one strand and its fractions.
void addStrand(Strands& strands, std::span<const Vec3> positions, std::span<const double> radii);
void addStrand(Strands& strands, std::span<const Vec3> positions, double radius);

struct Hair {
  Strands strands;
  Material material;
  uint32_t slot = 0;  // [0, 62], unique in the scene
};

// Matrices are column-major; view_from_world is a rigid motion; clip space is Vulkan's (conventions.md).
struct Camera {
  double view_from_world[16] = {};
  double clip_from_view[16] = {};
  int width = 0, height = 0;
};

struct Light {
  Vec3 direction_to_light{0, 1, 0};  // unit, world
  double radiance[3] = {1, 1, 1};
  bool shadow = false;
  int shadow_size = 1024;  // texels along an edge
};

struct Scene {
  std::vector<Hair> hairs;  // in submission order
  std::vector<Light> lights;
  double ambient[3] = {0, 0, 0};
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

struct Sphere {
  Vec3 center;
  double radius = 0;
};
// The sphere of section 4. Of several hairs each has its own enlarged sphere first.
Sphere boundingSphere(const Hair& hair);
Sphere boundingSphere(const Scene& scene);

// size == 0: no map, everything lit. depth is row-major, metre along z from the sphere's near side, infinity: empty.
struct ShadowMap {
  int size = 0;
  double texel = 0, rho = 0;  // metre
  Vec3 center, x, y, z;       // world
  std::vector<float> depth;
};

// Axes, texel size and empty depths; for a map that comes from elsewhere.
ShadowMap shadowFrame(const Sphere& sphere, Vec3 direction_to_light, int size);
ShadowMap renderShadowMap(const Scene& scene, const Light& light);
ShadowMap renderShadowMap(const Scene& scene, const Light& light, const Sphere& sphere);
// One per light; lights without a shadow get an empty map.
std::vector<ShadowMap> renderShadowMaps(const Scene& scene);
// Transmittance of one tap: map_depth and the fragment's D in metre.
double shadowTap(double depth, double map_depth, double bias, double opacity, double spacing);
double gaussianWeight(int i, int j);  // |i|, |j| <= 2; the 25 sum to 1
// Light that reaches the world point on a strand of that unit tangent.
double shadowLight(const ShadowMap& map, const Material& material, Vec3 position, Vec3 tangent, bool core);

// Area of a unit pixel on one side of a line, less one half: section 2.
double pixelHalfArea(double t, double nx, double ny);

struct Fragment {
  double depth;     // metre along -z
  double alpha;     // coverage times opacity, (0, 1]
  double coverage;  // before opacity
  Vec3 tangent;     // unit, VIEW space, towards the tip; zero where the two ends cancel
  uint32_t slot;
  uint32_t sequence;  // the segment's number over the scene in submission order: unique in a pixel
};

// Pixel (x, y) owns fragments[first[y * width + x]] .. first[... + 1], in submission order.
struct FragmentLists {
  int width = 0, height = 0;
  std::vector<uint64_t> first;
  std::vector<Fragment> fragments;

  std::span<const Fragment> at(int x, int y) const {
    const size_t pixel = size_t(y) * size_t(width) + size_t(x);
    return {fragments.data() + first[pixel], size_t(first[pixel + 1] - first[pixel])};
  }
};

// What a node keeps of a fragment (section 3). `unquantised` keeps float64 and drops only alpha = 0.
enum class Payload { unquantised, standard, paper };

struct GatherOptions {
  std::span<const double> host_depth{};  // linear depth per pixel, row-major; empty: nothing before the hair
  Payload payload = Payload::unquantised;
  int threads = 2;
};
FragmentLists gatherFragments(const Scene& scene, const Camera& camera, const GatherOptions& options = {});
// Decoded after coding; alpha 0 means dropped.
double codedAlpha(double alpha, Payload payload);
Vec3 codedTangent(Vec3 tangent, Payload payload);

// exact: all in key order. forward: all full, k_sort in order, the rest in list order. core_tail: section 6.
// core_only: core_tail whose tail has opacity but no colour.
enum class Method { exact, forward, core_tail, core_only };

struct ResolveOptions {
  Method method = Method::exact;
  int k = 8;       // fully shaded (core_tail, core_only)
  int k_sort = 8;  // sorted (all but exact); k <= k_sort
  int threads = 2;
};

// Linear, hair over black; T is what the background keeps.
struct Pixel {
  double rgb[3] = {0, 0, 0};
  double transmittance = 1;
  uint32_t fragments = 0;
};
struct Image {
  int width = 0, height = 0;
  std::vector<Pixel> pixels;

  Pixel& at(int x, int y) { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
  const Pixel& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

// maps: one per light (an empty span: all lit). They may be the device's, read back.
Image resolve(const Scene& scene, const Camera& camera, std::span<const ShadowMap> maps, const FragmentLists& lists,
              const ResolveOptions& options = {});

// Section 5 for one fragment. T, L, V unit vectors of one space; light in [0, 1] per light.
struct LobeInput {
  Vec3 tangent, to_light, to_eye;
};
// kd sin colour + kr lobe1 + kt lobe2 colour (the lobes only if full), without radiance.
std::array<double, 3> shadeLobes(const Material& material, const LobeInput& input, bool full);
std::array<double, 3> shadeFragment(const Scene& scene, const Camera& camera, std::span<const ShadowMap> maps, int x,
                                    int y, const Fragment& fragment, bool full);

// R_cover: opacity per pixel, row-major, of samples x samples points; what the coverage of section 2 stands for.
// Strips end flush at root and tip and meet on the bisector, clamped as in section 1 with the reach h.
std::vector<double> renderCover(const Scene& scene, const Camera& camera, int samples = 16, int threads = 2);
// 1 - T of a resolved image, and of fragment lists (no shading).
std::vector<double> opacityOf(const Image& image);
std::vector<double> opacityOf(const FragmentLists& lists);

// Section 7. In 0..255 after exposure and clamp; over the pixels with a fragment in either image.
struct Difference {
  double rmse = 0;             // squared errors of the three channels summed
  double rmse_channel[3] = {0, 0, 0};
  double p999 = 0;             // of the per-pixel root of that sum
  double mean_a = 0, mean_b = 0;  // mean over pixels and channels
  size_t pixels = 0;
};
Difference compare(const Image& a, const Image& b, double exposure = 1);

// Portable float maps for a failing test: linear RGB, bottom row first as the format wants. False: not written.
bool writePfm(const std::string& path, const Image& image);
bool writePfm(const std::string& path, std::span<const double> gray, int width, int height);

}  // namespace forelock::reference
