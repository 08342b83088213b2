// Collision mesh of TressFX 4 (.tfxmesh), text: "numOfBones N" and N lines "number name"; "numOfVertices N" and N lines of number,
// position, normal, four bones, four weights; "numOfTriangles N" and N lines of number and three vertices. Empty lines and lines
// that begin with # count for nothing. Numbers of bones, vertices and triangles are theirs in the order of the file.
#include "asset/rig_arrays.h"
#include "asset/sanitise.h"
#include "asset/text_cursor.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>

namespace forelock {
namespace {

using namespace std::string_view_literals;

// The lines that count, one after the other, each with its place in the file.
class Rows {
public:
  explicit Rows(std::span<const std::byte> bytes) noexcept : bytes_(bytes), text_(bytes) {}

  // False at the end.
  bool next() noexcept {
    for (;;) {
      const std::string_view first = text_.word();
      line_ = text_.line();
      at_ = text_.word_at();
      if (first.empty()) return false;
      text_.skipLine();
      if (first[0] == '#') continue;
      row_ = TextCursor(bytes_.subspan(at_, text_.at() - at_));
      return true;
    }
  }

  std::string_view word() noexcept { return row_.word(); }
  // What is left of the line, without the white space around it.
  std::string_view rest() noexcept {
    row_.word();
    const uint64_t from = at_ + row_.word_at();
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + from, text_.at() - from);
    const std::size_t last = text.find_last_not_of(" ,\t\r\v\f"sv);
    return last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
  }
  uint64_t line() const noexcept { return line_; }                        // of the row, or of the end
  uint64_t word_at() const noexcept { return at_ + row_.word_at(); }      // byte of the word read last
  uint64_t at() const noexcept { return at_; }                            // byte of the row, or of the end
  uint64_t left() const noexcept { return text_.left(); }                 // bytes after the row

private:
  std::span<const std::byte> bytes_;
  TextCursor text_, row_{std::span<const std::byte>()};
  uint64_t at_ = 0, line_ = 1;
};

struct Section {
  std::string_view key;
  const char* plural;
  const char* singular;
  uint64_t least_row;  // a digit and what divides it from the next for each word
  uint64_t count = 0, count_at = 0;
};

class Reader {
public:
  Reader(std::span<const std::byte> bytes, const RigLimits& limits, const Report& report, RigArrays& arrays, Findings& findings) noexcept
      : rows_(bytes), limits_(limits), report_(report), arrays_(arrays), findings_(findings), size_(bytes.size()) {}

  FlkResult read(uint32_t& triangles_in_source) {
    Section bones{"numOfBones"sv, "bones", "bone", 4}, vertices{"numOfVertices"sv, "vertices", "vertex", 30},
        triangles{"numOfTriangles"sv, "triangles", "triangle", 8};
    FlkResult result = readCount(bones, limits_.bones);
    if (result == FLK_SUCCESS) result = readBones(bones);
    if (result == FLK_SUCCESS) result = readCount(vertices, limits_.records);
    if (result == FLK_SUCCESS) result = readVertices(vertices);
    if (result == FLK_SUCCESS) result = readCount(triangles, limits_.records);
    if (result == FLK_SUCCESS) result = readTriangles(triangles);
    if (result != FLK_SUCCESS) return result;
    triangles_in_source = static_cast<uint32_t>(triangles.count);
    if (rows_.next()) findings_.note(FindingKind::trailing_bytes, no_strand, rows_.at(), size_ - rows_.at());
    return FLK_SUCCESS;
  }

private:
  FlkResult wrong(const char* what, std::string_view word) const {
    return report_.fail(FLK_ERROR_MALFORMED, "MESH_ROW", "in line %" PRIu64 " (byte %" PRIu64 ") %s should be, but there is \"%s\": the file is "
                        "damaged or its counts are wrong, export it again", rows_.line(), rows_.word_at(), what, Quoted(word).text);
  }

  FlkResult truncated(const Section& section, uint64_t row) const {
    return report_.fail(FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "it counts %" PRIu64 " %s (%.*s at byte %" PRIu64 "), but ends in line %" PRIu64
                        " (byte %" PRIu64 ") where %s %" PRIu64 " should be: it is truncated, fetch it again",
                        section.count, section.plural, static_cast<int>(section.key.size()), section.key.data(), section.count_at, rows_.line(),
                        rows_.at(), section.singular, row);
  }

