// SPDX-License-Identifier: MIT
#include "references.h"

#include "metrics.h"

#include <algorithm>
#include <optional>

namespace forelock::study {
namespace {

// Changes whenever the reference renders other pixels: cached pictures are then made again.
constexpr uint32_t kReferenceVersion = 1;
// Lists of so many fragments are kept at once (88 bytes each).
constexpr double kFragmentsAtOnce = 6e6;

// Strands, materials and lights.
Hash sceneHash(const Twin& twin, const Matrices& matrices, const View& view) {
  Hash hash;
  hash.add(kReferenceVersion);
  for (const reference::Hair& hair : twin.scene.hairs) {
    const reference::Strands& s = hair.strands;
    hash.add(std::span<const uint32_t>(s.first_vertex));
    for (const auto& values : {&s.positions, &s.colors})
      hash.add(std::span<const double>(reinterpret_cast<const double*>(values->data()), values->size() * 3));
    hash.add(std::span<const double>(s.radii)).add(std::span<const double>(s.fraction));
    const reference::Material& m = hair.material;
    for (const auto& c : {m.color, m.tip_color}) hash.add(std::span<const double>(c, 3));
    for (const double v : {m.opacity_root, m.opacity_tip, m.width_scale, m.kd, m.kr, m.exponent_r, m.kt, m.exponent_trt,
                           m.cuticle_tilt, m.shadow_opacity, m.fibre_spacing, m.tip_blend})
      hash.add(v);
  }
  for (const reference::Light& l : twin.scene.lights) {
    if (l.cover_width) hash.add(l.cover_width);  // references that were kept before there was a choice stay found
    hash.add(uint32_t(l.kind)).add(l.shadow).add(l.shadow_size).add(std::span<const double>(l.radiance, 3));
    for (const reference::Vec3& v : {l.direction_to_light, l.position, l.axis}) hash.add(v.x).add(v.y).add(v.z);
    for (const double v : {l.range, l.source_radius, l.inner_angle, l.outer_angle}) hash.add(v);
  }
  hash.add(std::span<const double>(twin.scene.ambient, 3));
  if (twin.scene.ambient_sh)
    for (const auto& c : *twin.scene.ambient_sh) hash.add(std::span<const double>(c));
  hash.add(std::span<const double>(matrices.view_from_world, 16)).add(std::span<const float>(matrices.clip_from_view, 16));
  hash.add(view.width).add(view.height).add(view.rect.x).add(view.rect.y).add(view.rect.width).add(view.rect.height);
  return hash;
}

void append(Picture& to, const Picture& band) {
  to.width = band.width, to.height += band.height;
  to.rgb.insert(to.rgb.end(), band.rgb.begin(), band.rgb.end());
  to.transmittance.insert(to.transmittance.end(), band.transmittance.begin(), band.transmittance.end());
  to.fragments.insert(to.fragments.end(), band.fragments.begin(), band.fragments.end());
}

void render(const Twin& twin, const View& view, const Matrices& matrices, const std::vector<reference::LightMaps>& maps,
            Picture* exact, Picture* forward) {
  for (const Rect& rect : bandsOf(view)) {
    const reference::Camera camera = referenceCamera(matrices, view.width, view.height, rect);
    const reference::FragmentLists lists = reference::gatherFragments(twin.scene, camera);
    reference::ResolveOptions options;
    options.method = reference::Method::exact;
    if (exact) append(*exact, fromReference(reference::resolve(twin.scene, camera, maps, lists, options)));
    options.method = reference::Method::forward;
    if (forward) append(*forward, fromReference(reference::resolve(twin.scene, camera, maps, lists, options)));
  }
}

}  // namespace

std::vector<Rect> bandsOf(const View& view) {
  const auto count = uint32_t(std::clamp(double(view.fragments) / kFragmentsAtOnce, 0.0, double(view.rect.height) - 1)) + 1;
  std::vector<Rect> bands(count, view.rect);
  for (uint32_t band = 0; band < count; ++band) {
    const auto begin = uint32_t(uint64_t(view.rect.height) * band / count), end = uint32_t(uint64_t(view.rect.height) * (band + 1) / count);
    bands[band].y += begin, bands[band].height = end - begin;
  }
  return bands;
}

References makeReferences(Twin& twin, View& view, const Lighting& unit_lighting, samples::HairColor color,
                          const ReferenceWish& wish, const ReferenceCache& cache) {
  References made;
  setTwinLights(twin, unit_lighting);
  std::optional<std::vector<reference::LightMaps>> maps;
  const auto lightMaps = [&]() -> const std::vector<reference::LightMaps>& {
    if (!maps) maps = twinMaps(twin);
    return *maps;
  };
  const std::string key = sceneHash(twin, view.matrices, view).text();
  made.scene_hash = key;
  made.exact.resize(wish.drift ? kDrift.size() : 1);
  const bool has_exact = cache.load(key + "-exact", made.exact[0]), has_forward = cache.load(key + "-forward", made.forward);
  if (!has_exact || !has_forward) {
    wish.says("reference images");
    made.exact[0] = {}, made.forward = {};
    render(twin, view, view.matrices, lightMaps(), &made.exact[0], &made.forward);
    cache.save(key + "-exact", made.exact[0]);
    cache.save(key + "-forward", made.forward);
  }
  for (std::size_t i = 1; i < made.exact.size(); ++i) {
    const Matrices moved = shifted(view.matrices, view.width, view.height, kDrift[i][0], kDrift[i][1]);
    const std::string moved_key = sceneHash(twin, moved, view).text() + "-exact";
    if (cache.load(moved_key, made.exact[i])) continue;
    wish.says("reference images of the drift");
    render(twin, view, moved, lightMaps(), &made.exact[i], nullptr);
    cache.save(moved_key, made.exact[i]);
  }
  if (wish.cover && !cache.load(key + "-cover", made.cover)) {
    wish.says("reference of the coverage");
    made.cover.clear();
    for (const double v : reference::renderCover(twin.scene, referenceCamera(view.matrices, view.width, view.height, view.rect)))
      made.cover.push_back(float(v));
    cache.save(key + "-cover", made.cover);
  }
  const double mean = meanRadiance(made.exact[0]);
  made.factor = mean > 0 ? samples::conditionMean(color) / mean : 1;
  for (Picture& picture : made.exact) picture.scale(made.factor);
  made.forward.scale(made.factor);
  made.reference_hash = Hash().add(std::span<const float>(made.exact[0].rgb)).text();
  view.max_overdraw = *std::max_element(made.exact[0].fragments.begin(), made.exact[0].fragments.end());
  return made;
}

}  // namespace forelock::study
