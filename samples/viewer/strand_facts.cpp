// SPDX-License-Identifier: MIT
#include "strand_facts.h"

#include "finding_strands.h"
#include "scene_keys.h"
#include "strand_color.h"
#include "strand_statistics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

namespace forelock::samples {

namespace {

// One strand as if it were all; `first` is what its first_vertex points to.
FlkStrands onlyStrand(const FlkStrands& all, uint32_t strand, std::array<uint32_t, 2>& first) {
  const size_t begin = all.first_vertex[strand];
  first = {0, all.first_vertex[strand + 1] - all.first_vertex[strand]};
  FlkStrands one = all;
  one.strand_count = 1;
  one.vertex_count = first[1];
  one.first_vertex = first.data();
  one.positions += 3 * begin;
  if (one.radii) one.radii += begin;
  if (one.root_uvs) one.root_uvs += size_t{2} * strand;
  if (one.inverse_masses) one.inverse_masses += begin;
  if (one.colors) one.colors += 3 * begin;
  return one;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string triple(const float* v) { return number(double{v[0]}) + ", " + number(double{v[1]}) + ", " + number(double{v[2]}); }

std::string ends(const std::string& root, const std::string& tip) { return root == tip ? root : root + " to " + tip; }

// What the asset has beside the strand's shape.
void sayAttributes(const FlkStrands& one, const FlkAssetInfo& info, double width_scale, StrandFacts& facts) {
  const size_t tip = one.vertex_count - 1;
  facts.lines.emplace_back("root", triple(one.positions));
  facts.lines.emplace_back("tip", triple(one.positions + 3 * tip));
  const auto width = [&](size_t v, double scale) { return number(2.0 * double{one.radii[v]} * scale); };
  facts.lines.emplace_back("width", ends(width(0, 1.0), width(tip, 1.0)) + (info.has_radii ? "" : " (a default: the source has none)"));
  if (width_scale != 1.0) {
    facts.lines.emplace_back("as drawn", ends(width(0, width_scale), width(tip, width_scale)));
  }
  if (one.root_uvs) {
    facts.lines.emplace_back("root UV", number(double{one.root_uvs[0]}) + ", " + number(double{one.root_uvs[1]}));
  }
  if (one.colors) {
    const auto color = [&](size_t v) { return hexColor({one.colors[3 * v], one.colors[3 * v + 1], one.colors[3 * v + 2]}); };
    facts.lines.emplace_back("colour", ends(color(0), color(tip)));
  }
  if (one.inverse_masses) {
    const auto pinned = std::count(one.inverse_masses, one.inverse_masses + one.vertex_count, 0.0f);
    facts.lines.emplace_back("pinned", std::to_string(pinned) + (pinned == 1 ? " vertex" : " vertices"));
  }
}

}  // namespace

std::string faultWords(uint8_t faults) {
  std::string words;
  for (uint32_t kind = 0; kind < kStrandFaultCount; ++kind) {
    if (faults >> kind & 1u) {
      words += (words.empty() ? "" : ", ") + std::string(faultWord(static_cast<StrandFault>(kind)));
    }
  }
  return words;
}

StrandFacts strandFacts(const OpenedAsset& opened, uint32_t strand, const StrandFactsOptions& options) {
  FlkAssetInfo info = {};
  flkAssetGetInfo(opened.asset.get(), &info);
  FlkStrands strands = {};
  flkAssetGetStrands(opened.asset.get(), &strands);
  std::array<uint32_t, 2> first{};
  const FlkStrands one = onlyStrand(strands, strand, first);
  const StrandStatistics measured = measureStrands(one, 0);
  const std::vector<VertexRow> rows = vertexRows(one, 0);
  const std::vector<float> curvature = strandCurvature(one);

  StrandFacts facts;
  facts.vertices = one.vertex_count;
  facts.length = rows.back().along;
  facts.root_to_tip = glm::length(glm::dvec3(rows.back().position) - glm::dvec3(rows[0].position));
  facts.min_segment = measured.segment_length.min;
  facts.mean_segment = facts.length / (one.vertex_count - 1);
  facts.max_segment = measured.segment_length.max;
  facts.max_turn_deg = measured.turn_degrees.max;
  facts.max_curvature = static_cast<double>(*std::max_element(curvature.begin(), curvature.end()));

  std::string name = std::to_string(strand) + " of " + std::to_string(info.strand_count);
  if (info.strands_in_source != info.strand_count) {
    const std::optional<uint32_t> source = SourceNumbers(info, findingsOf(opened)).source(strand);
    name += source ? " (" + std::to_string(*source) + " in the source)" : " (its number in the source is not known)";
  }
  facts.lines.emplace_back("strand", name);
  if (strand < opened.groups.size() && opened.groups[strand] < opened.group_names.size()) {
    facts.lines.emplace_back("group", opened.group_names[opened.groups[strand]]);
  }
  facts.lines.emplace_back("vertices", std::to_string(facts.vertices));
  facts.lines.emplace_back("length", number(facts.length));
  facts.lines.emplace_back("root to tip", number(facts.root_to_tip));
  facts.lines.emplace_back("segments", number(facts.min_segment) + " to " + number(facts.max_segment));
  facts.lines.emplace_back("mean segment", number(facts.mean_segment));
  facts.lines.emplace_back("curvature", "up to " + number(facts.max_curvature) + " rad per unit, " + number(facts.max_turn_deg) +
                                            " degrees in a vertex");
  sayAttributes(one, info, options.width_scale, facts);
  if (options.follow > 0) {
    facts.lines.emplace_back("guide", "of " + std::to_string(options.follow) +
                                          (options.follow == 1 ? " follow strand" : " follow strands"));
  }
  if (options.faults) {
    const std::string words = faultWords(options.faults->of[strand]);
    facts.lines.emplace_back("faults", words.empty() ? "none" : words);
  }
  return facts;
}

std::vector<VertexRow> vertexRows(const FlkStrands& strands, uint32_t strand) {
  std::vector<VertexRow> rows;
  const uint32_t begin = strands.first_vertex[strand];
  for (uint32_t v = begin; v < strands.first_vertex[strand + 1]; ++v) {
    VertexRow row;
    row.index = v - begin;
    const float* p = strands.positions + size_t{3} * v;
    row.position = {p[0], p[1], p[2]};
    row.radius = strands.radii ? strands.radii[v] : 0.0f;
    if (strands.colors) {
      const float* c = strands.colors + size_t{3} * v;
      row.color = glm::vec3(c[0], c[1], c[2]);
    }
    if (!rows.empty()) {
      row.along = rows.back().along + glm::length(glm::dvec3(row.position) - glm::dvec3(rows.back().position));
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace forelock::samples
