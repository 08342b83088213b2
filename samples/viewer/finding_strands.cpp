// SPDX-License-Identifier: MIT
#include "finding_strands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace forelock::samples {

namespace {

using Codes = std::vector<std::string>;

const Codes kDropping{"STRAND_TOO_SHORT", "POSITION_NOT_FINITE", "POSITION_OUT_OF_RANGE", "STRAND_ZERO_LENGTH", "STRAND_ROOT_ONLY"};
const Codes kOfAsset{"RADIUS_ALL_ZERO", "UNIT_SUSPECT", "ROOT_AT_TIP", "WIDTH_SUSPECT", "ROOT_UV_ALL_ZERO", "ROOT_UV_CONSTANT",
                     "FAR_FROM_ORIGIN", "INVERSE_MASS_ALL_ZERO", "INVERSE_MASS_IMPLIED", "WIDTH_DEFAULTED"};
constexpr size_t kListed = 8;  // strands of a finding: fewer are all that there are

bool isOneOf(const Codes& codes, const std::string& code) { return std::find(codes.begin(), codes.end(), code) != codes.end(); }

// As the library measures them.
std::vector<float> lengthsOf(const FlkStrands& strands) {
  std::vector<float> lengths(strands.strand_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    double length = 0.0;
    for (uint32_t v = strands.first_vertex[s]; v + 1 < strands.first_vertex[s + 1]; ++v) {
      const float* p = strands.positions + size_t{3} * v;
      const double x = double{p[3]} - double{p[0]}, y = double{p[4]} - double{p[1]}, z = double{p[5]} - double{p[2]};
      length += std::sqrt(x * x + y * y + z * z);
    }
    lengths[s] = static_cast<float>(length);
  }
  return lengths;
}

double medianOf(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

// Asks the strands themselves, by the rules of docs/findings.md.
class Checker {
 public:
  Checker(const FlkStrands& strands, const StrandFaults& faults) : strands_(strands), faults_(faults) {}

  // False: the loaded strands do not tell.
  bool find(const std::string& code, std::vector<uint32_t>& found) const {
    const FlkStrands& s = strands_;
    const auto last = [&s](uint32_t i) { return s.first_vertex[i + 1] - 1; };
    if (code == "STRAND_MICRO" || code == "SEGMENT_ZERO_LENGTH" || code == "STRAND_DUPLICATE") {
      found = withFault(code == "STRAND_MICRO" ? kFaultMicro : code == "STRAND_DUPLICATE" ? kFaultDuplicate : kFaultSegment);
    } else if (code == "ROOT_UV_OUTSIDE_UNIT" && s.root_uvs) {
      found = where([&](uint32_t i) {
        const float u = s.root_uvs[2 * size_t{i}], v = s.root_uvs[2 * size_t{i} + 1];
        return u < 0.0f || u > 1.0f || v < 0.0f || v > 1.0f;
      });
    } else if (code == "STRAND_LONG") {
      const std::vector<float> lengths = lengthsOf(s);
      const double median = medianOf(lengths);
      found = where([&](uint32_t i) { return static_cast<double>(lengths[i]) > 10.0 * median; });
    } else if (code == "WIDTH_GROWS") {
      found = where([&](uint32_t i) { return s.radii[last(i)] > 1.2f * s.radii[s.first_vertex[i]]; });
    } else if (code == "ROOT_NOT_PINNED" && s.inverse_masses) {
      found = where([&](uint32_t i) { return s.inverse_masses[s.first_vertex[i]] != 0.0f && s.inverse_masses[last(i)] != 0.0f; });
    } else if (code == "BOTH_ENDS_FIXED" && s.inverse_masses) {
      found = where([&](uint32_t i) {
        return last(i) - s.first_vertex[i] > 1 && s.inverse_masses[s.first_vertex[i]] == 0.0f && s.inverse_masses[last(i)] == 0.0f;
      });
    } else {
      return false;
    }
    return true;
  }

  std::vector<uint32_t> withFault(StrandFault kind) const {
    return where([&](uint32_t i) { return (faults_.of[i] >> kind & 1u) != 0; });
  }

 private:
  template <typename Test>
  std::vector<uint32_t> where(const Test& test) const {
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < strands_.strand_count; ++i) {
      if (test(i)) {
        found.push_back(i);
      }
    }
    return found;
  }

  const FlkStrands& strands_;
  const StrandFaults& faults_;
};

std::string countOf(size_t strands) { return std::to_string(strands) + (strands == 1 ? " strand" : " strands"); }

std::string listOf(const std::vector<uint32_t>& numbers) {
  std::string list;
  for (const uint32_t number : numbers) {
    list += (list.empty() ? "" : ", ") + std::to_string(number);
  }
  return list;
}

void takeListed(const SourceNumbers& numbers, FindingStrands& entry) {
  std::vector<uint32_t> unknown;
  for (const uint32_t source : entry.finding.strands) {
    if (const std::optional<uint32_t> loaded = numbers.loaded(source)) {
      entry.strands.push_back(*loaded);
    } else {
      unknown.push_back(source);
    }
  }
  std::sort(entry.strands.begin(), entry.strands.end());
  const bool complete = entry.finding.strands.size() < kListed;
  entry.all = complete && unknown.empty();
  entry.label = complete ? countOf(entry.finding.strands.size()) : "the first " + countOf(entry.finding.strands.size());
  if (!unknown.empty()) {
    entry.label += "; which of those loaded is not known of " + listOf(unknown) + " of the source";
  }
}

}  // namespace