  FlkResult readCount(Section& section, uint32_t limit) {
    char what[48];
    std::snprintf(what, sizeof what, "\"%.*s\"", static_cast<int>(section.key.size()), section.key.data());
    if (!rows_.next())
      return report_.fail(FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "it ends in line %" PRIu64 " (byte %" PRIu64 "), where %s should be: it is "
                          "truncated, fetch it again", rows_.line(), rows_.at(), what);
    std::string_view word = rows_.word();
    if (!sameWord(word, section.key)) return wrong(what, word);
    word = rows_.word();
    section.count_at = rows_.word_at();
    int64_t count = 0;
    std::snprintf(what, sizeof what, "a count of %s", section.plural);
    if (!TextCursor::parse(word, count) || count < 0) return wrong(what, word);
    section.count = static_cast<uint64_t>(count);
    if (count == 0)
      return report_.fail(FLK_ERROR_EMPTY_ASSET, sameWord(section.key, "numOfBones"sv) ? "RIG_NO_BONES" : "RIG_NO_RECORDS",
                          "it counts 0 %s (line %" PRIu64 ", byte %" PRIu64 "): there is nothing to load, export it again",
                          section.plural, rows_.line(), section.count_at);
    // The last line may lack its end.
    if (section.count > (rows_.left() + 1) / section.least_row)
      return report_.fail(FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "it counts %" PRIu64 " %s (%.*s at byte %" PRIu64 "), but only %" PRIu64
                          " bytes follow: it is truncated, fetch it again", section.count, section.plural,
                          static_cast<int>(section.key.size()), section.key.data(), section.count_at, rows_.left());
    if (section.count > limit)
      return report_.fail(FLK_ERROR_LIMIT, "RIG_TOO_LARGE", "it counts %" PRIu64 " %s (byte %" PRIu64 "), beyond the limit of %" PRIu32
                          ": leave some out of the export or raise the limit", section.count, section.plural, section.count_at, limit);
    return FLK_SUCCESS;
  }

  // The row of number `row` and its own number, which should be the same.
  FlkResult beginRow(const Section& section, uint32_t row) {
    if (!rows_.next()) return truncated(section, row);
    int64_t number = 0;
    const std::string_view word = rows_.word();
    char what[48];
    std::snprintf(what, sizeof what, "the number of %s %" PRIu32, section.singular, row);
    if (!TextCursor::parse(word, number)) return wrong(what, word);
    if (number != int64_t{row}) findings_.note(FindingKind::rig_index_unexpected, row, rows_.word_at());
    return FLK_SUCCESS;
  }

  template <class T> FlkResult values(const char* what, std::span<T> out) {
    for (T& value : out)
      if (const std::string_view word = rows_.word(); !TextCursor::parse(word, value)) return wrong(what, word);
    return FLK_SUCCESS;
  }

  FlkResult endRow() {
    const std::string_view word = rows_.word();
    return word.empty() ? FLK_SUCCESS : wrong("the end of the line", word);
  }

  FlkResult readBones(const Section& bones) {
    for (uint32_t bone = 0; bone < bones.count; ++bone) {
      if (const FlkResult result = beginRow(bones, bone); result != FLK_SUCCESS) return result;
      arrays_.names.add(rows_.rest());
    }
    arrays_.names.finish(findings_);
    return FLK_SUCCESS;
  }

  FlkResult readVertices(const Section& vertices) {
    const auto count = static_cast<std::size_t>(vertices.count);
    arrays_.positions.reserve(count * 3);
    arrays_.normals.reserve(count * 3);
    arrays_.bones.reserve(count * 4);
    arrays_.weights.reserve(count * 4);
    Weights weights(arrays_, findings_);
    for (uint32_t vertex = 0; vertex < count; ++vertex) {
      float position[3], normal[3];
      Attachment attachment;
      FlkResult result = beginRow(vertices, vertex);
      const uint64_t at = rows_.at();
      if (result == FLK_SUCCESS) result = values("a coordinate of a position", std::span<float>(position));
      if (result == FLK_SUCCESS) result = values("a coordinate of a normal", std::span<float>(normal));
      if (result == FLK_SUCCESS) result = values("the number of a bone", std::span<int64_t>(attachment.bones));
      if (result == FLK_SUCCESS) result = values("a weight", std::span<float>(attachment.weights));
      if (result == FLK_SUCCESS) result = endRow();
      if (result != FLK_SUCCESS) return result;
      addPosition(position, vertex, at);
      addNormal(normal, vertex, at);
      weights.add(attachment, at);
    }
    weights.finish("vertices");
    return FLK_SUCCESS;
  }

