// SPDX-License-Identifier: MIT
#include "report_pictures.h"

#include "float_picture.h"
#include "image.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace forelock::samples {

namespace {

namespace fs = std::filesystem;

constexpr uint32_t kDetailSize = 64, kDetailZoom = 4, kDetailGap = 8;
constexpr size_t kMaxLayers = 4096;  // of a histogram; what is above counts as this many

struct ColorStop {
  double at;
  double r, g, b;
};

double toSrgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055; }
float toLinear(int srgb) {
  const double x = srgb / 255.0;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

void setPixel(Image& image, uint32_t x, uint32_t y, const PictureColor& color, float alpha = 1.0f) {
  float* to = image.pixel(x, y);
  to[0] = alpha * toLinear(color.r);
  to[1] = alpha * toLinear(color.g);
  to[2] = alpha * toLinear(color.b);
  to[3] = alpha;
}

// File names are made of names in the table. Others than these would lead out of the folder.
bool isPlainName(const std::string& name) {
  return name.size() < 120 && std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
         });
}

class Maker {
 public:
  Maker(const StudyFacts& study, const fs::path& from, const fs::path& to) : facts(study), from_(from / "images"), to_(to) {}

  const StudyFacts& facts;
  Pictures made;

  std::optional<FloatPicture> read(const std::string& name, uint32_t channels, bool expected) {
    const std::string file = name + ".pfm";
    std::error_code error;
    if (!isPlainName(name) || !fs::is_regular_file(from_ / file, error)) {
      if (expected) made.missing.push_back("images/" + file.substr(0, 120));
      return std::nullopt;
    }
    try {
      FloatPicture picture = readPfm((from_ / file).string());
      if (picture.channels != channels) {
        throw std::runtime_error("has " + std::to_string(picture.channels) + " channels instead of " + std::to_string(channels));
      }
      if (picture.not_finite > 0) {
        made.problems.push_back("images/" + file + " has " + std::to_string(picture.not_finite) + " values that are not finite, shown as 0");
      }
      return picture;
    } catch (const std::runtime_error& problem) {
      made.problems.push_back("images/" + file + " " + problem.what());
      return std::nullopt;
    }
  }

  std::string save(const std::string& name, const Image& image) {
    const std::string path = "report/" + fileStem(name, stems_) + ".png";
    writeImage((to_ / path).string(), image);
    return path;
  }

 private:
  fs::path from_, to_;
  std::set<std::string> stems_;
};

Image shown(const FloatPicture& picture) {
  Image image(picture.width, picture.height);
  for (size_t i = 0; i < picture.pixelCount(); ++i) {
    std::copy_n(&picture.values[3 * i], 3, &image.rgba[4 * i]);
    image.rgba[4 * i + 3] = 1.0f;
  }
  return image;
}

void makeLayers(Maker& maker, const StudyView& view, std::map<std::string, FloatPicture>& layers_of) {
  std::optional<FloatPicture> layers = maker.read(view.name + "-layers", 1, true);
  if (!layers) return;
  LayersPicture picture;
  picture.view = view.name;
  picture.width = layers->width;
  picture.height = layers->height;
  Histogram histogram{view.name, {}};
  Image image(layers->width, layers->height);
  for (uint32_t y = 0; y < layers->height; ++y) {
    for (uint32_t x = 0; x < layers->width; ++x) {
      const double value = std::clamp(std::round(static_cast<double>(*layers->pixel(x, y))), 0.0, 1e9);
      const size_t bin = static_cast<size_t>(std::min(value, static_cast<double>(kMaxLayers)));
      if (histogram.pixels.size() <= bin) histogram.pixels.resize(bin + 1);
      ++histogram.pixels[bin];
      if (value < 1.0) continue;
      ++picture.hair_pixels;
      picture.fragments += static_cast<uint64_t>(value);
      picture.most = std::max(picture.most, static_cast<uint32_t>(value));
      setPixel(image, x, y, layersColor(value));
    }
  }
  if (view.hair_pixels > 0.0 && std::fabs(static_cast<double>(picture.hair_pixels) / view.hair_pixels - 1.0) > 0.01) {
    maker.made.problems.push_back("images/" + view.name + "-layers.pfm has " + readableCount(static_cast<double>(picture.hair_pixels)) +
                                  " hair pixels, the table says " + readableCount(view.hair_pixels));
  }
  picture.path = maker.save(view.name + "-layers", image);
  maker.made.layers.push_back(std::move(picture));
  maker.made.histograms.push_back(std::move(histogram));
  layers_of.emplace(view.name, std::move(*layers));
}

