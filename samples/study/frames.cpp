// SPDX-License-Identifier: MIT
#include "frames.h"

#include <algorithm>
#include <chrono>

namespace forelock::study {

void setCamera(FlkFrame& frame, const Matrices& matrices) {
  std::copy(matrices.view_from_world, matrices.view_from_world + 16, frame.view_from_world);
  std::copy(matrices.clip_from_view, matrices.clip_from_view + 16, frame.clip_from_view);
  frame.reversed_depth = matrices.reversed_depth;
}

void DeviceSubject::setColor(samples::HairColor color) {
  color_ = color;
  for (const std::vector<FlkHair>& handles : handles_)
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const FlkMaterial material = subjectMaterial(subject_, i, color);
      flkHairSetMaterial(handles[i], &material);
    }
}

const std::vector<FlkHair>& DeviceSubject::hairs(Order order) {
  const auto index = std::size_t(order);
  if (!handles_[index].empty()) return handles_[index];
  for (std::size_t i = 0; i < subject_.assets.size(); ++i) {
    const SubjectAsset& asset = subject_.assets[i];
    const FlkMaterial material = subjectMaterial(subject_, i, color_);
    FlkHairDesc desc = hairDesc();
    desc.asset = asset.opened.asset.get();
    desc.material = &material;
    desc.flags = asset.flags | (order == Order::kept ? uint32_t(FLK_HAIR_KEEP_ORDER) : 0u);
    desc.shuffle_seed = uint32_t(order);
    desc.follow = asset.follow;
    FlkHair hair = nullptr;
    FlkResult result = host_.createHair(desc, &hair);
    owned_[index].emplace_back(hair);
    if (result == FLK_SUCCESS) result = flkHairSetTransform(hair, asset.world_from_hair);
    if (result != FLK_SUCCESS) {
      owned_[index].clear();
      throw std::runtime_error(asset.opened.label + ": no hair can be made of it, " + flkResultName(result) +
                               (host_.messages().empty() ? "" : " (" + host_.messages().back() + ")"));
    }
  }
  for (const Hair& hair : owned_[index]) handles_[index].push_back(hair);
  return handles_[index];
}

Drawing::Drawing(samples::HeadlessHost& host, DeviceSubject& subject, const FlkFrame& frame, uint32_t width, uint32_t height)
    : host_(host), subject_(subject), frame_(frame), width_(width), height_(height) {
  FlkViewDesc desc{};
  desc.type = FLK_TYPE_VIEW;
  desc.frames_in_flight = 1;
  desc.pool_budget = uint64_t(1) << 30;  // the 2^26 nodes that lists can address, of 16 bytes
  if (create(host.context(), desc, lists_) != FLK_SUCCESS) throw RowFailure("failed: no view can be made");
}

double Drawing::render(FlkFrame frame) {
  if (!host_.resize(width_, height_)) throw RowFailure("failed: no device memory for a target");
  const auto begin = std::chrono::steady_clock::now();
  const FlkResult result = host_.render(lists_, frame, &plan_);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (result != FLK_SUCCESS)
    throw RowFailure(std::string("failed: ") + flkResultName(result) + (host_.messages().empty() ? "" : ", " + host_.messages().back()));
  if (host_.statistics(lists_, statistics_) != FLK_SUCCESS) throw RowFailure("failed: the frame has no statistics");
  return statistics_.milliseconds_frame;
}

void Drawing::prepare() {
  const std::vector<FlkHair>& hairs = subject_.hairs(Order::kept);
  FlkFrame frame = frame_;
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  frame.count_only = 1;
  render(frame);
  for (int attempt = 0; attempt < 4; ++attempt) {
    draw();
    if (statistics_.overflow_fragments == 0) return;
  }
  throw RowFailure("overflow: " + std::to_string(statistics_.overflow_fragments) + " of " + std::to_string(statistics_.fragments) +
                   " fragments find no room in the device's lists");
}

double Drawing::draw(Order order) {
  const std::vector<FlkHair>& hairs = subject_.hairs(order);
  FlkFrame frame = frame_;
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  return render(frame);
}

double Drawing::drawStages() {
  const std::vector<FlkHair>& hairs = subject_.hairs(Order::kept);
  FlkFrame frame = frame_;
  frame.timestamps = FLK_TIMESTAMPS_STAGES;
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  return render(frame);
}

void Drawing::drawMoved(const Matrices& matrices) {
  const std::vector<FlkHair>& hairs = subject_.hairs(Order::kept);
  FlkFrame frame = frame_;
  setCamera(frame, matrices);
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  render(frame);
}

void Drawing::drawCounted() {
  const std::vector<FlkHair>& hairs = subject_.hairs(Order::kept);
  FlkFrame frame = frame_;
  frame.count_work = 1;
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  render(frame);
}

Picture Drawing::picture(const Rect& rect) { return fromDevice(host_.readColor(), width_, rect); }

}  // namespace forelock::study
