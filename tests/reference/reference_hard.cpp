// Method hard of section 6: one opaque fragment a pixel.
#include "reference_quads.h"

#include <optional>
#include <tuple>

namespace forelock::reference {
namespace {

constexpr int hard_tangent_bits = 13;

// The quad reaches further than the strand: E past its ends and E past its width.
bool belongs(const PlaneSegment& s, const Placed& at) {
  if (s.has_root && !(at.y >= 0)) return false;
  if (s.has_tip && !(at.y < s.l)) return false;
  return std::fabs(at.x) <= std::max(mix(s.h_a, s.h_b, at.v), 0.5);
}

struct Candidate {
  Fragment fragment;
  uint32_t code;

  bool nearerThan(const Candidate& other) const {
    return std::tie(fragment.depth, fragment.slot, code, fragment.sequence) <
           std::tie(other.fragment.depth, other.fragment.slot, other.code, other.fragment.sequence);
  }
};

}  // namespace

FragmentLists gatherHard(const Scene& scene, const Camera& camera, const GatherOptions& options) {
  const bool perspective = isPerspective(camera);
  const bool colored = hasColors(scene);
  std::vector<std::optional<Candidate>> nearest(size_t(camera.width) * size_t(camera.height));
  for (const ScreenSegment& s : screenSegments(scene, camera, 1, false)) {
    forEachCell(s.plane.corner, camera.width, 0, camera.height, [&](int column, int row) {
      const Placed at = place(s.plane, column, row);
      if (!belongs(s.plane, at)) return;
      const size_t pixel = size_t(row) * size_t(camera.width) + size_t(column);
      const Along where = along(s, at.v, perspective);
      if (!options.host_depth.empty() && !(where.depth <= options.host_depth[pixel])) return;
      if (opacityModifier(options.modifiers, column + 0.5, row + 0.5, where.depth) < 0.5) return;
      Candidate found{};
      Fragment& f = found.fragment;
      f.depth = where.depth;
      f.alpha = f.coverage = 1;
      f.tangent = normalizeOrZero(mix(s.tangent_a, s.tangent_b, where.u));
      f.slot = scene.hairs[s.hair].slot;
      f.sequence = s.sequence;
      if (colored) {
        f.has_color = true;
        f.color = fibreColor(scene.hairs[s.hair].material, s, where.u, mix(s.fraction_a, s.fraction_b, where.u));
      }
      found.code = tangentCode(f.tangent, hard_tangent_bits);
      if (options.payload != Payload::unquantised) f.tangent = tangentOf(found.code, hard_tangent_bits);
      if (!nearest[pixel] || found.nearerThan(*nearest[pixel])) nearest[pixel] = found;
    });
  }
  FragmentLists lists;
  lists.width = camera.width;
  lists.height = camera.height;
  lists.first.push_back(0);
  for (const std::optional<Candidate>& found : nearest) {
    if (found) lists.fragments.push_back(found->fragment);
    lists.first.push_back(lists.fragments.size());
  }
  return lists;
}

Image renderHard(const Scene& scene, const Camera& camera, std::span<const LightMaps> maps,
                 const GatherOptions& options) {
  ResolveOptions resolving;
  resolving.method = Method::hard;
  resolving.threads = options.threads;
  return resolveLit(scene, camera, maps, gatherHard(scene, camera, options), resolving);
}

}  // namespace forelock::reference