// Per pixel: the root of the sum of the three channels' squared differences, of values clamped to [0, 1] and times 255.
std::vector<float> differences(const FloatPicture& a, const FloatPicture& b) {
  std::vector<float> result(a.pixelCount());
  const auto clamped = [](float value) { return 255.0 * std::clamp(static_cast<double>(value), 0.0, 1.0); };
  for (size_t i = 0; i < result.size(); ++i) {
    double sum = 0.0;
    for (size_t channel = 0; channel < 3; ++channel) {
      const double d = clamped(a.values[3 * i + channel]) - clamped(b.values[3 * i + channel]);
      sum += d * d;
    }
    result[i] = static_cast<float>(std::sqrt(sum));
  }
  return result;
}

// The square with the greatest sum of squares, by sums over rectangles from the upper left.
void findWorst(const std::vector<float>& difference, uint32_t width, uint32_t height, MethodPicture& picture) {
  const uint32_t size = std::min({kDetailSize, width, height});
  std::vector<double> sums(size_t{width + 1} * (height + 1), 0.0);
  const auto at = [&](uint32_t x, uint32_t y) -> double& { return sums[size_t{y} * (width + 1) + x]; };
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double d = static_cast<double>(difference[size_t{y} * width + x]);
      at(x + 1, y + 1) = d * d + at(x, y + 1) + at(x + 1, y) - at(x, y);
    }
  }
  double most = 0.0;
  for (uint32_t y = 0; y + size <= height; y += 4) {
    for (uint32_t x = 0; x + size <= width; x += 4) {
      const double sum = at(x + size, y + size) - at(x, y + size) - at(x + size, y) + at(x, y);
      if (sum > most) most = sum, picture.detail_x = x, picture.detail_y = y, picture.detail_size = size;
    }
  }
}

// Parts of images of one size beside each other, each pixel as a square.
Image magnified(const std::vector<const Image*>& images, uint32_t x0, uint32_t y0, uint32_t size) {
  const uint32_t step = size * kDetailZoom + kDetailGap, count = static_cast<uint32_t>(images.size());
  Image strip(count * step - kDetailGap, size * kDetailZoom);
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t y = 0; y < size * kDetailZoom; ++y) {
      for (uint32_t x = 0; x < size * kDetailZoom; ++x) {
        std::copy_n(images[i]->pixel(x0 + x / kDetailZoom, y0 + y / kDetailZoom), 4, strip.pixel(i * step + x, y));
      }
    }
  }
  return strip;
}

void frame(Image& image, const MethodPicture& picture) {
  const PictureColor color{90, 200, 250};
  const uint32_t size = picture.detail_size;
  for (uint32_t i = 0; i < size; ++i) {
    setPixel(image, picture.detail_x + i, picture.detail_y, color);
    setPixel(image, picture.detail_x + i, picture.detail_y + size - 1, color);
    setPixel(image, picture.detail_x, picture.detail_y + i, color);
    setPixel(image, picture.detail_x + size - 1, picture.detail_y + i, color);
  }
}

struct Loaded {
  MethodPicture picture;
  FloatPicture image;
  std::vector<float> difference;
};

void measure(const FloatPicture& exact, const FloatPicture* layers, Loaded& loaded) {
  std::vector<float> of_hair;
  double sum = 0.0;
  for (size_t i = 0; i < exact.pixelCount(); ++i) {
    bool hair = layers && layers->values[i] >= 0.5f;
    for (size_t channel = 0; channel < 3 && !hair; ++channel) {
      hair = exact.values[3 * i + channel] != 0.0f || loaded.image.values[3 * i + channel] != 0.0f;
    }
    if (!hair) continue;
    of_hair.push_back(loaded.difference[i]);
    sum += static_cast<double>(loaded.difference[i]) * static_cast<double>(loaded.difference[i]);
  }
  if (of_hair.empty()) return;
  loaded.picture.rmse = std::sqrt(sum / static_cast<double>(of_hair.size()));
  const size_t rank = std::min(of_hair.size() - 1, static_cast<size_t>(0.999 * static_cast<double>(of_hair.size())));
  std::nth_element(of_hair.begin(), of_hair.begin() + static_cast<std::ptrdiff_t>(rank), of_hair.end());
  loaded.picture.p999 = static_cast<double>(of_hair[rank]);
}

