// Panels of what the picture costs: times over time, bytes, fragments, the plan. SPDX-License-Identifier: MIT
#include "commands.h"
#include "ui.h"
#include "view_session.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace forelock::samples {

namespace {

constexpr std::array<const char*, FLK_STAGE_COUNT> kStages{"clear", "shadow", "capture", "resolve", "prepare", "output"};
const std::array<ImU32, FLK_STAGE_COUNT> kStageColors{IM_COL32(120, 120, 130, 255), IM_COL32(86, 120, 200, 255), IM_COL32(230, 150, 60, 255),
                                                      IM_COL32(90, 180, 110, 255), IM_COL32(200, 90, 140, 255), IM_COL32(160, 130, 210, 255)};

std::string milliseconds(double ms) {
  if (ms < 0.0) {
    return "-";
  }
  char text[32];
  std::snprintf(text, sizeof text, ms < 10.0 ? "%.3f ms" : "%.1f ms", ms);
  return text;
}

// Stages stacked, the newest at the right.
void timeGraph(const TimeHistory& times) {
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 6.0f);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##times", size);
  ui::noteItem("Times");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, ImVec2(low.x + size.x, low.y + size.y), IM_COL32(14, 15, 18, 255));
  const double most = times.percentile(TimeHistory::kTotal, 100.0);
  if (most <= 0.0) {
    return;
  }
  double top = 1.0;  // (ms) of the graph: 1, 2 or 5 times a power of ten
  while (top < most) {
    top *= 10.0;
  }
  while (top * 0.5 > most) {
    top *= top * 0.2 > most ? 0.2 : 0.5;
  }
  const float column = size.x / static_cast<float>(TimeHistory::kFrames);
  for (size_t ago = 0; ago < times.size(); ++ago) {
    const FrameTimes& frame = times.at(ago);
    const float right = low.x + size.x - static_cast<float>(ago) * column;
    double below = 0.0;
    for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage) {
      const double ms = std::max(frame.stage_ms[stage], 0.0);
      const auto height = [&](double value) { return low.y + size.y * static_cast<float>(1.0 - std::min(value / top, 1.0)); };
      if (ms > 0.0) {
        draw->AddRectFilled(ImVec2(right - std::max(column, 1.0f), height(below + ms)), ImVec2(right, height(below)), kStageColors[stage]);
      }
      below += ms;
    }
    if (frame.reduced) {  // a quick picture: marked below
      draw->AddRectFilled(ImVec2(right - column, low.y + size.y - 2.0f), ImVec2(right, low.y + size.y), IM_COL32(240, 220, 90, 255));
    }
  }
  char text[48];
  std::snprintf(text, sizeof text, "%g ms", top);
  draw->AddText(ImVec2(low.x + 3.0f, low.y + 1.0f), IM_COL32(200, 200, 205, 255), text);
  if (ImGui::IsItemHovered()) {
    const auto ago = static_cast<size_t>(std::max(0.0f, (low.x + size.x - ImGui::GetIO().MousePos.x) / column));
    if (ago < times.size()) {
      const FrameTimes& frame = times.at(ago);
      std::string words = std::to_string(ago) + " pictures ago, together " + milliseconds(frame.total_ms);
      for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage) {
        if (frame.stage_ms[stage] >= 0.0) {
          words += std::string("\n") + kStages[stage] + " " + milliseconds(frame.stage_ms[stage]);
        }
      }
      std::snprintf(text, sizeof text, "\nat %.0f %% of the window's resolution", 100.0 * frame.resolution_share);
      words += frame.reduced ? text : "";
      ui::tip(words.c_str());
    }
  }
}

}  // namespace

void costPanel(ViewSession& session, const LayerFacts* facts) {
  const ui::Section section("Cost", true, "What the picture takes of the device, measured while it is drawn");
  if (!section || !facts) {
    return;
  }
  timeGraph(session.times);
  if (ImGui::BeginTable("stages", 3, ImGuiTableFlags_SizingStretchSame)) {
    for (const char* name : {"GPU stage", "last", "median"}) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", name);
    }
    for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage) {
      if (facts->statistics.milliseconds[stage] < 0.0) {
        continue;
      }
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const ImVec4 color = ImGui::ColorConvertU32ToFloat4(kStageColors[stage]);
      ImGui::TextColored(color, "%s", kStages[stage]);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(milliseconds(facts->statistics.milliseconds[stage]).c_str());
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", milliseconds(session.times.median(stage, 30)).c_str());
    }
    ImGui::EndTable();
  }
  const FlkStatistics& statistics = facts->statistics;
  ui::fact("GPU total", milliseconds(statistics.milliseconds_frame) + (session.share < 0.999 ? ", reduced while it moves" : ""));
  ui::fact("Frame", milliseconds(session.frame_ms));
  ui::tip("From planning until the picture was there, with the window's own work");
  ui::fact("Fragments", groupedDigits(statistics.fragments));
  ui::fact("Segments", groupedDigits(facts->plan.segment_count));
  ui::fact("Memory", readableBytes(facts->plan.bytes_persistent + facts->plan.bytes_transient));
  ui::fact("  of hair", readableBytes(facts->plan.bytes_persistent));
  ui::fact("  of the view", readableBytes(facts->plan.bytes_transient));
  if (statistics.overflow_fragments > 0) {
    ImGui::TextColored(ImVec4(1.0f, 0.5f, 0.3f, 1.0f), "Overflow: %s fragments", groupedDigits(statistics.overflow_fragments).c_str());
    ui::tip("They found the lists full and are drawn as a sum; the next picture has longer lists, up to 1 GiB");
  }
  ui::checkbox("Count shades", session.count_work, "Counts shades and shadow map reads while it draws, which takes time");
  if (session.count_work && statistics.pixels > 0) {
    ui::fact("Pixels", groupedDigits(statistics.pixels));
    ui::fact("Full shades", groupedDigits(statistics.full_shades));
    ui::fact("Cheap shades", groupedDigits(statistics.low_shades));
    ui::fact("Shadow reads", groupedDigits(statistics.shadow_taps));
  }
}

void planPanel(const LayerFacts* facts) {
  const ui::Section section("Plan", false, "What runs, what it holds, and what is left out because this scene does not need it");
  if (!section || !facts) {
    return;
  }
  ImGui::TextDisabled("Passes");
  for (const PlanPass& pass : facts->passes) {
    ui::fact(pass.name.c_str(), pass.work);
  }
  ImGui::TextDisabled("Memory");
  for (const PlanResource& resource : facts->resources) {
    ui::fact(resource.name.c_str(), readableBytes(resource.bytes));
    ui::tip((resource.why + (resource.transient ? "; its content lives within a frame" : "")).c_str());
  }
  ImGui::TextDisabled("Left out");
  for (const std::string& omission : facts->omissions) {
    ImGui::Bullet();
    ui::text(omission);
  }
}

}  // namespace forelock::samples
