// SPDX-License-Identifier: MIT
#include "view_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::study {

using namespace samples;

namespace {

constexpr uint32_t kWidth = 1920, kHeight = 1200;       // the paper's
constexpr uint32_t kQuickWidth = 480, kQuickHeight = 300;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kTolerance = 0.02;
constexpr uint32_t kPad = 8;  // around hair's rectangle: more than the drift and the reference's faintest pixels need

class Search {
public:
  Search(HeadlessHost& host, DeviceSubject& device, const Subject& subject) : host_(host), device_(device), subject_(subject) {}

  const RecipeCamera* stored(const std::string& name) const {
    for (const SubjectAsset& asset : subject_.assets) {
      if (!asset.opened.recipe) continue;
      for (const RecipeCamera& camera : asset.opened.recipe->cameras)
        if (camera.name == name) return &camera;
    }
    return nullptr;
  }

  // Alpha of every pixel (RGBA), and the statistics of that frame.
  std::vector<float> layers(const Matrices& matrices, uint32_t width, uint32_t height, FlkStatistics& statistics) {
    FlkFrame frame{};
    frame.display = FLK_DISPLAY_LAYERS;
    frame.capture = host_.queueHasGraphics() ? FLK_CAPTURE_RASTER : FLK_CAPTURE_COMPUTE;
    frame.overflow = FLK_OVERFLOW_DROP;
    setCamera(frame, matrices);
    Drawing drawing(host_, device_, frame, width, height);
    drawing.prepare();
    statistics = drawing.statistics();
    return host_.readColor();
  }

  uint64_t fragments(const Matrices& matrices, uint32_t width, uint32_t height) {
    FlkFrame frame{};
    frame.display = FLK_DISPLAY_LAYERS;
    frame.capture = host_.queueHasGraphics() ? FLK_CAPTURE_RASTER : FLK_CAPTURE_COMPUTE;
    frame.count_only = 1;
    setCamera(frame, matrices);
    Drawing drawing(host_, device_, frame, width, height);
    drawing.draw();
    return drawing.statistics().fragments;
  }

  View place(const std::string& name, const Camera& camera, uint32_t width, uint32_t height) {
    View view;
    view.name = view.scene_view = name;
    view.width = view.scene_width = width, view.height = view.scene_height = height;
    view.camera = camera;
    view.matrices = matricesOf(camera, width, height);
    measure(view);
    return view;
  }

  void measure(View& view) {
    FlkStatistics statistics{};
    const std::vector<float> rgba = layers(view.matrices, view.width, view.height, statistics);
    view.rect = hairRect(rgba, view.width, view.height, kPad, view.hair_pixels);
    view.fragments = statistics.fragments;
    if (view.hair_pixels == 0)
      throw std::runtime_error(subject_.name + ": no hair is seen in view " + view.name +
                               "; look at it with `forelock preview`, and at its widths with `forelock inspect`");
  }

  // Framed like a preview, then zoomed by the field of view.
  View zoom(const std::string& name, double wanted, std::vector<std::string>& notes) {
    double radius = 0;
    const std::vector<glm::vec3> points = subjectPoints(subject_, radius);
    const SceneCamera& scene = subject_.scene.camera;
    Camera camera = scene.placed ? *scene.placed
                                 : framePoints({points, radius}, scene.azimuth_deg * kDegree, scene.elevation_deg * kDegree,
                                               scene.up, 24.0 * kDegree, double(kWidth) / kHeight, 1.06, 1);
    const auto count = [&](double tan_half) {
      camera.vertical_fov = 2 * std::atan(tan_half);
      FlkStatistics statistics{};
      const std::vector<float> rgba = layers(matricesOf(camera, kWidth, kHeight), kWidth, kHeight, statistics);
      uint64_t pixels = 0;
      hairRect(rgba, kWidth, kHeight, 0, pixels);
      return double(pixels);
    };
    // From 1 to 120 degrees; the guess is the last view's zoom, for this number of pixels.
    const double low = std::tan(0.51 * kDegree), high = std::tan(60 * kDegree);
    const double guess = last_.tan_half > 0 ? last_.tan_half * std::sqrt(last_.pixels / wanted) : std::tan(0.5 * camera.vertical_fov);
    last_ = findZoom(wanted, kTolerance, low, high, guess, count);
    if (!last_.reached) {
      char text[160];
      std::snprintf(text, sizeof text, "view %s: no zoom covers %.0f pixels, the nearest covers %.0f", name.c_str(), wanted, last_.pixels);
      notes.push_back(text);
    }
    camera.vertical_fov = 2 * std::atan(last_.tan_half);
    return place(name, camera, kWidth, kHeight);
  }

  View named(const std::string& name, std::vector<std::string>& notes) {
    if (const RecipeCamera* camera = stored(name)) return place(name, fromRecipeCamera(*camera), camera->width, camera->height);
    double wanted = 0;
    pixelsOfView(name, wanted);
    return zoom(name, wanted, notes);
  }

  // Of nine places over the hair the one with most fragments.
  View crop(const View& whole) {
    View view = whole;
    view.name = "quick", view.width = std::min(kQuickWidth, whole.width), view.height = std::min(kQuickHeight, whole.height);
    uint64_t most = 0;
    for (int place = 0; place < 9; ++place) {
      // Beside or inside the rectangle, and always inside the frame.
      const auto start = [](uint32_t from, uint32_t size, uint32_t crop, uint32_t frame, int step) {
        const double room = double(size) - crop;
        return uint32_t(std::clamp(room > 0 ? from + room * step / 2 : from + room / 2, 0.0, double(frame) - crop));
      };
      const Rect rect{start(whole.rect.x, whole.rect.width, view.width, whole.width, place % 3),
                      start(whole.rect.y, whole.rect.height, view.height, whole.height, place / 3), view.width, view.height};
      const Matrices matrices = cropped(whole.matrices, whole.width, whole.height, rect);
      const uint64_t found = fragments(matrices, view.width, view.height);
      if (found <= most) continue;
      most = found;
      view.matrices = matrices;
    }
    measure(view);
    return view;
  }

private:
  HeadlessHost& host_;
  DeviceSubject& device_;
  const Subject& subject_;
  ZoomFound last_;
};

}  // namespace

std::vector<View> findViews(HeadlessHost& host, DeviceSubject& device, const Subject& subject, const Options& options,
                            const std::function<void(const std::string&)>& says, std::vector<std::string>& notes) {
  Search search(host, device, subject);
  std::vector<View> views;
  const SceneCamera& own = subject.scene.camera;
  if (subject.has_setting && !options.views_given && (own.placed || !own.name.empty())) {
    const RecipeCamera* stored = own.name.empty() ? nullptr : search.stored(own.name);
    if (!own.name.empty() && !stored) throw UsageError(options.scene + ": camera.name " + own.name + " is stored by none of its assets");
    says("looking at view scene");
    const uint32_t width = subject.scene.width ? subject.scene.width : stored ? stored->width : kWidth;
    const uint32_t height = subject.scene.width ? subject.scene.height : stored ? stored->height : kHeight;
    const View view = search.place("scene", stored ? fromRecipeCamera(*stored) : *own.placed, width, height);
    views.push_back(options.amount == Amount::quick ? search.crop(view) : view);
    return views;
  }
  if (options.amount == Amount::quick) {
    says("looking for the crop");
    return {search.crop(search.named("198k", notes))};
  }
  for (const std::string& name : options.views) {
    says("looking for view " + name);
    views.push_back(search.named(name, notes));
  }
  return views;
}

}  // namespace forelock::study
