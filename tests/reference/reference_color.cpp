// The colour of the fibre (section 2) and how a node keeps it (section 3); the opacity modifiers.
#include "reference_quads.h"

namespace forelock::reference {
namespace {

// RGB9E5 as GL_EXT_texture_shared_exponent defines it.
constexpr int mantissa_bits = 9, exponent_bias = 15, exponent_max = 31;

}  // namespace

bool hasColors(const Hair& hair) { return !hair.strands.colors.empty() || hair.material.tip_blend != 0; }

bool hasColors(const Scene& scene) {
  return std::any_of(scene.hairs.begin(), scene.hairs.end(), [](const Hair& hair) { return hasColors(hair); });
}

std::array<double, 3> fibreColor(const Material& material, const ScreenSegment& segment, double u, double fraction) {
  const Vec3 vertex = mix(segment.color_a, segment.color_b, u);
  const double factor[3] = {vertex.x, vertex.y, vertex.z};
  std::array<double, 3> out{};
  for (size_t c = 0; c < 3; ++c) {
    out[c] = factor[c] * mix(material.color[c], material.tip_color[c], material.tip_blend * fraction);
  }
  return out;
}

std::array<double, 3> codedColor(const std::array<double, 3>& color, Payload payload) {
  if (payload == Payload::unquantised || payload == Payload::kept) return color;
  const double mantissas = std::exp2(mantissa_bits);
  const double brightest = (mantissas - 1) / mantissas * std::exp2(exponent_max - exponent_bias);
  std::array<double, 3> c{};
  for (size_t i = 0; i < 3; ++i) c[i] = color[i] > 0 ? std::min(color[i], brightest) : 0;  // NaN becomes 0
  const double largest = std::max({c[0], c[1], c[2]});
  int exponent = -exponent_bias - 1;
  if (largest > 0) exponent = std::max(exponent, std::ilogb(largest));
  exponent += 1 + exponent_bias;
  auto step = [](int e) { return std::exp2(e - exponent_bias - mantissa_bits); };
  if (std::floor(largest / step(exponent) + 0.5) == mantissas) ++exponent;
  for (double& v : c) v = std::floor(v / step(exponent) + 0.5) * step(exponent);
  return c;
}

Vec3 sampleColor(const ColorImage& image, double u, double v) {
  const double x = std::clamp(u * image.width - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  auto at = [&](int column, int row) { return image.texels[size_t(row) * size_t(image.width) + size_t(column)]; };
  return mix(mix(at(x0, y0), at(x1, y0), x - x0), mix(at(x0, y1), at(x1, y1), x - x0), y - y0);
}

void applyRootColors(Strands& strands, const ColorImage& image, std::span<const std::array<double, 2>> root_uv) {
  strands.colors.resize(strands.positions.size(), {1, 1, 1});
  for (size_t strand = 0; strand < strands.count(); ++strand) {
    const Vec3 texel = sampleColor(image, root_uv[strand][0], root_uv[strand][1]);
    for (size_t v = strands.first_vertex[strand]; v < strands.first_vertex[strand + 1]; ++v) {
      Vec3& color = strands.colors[v];
      color = {color.x * texel.x, color.y * texel.y, color.z * texel.z};
    }
  }
}

double opacityModifier(const OpacityModifiers& modifiers, double x, double y, double depth) {
  double factor = 1;
  if (modifiers.near_fade) {
    const NearFade& fade = *modifiers.near_fade;
    factor *= std::clamp((depth - fade.start) / (fade.end - fade.start), 0.0, 1.0);
  }
  if (modifiers.lens) {
    const Lens& lens = *modifiers.lens;
    const double beyond = std::hypot(x - lens.x, y - lens.y) - lens.radius;
    const double q = lens.feather > 0 ? std::clamp(beyond / lens.feather, 0.0, 1.0) : beyond > 0 ? 1 : 0;
    factor *= lens.inside + (1 - lens.inside) * q * q * (3 - 2 * q);
  }
  return factor;
}

}  // namespace forelock::reference
