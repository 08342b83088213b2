#include "asset/rig_arrays.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstring>

namespace forelock {
namespace {

// AMD's loader copies names with their NUL into 128 bytes.
constexpr std::size_t longest_name_of_tressfx = 127;

// A strand a metre from a bone's origin moves by a tenth of its width, 80 um, when its weights miss 1 by as much.
constexpr double sum_tolerance = 1e-5;

}  // namespace

void BoneNames::reserve(std::size_t bones, std::size_t bytes) {
  starts_.reserve(bones);
  pointers_.reserve(bones);
  text_.reserve(bytes + bones);
}

void BoneNames::add(std::string_view name) {
  starts_.push_back(text_.size());
  text_.insert(text_.end(), name.begin(), name.end());
  text_.push_back('\0');
}

void BoneNames::finish(Findings& findings) {
  for (const std::size_t start : starts_) pointers_.push_back(text_.data() + start);

  std::pmr::vector<uint32_t> sorted(starts_.size(), pointers_.get_allocator());
  for (uint32_t bone = 0; bone < sorted.size(); ++bone) sorted[bone] = bone;
  std::sort(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) {
    const int order = std::strcmp(pointers_[a], pointers_[b]);
    return order != 0 ? order < 0 : a < b;
  });
  // Marked in place of the sorted numbers, so that they are told in the order of the file.
  constexpr uint32_t none = UINT32_MAX;
  std::pmr::vector<uint32_t> first_of(starts_.size(), none, pointers_.get_allocator());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (std::strcmp(pointers_[sorted[i - 1]], pointers_[sorted[i]]) == 0)
      first_of[sorted[i]] = first_of[sorted[i - 1]] == none ? sorted[i - 1] : first_of[sorted[i - 1]];
  for (uint32_t bone = 0; bone < first_of.size(); ++bone) {
    const std::size_t length = std::strlen(pointers_[bone]);
    if (length > longest_name_of_tressfx) findings.note(FindingKind::bone_name_long, bone, no_byte);
    if (length == 0) {
      findings.note(FindingKind::bone_name_empty, bone, no_byte);
    } else if (first_of[bone] != none) {
      if (findings.count(FindingKind::bone_name_duplicate) == 0)
        findings.describe(FindingKind::bone_name_duplicate,
                          "bones have the name of a bone before them, the first is \"%s\" (bone %" PRIu32 " after bone %" PRIu32
                          "): a look-up by name finds one of them only; rename the joints or export with their namespaces",
                          Quoted(pointers_[bone]).text, bone, first_of[bone]);
      findings.note(FindingKind::bone_name_duplicate, bone, no_byte);
    }
  }
}

uint64_t BoneNames::bytes() const noexcept {
  return text_.capacity() + starts_.capacity() * sizeof(std::size_t) + pointers_.capacity() * sizeof(const char*);
}

void Weights::add(const Attachment& attachment, uint64_t byte) {
  const uint32_t record = arrays_.recordCount();
  const uint32_t bone_count = arrays_.names.size();
  uint32_t bones[4];
  double weights[4], sum = 0;
  bool whole = true;
  for (int i = 0; i < 4; ++i) {
    const int64_t bone = attachment.bones[i];
    const float weight = attachment.weights[i];
    bones[i] = 0;
    weights[i] = 0;
    if (!(weight >= 0) || std::isinf(weight)) {
      findings_.note(FindingKind::weight_invalid, record, byte);
      whole = false;
      if (bone >= 0 && bone < int64_t{bone_count}) bones[i] = static_cast<uint32_t>(bone);
    } else if (bone == bone_placeholder && weight == 0) {
      findings_.note(FindingKind::bone_placeholder, record, byte);
    } else if (bone < 0 || bone >= int64_t{bone_count}) {
      findings_.note(FindingKind::bone_out_of_range, record, byte);
      whole = whole && weight == 0;
    } else {
      bones[i] = static_cast<uint32_t>(bone);
      weights[i] = double{weight};
      sum += weights[i];
    }
  }
  double scale = 1;
  if (sum <= 0) {
    findings_.note(FindingKind::weights_all_zero, record, byte);
  } else if (std::fabs(sum - 1) > sum_tolerance) {
    scale = 1 / sum;
    // Where a weight was lost, that is the finding, and its share goes to the others.
    if (whole) {
      findings_.note(FindingKind::weights_not_normalised, record, byte);
      if (std::fabs(sum - 1) > std::fabs(worst_sum_ - 1)) worst_sum_ = sum, worst_record_ = record;
    }
  }
  arrays_.bones.insert(arrays_.bones.end(), bones, bones + 4);
  for (const double weight : weights)
    arrays_.weights.push_back(static_cast<float>(scale == 1 ? weight : std::min(weight / sum, 1.0)));
}

void Weights::finish(const char* plural) noexcept {
  const uint64_t count = findings_.count(FindingKind::weights_not_normalised);
  if (count != 0)
    findings_.describe(FindingKind::weights_not_normalised,
                       "the weights of %" PRIu64 " of %" PRIu32 " %s do not make 1, the worst make %s (number %" PRIu32
                       "); they were scaled to 1: export with normalised weights, programs that do not scale them pull towards the origin",
                       count, arrays_.recordCount(), plural, Number(worst_sum_, 6).text, worst_record_);
}

}  // namespace forelock
