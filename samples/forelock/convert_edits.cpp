// SPDX-License-Identifier: MIT
#include "convert_edits.h"

#include "commands.h"
#include "progress.h"
#include "strand_edit.h"
#include "strand_lod.h"
#include "strand_look.h"
#include "strand_multiply.h"

#include <forelock/render.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

namespace forelock::samples {
namespace {

// "500" or "12.5%".
std::string readKeep(const std::string& text, ConvertEdits& edits) {
  const std::string wrong = "--keep is " + text + ", must be a number of strands, or a share like 12.5%";
  double value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || !(value > 0)) return wrong;
  if (read.ptr == end && value == std::floor(value) && value <= kMostStrands) return edits.keep = uint32_t(value), "";
  if (read.ptr + 1 == end && *read.ptr == '%' && value <= 100) return edits.keep_share = value / 100, "";
  return wrong;
}

// Gives the strands the default width as one of their own, which a later number of strands does not change.
void takeDefaultWidths(EditableStrands& strands, const std::string& label) {
  if (!strands.radii.empty()) return;
  const OpenedAsset filled = assetOf(strands.view(), label);
  FlkStrands held{};
  flkAssetGetStrands(filled.asset.get(), &held);
  strands = editableStrands(held, true);
  std::printf("widths: the default, %.4g, as there are none\n", 2.0 * double(strands.radii[0]));
}

void multiply(EditableStrands& strands, const ConvertEdits& edits, const std::string& label) {
  if (edits.interpolate != 0) {
    const uint32_t guides = strands.strands();
    InterpolationReport report;
    {
      Progress progress("growing strands between guides");
      report = interpolateGuides(strands, edits.interpolate);
    }
    std::printf("interpolated: %s strands more between %s guides (%s triangles of neighbours), %.4g long on average, the guides %.4g\n",
                groupedDigits(report.added).c_str(), groupedDigits(guides).c_str(), groupedDigits(report.triangles).c_str(), report.mean_length,
                report.mean_guide_length);
    if (report.parted > 0) std::printf("interpolated: %s of them stand where guides part and follow the nearest one\n", groupedDigits(report.parted).c_str());
    if (report.added == 0) std::fprintf(stderr, "forelock: %s has %s strands already, --interpolate asks for no more\n", label.c_str(), groupedDigits(guides).c_str());
  }
  if (edits.follow != 0) {
    addFollowStrands(strands, edits.follow, edits.follow_radius_mm * 1e-3, 1, 1);
    std::printf("follow strands: %u beside each, within %.4g mm: %s strands in all\n", edits.follow, edits.follow_radius_mm, groupedDigits(strands.strands()).c_str());
  }
}

void dress(EditableStrands& strands, const ConvertEdits& edits, const std::string& label) {
  if (edits.width_mm > 0 || !edits.width_profile.empty()) {
    if (edits.width_mm <= 0) takeDefaultWidths(strands, label);
    applyWidthProfile(strands, edits.width_profile.empty() ? WidthProfile{{{0, 1}}} : parseWidthProfile(edits.width_profile), edits.width_mm * 1e-3);
    if (edits.width_mm > 0) std::printf("widths: %.4g mm, if the unit is the metre\n", edits.width_mm);
    if (!edits.width_profile.empty()) std::printf("widths: times %s along each strand\n", edits.width_profile.c_str());
  }
  if (!edits.root_image.empty()) {
    Image image;
    try {
      image = readImage(edits.root_image);
    } catch (const std::runtime_error& wrong) {
      throw AssetError(FLK_ERROR_IO, edits.root_image + ": " + wrong.what());
    }
    const RootColorReport report = colorFromImage(strands, image);
    std::printf("coloured by %s, %u x %u, at the root UVs (v = 0 is the top row)\n", edits.root_image.c_str(), image.width, image.height);
    if (report.outside > 0)
      std::printf("coloured: %s root UVs are outside 0..1 and take the border's colour; of a UDIM texture give the tile they are in\n",
                  groupedDigits(report.outside).c_str());
  }
}

void thin(EditableStrands& strands, const ConvertEdits& edits, const std::string& label) {
  if (!edits.lod_order && edits.keep == 0 && edits.keep_share == 0) return;
  orderStrands(strands, evenOrder(strands));
  std::printf("ordered: the first N strands, for every N, are spread like all of them\n");
  if (edits.keep == 0 && edits.keep_share == 0) return;
  takeDefaultWidths(strands, label);
  if (std::all_of(strands.radii.begin(), strands.radii.end(), [](float radius) { return radius == 0; })) throw std::invalid_argument("all widths are 0: there is nothing to keep");
  const uint32_t before = strands.strands();
  const uint32_t kept = edits.keep ? edits.keep : uint32_t(std::max(1.0, std::round(before * edits.keep_share)));
  FlkMaterial material{};
  flkMaterialDefault(&material);
  LodReport report;
  {
    Progress progress("widening strands");
    report = keepFirstStrands(strands, kept, 0.5 * double(material.opacity_root + material.opacity_tip));
  }
  std::printf("kept %s of %s strands, %.4g times as wide: seen from six sides they cover %.2f %% of what all did\n", groupedDigits(report.kept).c_str(),
              groupedDigits(before).c_str(), report.widening,
              report.coverage_before > 0 ? 100 * report.coverage_after / report.coverage_before : 100.0);
  if (std::abs(report.coverage_after - report.coverage_before) > 0.01 * report.coverage_before)
    std::fprintf(stderr, "forelock: %s: so few strands cannot cover as much: widths are held at four times what their number asks for\n", label.c_str());
}

}  // namespace

