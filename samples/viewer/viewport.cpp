// SPDX-License-Identifier: MIT
#include "viewport.h"

#include "asset_source.h"
#include "commands.h"
#include "image.h"
#include "ui.h"
#include "view_measure.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::samples {

namespace {

constexpr float kClickPx = 4.0f;          // a button that moved less was a click
constexpr double kCountAfter_s = 0.15;    // of a mouse that is still
constexpr size_t kMostDrawnStrands = 2000;

}  // namespace

void Viewport::size(uint32_t& width, uint32_t& height) const {
  width = std::clamp(static_cast<uint32_t>(std::lround(rect_.width * scale_)), 16u, 16384u);
  height = std::clamp(static_cast<uint32_t>(std::lround(rect_.height * scale_)), 16u, 16384u);
}

ViewportRect Viewport::pixels() const {
  uint32_t width = 0, height = 0;
  size(width, height);
  return {std::round(rect_.x * scale_), std::round(rect_.y * scale_), static_cast<float>(width), static_cast<float>(height)};
}

void Viewport::draw(ViewSession& session, ViewLayers& layers, const ViewportRect& rect) {
  rect_ = rect;
  scale_ = std::max(ImGui::GetIO().DisplayFramebufferScale.x, 0.1f);
  ImGui::SetNextWindowPos(ImVec2(rect.x, rect.y));
  ImGui::SetNextWindowSize(ImVec2(rect.width, rect.height));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.0f, 0.0f));
  ImGui::Begin("##viewport", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  if (session.loaded()) {
    ImGui::InvisibleButton("##picture", ImVec2(rect.width, rect.height),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    mouse(session, layers);
    drawSelection(session);
    drawLegend(session.stage()->legend);
    if (!session.compiling) {
      drawCount(session, layers);
    }
    drawCaptions(session);
  } else if (session.busy.empty()) {
    welcome(session);
  }
  ImGui::End();
}

// What there is to open, where nothing is.
void Viewport::welcome(ViewSession& session) const {
  const auto middle = [&](float width, float y) { ImGui::SetCursorScreenPos(ImVec2(rect_.x + std::max(0.5f * (rect_.width - width), 8.0f), y)); };
  const float line = ImGui::GetFrameHeightWithSpacing();
  float y = rect_.y + 0.3f * rect_.height;
  for (const char* words : {"Drag a strand file here", ".tfx  .hair  .ply  .gltf  .glb  .flk  .data  .bin  .json"}) {
    middle(ImGui::CalcTextSize(words).x, y);
    ImGui::TextDisabled("%s", words);
    y += line;
  }
  const ui::Scope scope("Welcome");
  const auto wide = [](const std::string& label) { return ImGui::CalcTextSize(label.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x; };
  middle(wide("Open a file..."), y);
  if (ui::button("Open a file...", "Ctrl O")) {
    session.requests.open_file = true;
  }
  if (!session.settings.last_scene.empty()) {
    y += line;
    middle(wide("The last scene"), y);
    if (ui::button("The last scene", "Assets, lights, materials, method and view as they were when the window was closed")) {
      try {
        session.requests.open = parseScene(session.settings.last_scene);
      } catch (const std::exception& error) {
        session.alert = error.what();
      }
    }
  }
  y += 1.5f * line;
  const std::vector<std::string> grooms = groomNames();
  if (!grooms.empty()) {
    middle(ImGui::CalcTextSize("or a groom that comes with Forelock").x, y);
    ImGui::TextDisabled("or a groom that comes with Forelock");
    y += line;
  }
  for (const std::string& name : grooms) {
    middle(wide(name), y);
    if (ui::button(name.c_str(), "Grown when it is opened, in seconds")) {
      session.requests.open = sceneOf(session, "groom:" + name, false);
    }
    y += line;
  }
}

// What the picture is of, along its lower edge.
void Viewport::drawCaptions(ViewSession& session) const {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float y = rect_.y + rect_.height - ImGui::GetFontSize() * 1.6f;
  const ImU32 color = IM_COL32(235, 225, 200, 255);
  if (session.reduced) {
    draw->AddText(ImVec2(rect_.x + 8.0f, rect_.y + 6.0f), IM_COL32(240, 220, 90, 255), "reduced; the full picture follows");
  }
  const bool compares = session.compare != Compare::none && session.shaded();
  if (compares) {
    Scene second;
    applyMethod(session.second, second);
    const std::string left = methodText(session.scene), right = methodText(second);
    if (session.compare == Compare::split) {
      const float x = rect_.x + session.divider * rect_.width;
      draw->AddText(ImVec2(x - ImGui::CalcTextSize(left.c_str()).x - 8.0f, y), color, left.c_str());
      draw->AddText(ImVec2(x + 8.0f, y), color, right.c_str());
    } else {
      char gain[32];
      std::snprintf(gain, sizeof gain, "%.3g", static_cast<double>(session.gain));
      const std::string words = "difference of " + left + " and " + right + ", times " + gain;
      draw->AddText(ImVec2(rect_.x + 8.0f, y), color, words.c_str());
    }
  } else if (!session.used_mouse && session.stage()->legend.title.empty()) {
    draw->AddText(ImVec2(rect_.x + 8.0f, y), IM_COL32(170, 170, 175, 255), "drag: orbit   right drag: pan   wheel: zoom   click: pick a strand   F: frame   F1: keys");
  }
}

void Viewport::mouse(ViewSession& session, ViewLayers& layers) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool over = ImGui::IsItemHovered();
  const float divider_x = rect_.x + session.divider * rect_.width;
  const bool at_divider = session.compare == Compare::split && std::abs(io.MousePos.x - divider_x) < 6.0f;
  const bool idle = drag_ == Drag::none;
  if (idle && over) {
    if (at_divider) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
    if (ImGui::IsMouseClicked(0)) {
      drag_ = at_divider ? Drag::divider : io.KeyShift ? Drag::pan : Drag::turn;
      moved_ = 0.0f;
    } else if (ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2)) {
      drag_ = Drag::pan;
      moved_ = 0.0f;
    }
    if (io.MouseWheel != 0.0f) {
      session.approach_to.reset();
      const glm::dvec2 from_middle(static_cast<double>(io.MousePos.x - rect_.x) - 0.5 * static_cast<double>(rect_.width),
                                   static_cast<double>(io.MousePos.y - rect_.y) - 0.5 * static_cast<double>(rect_.height));
      session.orbit.zoom(static_cast<double>(io.MouseWheel), from_middle, static_cast<double>(rect_.height), session.bounds.size());
    }
    if (ImGui::IsMouseDoubleClicked(0) && !at_divider) {
      pick(session, layers, true);
    }
  }
  if (drag_ == Drag::none) {
    return;
  }
  // The way to where the button went down may be in the same frame, and is no drag.
  const ImVec2 delta = idle ? ImVec2(0.0f, 0.0f) : io.MouseDelta;
  const double dx = static_cast<double>(delta.x), dy = static_cast<double>(delta.y);
  moved_ += std::abs(delta.x) + std::abs(delta.y);
  const bool click_yet = moved_ < kClickPx && drag_ != Drag::divider;
  if (!click_yet && (dx != 0.0 || dy != 0.0)) {
    session.approach_to.reset();
    session.used_mouse = true;
    if (drag_ == Drag::turn) {
      session.orbit.turn(dx, dy, static_cast<double>(rect_.height));
    } else if (drag_ == Drag::pan) {
      session.orbit.pan(dx, dy, static_cast<double>(rect_.height));
    } else {
      session.divider = std::clamp((io.MousePos.x - rect_.x) / rect_.width, 0.02f, 0.98f);
    }
  }
  if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2)) {
    if (click_yet && drag_ == Drag::turn) {
      pick(session, layers, false);
    }
    drag_ = Drag::none;
  }
}

