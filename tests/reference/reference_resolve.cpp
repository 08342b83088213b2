// Section 6: the fragments of a pixel to its colour.
#include "reference_vector.h"

#include <algorithm>
#include <numbers>
#include <tuple>

namespace forelock::reference {
namespace {

bool nearer(const Fragment& a, const Fragment& b) {
  return std::tie(a.depth, a.slot, a.sequence) < std::tie(b.depth, b.slot, b.sequence);
}

constexpr double thickest_tau = 12;  // of one fragment in the deterministic tail

// The colour and transmittance of what the core leaves.
struct Tail {
  TailOrder order = TailOrder::list;
  std::array<double, 3> color{};  // deterministic: the sum of tau times colour until finish()
  double transmittance = 1, sum_tau = 0;

  void add(double alpha, const std::array<double, 3>& c) {
    transmittance *= 1 - alpha;
    const double tau = std::min(-std::log1p(-alpha) / std::numbers::ln2, thickest_tau);
    sum_tau += tau;
    for (size_t i = 0; i < 3; ++i) {
      color[i] = order == TailOrder::list ? alpha * c[i] + (1 - alpha) * color[i] : color[i] + tau * c[i];
    }
  }
  void finish() {
    if (order == TailOrder::list) return;
    if (order == TailOrder::once) sum_tau = 1;
    for (double& c : color) c = sum_tau > 0 ? (1 - transmittance) * c / sum_tau : 0;
  }
};

Image resolveFaces(const Scene& scene, const Camera& camera, std::span<const std::span<const ShadowMap>> faces,
                   const FragmentLists& lists, const ResolveOptions& options) {
  Image image;
  image.width = lists.width;
  image.height = lists.height;
  image.pixels.resize(size_t(lists.width) * size_t(lists.height));
  const Method method = options.method;
  const bool sorts_all = method == Method::exact || method == Method::hard;
  const size_t k_sort = size_t(std::max(options.k_sort, 0));

  parallelFor(lists.height, options.threads, [&](int y) {
    std::vector<Fragment> core;
    for (int x = 0; x < lists.width; ++x) {
      const std::span<const Fragment> list = lists.at(x, y);
      if (list.empty()) continue;
      Pixel& pixel = image.at(x, y);
      pixel.fragments = uint32_t(list.size());
      auto shade = [&](const Fragment& f, bool full) { return shadeFragmentLit(scene, camera, faces, x, y, f, full); };

      Tail tail;
      if (method != Method::forward) tail.order = options.tail;
      core.clear();
      if (sorts_all) {
        core.assign(list.begin(), list.end());
        std::sort(core.begin(), core.end(), nearer);
        if (method == Method::hard) {
          core.resize(1);
          core[0].alpha = 1;
        }
      } else {
        std::optional<Fragment> behind;
        for (size_t i = list.size(); i-- > 0;) {  // the last stored is met first
          Fragment out = list[i];
          if (core.size() < k_sort || (k_sort > 0 && nearer(out, core.back()))) {
            core.insert(std::upper_bound(core.begin(), core.end(), out, nearer), out);
            if (core.size() <= k_sort) continue;
            out = core.back();
            core.pop_back();
          }
          std::array<double, 3> color{};
          if (!behind || nearer(out, *behind)) behind = out;
          if (method != Method::core_only && tail.order != TailOrder::once) color = shade(out, method == Method::forward);
          tail.add(out.alpha, color);
        }
        // once: the colour of the nearest, which stands for all.
        if (tail.order == TailOrder::once && behind) tail.color = shade(*behind, false);
        tail.finish();
      }
      double transmittance = 1;
      for (size_t i = 0; i < core.size(); ++i) {
        const bool full =
            sorts_all || method == Method::forward || (method != Method::all_low && int(i) < options.k);
        const std::array<double, 3> color = transmittance > 0 ? shade(core[i], full) : std::array<double, 3>{};
        for (size_t c = 0; c < 3; ++c) pixel.rgb[c] += transmittance * core[i].alpha * color[c];
        transmittance *= 1 - core[i].alpha;
      }
      for (size_t c = 0; c < 3; ++c) pixel.rgb[c] += transmittance * tail.color[c];
      pixel.transmittance = transmittance * tail.transmittance;
    }
  });
  return image;
}

}  // namespace

Image resolve(const Scene& scene, const Camera& camera, std::span<const ShadowMap> maps, const FragmentLists& lists,
              const ResolveOptions& options) {
  std::vector<std::span<const ShadowMap>> faces;
  for (const ShadowMap& map : maps) faces.push_back({&map, 1});
  return resolveFaces(scene, camera, faces, lists, options);
}

Image resolveLit(const Scene& scene, const Camera& camera, std::span<const LightMaps> maps, const FragmentLists& lists,
                 const ResolveOptions& options) {
  std::vector<std::span<const ShadowMap>> faces;
  for (const LightMaps& light : maps) faces.push_back(light.faces);
  return resolveFaces(scene, camera, faces, lists, options);
}

std::vector<double> opacityOf(const Image& image) {
  std::vector<double> out;
  out.reserve(image.pixels.size());
  for (const Pixel& pixel : image.pixels) out.push_back(1 - pixel.transmittance);
  return out;
}

std::vector<double> opacityOf(const FragmentLists& lists) {
  std::vector<double> out(size_t(lists.width) * size_t(lists.height));
  for (size_t pixel = 0; pixel < out.size(); ++pixel) {
    double t = 1;
    for (uint64_t i = lists.first[pixel]; i < lists.first[pixel + 1]; ++i) t *= 1 - lists.fragments[i].alpha;
    out[pixel] = 1 - t;
  }
  return out;
}

}  // namespace forelock::reference
