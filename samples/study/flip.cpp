// SPDX-License-Identifier: MIT
#include "flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace forelock::study {
namespace {

// Exponents and knees of the paper's sections 4.1.3, 4.2 and 4.3.
constexpr double kColorExponent = 0.7, kKneeIn = 0.4, kKneeOut = 0.95;
constexpr double kFeatureExponent = 0.5, kFeatureWidthDegree = 0.082;

// Contrast sensitivity of the three opponent channels: sums of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees
// (table 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
constexpr double kWidestB = 0.04;

// Rec. 709 with white D65 to XYZ.
constexpr double kXyzOfRgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double kWhite[3] = {0.950428545377181, 1.0, 1.088900370798128};

using Color = std::array<double, 3>;

Color xyzOfLinear(double r, double g, double b) {
  Color xyz;
  for (std::size_t i = 0; i < 3; ++i) xyz[i] = kXyzOfRgb[i][0] * r + kXyzOfRgb[i][1] * g + kXyzOfRgb[i][2] * b;
  return xyz;
}

// The inverse of kXyzOfRgb, by cofactors.
Color linearOfXyz(const Color& xyz) {
  static const std::array<std::array<double, 3>, 3> inverse = [] {
    std::array<std::array<double, 3>, 3> m{};
    const auto& a = kXyzOfRgb;
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
        m[i][j] = a[r0][c0] * a[r1][c1] - a[r0][c1] * a[r1][c0];
      }
    for (std::size_t j = 0; j < 3; ++j) determinant += a[0][j] * m[j][0];
    for (auto& row : m)
      for (double& v : row) v /= determinant;
    return m;
  }();
  Color rgb;
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = inverse[i][0] * xyz[0] + inverse[i][1] * xyz[1] + inverse[i][2] * xyz[2];
  return rgb;
}

struct Plane {
  uint32_t width, height;
  std::vector<float> values;
};

// Weights of offsets -radius .. radius.
using Kernel = std::vector<float>;

Kernel gaussian(int radius, double scale) {  // exp(-scale x^2)
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(float(std::exp(-scale * x * x)));
  return kernel;
}

double sumOf(const Kernel& kernel) {
  double sum = 0;
  for (const float w : kernel) sum += double(w);
  return sum;
}

// Rows, then columns; beyond the border the border goes on.
Plane separable(const Plane& in, const Kernel& across, const Kernel& down) {
  const int width = int(in.width), height = int(in.height), radius = int(across.size() / 2);
  Plane rows{in.width, in.height, std::vector<float>(in.values.size())}, out = rows;
  std::vector<float> line(std::size_t(width + 2 * radius));
  for (int y = 0; y < height; ++y) {
    const float* from = &in.values[std::size_t(y) * in.width];
    for (int x = -radius; x < width + radius; ++x) line[std::size_t(x + radius)] = from[std::clamp(x, 0, width - 1)];
    float* to = &rows.values[std::size_t(y) * in.width];
    for (std::size_t i = 0; i < across.size(); ++i)
      for (int x = 0; x < width; ++x) to[x] += across[i] * line[std::size_t(x) + i];
  }
  for (int y = 0; y < height; ++y) {
    float* to = &out.values[std::size_t(y) * in.width];
    for (int i = -radius; i <= radius; ++i) {
      const float weight = down[std::size_t(i + radius)];
      const float* from = &rows.values[std::size_t(std::clamp(y + i, 0, height - 1)) * in.width];
      for (int x = 0; x < width; ++x) to[x] += weight * from[x];
    }
  }
  return out;
}

// What the eye tells apart at that distance: opponent channels (Y, Cx, Cz), each blurred by its sensitivity.
struct Seen {
  std::vector<Color> hunt;  // Hunt-adjusted L*a*b* after the blur
  Plane luminance;          // of before it, in [0, 1]
};

