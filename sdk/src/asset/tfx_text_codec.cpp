// TressFX 1 and 2 (.tfx as text): lines of a key and its values, the last of them numStrands; then for each strand a line
// "strand I numVerts N texcoord U V" and a line a vertex, x y z. White space or commas divide numbers. Masses are not in it
// (impliedInverseMass).
#include "asset/codec.h"
#include "asset/text_cursor.h"

#include <algorithm>
#include <cinttypes>

namespace forelock {
namespace {

using namespace std::string_view_literals;

// Every coordinate is a digit and what divides it from the next, at least.
constexpr uint64_t least_vertex = 6;

struct Header {
  float scale = 1, rotation[3] = {}, translation[3] = {};
  int64_t both_ends = 0, most_vertices = 0, follow_strands = 0, strands = -1;
  float follow_radius = 0;
  int64_t sorted = 0;
};

struct Key {
  std::string_view name;
  int values;
  float Header::*single;
  float (Header::*triple)[3];
  int64_t Header::*whole;
};

constexpr Key keys[] = {
    {"scale"sv, 1, &Header::scale, nullptr, nullptr},
    {"rotation"sv, 3, nullptr, &Header::rotation, nullptr},
    {"translation"sv, 3, nullptr, &Header::translation, nullptr},
    {"bothEndsImmovable"sv, 1, nullptr, nullptr, &Header::both_ends},
    {"maxNumVerticesInStrand"sv, 1, nullptr, nullptr, &Header::most_vertices},
    {"numFollowHairsPerGuideHair"sv, 1, nullptr, nullptr, &Header::follow_strands},
    {"maxRadiusAroundGuideHair"sv, 1, &Header::follow_radius, nullptr, nullptr},
    {"numStrands"sv, 1, nullptr, nullptr, &Header::strands},
};

FlkResult notNumber(const Report& report, const TextCursor& text, const char* what, std::string_view word) {
  if (word.empty())
    return report.fail(FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "it ends in line %" PRIu64 " (byte %" PRIu64
                       "), where %s should be: it is truncated, fetch it again", text.line(), text.word_at(), what);
  return report.fail(FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "in line %" PRIu64 " (byte %" PRIu64 ") %s should be, but there is \"%s\": "
                     "the file is damaged, export it again", text.line(), text.word_at(), what, Quoted(word).text);
}

FlkResult readHeader(TextCursor& text, const Report& report, Header& header, Findings& findings) {
  for (std::string_view next = text.peek(); !next.empty() && !sameWord(next, "strand"sv); next = text.peek()) {
    const std::string_view word = text.word();
    if (sameWord(word, "is"sv) && sameWord(text.peek(), "sorted"sv)) {
      text.word();
      const std::string_view value = text.word();
      if (!TextCursor::parse(value, header.sorted)) return notNumber(report, text, "the value of \"is sorted\"", value);
      continue;
    }
    const Key* key = std::find_if(std::begin(keys), std::end(keys), [&](const Key& k) { return sameWord(word, k.name); });
    if (key == std::end(keys)) {
      findings.note(FindingKind::tfx_text_key_unknown, no_strand, text.word_at());
      text.skipLine();
      continue;
    }
    for (int i = 0; i < key->values; ++i) {
      const std::string_view value = text.word();
      const bool read = key->whole ? TextCursor::parse(value, header.*key->whole)
                                   : TextCursor::parse(value, key->single ? header.*key->single : (header.*key->triple)[i]);
      char what[64];
      std::snprintf(what, sizeof what, "a number of \"%.*s\"", int(key->name.size()), key->name.data());
      if (!read) return notNumber(report, text, what, value);
    }
  }
  return FLK_SUCCESS;
}

FlkResult read(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
               Places&, Findings& findings) {
  TextCursor text(bytes);
  text.word();  // "version"
  std::string_view version_word = text.word();
  float version = 0;
  if (!TextCursor::parse(version_word, version)) return notNumber(report, text, "the version", version_word);
  if (version == 3)
    return report.fail(FLK_ERROR_FORMAT_UNKNOWN, "TFX_PROJECT", "it is a text of TressFX 3 (byte %" PRIu64 "), a project or settings and no strands: "
                       "give the .tfx files that the project names", text.word_at());
  if (!(version >= 1 && version < 3))
    return report.fail(FLK_ERROR_FORMAT_UNKNOWN, "TFX_TEXT_VERSION", "it is a text file of TressFX %s (byte %" PRIu64
                       "), but only 1 and 2 have been text: the file is damaged or newer, export it again as TressFX 4",
                       Number(double{version}, 6).text, text.word_at());
  Header header;
  FlkResult result = readHeader(text, report, header, findings);
  if (result != FLK_SUCCESS) return result;
  const uint64_t strands_at = text.at();
  if (header.strands == 0 || (header.strands < 0 && text.peek().empty()))
    return report.fail(FLK_ERROR_EMPTY_ASSET, "TFX_TEXT_NO_STRANDS",
                       "its header (to byte %" PRIu64 ") counts no strands and none follow: there is nothing to load, export it again", strands_at);
  if (header.strands > int64_t{limits.strands})
    return report.fail(FLK_ERROR_LIMIT, "TFX_TEXT_TOO_LARGE", "numStrands is %" PRId64 ", beyond the limit of %" PRIu32
                       ": split it or raise the limit", header.strands, limits.strands);

  arrays.first_vertex.push_back(0);
  bool all_have_uv = true;
  while (header.strands < 0 ? !text.peek().empty() : arrays.strandCount() < static_cast<uint64_t>(header.strands)) {
    std::string_view word = text.word();
    const uint32_t strand = arrays.strandCount();
    if (word.empty())
      return report.fail(FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "numStrands is %" PRId64 ", but it ends after strand %" PRId64 " in line %" PRIu64
                         " (byte %" PRIu64 "): it is truncated, fetch it again", header.strands, int64_t{strand} - 1, text.line(), text.word_at());
    if (!sameWord(word, "strand"sv))
      return report.fail(FLK_ERROR_MALFORMED, "TFX_TEXT_NO_STRAND", "in line %" PRIu64 " (byte %" PRIu64 ") strand %" PRIu32
                         " should begin, but there is \"%s\": the counts before it are wrong, export it again",
                         text.line(), text.word_at(), strand, Quoted(word).text);
    int64_t index = 0, count = 0;
    word = text.word();
    if (!TextCursor::parse(word, index)) return notNumber(report, text, "the number of a strand", word);
    word = text.word();
    if (!sameWord(word, "numVerts"sv)) return notNumber(report, text, "\"numVerts\" of a strand", word);
    word = text.word();
    if (!TextCursor::parse(word, count)) return notNumber(report, text, "the count of a strand's vertices", word);
    if (count < 0 || static_cast<uint64_t>(count) > (text.left() + 1) / least_vertex)
      return report.fail(FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "strand %" PRIu32 " has %" PRId64 " vertices (line %" PRIu64 ", byte %" PRIu64
                         "), but only %" PRIu64 " bytes follow: it is truncated, fetch it again", strand, count, text.line(), text.word_at(), text.left());
    if (arrays.vertexCount() + static_cast<uint64_t>(count) > limits.vertices || strand >= limits.strands)
      return report.fail(FLK_ERROR_LIMIT, "TFX_TEXT_TOO_LARGE", "strand %" PRIu32 " (line %" PRIu64 ", byte %" PRIu64
                         ") is beyond the limit of %" PRIu32 " strands and %" PRIu32 " vertices: split it or raise the limit",
                         strand, text.line(), text.word_at(), limits.strands, limits.vertices);
    float uv[2] = {};
    if (sameWord(text.peek(), "texcoord"sv)) {
      text.word();
      for (float& value : uv)
        if (word = text.word(); !TextCursor::parse(word, value)) return notNumber(report, text, "a texture coordinate", word);
    } else {
      all_have_uv = false;
    }
    arrays.root_uvs.insert(arrays.root_uvs.end(), {uv[0], uv[1]});
    for (int64_t i = 0; i < count; ++i) {
      float xyz[3];
      for (float& value : xyz)
        if (word = text.word(); !TextCursor::parse(word, value)) return notNumber(report, text, "a coordinate", word);
      arrays.positions.insert(arrays.positions.end(), {xyz[0], xyz[1], xyz[2]});
      arrays.inverse_masses.push_back(impliedInverseMass(static_cast<uint64_t>(i), static_cast<uint64_t>(count), header.both_ends != 0));
    }
    arrays.first_vertex.push_back(arrays.vertexCount() + static_cast<uint32_t>(count));
  }
  if (!text.peek().empty()) {
    text.word();
    findings.note(FindingKind::trailing_bytes, no_strand, text.word_at(), bytes.size() - text.word_at());
  }
  if (!all_have_uv) arrays.root_uvs.clear();
  const auto isZero = [](const float (&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
  if (header.scale != 1 || !isZero(header.rotation) || !isZero(header.translation)) {
    findings.note(FindingKind::tfx_text_transform_ignored, no_strand, 0);
    findings.describe(FindingKind::tfx_text_transform_ignored,
                      "its header asks for a scale of %s, a rotation of %s %s %s and a shift of %s %s %s, which are not applied: transform the hair "
                      "where it is placed, or convert with a scale",
                      Number(double{header.scale}, 6).text, Number(double{header.rotation[0]}, 6).text, Number(double{header.rotation[1]}, 6).text, Number(double{header.rotation[2]}, 6).text,
                      Number(double{header.translation[0]}, 6).text, Number(double{header.translation[1]}, 6).text, Number(double{header.translation[2]}, 6).text);
  }
  findings.note(FindingKind::inverse_mass_implied, no_strand, no_byte, arrays.strandCount());
  if (header.both_ends != 0) findings.note(FindingKind::both_ends_fixed, no_strand, 0, arrays.strandCount());
  if (header.follow_strands > 0)
    findings.note(FindingKind::tfx_follow_strands_ignored, no_strand, 0, static_cast<uint64_t>(header.follow_strands));
  return FLK_SUCCESS;
}

}  // namespace

const Codec tfx_text_codec{FLK_FORMAT_TFX_TEXT, read, nullptr, nullptr};

}  // namespace forelock
