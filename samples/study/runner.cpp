// SPDX-License-Identifier: MIT
#include "runner.h"

#include "csv.h"
#include "dense.h"
#include "device_file.h"
#include "flip.h"
#include "frames.h"
#include "limit.h"
#include "measurement.h"
#include "metrics.h"
#include "references.h"
#include "status_line.h"
#include "study_commit.h"
#include "view_search.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

namespace forelock::study {

using samples::HairColor;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double processorSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + 1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

FlipInput flipInput(const Picture& picture) {
  FlipInput input{picture.width, picture.height, picture.rgb};
  for (float& c : input.rgb) c = std::clamp(c, 0.0f, 1.0f);
  return input;
}

double meanFlip(const Picture& reference, const Picture& test) {
  const std::vector<float> values = flip(flipInput(reference), flipInput(test));
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (reference.isHair(i) || test.isHair(i)) sum += double(values[i]), n += 1;
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

// Supersampled coverage takes about a second a million fragments: beyond this only --full makes it.
constexpr double kCoverFragments = 8e6;

// A view in one light and colour: references, and how bright the lights are.
struct Setting {
  std::size_t view = 0;
  HairColor color{};
  uint32_t lights = 0;
  Lighting lighting;  // scaled
  References references;
};

// Times of a row and of the baseline, frame by frame in turn.
struct Times {
  std::vector<double> baseline, row, stages[FLK_STAGE_COUNT];
  double processor_s = 0, wall_s = 0;  // of the row's frames
};

class Study {
public:
  explicit Study(const Options& options) : options_(options), begin_(Clock::now()) {}
  int run();

private:
  bool openDevice();
  void openFolder();
  void findWhatToMeasure();
  void warnOfMissing() const;
  Setting& setting(const Measurement& m);
  FlkFrame frameOf(const Measurement& m, const Setting& s);
  Drawing& baseline(const Measurement& m, const Setting& s);
  void measure(const Measurement& m, Row& row);
  void errors(const Measurement& m, const Setting& s, const Picture& picture, Row& row) const;
  Times timeRow(Drawing& base, Drawing& drawing) const;
  void checkOrder(Drawing& drawing, const Setting& s, const Picture& first, const Picture& second, Row& row) const;
  void describe(const Measurement& m, Row& row) const;
  double estimate(const Measurement& m) const;
  double estimateLeft(std::size_t from) const;
  std::string imagePath(const std::string& name) const { return options_.out + "/images/" + name + ".pfm"; }
  bool onProcessor() const { return host_->deviceType() == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  const Options& options_;
  Clock::time_point begin_;
  StatusLine status_;
  Subject subject_;
  std::unique_ptr<samples::HeadlessHost> host_;
  std::unique_ptr<StudyFile> file_;
  std::unique_ptr<DeviceSubject> device_;
  Calibration calibration_;
  DeviceFacts facts_;
  std::vector<View> views_;
  std::vector<Measurement> rows_;  // that are not in the file yet
  std::size_t done_ = 0;
  Twin twin_;
  std::optional<HairColor> twin_color_;
  std::optional<Setting> setting_;
  std::unique_ptr<Drawing> baseline_;
  std::string baseline_capture_;
  // Seconds a row and fragment, of what was measured so far; and of one reference image a fragment.
  double row_s_ = 0, row_fragments_ = 0, reference_s_ = 0, reference_fragments_ = 0;
  // Lights whose references were made or are at hand, "view,colour,lights".
  std::set<std::string> prepared_;
  std::set<std::string> announced_;
};

std::string settingKey(const Measurement& m) {
  return m.view + "," + colorName(m.color) + "," + std::to_string(m.lights);
}

bool Study::openDevice() {
  samples::HeadlessOptions wanted;
  wanted.validation = options_.validation;
  wanted.device_name = options_.device;
  std::string error;
  host_ = samples::HeadlessHost::create(wanted, error);
  if (!host_)
    status_.print("no usable device: " + error + "; install a Vulkan 1.3 driver (Debian without a GPU: mesa-vulkan-drivers), or look "
                                                 "with `vulkaninfo --summary`");
  return host_ != nullptr;
}

void Study::openFolder() {
  namespace fs = std::filesystem;
  const std::string path = options_.out + "/study.csv";
  std::error_code error;
  if (fs::exists(path, error) && !options_.resume)
    throw UsageError(options_.out + ": holds a study already, add --resume to go on with it or choose another folder");
  fs::create_directories(options_.out + "/references", error);
  if (options_.images) fs::create_directories(options_.out + "/images", error);
  if (error) throw std::runtime_error(options_.out + ": cannot be made, " + error.message());
  file_ = std::make_unique<StudyFile>(path);
  for (const Row& row : file_->rows()) {
    if (row["asset"] != subject_.name)
      throw UsageError(options_.out + ": is a study of " + row["asset"] + ", not of " + subject_.name + "; choose another folder");
    if (row["device"] != host_->deviceName())
      throw UsageError(options_.out + ": was measured on " + row["device"] + ", not on " + host_->deviceName() + "; choose another folder");
  }
}

void Study::findWhatToMeasure() {
  std::vector<std::string> notes;
  device_ = std::make_unique<DeviceSubject>(*host_, subject_);
  device_->setColor(options_.colors.front());
  views_ = findViews(*host_, *device_, subject_, options_, [&](const std::string& what) { status_.show(0, 0, what); }, notes);
  for (const std::string& note : notes) status_.print(note);

  Room room;
  for (const View& view : views_) room.views.push_back(view.name);
  room.raster = host_->queueHasGraphics();
  if (subject_.has_setting) {
    const Lighting lighting = makeLighting(subject_, views_.front().camera, 0);
    room.scene_lights = std::max<uint32_t>(1, uint32_t(lighting.lights.size()));
    room.default_shadow_size = shadowSizeOf(lighting);
  }
  std::set<std::string> there;
  const auto keyOf = [](const Row& row) {
    std::string key;
    for (const char* column : {"view", "method", "capture", "payload", "lights", "hair_colour", "shadow_size", "k", "k_sort", "core_taps"})
      key += (key.empty() ? "" : ",") + row[column];
    return key;
  };
  for (const Row& row : file_->rows()) there.insert(keyOf(row));
  for (const Measurement& m : listMeasurements(options_, room))
    if (!there.contains(m.key())) rows_.push_back(m);
}

FlkFrame Study::frameOf(const Measurement& m, const Setting& s) {
  FlkFrame frame{};
  frame.type = FLK_TYPE_FRAME;
  applyMeasurement(m, frame);
  setCamera(frame, views_[s.view].matrices);
  frame.lights = s.lighting.lights.data();
  frame.light_count = uint32_t(s.lighting.lights.size());
  std::copy(s.lighting.ambient, s.lighting.ambient + 3, frame.ambient);
  frame.ambient_sh = s.lighting.has_sh ? s.lighting.ambient_sh.data() : nullptr;
  return frame;
}

Setting& Study::setting(const Measurement& m) {
  const auto found = std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.name == m.view; });
  const auto index = std::size_t(found - views_.begin());
  if (setting_ && setting_->view == index && setting_->color == m.color && setting_->lights == m.lights) return *setting_;
  baseline_.reset();
  setting_.reset();
  device_->setColor(m.color);
  if (!twin_color_) twin_ = makeTwin(subject_, m.color);
  else if (*twin_color_ != m.color) setTwinMaterials(twin_, subject_, m.color);
  twin_color_ = m.color;

  View& view = views_[index];
  ReferenceWish wish;
  wish.cover = options_.amount == Amount::full || double(view.fragments) < kCoverFragments;
  wish.says = [&](const char* what) { status_.show(done_, done_ + rows_.size(), "view " + view.name + ": " + what); };
  Setting made;
  made.view = index, made.color = m.color, made.lights = m.lights;
  made.lighting = makeLighting(subject_, view.camera, m.lights);
  const Clock::time_point begin = Clock::now();
  made.references = makeReferences(twin_, view, made.lighting, m.color, wish, ReferenceCache(options_.out + "/references"));
  reference_s_ += secondsSince(begin), reference_fragments_ += double(view.fragments);
  made.lighting.scale(made.references.factor);
  prepared_.insert(settingKey(m));

  writeDeviceFile(options_.out + "/device.json", facts_, views_);  // with the view's largest overdraw now
  if (m.color == options_.colors.front() && m.lights == (subject_.has_setting ? m.lights : options_.lights.front())) {
    writeSceneFile(options_.out + "/scene-" + view.name + ".json", subject_, view, m.color, made.references.factor);
    if (options_.images) {
      const Picture& exact = made.references.exact[0];
      std::vector<float> layers(exact.fragments.begin(), exact.fragments.end());
      writePfm(imagePath(view.name + "-layers"), layers, exact.width, exact.height);
      if (!made.references.cover.empty()) writePfm(imagePath(view.name + "-R_cover"), made.references.cover, exact.width, exact.height);
    }
  }
  if (options_.images && (subject_.has_setting || m.lights == options_.lights.front())) {
    writePfm(imagePath(view.name + "-" + colorName(m.color) + "-R_exact"), made.references.exact[0]);
    writePfm(imagePath(view.name + "-" + colorName(m.color) + "-R_forward"), made.references.forward);
  }
  setting_ = std::move(made);
  if (announced_.insert(view.name).second) {
    char text[200];
    std::snprintf(text, sizeof text, "view %s: %u x %u, %.2f M fragments on %.1f k pixels, %.1f layers on average, at most %u", view.name.c_str(),
                  view.width, view.height, double(view.fragments) / 1e6, double(view.hair_pixels) / 1e3,
                  double(view.fragments) / double(view.hair_pixels), view.max_overdraw);
    status_.printPiped(text);
  }
  return *setting_;
}

// core_tail, k 8, default settings, of the row's view, light and capture.
Drawing& Study::baseline(const Measurement& m, const Setting& s) {
  if (baseline_ && baseline_capture_ == m.capture) return *baseline_;
  Measurement base;
  base.view = m.view, base.method = findMethod(kBaseline), base.capture = m.capture;
  const View& view = views_[s.view];
  baseline_ = std::make_unique<Drawing>(*host_, *device_, frameOf(base, s), view.width, view.height);
  baseline_capture_ = m.capture;
  baseline_->prepare();
  return *baseline_;
}

Times Study::timeRow(Drawing& base, Drawing& drawing) const {
  const bool cpu = onProcessor();
  const uint32_t wanted = options_.frames ? options_.frames : cpu ? 5 : 101;
  // What both have drawn last says what a pair costs; a GPU is then warmed up by as many pairs as will be timed, and for long enough
  // to bring its clocks up again, which fall while references are made.
  const double pair_s = std::max(base.seconds() + drawing.seconds(), 1e-6);
  const double budget_s = options_.amount == Amount::quick ? 2.5 : options_.amount == Amount::full ? 25 : 12;
  const auto pairs = uint32_t(std::clamp(budget_s / pair_s, 2.0, double(wanted)));
  constexpr double kWarmUp_s = 0.5;
  const Clock::time_point began = Clock::now();
  for (uint32_t i = 0; !cpu && (i < pairs || secondsSince(began) < kWarmUp_s); ++i) base.draw(), drawing.draw();
  Times times;
  for (uint32_t i = 0; i < pairs; ++i) {
    times.baseline.push_back(cpu ? base.drawStages() : base.draw());
    const double processor = processorSeconds();
    const Clock::time_point start = Clock::now();
    times.row.push_back(cpu ? drawing.drawStages() : drawing.draw());  // a processor runs one stage at a time
    times.wall_s += secondsSince(start);
    times.processor_s += processorSeconds() - processor;
    if (!cpu) drawing.drawStages();
    for (int stage = 0; stage < FLK_STAGE_COUNT; ++stage)
      if (drawing.statistics().milliseconds[stage] >= 0) times.stages[stage].push_back(drawing.statistics().milliseconds[stage]);
  }
  return times;
}

void Study::checkOrder(Drawing& drawing, const Setting& s, const Picture& first, const Picture& second, Row& row) const {
  const Rect& rect = views_[s.view].rect;
  drawing.draw(Order::first_shuffle);
  const Picture third = drawing.picture(rect);
  drawing.draw(Order::second_shuffle);
  const Picture fourth = drawing.picture(rect);
  row.set("order_noise", compare(third, fourth).rmse);
  row.set("deterministic", sameBits(first, second) && sameBits(first, third) && sameBits(first, fourth) ? "1" : "0");
}

void Study::errors(const Measurement&, const Setting& s, const Picture& picture, Row& row) const {
  const References& r = s.references;
  const Errors exact = compare(picture, r.exact[0]);
  row.set("rmse_forward", compare(picture, r.forward).rmse);
  row.set("rmse_exact", exact.rmse);
  row.set("rmse_exact_channel", exact.rmse_channel);
  row.set("p999_exact", exact.p999);
  row.set("radiance_ratio", exact.radiance_ratio);
  if (!r.cover.empty()) row.set("rmse_cover", compareOpacity(picture, r.cover));
  row.set("perceptual", meanFlip(r.exact[0], picture));
}

// What is known of a row before it is measured.
void Study::describe(const Measurement& m, Row& row) const {
  const View& view = *std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.name == m.view; });
  row.set("asset", subject_.name);
  row.set("view", view.name);
  row.set("width", view.width), row.set("height", view.height);
  row.set("hair_pixels", view.hair_pixels);
  row.set("method", m.method->name);
  row.set("store", m.method->lists ? "linked_list" : "none");
  row.set("capture", m.capture);
  if (m.method->has_core) row.set("k", m.k);
  if (m.method->sorts) row.set("k_sort", m.k_sort);
  if (m.method->shades_fully) row.set("core_taps", m.core_taps);
  row.set("payload", m.payload);
  row.set("lights", m.lights);
  row.set("hair_colour", colorName(m.color));
  row.set("shadow_size", m.shadow_size);
  row.set("commit", facts_.commit);
  row.set("device", facts_.device);
  row.set("driver", facts_.driver);
}

