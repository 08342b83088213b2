// SPDX-License-Identifier: MIT
#include "measurement.h"

#include <algorithm>
#include <set>

namespace forelock::study {
namespace {

constexpr uint32_t kDefaultTaps = 25, kDefaultK = 8;

class List {
public:
  List(const Options& options, const Room& room) : options_(options), room_(room) {
    for (const std::string& name : options.methods) methods_.push_back(findMethod(name));
    const auto has = [](const auto& values, const auto& value) { return std::find(values.begin(), values.end(), value) != values.end(); };
    k_ = has(options.k, kDefaultK) ? kDefaultK : options.k.front();
    taps_ = has(options.core_taps, kDefaultTaps) ? kDefaultTaps : options.core_taps.front();
    payload_ = has(options.payloads, std::string("default")) ? "default" : options.payloads.front();
    size_ = has(options.shadow_sizes, room.default_shadow_size) || room.scene_lights ? room.default_shadow_size
                                                                                     : options.shadow_sizes.front();
  }

  // The setting of rows that follow.
  void set(const std::string& capture, samples::HairColor color, uint32_t lights) {
    capture_ = capture, color_ = color, lights_ = lights;
  }

  void main(const std::string& view, bool all) {
    for (const Method* method : methods_)
      if (all || method->in_every_view) add(row(view, method));
  }
  void sweepK(const std::string& view) {
    for (const char* name : {"core_tail", "core_only"})
      // A quick look is content with one curve.
      for (const uint32_t k : options_.amount == Amount::quick && std::string(name) != kBaseline ? std::vector<uint32_t>{} : options_.k)
        with(view, name, [k](Measurement& m) { m.k = k; });
  }
  void sweepTaps(const std::string& view) {
    for (const uint32_t taps : options_.core_taps) with(view, kBaseline, [taps](Measurement& m) { m.core_taps = taps; });
  }
  void sweepPayload(const std::string& view) {
    for (const std::string& payload : options_.payloads)
      for (const char* name : {"core_tail_list", "core_tail", "forward"})
        with(view, name, [&payload](Measurement& m) { m.payload = payload; });
  }
  void sweepShadow(const std::string& view) {
    if (room_.scene_lights && !options_.shadow_sizes_given) return;
    for (const uint32_t size : options_.shadow_sizes) with(view, kBaseline, [size](Measurement& m) { m.shadow_size = size; });
  }

  std::vector<Measurement> rows;

private:
  Measurement row(const std::string& view, const Method* method) const {
    Measurement m;
    m.view = view, m.method = method, m.capture = capture_, m.color = color_, m.lights = lights_;
    m.k = k_, m.core_taps = taps_, m.payload = payload_, m.shadow_size = size_;
    m.main = true;
    return m;
  }
  template <class Change>
  void with(const std::string& view, const char* name, const Change& change) {
    const Method* method = findMethod(name);
    if (std::find(methods_.begin(), methods_.end(), method) == methods_.end()) return;
    Measurement m = row(view, method);
    m.main = false;
    change(m);
    add(m);
  }
  void add(Measurement m) {
    m.k_sort = std::max(options_.k_sort ? options_.k_sort : kDefaultK, m.method->has_core ? m.k : 0u);
    if (!m.method->lists) m.payload = "default";
    if (seen_.insert(m.key()).second) rows.push_back(m);
  }

  const Options& options_;
  const Room& room_;
  std::vector<const Method*> methods_;
  uint32_t k_, taps_, size_;
  std::string payload_, capture_;
  samples::HairColor color_{};
  uint32_t lights_ = 1;
  std::set<std::string> seen_;
};

}  // namespace

std::string Measurement::key() const {
  std::string text = view + "," + method->name + "," + capture + "," + payload + "," + std::to_string(lights) + "," +
                     colorName(color) + "," + std::to_string(shadow_size) + ",";
  text += (method->has_core ? std::to_string(k) : "") + ",";
  text += (method->sorts ? std::to_string(k_sort) : "") + ",";
  return text + (method->shades_fully ? std::to_string(core_taps) : "");
}

const std::string& mainView(const std::vector<std::string>& views) {
  const auto found = std::find(views.begin(), views.end(), "198k");
  return found == views.end() ? views.front() : *found;
}

void applyMeasurement(const Measurement& m, FlkFrame& frame) {
  m.method->set(frame);
  frame.k = m.k ? m.k : FLK_K_NONE;
  frame.k_sort = m.k_sort;
  frame.payload = m.payload == "paper" ? FLK_PAYLOAD_PAPER : FLK_PAYLOAD_DEFAULT;
  frame.capture = m.capture == "compute" ? FLK_CAPTURE_COMPUTE : FLK_CAPTURE_RASTER;
  // As the paper has it: lists that suffice, and nothing kept for those that do not.
  frame.overflow = FLK_OVERFLOW_DROP;
  // Of the paper's payload alone: colours up to 4, since fragments are brighter than the pixels they make up.
  frame.exposure = 0.25f;
  frame.timestamps = FLK_TIMESTAMPS_FRAME;
  frame.core_taps = m.core_taps;
}

std::vector<Measurement> listMeasurements(const Options& options, const Room& room) {
  std::vector<std::string> captures;
  for (const std::string& capture : options.captures)
    if (capture == "raster" ? room.raster : room.compute) captures.push_back(capture);
  if (captures.empty() && !options.captures_given && room.compute) captures.push_back("compute");
  if (captures.empty()) throw UsageError("--capture: this device's queue has no graphics, use compute");
  const std::vector<uint32_t> lights = room.scene_lights ? std::vector<uint32_t>{room.scene_lights} : options.lights;
  const std::string& first = mainView(room.views);
  const bool full = options.amount == Amount::full;

  List list(options, room);
  bool leading = true;  // the first setting, which has all sweeps
  for (const uint32_t count : lights)
    for (const samples::HairColor color : options.colors)
      for (const std::string& capture : captures) {
        list.set(capture, color, count);
        list.main(first, true);
        if (leading || full) list.sweepK(first);
        if (options.amount == Amount::quick) {
          leading = false;
          continue;
        }
        for (const std::string& view : room.views)
          if (view != first) list.main(view, full);
        if (leading || full) {
          list.sweepTaps(first);
          list.sweepPayload(first);
          list.sweepShadow(first);
          for (const std::string& view : room.views)
            if (full && view != first) list.sweepK(view);
        }
        leading = false;
      }
  if (list.rows.empty()) throw UsageError("--methods and the other lists leave nothing to measure");
  return list.rows;
}

}  // namespace forelock::study