void Viewport::pick(ViewSession& session, ViewLayers& layers, bool go) {
  if (session.compiling) {
    return;
  }
  const ImVec2 at = ImGui::GetIO().MousePos;
  uint32_t width = 0, height = 0;
  size(width, height);
  const glm::dvec2 pixel(static_cast<double>((at.x - rect_.x) * scale_), static_cast<double>((at.y - rect_.y) * scale_));
  const OpaqueDepth opaque = layers.opaqueDepths(width, height);
  std::optional<StrandHit> best;
  size_t best_asset = 0;
  for (size_t a = 0; a < session.plain->assets.size(); ++a) {
    const StagedAsset& asset = session.plain->assets[a];
    FlkStrands strands = {};
    flkAssetGetStrands(asset.opened->asset.get(), &strands);
    const StrandView view{strands, asset.world_from_hair, cameraOf(session.orbit, session.bounds), static_cast<double>(width),
                          static_cast<double>(height), static_cast<double>(asset.material.width_scale)};
    const std::optional<StrandHit> hit = pickStrand(view, pixel, opaque);
    if (hit && (!best || hit->depth_m < best->depth_m)) {
      best = hit;
      best_asset = a;
    }
  }
  if (!best) {
    session.selection = {};
    session.picked.reset();
    return;
  }
  session.selection = {best_asset, {best->strand}, "strand " + std::to_string(best->strand)};
  session.picked = best;
  session.show_strand = true;
  session.say("strand " + groupedDigits(best->strand) + ", vertex " + std::to_string(best->vertex) + "; its numbers are under Strand");
  if (go) {
    session.requests.frame_selection = true;
  }
}

void Viewport::drawSelection(const ViewSession& session) const {
  const Selection& selection = session.selection;
  if (selection.strands.empty() || selection.asset >= session.plain->assets.size()) {
    return;
  }
  const StagedAsset& asset = session.plain->assets[selection.asset];
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  const StrandView view{strands, asset.world_from_hair, cameraOf(session.orbit, session.bounds), static_cast<double>(rect_.width),
                        static_cast<double>(rect_.height), static_cast<double>(asset.material.width_scale)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(ImVec2(rect_.x, rect_.y), ImVec2(rect_.x + rect_.width, rect_.y + rect_.height), true);
  const size_t step = selection.strands.size() / kMostDrawnStrands + 1;  // an even share of very many
  std::vector<ImVec2> points;
  for (size_t i = 0; i < selection.strands.size(); i += step) {
    if (selection.strands[i] >= strands.strand_count) {
      continue;
    }
    for (const std::vector<glm::vec2>& line : projectStrand(view, selection.strands[i])) {
      points.clear();
      for (const glm::vec2& p : line) {
        points.emplace_back(rect_.x + p.x, rect_.y + p.y);
      }
      draw->AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(20, 10, 0, 160), 0, 4.0f);
      draw->AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(255, 190, 60, 255), 0, 1.5f);
      draw->AddCircle(points.front(), 4.0f, IM_COL32(255, 230, 150, 255));  // the root; also of a strand that is a point
    }
  }
  draw->PopClipRect();
}