void Study::measure(const Measurement& m, Row& row) {
  Setting& s = setting(m);
  const View& view = views_[s.view];
  row.set("reference_hash", s.references.reference_hash);
  row.set("scene_hash", s.references.scene_hash);
  if (view.max_overdraw) row.set("max_overdraw", view.max_overdraw);

  // Other sizes of the shadow map than the setting's.
  std::vector<FlkLight> lights = s.lighting.lights;
  for (FlkLight& light : lights)
    if (light.casts_shadow && m.shadow_size != shadowSizeOf(s.lighting)) light.shadow_size = m.shadow_size;
  FlkFrame frame = frameOf(m, s);
  frame.lights = lights.data();

  Drawing& base = baseline(m, s);
  Drawing drawing(*host_, *device_, frame, view.width, view.height);
  drawing.prepare();
  const Picture picture = drawing.picture(view.rect);
  if (!isFinite(picture)) throw RowFailure("not finite");
  FlkPlanInfo plan{};
  flkPlanGetInfo(drawing.plan(), &plan);
  const uint64_t fragments = drawing.statistics().fragments;
  row.set("fragments", m.method->lists ? fragments : view.fragments);
  row.set("mean_overdraw", double(view.fragments) / double(view.hair_pixels));
  row.set("segments", plan.segment_count);
  if (plan.low_shade_taps) row.set("tail_taps", plan.low_shade_taps);
  row.set("bytes_persistent", plan.bytes_persistent);
  row.set("bytes_transient", plan.bytes_transient);
  row.set("limit_us", limitMicroseconds(drawing.plan(), {fragments, view.hair_pixels}, calibration_));
  errors(m, s, picture, row);

  const Times times = timeRow(base, drawing);
  row.set("overflow_fragments", drawing.statistics().overflow_fragments);
  row.set("frames", uint64_t(times.row.size()));
  row.set("ms_total", median(times.row));
  row.set("ms_p5", percentile(times.row, 0.05)), row.set("ms_p95", percentile(times.row, 0.95));
  const auto stage = [&](int index) { return median(times.stages[index]); };
  const double clear = stage(FLK_STAGE_CLEAR), prepare = stage(FLK_STAGE_PREPARE);
  row.set("ms_prepare", times.stages[FLK_STAGE_PREPARE].empty() ? clear : clear + prepare);
  row.set("ms_shadow", stage(FLK_STAGE_SHADOW));
  row.set("ms_capture", stage(FLK_STAGE_CAPTURE));
  row.set("ms_resolve", stage(FLK_STAGE_RESOLVE));
  row.set("cpu_per_wall", times.processor_s / times.wall_s);
  const PairRatio ratio = pairRatio(times.baseline, times.row, onProcessor() ? times.row.size() : 5);
  row.set("pair_ratio", ratio.ratio);
  row.set("pair_spread", ratio.spread);

  const Picture again = drawing.picture(view.rect);  // of the last timed frame
  row.set("frame_noise", compare(picture, again).rmse);
  const double frame_s = times.wall_s / double(times.row.size());
  if (m.main || frame_s < 0.15) {
    checkOrder(drawing, s, picture, again, row);
    std::vector<Picture> moved{picture};
    for (std::size_t i = 1; i < kDrift.size(); ++i) {
      drawing.drawMoved(shifted(view.matrices, view.width, view.height, kDrift[i][0], kDrift[i][1]));
      moved.push_back(drawing.picture(view.rect));
    }
    row.set("temporal_drift", drift(moved, s.references.exact));
  }
  drawing.drawCounted();
  row.set("full_shades", drawing.statistics().full_shades);
  row.set("shadow_taps", drawing.statistics().shadow_taps);

  FlkShadowMap map{};
  if (m.main && std::string_view(m.method->name) == "forward" && subject_.assets.size() == 1 &&
      flkViewGetShadowMap(drawing.view(), 0, 0, &map) == FLK_SUCCESS) {
    status_.show(done_, done_ + rows_.size(), "view " + view.name + ": its fragments shaded densely");
    if (const auto ms = denseShading(*host_, twin_, view, subjectMaterial(subject_, 0, m.color), s.lighting, map)) row.set("ms_dense", *ms);
  }

  if (options_.images && m.main && (subject_.has_setting || m.lights == options_.lights.front()))
    writePfm(imagePath(view.name + "-" + colorName(m.color) + "-" + m.method->name + "-" + m.capture), picture);
}

