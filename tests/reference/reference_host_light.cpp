// What the host knows of the light: its shadow maps and tile masks (section 4), its ambient (section 5).
#include "reference_lights.h"

#include "reference_vector.h"

#include <numbers>

namespace forelock::reference {

double hostShadowLight(const HostShadow& shadow, Vec3 position) {
  const double* m = shadow.texel_from_world;
  double at[4];
  for (int row = 0; row < 4; ++row) {
    at[row] = m[row] * position.x + m[4 + row] * position.y + m[8 + row] * position.z + m[12 + row];
  }
  if (!(at[3] > 0)) return 1;
  const double x = at[0] / at[3] - 0.5, y = at[1] / at[3] - 0.5, z = at[2] / at[3];
  if (!(std::fabs(x) < 1e9) || !(std::fabs(y) < 1e9)) return 1;
  const double column = std::floor(x), row = std::floor(y);
  auto lit = [&](int c, int r) {
    if (c < shadow.left || r < shadow.top || c >= shadow.right || r >= shadow.bottom) return 1.0;
    if (c < 0 || r < 0 || c >= shadow.width || r >= shadow.height) return 1.0;
    const double value = double(shadow.values[size_t(r) * size_t(shadow.width) + size_t(c)]);
    return (shadow.reversed ? z >= value - shadow.bias : z <= value + shadow.bias) ? 1.0 : 0.0;
  };
  const int c = int(column), r = int(row);
  return mix(mix(lit(c, r), lit(c + 1, r), x - column), mix(lit(c, r + 1), lit(c + 1, r + 1), x - column), y - row);
}

bool lightReaches(const LightTiles& tiles, size_t light, int x, int y) {
  if (tiles.tile_size <= 0) return true;
  const int tile_x = x / tiles.tile_size, tile_y = y / tiles.tile_size;
  if (tile_x >= tiles.tiles_x || tile_y >= tiles.tiles_y) return false;
  const size_t word = (light / 32 * size_t(tiles.tiles_y) + size_t(tile_y)) * size_t(tiles.tiles_x) + size_t(tile_x);
  return word < tiles.words.size() && (tiles.words[word] >> light % 32 & 1) != 0;
}

std::array<double, 3> ambientLight(const Scene& scene, Vec3 tangent) {
  constexpr double pi = std::numbers::pi;
  const auto [x, y, z] = tangent;
  // Y_2m in the order of m; a zero tangent sees the mean alone.
  const double y2[5] = {std::sqrt(15 / (4 * pi)) * x * y, std::sqrt(15 / (4 * pi)) * y * z,
                        std::sqrt(5 / (16 * pi)) * (3 * z * z - 1), std::sqrt(15 / (4 * pi)) * x * z,
                        std::sqrt(15 / (16 * pi)) * (x * x - y * y)};
  const bool valid = !isZero(tangent) && std::isfinite(x + y + z);
  std::array<double, 3> out{};
  for (size_t c = 0; c < 3; ++c) {
    double value = scene.ambient[c];
    if (scene.ambient_sh) {
      const auto& sh = *scene.ambient_sh;
      value += sh[0][c] / std::sqrt(4 * pi);
      for (size_t m = 0; valid && m < 5; ++m) value -= sh[4 + m][c] * y2[m] / 8;
    }
    out[c] = std::max(value, 0.0);
  }
  return out;
}

}  // namespace forelock::reference