bool ConvertEdits::any() const {
  return !axes.empty() || scale != 1 || min_length > 0 || resample != 0 || flip_v || reverse || recentre || interpolate != 0 || follow != 0 || width_mm > 0 ||
         !width_profile.empty() || !root_image.empty() || lod_order || keep != 0 || keep_share != 0;
}

void addConvertEdits(CLI::App& command, ConvertEdits& edits) {
  const std::string group = "On the way, in this order";
  // CLI11's own range lets NaN through, and shows its bounds with 300 digits.
  const auto between = [](const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc() && read.ptr == end && value >= 1e-6 && value <= 1e6 ? std::string() : text + " is no number from 0.000001 to 1,000,000";
  };
  const auto parsed = [](const char* option, auto parse) {
    return [option, parse](const std::string& text) {
      try {
        parse(text);
        return std::string();
      } catch (const std::invalid_argument& wrong) {
        return std::string(option) + " " + wrong.what();
      }
    };
  };
  command.add_flag("--reverse", edits.reverse, "Swap root and tip of every strand")->group(group);
  command.add_option("--axes", edits.axes, "New axes from old ones: x,z,-y makes y up of z up, x,-z,y the other way")
      ->check(parsed("--axes", parseAxes))->group(group)->type_name("X,Y,Z");
  command.add_option("--scale", edits.scale, "Positions and widths times this: 0.01 makes metres of centimetres")->check(between)->group(group);
  command.add_flag("--recentre", edits.recentre, "Move the middle of the hair to the origin")->group(group);
  command.add_option("--min-length", edits.min_length, "Remove strands that are shorter (unit of the written file)")->check(between)->group(group);
  command.add_option("--interpolate", edits.interpolate, "Grow strands between guides until there are N, each from its three guides")
      ->check(CLI::Range(2u, kMostStrands))->group(group)->type_name("N");
  CLI::Option* follow = command.add_option("--follow", edits.follow, "N follow strands beside each, as strands of their own")->check(CLI::Range(1u, 1023u))->group(group)->type_name("N");
  command.add_option("--follow-radius", edits.follow_radius_mm, "How far from their guide at most, if the unit is the metre [1]")
      ->check(between)->needs(follow)->group(group)->type_name("MM");
  command.add_option("--resample", edits.resample, "Vertices a strand, evenly along it; says how far lengths are off")->check(CLI::Range(2, 1024))->group(group)->type_name("N");
  command.add_option("--width", edits.width_mm, "Diameter of every strand, if the unit is the metre")->check(between)->group(group)->type_name("MM");
  command.add_option("--width-profile", edits.width_profile, "Factors of the width along each strand: 0:1,0.7:0.9,1:0.1 tapers the tip")
      ->check(parsed("--width-profile", parseWidthProfile))->group(group)->type_name("PLACE:FACTOR,...");
  command.add_flag("--flip-v", edits.flip_v, "v of the root UVs becomes 1 - v")->group(group);
  command.add_option("--root-image", edits.root_image, "Colour strands by this picture of the scalp (.png, .exr), at their root UVs")
      ->check(CLI::ExistingFile)->group(group)->type_name("FILE");
  command.add_flag("--lod-order", edits.lod_order, "Order strands so that the first N, for every N, are spread like all of them")->group(group);
  command.add_option_function<std::string>("--keep", [&edits](const std::string& text) {
    const std::string wrong = readKeep(text, edits);
    if (!wrong.empty()) throw CLI::ValidationError(wrong);
  }, "Keep N strands, or P% of them, spread evenly and widened so that they cover as much")->group(group)->type_name("N|P%");
}