// Seconds; 0 before anything is known.
double Study::estimate(const Measurement& m) const {
  const View& view = *std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.name == m.view; });
  double seconds = row_fragments_ > 0 ? double(view.fragments) * row_s_ / row_fragments_ : 0;
  if (!prepared_.contains(settingKey(m)) && reference_fragments_ > 0)
    seconds += double(view.fragments) * reference_s_ / reference_fragments_ * m.lights;
  return seconds;
}

double Study::estimateLeft(std::size_t from) const {
  double seconds = 0;
  std::set<std::string> counted = prepared_;
  for (std::size_t i = from; i < rows_.size(); ++i) {
    const Measurement& m = rows_[i];
    const View& view = *std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.name == m.view; });
    if (row_fragments_ > 0) seconds += double(view.fragments) * row_s_ / row_fragments_;
    if (counted.insert(settingKey(m)).second && reference_fragments_ > 0)
      seconds += double(view.fragments) * reference_s_ / reference_fragments_ * m.lights;
  }
  return seconds;
}

int Study::run() {
  subject_ = openSubject(options_);
  if (!openDevice()) return 3;
  openFolder();
  status_.show(0, 0, "measuring the device");
  const std::string device_file = options_.out + "/device.json";
  const bool given = options_.bandwidth_gb_s > 0 && options_.lane_rate > 0;
  if (!given && !(options_.resume && readCalibration(device_file, host_->deviceName(), calibration_))) calibration_ = calibrate(*host_);
  if (options_.bandwidth_gb_s > 0) calibration_.bytes_per_s = 1e9 * options_.bandwidth_gb_s, calibration_.measured = false;
  if (options_.lane_rate > 0) calibration_.operations_per_s = options_.lane_rate, calibration_.measured = false;
  facts_ = {host_->deviceName(), host_->driverName(), deviceKind(host_->deviceType()), FORELOCK_STUDY_COMMIT, subject_.name, options_.command, calibration_};
  findWhatToMeasure();
  writeDeviceFile(device_file, facts_, views_);

  bool spoken = false;  // the validation layers
  std::size_t failed = 0, next = 0;
  for (; next < rows_.size(); ++next) {
    const Measurement& m = rows_[next];
    if (secondsSince(begin_) + estimate(m) > 60 * options_.minutes) break;
    done_ = next;
    std::string label = m.view + " " + m.method->name;
    if (m.method->has_core) label += " k " + std::to_string(m.k);
    if (!m.main) label += m.payload == "paper" ? ", payload paper" : m.core_taps != 25 ? ", " + std::to_string(m.core_taps) + " taps" : "";
    status_.show(next, rows_.size(), label + " " + m.capture, row_fragments_ > 0 ? estimateLeft(next) : -1);
    Row row;
    describe(m, row);
    const double references_before = reference_s_;
    const Clock::time_point begin = Clock::now();
    try {
      measure(m, row);
      row.set("status", "ok");
    } catch (const RowFailure& failure) {
      row.set("status", failure.what());
      ++failed;
    }
    row_s_ += secondsSince(begin) - (reference_s_ - references_before);
    row_fragments_ += double(std::find_if(views_.begin(), views_.end(), [&](const View& v) { return v.name == m.view; })->fragments);
    if (!host_->validationMessages().empty()) {
      row.set("status", "failed: validation: " + host_->validationMessages().front());
      status_.print("validation: " + host_->validationMessages().front());
      host_->validationMessages().clear();
      spoken = true;
    }
    file_->append(row);
  }
  status_.clear();
  if (failed) status_.print(options_.out + ": " + std::to_string(failed) + " rows could not be measured, their status says why");
  if (next < rows_.size())
    status_.print(options_.out + ": " + std::to_string(rows_.size() - next) + " rows are left after " + std::to_string(long(secondsSince(begin_) / 60 + 0.5)) +
                  " minutes; --resume measures them, --minutes M gives more time");
  std::printf("%s: %zu rows, %zu of them new\n", (options_.out + "/study.csv").c_str(), file_->rows().size(), next);
  return spoken ? 1 : 0;
}

}  // namespace

int runStudy(const Options& options) { return Study(options).run(); }

}  // namespace forelock::study
