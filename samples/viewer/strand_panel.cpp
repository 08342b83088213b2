// Panels of single strands: what is wrong with which, and what one is like. SPDX-License-Identifier: MIT
#include "commands.h"
#include "strand_facts.h"
#include "ui.h"
#include "view_session.h"

#include <algorithm>
#include <cstdio>

namespace forelock::samples {

namespace {

ImVec4 severityColor(uint32_t severity) {
  switch (severity) {
    case FLK_SEVERITY_ERROR: return {1.0f, 0.40f, 0.35f, 1.0f};
    case FLK_SEVERITY_WARNING: return {1.0f, 0.75f, 0.35f, 1.0f};
    default: return {0.65f, 0.75f, 0.85f, 1.0f};
  }
}

}  // namespace

void findingsPanel(ViewSession& session) {
  const ui::Scope panel("Findings");
  if (!session.plain) {
    ui::faintText("What is wrong with an asset, or unusual, is told here.");
    return;
  }
  if (session.findings.empty()) {
    ui::faintText("looking...");
    return;
  }
  bool any = false;
  for (size_t a = 0; a < session.findings.size(); ++a) {
    const ui::Scope scope("Asset " + std::to_string(a + 1));
    for (size_t i = 0; i < session.findings[a].size(); ++i) {
      const FindingStrands& found = session.findings[a][i];
      any = true;
      ImGui::PushID(static_cast<int>(i));
      ImGui::PushStyleColor(ImGuiCol_Text, severityColor(found.finding.severity));
      const std::string label = found.finding.code.empty() ? found.label : found.finding.code;
      const bool chosen = session.selection.asset == a && session.selection.label == label;
      const bool pressed = ui::selectable(label, chosen);
      ImGui::PopStyleColor();
      ui::tip("Selects and frames the strands that it speaks of");
      if (pressed) {
        session.selection = {a, found.strands, label};
        session.picked.reset();
        session.requests.frame_selection = !found.strands.empty();
      }
      ui::faintText(found.finding.text);
      if (chosen) {
        if (found.reach == FindingReach::dropped) {
          ui::faintText("They were left out while loading.");
        } else if (found.reach == FindingReach::file) {
          ui::faintText("It is about the file, not about strands.");
        }
      }
      ImGui::PopID();
    }
  }
  if (!any) {
    ui::text("Nothing is wrong.");
  }
}

void strandPanel(ViewSession& session) {
  const ui::Scope panel("Strand");
  if (!session.plain) {
    ui::faintText("Click a strand in the picture to see what it is like.");
    return;
  }
  const size_t a = std::min(session.selection.asset, session.plain->assets.size() - 1);
  const StagedAsset& asset = session.plain->assets[a];
  const bool one = session.selection.strands.size() == 1;
  int number = one ? static_cast<int>(session.selection.strands[0]) : 0;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  const bool typed = ImGui::InputInt("Number", &number, 1, 100);
  ui::tip("Strands count from 0, as in the asset");
  ui::noteItem("Number");
  if (typed) {
    const auto strand = static_cast<uint32_t>(std::clamp<int64_t>(number, 0, int64_t{asset.info.strand_count} - 1));
    session.selection = {a, {strand}, "strand " + std::to_string(strand)};
    session.picked.reset();
  }
  if (!one) {
    ui::faintText(session.selection.strands.empty() ? "Click a strand in the picture."
                                                    : session.selection.label + ": " + groupedDigits(session.selection.strands.size()) + " strands");
    return;
  }
  const uint32_t strand = session.selection.strands[0];
  if (ui::button("Go there", "This strand in view (G)")) {
    session.requests.frame_selection = true;
  }
  StrandFactsOptions options;
  options.faults = a < session.faults.size() ? &session.faults[a] : nullptr;
  options.follow = asset.follow.count;
  options.width_scale = static_cast<double>(asset.material.width_scale);
  const double unit_mm = 1e3 * session.scene.assets[a].scale;
  char unit[64];
  std::snprintf(unit, sizeof unit, "Lengths in the asset's unit: %.4g mm here", unit_mm);
  ui::faintText(unit);
  for (const auto& [name, value] : strandFacts(*asset.opened, strand, options).lines) {
    ui::fact(name.c_str(), value);
  }
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  const std::vector<VertexRow> rows = vertexRows(strands, strand);
  if (ImGui::BeginTable("vertices", 4, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg,
                        ImVec2(0.0f, std::max(ImGui::GetContentRegionAvail().y, ImGui::GetFontSize() * 10.0f)))) {
    for (const char* name : {"", "position", "width", "along"}) {
      ImGui::TableSetupColumn(name);
    }
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
        const VertexRow& row = rows[static_cast<size_t>(i)];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool under = session.picked && session.picked->vertex == row.index;
        ImGui::TextColored(under ? ImVec4(0.95f, 0.75f, 0.3f, 1.0f) : ImVec4(0.6f, 0.6f, 0.62f, 1.0f), "%u", row.index);
        ImGui::TableNextColumn();
        ImGui::Text("%.3g %.3g %.3g", static_cast<double>(row.position.x), static_cast<double>(row.position.y), static_cast<double>(row.position.z));
        ImGui::TableNextColumn();
        ImGui::Text("%.3g", 2.0 * static_cast<double>(row.radius));
        ImGui::TableNextColumn();
        ImGui::Text("%.4g", row.along);
      }
    }
    ImGui::EndTable();
  }
}

}  // namespace forelock::samples