  // What is no position is marked by NaN until the triangles are known.
  void addPosition(float (&position)[3], uint32_t vertex, uint64_t at) {
    const bool usable = std::all_of(position, position + 3, [](float value) { return std::fabs(value) <= largest_coordinate; });
    if (!usable) {
      findings_.note(FindingKind::mesh_position_invalid, vertex, at);
      std::fill_n(position, 3, std::numeric_limits<float>::quiet_NaN());
    }
    arrays_.positions.insert(arrays_.positions.end(), position, position + 3);
  }

  void addNormal(float (&normal)[3], uint32_t vertex, uint64_t at) {
    const bool finite = std::all_of(normal, normal + 3, [](float value) { return std::isfinite(value); });
    if (!finite || std::all_of(normal, normal + 3, [](float value) { return value == 0; })) {
      findings_.note(FindingKind::mesh_normal_invalid, vertex, at);
      std::fill_n(normal, 3, 0.0f);
    }
    arrays_.normals.insert(arrays_.normals.end(), normal, normal + 3);
  }

  FlkResult readTriangles(const Section& triangles) {
    const auto vertices = int64_t{arrays_.recordCount()};
    arrays_.triangles.reserve(static_cast<std::size_t>(triangles.count) * 3);
    uint64_t of_bad_vertices = 0;
    for (uint32_t triangle = 0; triangle < triangles.count; ++triangle) {
      int64_t corners[3];
      FlkResult result = beginRow(triangles, triangle);
      const uint64_t at = rows_.at();
      if (result == FLK_SUCCESS) result = values("the vertex of a triangle", std::span<int64_t>(corners));
      if (result == FLK_SUCCESS) result = endRow();
      if (result != FLK_SUCCESS) return result;
      const auto unknown = [&](int64_t corner) { return corner < 0 || corner >= vertices; };
      const auto bad = [&](int64_t corner) { return std::isnan(arrays_.positions[static_cast<std::size_t>(corner) * 3]); };
      if (std::any_of(corners, corners + 3, unknown))
        findings_.note(FindingKind::triangle_out_of_range, triangle, at);
      else if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        findings_.note(FindingKind::triangle_degenerate, triangle, at);
      else if (std::any_of(corners, corners + 3, bad))
        ++of_bad_vertices;
      else
        for (const int64_t corner : corners) arrays_.triangles.push_back(static_cast<uint32_t>(corner));
    }
    if (arrays_.triangles.empty())
      return report_.fail(FLK_ERROR_EMPTY_ASSET, "MESH_NO_TRIANGLE_LEFT", "none of its %" PRIu64 " triangles can be used: %" PRIu64
                          " name vertices that do not exist, %" PRIu64 " name one twice, %" PRIu64 " have a vertex without a position; export it again",
                          triangles.count, findings_.count(FindingKind::triangle_out_of_range),
                          findings_.count(FindingKind::triangle_degenerate), of_bad_vertices);
    for (float& value : arrays_.positions)
      if (std::isnan(value)) value = 0;
    return FLK_SUCCESS;
  }

  Rows rows_;
  const RigLimits& limits_;
  const Report& report_;
  RigArrays& arrays_;
  Findings& findings_;
  uint64_t size_;
};

}  // namespace

FlkResult readTfxmesh(std::span<const std::byte> bytes, const RigLimits& limits, const Report& report, RigArrays& arrays,
                      Findings& findings, uint32_t& triangles_in_source) {
  return Reader(bytes, limits, report, arrays, findings).read(triangles_in_source);
}

}  // namespace forelock
