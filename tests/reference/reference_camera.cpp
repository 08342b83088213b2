// Projection both ways, and the helpers of strands.
#include "reference_vector.h"

namespace forelock::reference {

namespace {

// Zero over a strand that has no length or no finite one.
void setStrandFractions(Strands& strands, size_t begin, size_t end) {
  double total = 0;
  for (size_t v = begin; v < end; ++v) {
    if (v > begin) total += length(strands.positions[v] - strands.positions[v - 1]);
    strands.fraction[v] = total;
  }
  const bool usable = total > 0 && std::isfinite(total);
  for (size_t v = begin; v < end; ++v) strands.fraction[v] = usable ? strands.fraction[v] / total : 0;
}

}  // namespace

void setFractions(Strands& strands) {
  strands.fraction.assign(strands.positions.size(), 0.0);
  for (size_t strand = 0; strand < strands.count(); ++strand) {
    setStrandFractions(strands, strands.first_vertex[strand], strands.first_vertex[strand + 1]);
  }
}

void addStrand(Strands& strands, std::span<const Vec3> positions, std::span<const double> radii) {
  const size_t begin = strands.positions.size();
  strands.positions.insert(strands.positions.end(), positions.begin(), positions.end());
  strands.radii.insert(strands.radii.end(), radii.begin(), radii.end());
  strands.first_vertex.push_back(uint32_t(strands.positions.size()));
  strands.fraction.resize(strands.positions.size(), 0.0);
  setStrandFractions(strands, begin, strands.positions.size());
  if (!strands.colors.empty()) strands.colors.resize(strands.positions.size(), {1, 1, 1});
}

void addStrand(Strands& strands, std::span<const Vec3> positions, double radius) {
  const std::vector<double> radii(positions.size(), radius);
  addStrand(strands, positions, radii);
}

bool isPerspective(const Camera& camera) { return camera.clip_from_view[11] != 0; }

double nearPlane(const Camera& camera) {
  // NDC depth is -A + B / d in perspective and -A d + B in an orthographic projection; growing with d: near is 0.
  const double a = camera.clip_from_view[10], b = camera.clip_from_view[14];
  if (isPerspective(camera)) return b < 0 ? b / a : b / (1 + a);
  return a < 0 ? b / a : (b - 1) / a;
}

Camera makeCamera(Vec3 eye, Vec3 target, Vec3 up, const Projection& projection, int width, int height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  const Vec3 z = normalizeOrZero(eye - target), x = normalizeOrZero(cross(up, z)), y = cross(z, x);
  const Vec3 rows[3] = {x, y, z};
  for (int row = 0; row < 3; ++row) {
    camera.view_from_world[row] = rows[row].x;
    camera.view_from_world[4 + row] = rows[row].y;
    camera.view_from_world[8 + row] = rows[row].z;
    camera.view_from_world[12 + row] = -dot(rows[row], eye);
  }
  camera.view_from_world[15] = 1;

  double* p = camera.clip_from_view;
  const double n = projection.near_plane, f = projection.far_plane;
  p[5] = -1 / projection.tan_half_y;
  p[0] = height / (projection.tan_half_y * width * projection.pixel_aspect);
  if (projection.orthographic) {
    p[10] = (projection.reversed ? 1 : -1) / (f - n);
    p[14] = projection.reversed ? f / (f - n) : -n / (f - n);
    p[12] = projection.offset_x;
    p[13] = projection.offset_y;
    p[15] = 1;
  } else {
    p[10] = projection.reversed ? n / (f - n) : -f / (f - n);
    p[14] = (projection.reversed ? 1 : -1) * n * f / (f - n);
    p[8] = -projection.offset_x;
    p[9] = -projection.offset_y;
    p[11] = -1;
  }
  return camera;
}

Projected project(const Camera& camera, Vec3 world) {
  const double *m = camera.view_from_world, *p = camera.clip_from_view;
  const double vx = m[0] * world.x + m[4] * world.y + m[8] * world.z + m[12];
  const double vy = m[1] * world.x + m[5] * world.y + m[9] * world.z + m[13];
  const double vz = m[2] * world.x + m[6] * world.y + m[10] * world.z + m[14];
  const double w = p[11] * vz + p[15];
  const double ndc_x = (p[0] * vx + p[8] * vz + p[12]) / w, ndc_y = (p[5] * vy + p[9] * vz + p[13]) / w;
  return {(ndc_x + 1) / 2 * camera.width, (ndc_y + 1) / 2 * camera.height, -vz};
}

Vec3 unproject(const Camera& camera, double x, double y, double depth) {
  const double *m = camera.view_from_world, *p = camera.clip_from_view;
  const double vz = -depth, w = p[11] * vz + p[15];
  const double ndc_x = x / camera.width * 2 - 1, ndc_y = y / camera.height * 2 - 1;
  const double vx = (ndc_x * w - p[8] * vz - p[12]) / p[0];
  const double vy = (ndc_y * w - p[9] * vz - p[13]) / p[5];
  // A rigid motion: the inverse of its rotation is the transpose.
  const Vec3 q{vx - m[12], vy - m[13], vz - m[14]};
  return {m[0] * q.x + m[1] * q.y + m[2] * q.z, m[4] * q.x + m[5] * q.y + m[6] * q.z,
          m[8] * q.x + m[9] * q.y + m[10] * q.z};
}

}  // namespace forelock::reference
