// The subject on the device, and frames of it. SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"
#include "lighting.h"
#include "picture.h"
#include "subject.h"
#include "views.h"

#include <forelock/forelock.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::study {

// Why a row has no numbers; what() is its status.
struct RowFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Orders in which strands are submitted.
enum class Order { kept, first_shuffle, second_shuffle };

class DeviceSubject {
public:
  // Uploads nothing yet. Both outlive it.
  DeviceSubject(samples::HeadlessHost& host, const Subject& subject) : host_(host), subject_(subject) {}

  void setColor(samples::HairColor color);
  // Made when first asked for. Throws std::runtime_error: no memory.
  const std::vector<FlkHair>& hairs(Order order);

private:
  samples::HeadlessHost& host_;
  const Subject& subject_;
  samples::HairColor color_ = samples::HairColor::dark;
  std::vector<Hair> owned_[3];
  std::vector<FlkHair> handles_[3];
};

// One method's frames of one view: lists of its own, so that frames of two methods can alternate. The pointers in `frame` are
// to what the maker keeps alive.
class Drawing {
public:
  // `frame` has camera, lights and method, but no hairs.
  Drawing(samples::HeadlessHost& host, DeviceSubject& subject, const FlkFrame& frame, uint32_t width, uint32_t height);

  // Sizes the lists so that nothing overflows and draws once. Throws RowFailure.
  void prepare();
  // One frame, waited for; its device time (ms). Throws RowFailure.
  double draw(Order order = Order::kept);
  // With a time for each stage, which keeps stages apart that may else overlap; statistics() then has them.
  double drawStages();
  // With the camera moved.
  void drawMoved(const Matrices& matrices);
  // With counters; statistics() then has them.
  void drawCounted();

  const FlkStatistics& statistics() const { return statistics_; }
  // Of the rectangle, of the last frame.
  Picture picture(const Rect& rect);
  FlkPlan plan() const { return plan_; }
  FlkView view() const { return lists_.get(); }
  // By the wall clock, of the last frame.
  double seconds() const { return seconds_; }

private:
  double render(FlkFrame frame);

  samples::HeadlessHost& host_;
  DeviceSubject& subject_;
  FlkFrame frame_;
  uint32_t width_, height_;
  FlkPlan plan_ = nullptr;
  double seconds_ = 0;
  FlkStatistics statistics_{};
  forelock::View lists_;
};

// Camera of a frame.
void setCamera(FlkFrame& frame, const Matrices& matrices);

}  // namespace forelock::study