uint32_t applyEdits(OpenedAsset& opened, const ConvertEdits& edits) {
  uint32_t lost = 0;
  FlkStrands held{};
  FlkAssetInfo info{};
  flkAssetGetStrands(opened.asset.get(), &held);
  flkAssetGetInfo(opened.asset.get(), &info);
  EditableStrands strands = editableStrands(held, info.has_radii != 0);
  if (edits.reverse) reverseStrands(strands), std::printf("reversed: roots are where tips were\n");
  if (!edits.axes.empty()) {
    const AxisMap map = parseAxes(edits.axes);
    mapAxes(strands, map);
    std::printf("axes: %s%s\n", edits.axes.c_str(), map.mirrors() ? ", which mirrors the hair" : "");
  }
  if (edits.scale != 1) scaleStrands(strands, edits.scale), std::printf("scaled by %g, widths too\n", edits.scale);
  if (edits.recentre) {
    const std::array<double, 3> shift = recentreStrands(strands);
    std::printf("moved by %g %g %g\n", shift[0], shift[1], shift[2]);
  }
  if (edits.min_length > 0) {
    const uint32_t removed = removeShortStrands(strands, edits.min_length);
    std::printf("removed %s strands shorter than %g\n", groupedDigits(removed).c_str(), edits.min_length);
    if (strands.strands() == 0) throw AssetError(FLK_ERROR_EMPTY_ASSET, opened.label + ": no strand is as long as --min-length asks for");
  }
  try {
    multiply(strands, edits, opened.label);
    if (edits.resample != 0) {
      const ResampleReport report = resampleStrands(strands, edits.resample);
      std::printf("resampled to %u vertices a strand: lengths are off by %.2g %% on average, by %.2g %% at most (strand %u)\n", edits.resample,
                  100 * report.mean_error, 100 * report.worst_error, report.worst_strand);
      if (edits.resample == 2 && !strands.inverse_masses.empty()) std::printf("resampled: with two vertices a strand, roots and tips take the masses of both ends\n");
    }
    if (edits.flip_v) {
      flipV(strands);
      std::printf(strands.root_uvs.empty() ? "no root UVs to flip\n" : "flipped v of the root UVs\n");
    }
    dress(strands, edits, opened.label);
    thin(strands, edits, opened.label);
  } catch (const std::invalid_argument& wrong) {
    throw AssetError(FLK_ERROR_INVALID_ARGUMENT, opened.label + ": " + wrong.what());
  } catch (const std::length_error& wrong) {
    throw AssetError(FLK_ERROR_LIMIT, opened.label + ": " + wrong.what());
  }
  OpenedAsset edited;
  try {
    edited = assetOf(strands.view(), opened.label);
  } catch (const AssetError& wrong) {
    throw AssetError(wrong.result, std::string(wrong.what()) + " (after what --scale and the other options did to it)");
  }
  // What is new about it: of what was there before the source has been said.
  std::set<std::string> known;
  for (const AssetMessage& message : *opened.messages) known.insert(message.id);
  for (const AssetMessage& message : *edited.messages)
    if (message.severity != FLK_SEVERITY_INFO && known.count(message.id) == 0) std::fprintf(stderr, "forelock: %s (after what was done to it)\n", message.text.c_str());
  flkAssetGetInfo(edited.asset.get(), &info);
  lost = strands.strands() - info.strand_count;
  std::swap(opened.asset, edited.asset);  // before the messages that each points to
  std::swap(opened.messages, edited.messages);
  if (edits.min_length > 0 || edits.interpolate || edits.follow || edits.lod_order || edits.keep || edits.keep_share > 0)
    opened.groups.clear(), opened.group_names.clear();  // they were those of the strands as they stood in the source
  if (lost > 0) opened.groups.clear(), opened.group_names.clear();
  return lost;
}

}  // namespace forelock::samples