SourceNumbers::SourceNumbers(const FlkAssetInfo& info, const std::vector<AssetFinding>& findings)
    : in_source_(info.strands_in_source), known_below_(info.strands_in_source) {
  const uint64_t gone = info.strands_in_source - info.strand_count;
  uint64_t counted = 0;
  for (const AssetFinding& finding : findings) {
    if (!isOneOf(kDropping, finding.code)) {
      continue;
    }
    counted += finding.count;
    dropped_.insert(dropped_.end(), finding.strands.begin(), finding.strands.end());
    if (finding.count > finding.strands.size()) {
      known_below_ = std::min(known_below_, finding.strands.empty() ? 0 : finding.strands.back() + 1);
    }
  }
  std::sort(dropped_.begin(), dropped_.end());
  if (counted != gone) {
    known_below_ = 0;
  }
}

std::optional<uint32_t> SourceNumbers::loaded(uint32_t source) const {
  const auto after = std::lower_bound(dropped_.begin(), dropped_.end(), source);
  if (source >= known_below_ || (after != dropped_.end() && *after == source)) {
    return std::nullopt;
  }
  return source - static_cast<uint32_t>(after - dropped_.begin());
}

std::optional<uint32_t> SourceNumbers::source(uint32_t loaded) const {
  uint32_t number = loaded;
  for (const uint32_t dropped : dropped_) {
    number += dropped <= number ? 1 : 0;
  }
  return number < known_below_ ? std::optional<uint32_t>(number) : std::nullopt;
}

std::vector<FindingStrands> findingStrands(const OpenedAsset& opened, const StrandFaults& faults) {
  FlkAssetInfo info = {};
  flkAssetGetInfo(opened.asset.get(), &info);
  FlkStrands strands = {};
  flkAssetGetStrands(opened.asset.get(), &strands);
  const std::vector<AssetFinding> findings = findingsOf(opened);
  const SourceNumbers numbers(info, findings);
  const Checker checker(strands, faults);
  std::vector<FindingStrands> entries;
  bool width_said = false, uv_said = false;
  for (const AssetFinding& finding : findings) {
    FindingStrands& entry = entries.emplace_back();
    entry.finding = finding;
    width_said = width_said || finding.code == "RADIUS_ALL_ZERO";
    uv_said = uv_said || finding.code == "ROOT_UV_OUTSIDE_UNIT";
    if (isOneOf(kDropping, finding.code)) {
      entry.reach = FindingReach::dropped;
      entry.all = finding.count <= finding.strands.size();
      entry.label = countOf(finding.count) + " left out, of the source " + listOf(finding.strands) + (entry.all ? "" : " and on");
    } else if (isOneOf(kOfAsset, finding.code)) {
      entry.reach = FindingReach::asset;
      entry.label = "the whole asset";
    } else if (checker.find(finding.code, entry.strands)) {
      entry.reach = FindingReach::strands;
      entry.label = countOf(entry.strands.size());
    } else if (!finding.strands.empty()) {
      entry.reach = FindingReach::strands;
      takeListed(numbers, entry);
    } else {
      entry.label = "the file";
    }
  }
  const auto add = [&](StrandFault kind, const char* text, uint32_t severity) {
    if (faults.counts[kind] == 0) {
      return;
    }
    FindingStrands& entry = entries.emplace_back();
    entry.reach = FindingReach::strands;
    entry.strands = checker.withFault(kind);
    entry.label = countOf(entry.strands.size());
    entry.finding.text = text;
    entry.finding.severity = severity;
    entry.finding.count = entry.strands.size();
    entry.finding.strands = entry.strands;
    entry.finding.strands.resize(std::min(entry.strands.size(), kListed));
  };
  add(kFaultTurn, "strands turn by more than 120 degrees in a vertex: style in fur and curls, elsewhere a vertex out of place",
      FLK_SEVERITY_INFO);
  if (!width_said) {
    add(kFaultWidth, "strands have width 0 from root to tip, so that they are not seen: set a width on them", FLK_SEVERITY_WARNING);
  }
  if (!uv_said) {
    add(kFaultRootUv, "strands have a root UV outside 0..1 where most are inside: project their roots again", FLK_SEVERITY_INFO);
  }
  return entries;
}

std::vector<glm::vec3> pointsOf(const FlkStrands& strands, const std::vector<uint32_t>& chosen, const double world_from_hair[16]) {
  std::vector<glm::vec3> points;
  const double* m = world_from_hair;
  for (const uint32_t strand : chosen) {
    for (uint32_t v = strands.first_vertex[strand]; v < strands.first_vertex[strand + 1]; ++v) {
      const float* p = strands.positions + size_t{3} * v;
      const double x = double{p[0]}, y = double{p[1]}, z = double{p[2]};
      const auto row = [&](int i) { return m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i]; };
      points.emplace_back(row(0), row(1), row(2));
    }
  }
  return points;
}

std::vector<glm::vec3> pointsOf(const FlkStrands& strands, const FindingStrands& finding, const double world_from_hair[16]) {
  if (finding.reach != FindingReach::asset) {
    return pointsOf(strands, finding.strands, world_from_hair);
  }
  std::vector<uint32_t> all(strands.strand_count);
  std::iota(all.begin(), all.end(), 0u);
  return pointsOf(strands, all, world_from_hair);
}

}  // namespace forelock::samples
