// `forelock diff`: whether two assets are the same groom, and where they differ. SPDX-License-Identifier: MIT
#include "commands.h"
#include "progress.h"
#include "strand_diff.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace forelock::samples {

namespace {

using Json = nlohmann::ordered_json;

struct DiffArguments {
  std::string a, b;
  double tolerance = 0;
  bool json = false;
};

constexpr const char* kExamples =
    "Finds what turns B into A (unit, axes, direction, shift, order of strands, V), then says how far strands are apart after that, in the\n"
    "unit of A. Strands of other vertex counts are compared along their length.\n"
    "Exit status: 0 the same groom; 1 not related, or beyond --tolerance.\n\n"
    "Examples:\n"
    "  forelock diff game.tfx maya.tfx                      the same hair in another unit, with V flipped?\n"
    "  forelock diff old.hair new.hair --tolerance 1e-4     fails where a vertex moved by more than 0.1 mm, or a strand came or went\n"
    "  forelock diff groom:long-wavy export.tfx --json\n";

std::string axesText(const AxisMap& map) {
  std::string text;
  for (size_t axis = 0; axis < 3; ++axis) text += std::string(axis ? "," : "") + (map.sign[axis] < 0 ? "-" : "") + "xyz"[map.from[axis]];
  return text;
}

bool isIdentity(const AxisMap& map) { return axesText(map) == "x,y,z"; }

const char* uvName(UvRelation uvs) {
  switch (uvs) {
    case UvRelation::only_a: return "only in A";
    case UvRelation::only_b: return "only in B";
    case UvRelation::same: return "same";
    case UvRelation::flipped_v: return "V flipped";
    case UvRelation::different: return "different";
    default: return "absent";
  }
}

// The units that a factor is likely to be between.
std::string unitsText(double a_over_b) {
  const struct {
    double metres;
    const char* name;
  } units[] = {{1, "metres"}, {0.01, "centimetres"}, {0.001, "millimetres"}, {0.0254, "inches"}, {0.3048, "feet"}, {0.1, "decimetres"}};
  for (const auto& a : units)
    for (const auto& b : units)
      if (std::abs(a_over_b * a.metres / b.metres - 1) < 1e-6) return std::string("as if A were in ") + a.name + " and B in " + b.name;
  return "which is between no usual units";
}

// The options of convert that make A of B, but for a shift.
std::string convertOptions(const StrandDiff& diff) {
  std::string options;
  char number[40];
  if (diff.relation.reversed) options += " --reverse";
  if (!isIdentity(diff.relation.axes)) options += " --axes=" + axesText(diff.relation.axes);
  std::snprintf(number, sizeof number, " --scale %.9g", diff.relation.scale);
  if (diff.relation.scale != 1) options += number;
  if (diff.uvs == UvRelation::flipped_v) options += " --flip-v";
  return options;
}

bool beyond(const StrandDiff& diff, const DiffArguments& arguments) {
  return !diff.related || (arguments.tolerance > 0 && (diff.max_distance > arguments.tolerance || !diff.only_a.empty() || !diff.only_b.empty()));
}

std::string numbersText(const std::vector<uint32_t>& numbers) {
  std::string text;
  for (size_t i = 0; i < numbers.size() && i < 8; ++i) text += (i ? " " : "") + std::to_string(numbers[i]);
  return text + (numbers.size() > 8 ? " ..." : "");
}

void printPairs(const char* name, const std::vector<StrandPair>& pairs) {
  for (size_t i = 0; i < pairs.size() && i < 4; ++i)
    std::printf("  %-11s strand %u of A and %u of B: %.4g\n", i ? "" : name, pairs[i].a, pairs[i].b, pairs[i].distance);
}

void printAttribute(const char* name, const bool (&has)[2], uint64_t compared, const std::string& both) {
  if (has[0] && has[1]) std::printf("  %-11s %s\n", name, compared ? both.c_str() : "in both, not compared: no two partners have as many vertices");
  else if (has[0] || has[1]) std::printf("  %-11s only in %s\n", name, has[0] ? "A" : "B");
}

std::string format(const char* text, double a, double b = 0) {
  char line[200];
  std::snprintf(line, sizeof line, text, a, b);
  return line;
}

void printText(const StrandDiff& diff, const FlkAssetInfo (&info)[2], const DiffArguments& arguments) {
  std::printf("A %s: %s strands, %s vertices\nB %s: %s strands, %s vertices\n", arguments.a.c_str(), groupedDigits(info[0].strand_count).c_str(),
              groupedDigits(info[0].vertex_count).c_str(), arguments.b.c_str(), groupedDigits(info[1].strand_count).c_str(), groupedDigits(info[1].vertex_count).c_str());
  if (!diff.related) {
    std::printf("  not related: in no unit and with no axes do half of the strands lie on each other within a twentieth of their length\n");
    return;
  }
  const StrandRelation& relation = diff.relation;
  std::printf("  matched     %s strands", groupedDigits(diff.matched).c_str());
  if (!diff.only_a.empty()) std::printf("; only in A %s: %s", groupedDigits(diff.only_a.size()).c_str(), numbersText(diff.only_a).c_str());
  if (!diff.only_b.empty()) std::printf("; only in B %s: %s", groupedDigits(diff.only_b.size()).c_str(), numbersText(diff.only_b).c_str());
  std::printf("\n");
  if (relation.scale != 1) std::printf("  scale       A is %.9g x B, %s\n", relation.scale, unitsText(relation.scale).c_str());
  if (!isIdentity(relation.axes)) std::printf("  axes        x,y,z of A are %s of B%s\n", axesText(relation.axes).c_str(), relation.axes.mirrors() ? ", which mirrors the hair" : "");
  if (relation.reversed) std::printf("  direction   roots of A are tips of B\n");
  if (relation.shift != std::array<double, 3>{}) std::printf("  shift       B has to move by (%.6g, %.6g, %.6g), unit of A\n", relation.shift[0], relation.shift[1], relation.shift[2]);
  if (diff.reordered) std::printf("  order       the strands come in another order\n");
  if (diff.resampled) std::printf("  resampled   %s strands have other vertex counts, compared along their length\n", groupedDigits(diff.resampled).c_str());
  if (diff.respaced) std::printf("  respaced    %s strands are the same curves with their vertices elsewhere\n", groupedDigits(diff.respaced).c_str());
  if (relation.isNone() && !diff.reordered && !diff.resampled && !diff.respaced) std::printf("  relation    none needed: same unit, axes, direction, place and order\n");
  std::printf("  distance    at most %.4g, mean %.4g, RMS %.4g (unit of A)\n", diff.max_distance, diff.mean_distance, diff.rms_distance);
  if (diff.differing) {
    std::printf("  differing   %s strands\n", groupedDigits(diff.differing).c_str());
    printPairs("first", diff.first);
    printPairs("furthest", diff.worst);
  }
  if (diff.uvs != UvRelation::absent)
    std::printf("  root UVs    %s%s\n", uvName(diff.uvs), diff.uvs == UvRelation::different ? format(", by %.4g", diff.max_uv_difference).c_str() : "");
  const bool widths_along = std::abs(diff.width_ratio - 1) < 1e-3;
  printAttribute("widths", diff.has_widths, diff.compared_vertices, format("by %.4g at most", diff.max_width_difference) + (widths_along ? "" : format("; those of A are %.4g x B's after the scale", diff.width_ratio)));
  printAttribute("masses", diff.has_masses, diff.compared_vertices, groupedDigits(diff.differing_masses) + " vertices differ");
  printAttribute("colours", diff.has_colors, diff.compared_vertices, format("by %.4g at most", diff.max_color_difference));
  const std::string options = convertOptions(diff);
  if (!options.empty())
    std::printf("  to make A   forelock convert %s OUT%s%s\n", arguments.b.c_str(), options.c_str(), relation.shift != std::array<double, 3>{} ? ", and move it" : "");
}

Json pairsJson(const std::vector<StrandPair>& pairs) {
  Json list = Json::array();
  for (const StrandPair& pair : pairs) list.push_back({{"a", pair.a}, {"b", pair.b}, {"distance", pair.distance}});
  return list;
}

void printJson(const StrandDiff& diff, const FlkAssetInfo (&info)[2], const DiffArguments& arguments) {
  Json json;
  json["schema"] = "forelock.diff/1";
  json["a"] = {{"asset", arguments.a}, {"strands", info[0].strand_count}, {"vertices", info[0].vertex_count}};
  json["b"] = {{"asset", arguments.b}, {"strands", info[1].strand_count}, {"vertices", info[1].vertex_count}};
  json["related"] = diff.related;
  json["within_tolerance"] = !beyond(diff, arguments);
  if (diff.related) {
    json["scale"] = diff.relation.scale;
    json["axes"] = axesText(diff.relation.axes);
    json["mirrored"] = diff.relation.axes.mirrors();
    json["shift"] = diff.relation.shift;
    json["reversed"] = diff.relation.reversed;
    json["reordered"] = diff.reordered;
    json["resampled"] = diff.resampled;
    json["respaced"] = diff.respaced;
    json["matched"] = diff.matched;
    json["only_a"] = diff.only_a;
    json["only_b"] = diff.only_b;
    json["distance"] = {{"max", diff.max_distance}, {"mean", diff.mean_distance}, {"rms", diff.rms_distance}};
    json["differing"] = diff.differing;
    json["first"] = pairsJson(diff.first);
    json["furthest"] = pairsJson(diff.worst);
    json["compared_vertices"] = diff.compared_vertices;
    json["root_uvs"] = {{"relation", uvName(diff.uvs)}, {"max_difference", diff.max_uv_difference}};
    json["widths"] = {{"a", diff.has_widths[0]}, {"b", diff.has_widths[1]}, {"ratio", diff.width_ratio}, {"max_difference", diff.max_width_difference}};
    json["masses"] = {{"a", diff.has_masses[0]}, {"b", diff.has_masses[1]}, {"differing", diff.differing_masses}};
    json["colors"] = {{"a", diff.has_colors[0]}, {"b", diff.has_colors[1]}, {"max_difference", diff.max_color_difference}};
    json["convert"] = convertOptions(diff);
  }
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

int runDiff(const DiffArguments& arguments) {
  OpenedAsset opened[2];
  FlkStrands strands[2]{};
  FlkAssetInfo info[2]{};
  for (int side = 0; side < 2; ++side) {
    const std::string& source = side ? arguments.b : arguments.a;
    Progress progress("opening " + source);
    opened[side] = openAsset(source, [&](uint64_t done, uint64_t total) { progress.update(done, total); });
    flkAssetGetStrands(opened[side].asset.get(), &strands[side]);
    flkAssetGetInfo(opened[side].asset.get(), &info[side]);
  }
  Progress progress("comparing");
  StrandDiffOptions options;
  options.tolerance = arguments.tolerance;
  options.progress = [&](uint64_t done, uint64_t total) { progress.update(done, total); };
  const StrandDiff diff = diffStrands(strands[0], info[0].has_radii != 0, strands[1], info[1].has_radii != 0, options);
  if (arguments.json) printJson(diff, info, arguments);
  else printText(diff, info, arguments);
  return beyond(diff, arguments) ? kFailed : kDone;
}

}  // namespace

void addDiffCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("diff", "Say whether two assets are the same groom, and where they differ.");
  auto arguments = std::make_shared<DiffArguments>();
  command->add_option("A", arguments->a, "A strand file, a recipe or groom:NAME")->required();
  command->add_option("B", arguments->b, "What it is compared with")->required();
  command->add_option("--tolerance", arguments->tolerance, "Exit with 1 where a vertex is further away, or a strand is in one only (unit of A)")->check(CLI::PositiveNumber)->type_name("T");
  command->add_flag("--json", arguments->json, "Print JSON for programs");
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runDiff(*arguments); });
}

}  // namespace forelock::samples