// In the lower left corner.
void Viewport::drawLegend(const Legend& legend) const {
  if (legend.title.empty()) {
    return;
  }
  const auto colorOf = [](const glm::vec3& linear) {
    const ImVec4 coded(encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z), 1.0f);
    return ImGui::ColorConvertFloat4ToU32(coded);
  };
  const float line = ImGui::GetTextLineHeightWithSpacing(), edge = 0.5f * line, bar = 14.0f * ImGui::GetFontSize(), thick = 0.7f * line;
  const size_t swatches = std::min(legend.swatches.size(), kMostSwatches);
  const auto swatchText = [&](size_t i) {
    return i + 1 == swatches && legend.swatches.size() > swatches ? groupedDigits(legend.swatches.size() - i) + " more" : legend.swatches[i].second;
  };
  float width = std::max(ImGui::CalcTextSize(legend.title.c_str()).x, legend.stops.empty() ? 0.0f : bar);
  for (size_t i = 0; i < swatches; ++i) {
    width = std::max(width, line + ImGui::CalcTextSize(swatchText(i).c_str()).x);
  }
  const float height = line + (legend.stops.empty() ? 0.0f : thick + line) + static_cast<float>(swatches) * line;
  const float left = rect_.x + edge, top = rect_.y + rect_.height - height - 3.0f * edge;
  if (top < rect_.y || width + 4.0f * edge > rect_.width) {
    return;  // the words under Show remain
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 text = IM_COL32(225, 225, 228, 255);
  draw->AddRectFilled(ImVec2(left, top), ImVec2(left + width + 2.0f * edge, top + height + 2.0f * edge), IM_COL32(14, 15, 18, 215), 3.0f);
  const float x = left + edge;
  float y = top + edge;
  draw->AddText(ImVec2(x, y), text, legend.title.c_str());
  y += line;
  if (!legend.stops.empty()) {
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
      const float from = bar * static_cast<float>(i) / kSteps, to = bar * static_cast<float>(i + 1) / kSteps;
      draw->AddRectFilled(ImVec2(x + from, y), ImVec2(x + to, y + thick), colorOf(barColor(legend, (i + 0.5) / kSteps)));
    }
    y += thick;
    for (const auto& [share, mark] : legend.marks) {
      const float at = static_cast<float>(share);
      draw->AddText(ImVec2(x + at * (bar - ImGui::CalcTextSize(mark.c_str()).x), y), text, mark.c_str());
    }
    y += line;
  }
  for (size_t i = 0; i < swatches; ++i) {
    draw->AddRectFilled(ImVec2(x, y + 0.15f * line), ImVec2(x + 0.6f * line, y + 0.75f * line), colorOf(legend.swatches[i].first));
    draw->AddText(ImVec2(x + line, y), text, swatchText(i).c_str());
    y += line;
  }
}

void Viewport::drawCount(const ViewSession& session, ViewLayers& layers) {
  if (session.scene.display != FLK_DISPLAY_LAYERS || session.scene.coloring != StrandColoring::none || !layers.drawn(kLayerFirst) ||
      !ImGui::IsMouseHoveringRect(ImVec2(rect_.x, rect_.y), ImVec2(rect_.x + rect_.width, rect_.y + rect_.height)) || drag_ != Drag::none ||
      ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) {
    counted_x_ = -1;
    return;
  }
  const ImVec2 at = ImGui::GetIO().MousePos;
  const int x = static_cast<int>((at.x - rect_.x) * scale_), y = static_cast<int>((at.y - rect_.y) * scale_);
  const std::string key = pictureKey(session, cameraOf(session.orbit, session.bounds));
  if (x != counted_x_ || y != counted_y_ || key != counted_key_) {
    counted_x_ = x;
    counted_y_ = y;
    counted_key_ = key;
    hover_since_ = Clock::now();
    counted_.reset();
  }
  const bool full = layers.hairImage(kLayerFirst).width == session.scene.width;
  if (!counted_ && full && std::chrono::duration<double>(Clock::now() - hover_since_).count() > kCountAfter_s && x >= 0 && y >= 0 &&
      static_cast<uint32_t>(x) < session.scene.width && static_cast<uint32_t>(y) < session.scene.height) {
    counted_ = layers.countFragments(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
  }
  if (counted_) {
    ImGui::SetTooltip("%s fragments in pixel %d, %d", groupedDigits(*counted_).c_str(), x, y);
  }
}

}  // namespace forelock::samples
