// The outputs of section 6.
#include "reference_outputs.h"

#include "reference_vector.h"

#include <algorithm>
#include <tuple>

namespace forelock::reference {
namespace {

Vec3 transform(const Matrix& m, Vec3 p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

// The p of which transform(m, p) is q, by Cramer's rule.
Vec3 inverseTransform(const Matrix& m, Vec3 q) {
  const Vec3 x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]}, d = q - Vec3{m[12], m[13], m[14]};
  const double determinant = dot(x, cross(y, z));
  return {dot(d, cross(y, z)) / determinant, dot(x, cross(d, z)) / determinant, dot(x, cross(y, d)) / determinant};
}

}  // namespace

std::vector<OutputPixel> outputsOf(const Scene& scene, const Camera& camera, const FragmentLists& lists,
                                   const Motion& motion) {
  std::vector<OutputPixel> out(size_t(lists.width) * size_t(lists.height));
  for (int y = 0; y < lists.height; ++y) {
    for (int x = 0; x < lists.width; ++x) {
      const std::span<const Fragment> list = lists.at(x, y);
      if (list.empty()) continue;
      OutputPixel& pixel = out[size_t(y) * size_t(lists.width) + size_t(x)];
      const Fragment* front = &list[0];
      pixel.written = true;
      pixel.depth_min = pixel.depth_max = front->depth;
      for (const Fragment& f : list) {
        pixel.transmittance *= 1 - f.alpha;
        pixel.depth_min = std::min(pixel.depth_min, f.depth);
        pixel.depth_max = std::max(pixel.depth_max, f.depth);
        if (std::tie(f.depth, f.slot, f.sequence) < std::tie(front->depth, front->slot, front->sequence)) front = &f;
      }
      pixel.front_depth = front->depth;

      Vec3 before = unproject(camera, x + 0.5, y + 0.5, front->depth);
      for (size_t hair = 0; hair < scene.hairs.size() && !motion.world_from_hair.empty(); ++hair) {
        if (scene.hairs[hair].slot != front->slot) continue;
        before = transform(motion.world_from_hair_before[hair], inverseTransform(motion.world_from_hair[hair], before));
        break;
      }
      const Projected was = project(motion.camera_before, before);
      if (isPerspective(motion.camera_before) && !(was.depth > 0)) continue;
      pixel.velocity[0] = x + 0.5 - was.x;
      pixel.velocity[1] = y + 0.5 - was.y;
    }
  }
  return out;
}

}  // namespace forelock::reference