bool sameSize(const FloatPicture& a, const FloatPicture& b) { return a.width == b.width && a.height == b.height; }

std::string dashed(const std::string& a, const std::string& b) { return a + "-" + b; }

void makeGroup(Maker& maker, const Setting& setting, const FloatPicture* layers) {
  const std::string prefix = dashed(setting.view, setting.hair_colour);
  std::vector<Loaded> loaded;
  const std::optional<FloatPicture> exact = maker.read(prefix + "-R_exact", 3, true);
  if (!exact) return;
  if (layers && !sameSize(*layers, *exact)) {
    maker.made.problems.push_back("images/" + prefix + "-R_exact.pfm is not as large as " + setting.view + "-layers.pfm");
    layers = nullptr;
  }
  for (const std::string& method : maker.facts.methods) {
    const StudyRow* row = maker.facts.baseRow(setting, method);
    const std::string name = dashed(prefix, dashed(row ? row->method : method, setting.capture));
    std::optional<FloatPicture> image = maker.read(name, 3, row && row->status == "ok");
    if (!image) continue;
    if (!sameSize(*image, *exact)) {
      maker.made.problems.push_back("images/" + name + ".pfm is " + std::to_string(image->width) + " x " + std::to_string(image->height) +
                                    ", its reference " + std::to_string(exact->width) + " x " + std::to_string(exact->height));
      continue;
    }
    Loaded one{{}, std::move(*image), {}};
    one.picture.method = method;
    one.picture.row = row;
    one.difference = differences(one.image, *exact);
    measure(*exact, layers, one);
    findWorst(one.difference, exact->width, exact->height, one.picture);
    if (row && std::fabs(row->rmse_exact - one.picture.rmse) > 0.1 + 0.03 * row->rmse_exact) {
      maker.made.problems.push_back("images/" + name + ".pfm is " + readableNumber(one.picture.rmse) +
                                    " RMSE from its reference, the table says " + readableNumber(row->rmse_exact));
    }
    loaded.push_back(std::move(one));
  }
  if (loaded.empty()) return;

  PictureGroup group;
  group.setting = setting;
  group.width = exact->width;
  group.height = exact->height;
  // One scale for all methods, so that they can be compared by eye: it shows most of core_tail's differences, or of the method
  // in the middle.
  std::vector<double> ends;
  double end = 0.0;
  for (const Loaded& one : loaded) {
    ends.push_back(one.picture.p999);
    if (one.picture.method == "core_tail") end = one.picture.p999;
  }
  std::sort(ends.begin(), ends.end());
  if (end <= 0.0) end = ends[ends.size() / 2];
  while (group.scale < 64.0 && 2.0 * group.scale * end <= 255.0) group.scale *= 2.0;

  const Image exact_image = shown(*exact);
  group.exact = maker.save(prefix + "-R_exact", exact_image);
  if (const std::optional<FloatPicture> forward = maker.read(prefix + "-R_forward", 3, true); forward && sameSize(*forward, *exact)) {
    group.forward = maker.save(prefix + "-R_forward", shown(*forward));
  }
  for (Loaded& one : loaded) {
    const std::string name = dashed(prefix, dashed(one.picture.method, setting.capture));
    Image difference(exact->width, exact->height);
    uint64_t off = 0, hair = 0;
    for (size_t i = 0; i < one.difference.size(); ++i) {
      const double t = group.scale * static_cast<double>(one.difference[i]) / 255.0;
      hair += layers ? layers->values[i] >= 0.5f : 1;
      off += t > 1.0 ? 1 : 0;
      setPixel(difference, static_cast<uint32_t>(i % exact->width), static_cast<uint32_t>(i / exact->width), differenceColor(t));
    }
    one.picture.off_scale = hair > 0 ? static_cast<double>(off) / static_cast<double>(hair) : 0.0;
    const Image image = shown(one.image);
    one.picture.image = maker.save(name, image);
    if (one.picture.detail_size > 0) {
      one.picture.detail = maker.save(name + "-detail", magnified({&image, &exact_image, &difference}, one.picture.detail_x,
                                                                  one.picture.detail_y, one.picture.detail_size));
      if (std::min(exact->width, exact->height) > 2 * one.picture.detail_size) frame(difference, one.picture);
    }
    one.picture.difference = maker.save(name + "-difference", difference);
    group.methods.push_back(std::move(one.picture));
  }
  maker.made.groups.push_back(std::move(group));
}