Seen see(const FlipInput& image, double ppd) {
  Plane opponent[3];
  for (Plane& plane : opponent) plane = {image.width, image.height, std::vector<float>(image.rgb.size() / 3)};
  Seen seen;
  seen.luminance = opponent[0];
  for (std::size_t i = 0; i < image.rgb.size() / 3; ++i) {
    Color xyz = xyzOfLinear(double(image.rgb[i * 3]), double(image.rgb[i * 3 + 1]), double(image.rgb[i * 3 + 2]));
    for (std::size_t c = 0; c < 3; ++c) xyz[c] /= kWhite[c];
    opponent[0].values[i] = float(116 * xyz[1] - 16);
    opponent[1].values[i] = float(500 * (xyz[0] - xyz[1]));
    opponent[2].values[i] = float(200 * (xyz[1] - xyz[2]));
    seen.luminance.values[i] = float(xyz[1]);
  }
  constexpr double pi = std::numbers::pi;
  const int radius = int(std::ceil(3 * std::sqrt(kWidestB / (2 * pi * pi)) * ppd));
  for (std::size_t c = 0; c < 3; ++c) {
    const Sensitivity& s = kSensitivity[c];
    const Kernel first = gaussian(radius, pi * pi / (s.b1 * ppd * ppd)), second = gaussian(radius, pi * pi / (s.b2 * ppd * ppd));
    const double w1 = s.a1 * std::sqrt(pi / s.b1), w2 = s.a2 * std::sqrt(pi / s.b2);
    const double total = w1 * sumOf(first) * sumOf(first) + w2 * sumOf(second) * sumOf(second);
    const auto scaled = [](Kernel kernel, double factor) {
      for (float& w : kernel) w = float(double(w) * factor);
      return kernel;
    };
    Plane blurred = separable(opponent[c], scaled(first, w1 / total), first);
    if (s.a2 != 0) {
      const Plane more = separable(opponent[c], scaled(second, w2 / total), second);
      for (std::size_t i = 0; i < blurred.values.size(); ++i) blurred.values[i] += more.values[i];
    }
    opponent[c] = std::move(blurred);
  }
  seen.hunt.resize(image.rgb.size() / 3);
  for (std::size_t i = 0; i < seen.hunt.size(); ++i) {
    const double y = (double(opponent[0].values[i]) + 16) / 116;
    const double x = y + double(opponent[1].values[i]) / 500, z = y - double(opponent[2].values[i]) / 200;
    const Color rgb = linearOfXyz({x * kWhite[0], y * kWhite[1], z * kWhite[2]});
    seen.hunt[i] = huntAdjusted(labOfLinear(std::clamp(rgb[0], 0.0, 1.0), std::clamp(rgb[1], 0.0, 1.0), std::clamp(rgb[2], 0.0, 1.0)));
  }
  return seen;
}

// Derivatives of a Gaussian: the first finds edges, the second points. Positive and negative weights sum to 1 each.
struct Features {
  std::vector<float> edge, point;  // magnitudes
};

Features findFeatures(const Plane& luminance, double ppd) {
  const double deviation = 0.5 * kFeatureWidthDegree * ppd;
  const int radius = int(std::ceil(3 * deviation));
  Kernel smooth = gaussian(radius, 1 / (2 * deviation * deviation)), first, second;
  for (int x = -radius; x <= radius; ++x) {
    const float g = smooth[std::size_t(x + radius)];
    first.push_back(float(-x) * g);
    second.push_back(float(x * x / (deviation * deviation) - 1) * g);
  }
  const auto normalise = [](Kernel& kernel) {
    double positive = 0, negative = 0;
    for (const float w : kernel) (w > 0 ? positive : negative) += std::fabs(double(w));
    for (float& w : kernel) w = float(double(w) / (w > 0 ? positive : negative > 0 ? negative : 1));
  };
  normalise(smooth), normalise(first), normalise(second);
  const auto magnitude = [&](const Kernel& kernel) {
    const Plane x = separable(luminance, kernel, smooth), y = separable(luminance, smooth, kernel);
    std::vector<float> out(x.values.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
    return out;
  };
  return {magnitude(first), magnitude(second)};
}

}  // namespace

std::array<double, 3> labOfLinear(double r, double g, double b) {
  const Color xyz = xyzOfLinear(r, g, b);
  constexpr double delta = 6.0 / 29;
  const auto f = [&](double t) { return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29; };
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

std::array<double, 3> huntAdjusted(const std::array<double, 3>& lab) {
  return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

double hyab(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

double flipColorMaximum() {
  static const double most = std::pow(hyab(huntAdjusted(labOfLinear(0, 1, 0)), huntAdjusted(labOfLinear(0, 0, 1))), kColorExponent);
  return most;
}

double redistributed(double powered) {
  const double most = flipColorMaximum(), knee = kKneeIn * most;
  const double value = powered < knee ? kKneeOut / knee * powered : kKneeOut + (powered - knee) / (most - knee) * (1 - kKneeOut);
  return std::clamp(value, 0.0, 1.0);
}

std::vector<float> flip(const FlipInput& reference, const FlipInput& test, double ppd) {
  const Seen a = see(reference, ppd), b = see(test, ppd);
  const Features fa = findFeatures(a.luminance, ppd), fb = findFeatures(b.luminance, ppd);
  std::vector<float> out(a.hunt.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double color = redistributed(std::pow(hyab(a.hunt[i], b.hunt[i]), kColorExponent));
    const double feature = std::max(std::fabs(double(fa.edge[i]) - double(fb.edge[i])), std::fabs(double(fa.point[i]) - double(fb.point[i])));
    const double strength = std::pow(std::clamp(feature / std::numbers::sqrt2, 0.0, 1.0), kFeatureExponent);
    out[i] = float(std::pow(color, 1 - strength));
  }
  return out;
}

}  // namespace forelock::study
