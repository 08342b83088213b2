// Forelock's reference renderer: docs/methods.md in float64, plain and without quantisation unless asked for.
// It shares no code with the SDK or the shaders. Nothing here depends on the number of threads.
#pragma once

#include "reference_lights.h"
#include "reference_scene.h"

#include <concepts>
#include <optional>
#include <string>

namespace forelock::reference {

// Area of a unit pixel on one side of a line, less one half: section 2.
double pixelHalfArea(double t, double nx, double ny);

struct Fragment {
  double depth;     // metre along -z
  double alpha;     // coverage times opacity, (0, 1]
  double coverage;  // before opacity
  Vec3 tangent;     // unit, VIEW space, towards the tip; zero where the two ends cancel
  uint32_t slot;
  uint32_t sequence;  // the segment's number over the scene in submission order: unique in a pixel
  bool has_color = false;  // else it has the material's
  std::array<double, 3> color{};
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
// `kept`: float64 values of the fragments that `standard` keeps.
enum class Payload { unquantised, kept, standard, paper };

// Opacity modifiers of section 2.
struct NearFade {
  double start = 0, end = 1;  // metre; gone before start, whole beyond end
};
struct Lens {
  double x = 0, y = 0;  // centre, pixels from the target's corner
  double radius = 0, feather = 1;  // pixels
  double inside = 0;    // factor in the middle
};
struct OpacityModifiers {
  std::optional<NearFade> near_fade{};
  std::optional<Lens> lens{};
};
// x, y: the pixel's centre.
double opacityModifier(const OpacityModifiers& modifiers, double x, double y, double depth);

struct GatherOptions {
  std::span<const double> host_depth{};  // linear depth per pixel, row-major; empty: nothing before the hair
  Payload payload = Payload::unquantised;
  int threads = 2;
  OpacityModifiers modifiers{};
};
FragmentLists gatherFragments(const Scene& scene, const Camera& camera, const GatherOptions& options = {});
// Decoded after coding; alpha 0 means dropped.
double codedAlpha(double alpha, Payload payload);
Vec3 codedTangent(Vec3 tangent, Payload payload);
// Nine bits a channel and a shared exponent of five (bias 15, no sign), but for unquantised.
std::array<double, 3> codedColor(const std::array<double, 3>& color, Payload payload);
// Octahedral, the first component in the low bits; all bits set for the zero tangent. bits: of a component.
uint32_t tangentCode(Vec3 tangent, int bits);
Vec3 tangentOf(uint32_t code, int bits);
// Method hard: at most one fragment a pixel, of alpha 1. A payload other than unquantised rounds the tangent.
FragmentLists gatherHard(const Scene& scene, const Camera& camera, const GatherOptions& options = {});

// Section 6. hard is for the lists of gatherHard: the nearest fragment, fully shaded and opaque.
enum class Method { exact, forward, core_tail, core_only, all_low, hard };
// Of core_tail, core_only and all_low; the tail of forward is in list order.
enum class TailOrder { list, deterministic, once };

struct ResolveOptions {
  Method method = Method::exact;
  int k = 8;       // fully shaded (core_tail, core_only)
  int k_sort = 8;  // sorted (all but exact and hard); k <= k_sort
  int threads = 2;
  TailOrder tail = TailOrder::list;
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
Image resolveLit(const Scene& scene, const Camera& camera, std::span<const LightMaps> maps, const FragmentLists& lists,
                 const ResolveOptions& options = {});
// The same under the one name. A template, so that {} stands for no maps of either type.
template <std::convertible_to<std::span<const LightMaps>> Maps>
Image resolve(const Scene& scene, const Camera& camera, const Maps& maps, const FragmentLists& lists,
              const ResolveOptions& options = {}) {
  return resolveLit(scene, camera, maps, lists, options);
}

Image renderHard(const Scene& scene, const Camera& camera, std::span<const LightMaps> maps,
                 const GatherOptions& options = {});

// Section 5 for one fragment. T, L, V unit vectors of one space; light in [0, 1] per light.
struct LobeInput {
  Vec3 tangent, to_light, to_eye;
};
enum class Lobes { none, mean, own };
// kd sin colour + kr lobe1 + kt lobe2 colour, without radiance; the mean is over all angles.
std::array<double, 3> shadeLobes(const Material& material, const LobeInput& input, Lobes lobes);
inline std::array<double, 3> shadeLobes(const Material& material, const LobeInput& input, bool full) {
  return shadeLobes(material, input, full ? Lobes::own : Lobes::none);
}
double meanLobe(double exponent);
// faces[i]: the maps of light i; lights beyond the span are lit.
std::array<double, 3> shadeFragmentLit(const Scene& scene, const Camera& camera,
                                       std::span<const std::span<const ShadowMap>> faces, int x, int y,
                                       const Fragment& fragment, bool full);
// One map a light.
std::array<double, 3> shadeFragment(const Scene& scene, const Camera& camera, std::span<const ShadowMap> maps, int x,
                                    int y, const Fragment& fragment, bool full);

// R_cover: opacity per pixel, row-major, of samples x samples points; what the coverage of section 2 stands for.
// Strips end flush at root and tip and meet on the bisector, clamped as in section 1 with the reach h.
std::vector<double> renderCover(const Scene& scene, const Camera& camera, int samples = 16, int threads = 2);
// 1 - T of a resolved image, and of fragment lists (no shading).
std::vector<double> opacityOf(const Image& image);
std::vector<double> opacityOf(const FragmentLists& lists);

// Section 8. In 0..255 after exposure and clamp; over the pixels with a fragment in either image.
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