PictureColor between(const ColorStop* stops, size_t count, double at, bool linear) {
  size_t i = 0;
  while (i + 2 < count && at > stops[i + 1].at) ++i;
  const double t = std::clamp((at - stops[i].at) / (stops[i + 1].at - stops[i].at), 0.0, 1.0);
  const auto channel = [&](double a, double b) {
    const double value = a + t * (b - a);
    return static_cast<int>(std::lround(255.0 * (linear ? toSrgb(value) : value)));
  };
  return {channel(stops[i].r, stops[i + 1].r), channel(stops[i].g, stops[i + 1].g), channel(stops[i].b, stops[i + 1].b)};
}

}  // namespace

std::string PictureColor::css() const {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(r) & 255u, static_cast<unsigned>(g) & 255u, static_cast<unsigned>(b) & 255u);
  return text;
}

PictureColor layersColor(double fragments) {
  // Linear, the same as in shaders/lib/display.glsl.
  static constexpr ColorStop stops[] = {{1, 0.5, 0.5, 0.5}, {8, 0.05, 0.1, 0.9}, {50, 0.05, 0.7, 0.1}, {100, 0.9, 0.05, 0.02}};
  return between(stops, std::size(stops), fragments, true);
}

PictureColor differenceColor(double t) {
  static constexpr ColorStop stops[] = {{0.0, 0.0, 0.0, 0.02},   {0.2, 0.20, 0.06, 0.40}, {0.45, 0.60, 0.16, 0.42},
                                        {0.7, 0.93, 0.42, 0.20}, {0.88, 0.99, 0.77, 0.25}, {1.0, 1.0, 1.0, 0.90}};
  return between(stops, std::size(stops), t, false);
}

Pictures makePictures(const StudyFacts& facts, const std::string& study, const std::string& folder,
                      const std::function<void(uint64_t, uint64_t)>& progress) {
  constexpr size_t kMaxViews = 24;
  Maker maker(facts, study, folder);
  std::map<std::string, FloatPicture> layers;
  const size_t views = std::min(facts.views.size(), kMaxViews);
  const uint64_t total = views * (1 + facts.hair_colours.size());
  uint64_t done = 0;
  for (size_t i = 0; i < views; ++i) {
    makeLayers(maker, facts.views[i], layers);
    progress(++done, total);
  }
  // Captures hardly differ in their pictures: each view and colour is shown by one of them.
  std::vector<Setting> settings = {facts.main};
  for (const std::string& hair_colour : facts.hair_colours) {
    for (size_t i = 0; i < views; ++i) {
      std::optional<Setting> chosen;
      size_t most = 0;
      for (const std::string& capture : facts.captures) {
        const Setting setting{facts.views[i].name, capture, hair_colour};
        const size_t rows = facts.rows(setting).size() + (capture == facts.main.capture ? 1 : 0);
        if (!facts.rows(setting).empty() && rows > most) chosen = setting, most = rows;
      }
      if (chosen && *chosen != facts.main) settings.push_back(*chosen);
    }
  }
  for (const Setting& setting : settings) {
    const auto found = layers.find(setting.view);
    makeGroup(maker, setting, found == layers.end() ? nullptr : &found->second);
    ++done;
    progress(done, std::max(total, done));
  }
  return std::move(maker.made);
}

}  // namespace forelock::samples
