// What a node keeps of a fragment: section 3.
#include "reference_vector.h"

#include <algorithm>

namespace forelock::reference {
namespace {

void fold(double& p, double& q) {
  const double old = p;
  p = (1 - std::fabs(q)) * (p >= 0 ? 1 : -1);
  q = (1 - std::fabs(old)) * (q >= 0 ? 1 : -1);
}

}  // namespace

double codedAlpha(double alpha, Payload payload) {
  if (payload == Payload::standard || payload == Payload::kept) {
    const double q = std::floor(std::sqrt(alpha) * 1023 + 0.5) / 1023;
    if (payload == Payload::kept) return q > 0 ? alpha : 0;
    return q * q;
  }
  if (payload == Payload::paper) return alpha < 1.0 / 255 ? 0 : std::floor(alpha * 255 + 0.5) / 255;
  return alpha;
}

uint32_t tangentCode(Vec3 tangent, int bits) {
  const double steps = double((1 << bits) - 2);
  const double sum = std::fabs(tangent.x) + std::fabs(tangent.y) + std::fabs(tangent.z);
  if (!(sum > 0)) return uint32_t((uint64_t(1) << (2 * bits)) - 1);
  double u = tangent.x / sum, v = tangent.y / sum;
  if (tangent.z < 0) fold(u, v);
  const auto low = uint32_t(std::floor((u + 1) / 2 * steps + 0.5)),
             high = uint32_t(std::floor((v + 1) / 2 * steps + 0.5));
  return low | high << bits;
}

Vec3 tangentOf(uint32_t code, int bits) {
  const uint32_t all = (uint32_t(1) << bits) - 1;
  const uint32_t low = code & all, high = code >> bits & all;
  if (low == all && high == all) return {};
  const double steps = double((1 << bits) - 2);
  double u = low / steps * 2 - 1, v = high / steps * 2 - 1;
  const double z = 1 - std::fabs(u) - std::fabs(v);
  if (z < 0) fold(u, v);
  return normalizeOrZero({u, v, z});
}

Vec3 codedTangent(Vec3 tangent, Payload payload) {
  if (payload == Payload::unquantised || payload == Payload::kept) return tangent;
  const int bits = payload == Payload::standard ? 11 : 12;
  return tangentOf(tangentCode(tangent, bits), bits);
}

}  // namespace forelock::reference
