// PLY (Turk 1994) with strands, as hairutil writes it: element vertex (x y z; red green blue, thickness where present), element strand
// (nsegs: segments of the strand, which has one point more), vertices in the order of strands. Forelock adds u v to strands and
// inverse_mass to vertices, reads bare points where the caller says how many make a strand (as NeuralHaircut writes them), and writes the segments once more as element edge, so that any viewer of PLY files shows lines.
// ascii, binary_little_endian and binary_big_endian are read; binary_little_endian is written. Thickness is the diameter.
#include "asset/codec.h"
#include "asset/text_cursor.h"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <string_view>

namespace forelock {
namespace {

using namespace std::string_view_literals;

enum class Type : uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct TypeName {
  std::string_view name;
  Type type;
  uint8_t size;
  bool whole;  // an integer
};

constexpr TypeName types[] = {{"char"sv, Type::i8, 1, true},    {"int8"sv, Type::i8, 1, true},     {"uchar"sv, Type::u8, 1, true},
                              {"uint8"sv, Type::u8, 1, true},   {"short"sv, Type::i16, 2, true},   {"int16"sv, Type::i16, 2, true},
                              {"ushort"sv, Type::u16, 2, true}, {"uint16"sv, Type::u16, 2, true},  {"int"sv, Type::i32, 4, true},
                              {"int32"sv, Type::i32, 4, true},  {"uint"sv, Type::u32, 4, true},    {"uint32"sv, Type::u32, 4, true},
                              {"float"sv, Type::f32, 4, false}, {"float32"sv, Type::f32, 4, false}, {"double"sv, Type::f64, 8, false},
                              {"float64"sv, Type::f64, 8, false}};

const TypeName* findType(std::string_view name) noexcept {
  for (const TypeName& type : types)
    if (type.name == name) return &type;
  return nullptr;
}

// What a property of a vertex or strand is used for.
enum Use : uint8_t { unused, x, y, z, red, green, blue, thickness, inverse_mass, segments, u, v, uses };

constexpr struct {
  std::string_view name;
  Use use;
  bool of_strand;
} used_names[] = {{"x"sv, x, false},       {"y"sv, y, false},          {"z"sv, z, false},
                  {"red"sv, red, false},   {"green"sv, green, false},  {"blue"sv, blue, false},
                  {"thickness"sv, thickness, false}, {"inverse_mass"sv, inverse_mass, false},
                  {"nsegs"sv, segments, true}, {"u"sv, u, true},       {"v"sv, v, true}};

enum class Kind : uint8_t { other, vertex, strand, face };

constexpr std::size_t most_elements = 16, most_properties = 64;

struct Property {
  const TypeName* type = nullptr;
  const TypeName* count = nullptr;  // of a list
  Use use = unused;
};

struct Element {
  Kind kind = Kind::other;
  uint64_t count = 0, count_at = 0;  // its value and its byte
  std::size_t first = 0, properties = 0;
  bool has_list = false;
};

struct Header {
  bool ascii = false, big = false;
  std::array<Element, most_elements> elements;
  std::size_t element_count = 0;
  std::array<Property, most_properties> properties;
  std::size_t property_count = 0;
  uint64_t end = 0;  // byte of the first record
  bool alpha = false;

  const Element* find(Kind kind) const noexcept {
    for (std::size_t i = 0; i < element_count; ++i)
      if (elements[i].kind == kind) return &elements[i];
    return nullptr;
  }
  const Property* find(const Element& element, Use use) const noexcept {
    for (std::size_t i = 0; i < element.properties; ++i)
      if (properties[element.first + i].use == use) return &properties[element.first + i];
    return nullptr;
  }
};

FlkResult badHeader(const Report& report, const TextCursor& text, const char* what, std::string_view word) {
  return report.fail(FLK_ERROR_MALFORMED, "PLY_HEADER", "in line %" PRIu64 " of the header (byte %" PRIu64 ") %s, but there is \"%s\": "
                     "the header is damaged or truncated, export it again", text.line(), text.word_at(), what, Quoted(word).text);
}

FlkResult readHeader(std::span<const std::byte> bytes, const Report& report, Header& header) {
  TextCursor text(bytes);
  text.word();  // "ply"
  std::string_view word = text.word();
  if (word != "format"sv) return badHeader(report, text, "\"format\" should be", word);
  word = text.word();
  header.ascii = word == "ascii"sv, header.big = word == "binary_big_endian"sv;
  if (!header.ascii && !header.big && word != "binary_little_endian"sv)
    return badHeader(report, text, "ascii, binary_little_endian or binary_big_endian should be", word);
  word = text.word();
  if (word != "1.0"sv) return badHeader(report, text, "version 1.0 should be", word);
  for (;;) {
    word = text.word();
    if (word == "end_header"sv) break;
    if (word == "comment"sv || word == "obj_info"sv) {
      text.skipLine();
    } else if (word == "element"sv) {
      if (header.element_count == most_elements) return badHeader(report, text, "the header should end: more than 16 elements are not read", word);
      Element& element = header.elements[header.element_count++];
      const std::string_view name = text.word();
      element.kind = name == "vertex"sv ? Kind::vertex : name == "strand"sv ? Kind::strand : name == "face"sv ? Kind::face : Kind::other;
      word = text.word();
      element.count_at = text.word_at();
      int64_t count = 0;
      if (!TextCursor::parse(word, count) || count < 0) return badHeader(report, text, "an element's count should be", word);
      element.count = static_cast<uint64_t>(count);
      element.first = header.property_count;
    } else if (word == "property"sv) {
      if (header.element_count == 0) return badHeader(report, text, "an element should come before its properties", word);
      if (header.property_count == most_properties)
        return badHeader(report, text, "the header should end: more than 64 properties are not read", word);
      Element& element = header.elements[header.element_count - 1];
      Property& property = header.properties[header.property_count++];
      ++element.properties;
      word = text.word();
      if (word == "list"sv) {
        element.has_list = true;
        word = text.word();
        property.count = findType(word);
        if (!property.count || !property.count->whole) return badHeader(report, text, "a whole type for a list's length should be", word);
        word = text.word();
      }
      property.type = findType(word);
      if (!property.type) return badHeader(report, text, "a property's type should be", word);
      const std::string_view name = text.word();
      if (name.empty()) return badHeader(report, text, "a property's name should be", name);
      header.alpha = header.alpha || (element.kind == Kind::vertex && name == "alpha"sv);
      for (const auto& used : used_names)
        if (!property.count && used.name == name && (used.use != segments || property.type->whole) && element.kind == (used.of_strand ? Kind::strand : Kind::vertex)) property.use = used.use;
    } else {
      return badHeader(report, text, "element, property, comment or end_header should be", word);
    }
  }
  text.skipLine();
  header.end = text.at() + (text.left() > 0 ? 1 : 0);  // its line feed
  return FLK_SUCCESS;
}

// Values one after the other, whatever the encoding.
class Values {
public:
  Values(std::span<const std::byte> bytes, const Header& header) noexcept
      : ascii_(header.ascii), big_(header.big), text_(bytes.subspan(header.end)), binary_(bytes, header.end), start_(header.end) {}

  double next(Type type) noexcept {
    if (ascii_) {
      double value = 0;
      if (!TextCursor::parse(text_.word(), value)) failed_ = true;
      return value;
    }
    switch (type) {
      case Type::i8: return static_cast<int8_t>(whole(1));
      case Type::u8: return static_cast<uint8_t>(whole(1));
      case Type::i16: return static_cast<int16_t>(whole(2));
      case Type::u16: return static_cast<uint16_t>(whole(2));
      case Type::i32: return static_cast<int32_t>(whole(4));
      case Type::u32: return static_cast<uint32_t>(whole(4));
      case Type::f32: return std::bit_cast<float>(static_cast<uint32_t>(whole(4)));
      case Type::f64: return std::bit_cast<double>(whole(8));
    }
    return 0;
  }
  void skip(uint64_t bytes) noexcept { binary_.skip(bytes); }
  // A read past the end, or a word that is no number.
  bool failed() const noexcept { return failed_ || binary_.failed(); }
  uint64_t at() const noexcept { return ascii_ ? start_ + text_.word_at() : binary_.at(); }
  uint64_t next_at() const noexcept { return ascii_ ? start_ + text_.at() : binary_.at(); }
  uint64_t left() const noexcept { return ascii_ ? text_.left() : binary_.left(); }
  bool ended() const noexcept { return ascii_ ? text_.peek().empty() : binary_.left() == 0; }

private:
  uint64_t whole(int size) noexcept {
    uint64_t value = 0;
    for (int i = 0; i < size; ++i) {
      const uint64_t byte = binary_.u8();
      value |= byte << (8 * (big_ ? size - 1 - i : i));
    }
    return value;
  }

  bool ascii_, big_, failed_ = false;
  TextCursor text_;
  Cursor binary_;
  uint64_t start_;
};

// Bytes of a record without what its lists hold. In ascii the least: a digit and what divides it from the next for each value.
uint64_t recordSize(const Header& header, const Element& element) noexcept {
  uint64_t bytes = 0;
  for (std::size_t i = 0; i < element.properties; ++i) {
    const Property& property = header.properties[element.first + i];
    bytes += header.ascii ? 2 : property.count ? property.count->size : property.type->size;
  }
  return bytes;
}

FlkResult pastEnd(const Report& report, const char* what, uint64_t count, uint64_t count_at, uint64_t at, uint64_t size) {
  return report.fail(FLK_ERROR_MALFORMED, "PLY_PAST_END", "its %" PRIu64 " %s (count at byte %" PRIu64 ") do not fit between byte %" PRIu64
                     " and its end at byte %" PRIu64 ", or hold what is no number: it is truncated or damaged, fetch it again",
                     count, what, count_at, at, size);
}

FlkResult read(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
               Places& places, Findings& findings) {
  Header header;
  FlkResult result = readHeader(bytes, report, header);
  if (result != FLK_SUCCESS) return result;
  const Element *vertices = header.find(Kind::vertex), *strands = header.find(Kind::strand);
  if (!vertices || !header.find(*vertices, x) || !header.find(*vertices, y) || !header.find(*vertices, z))
    return report.fail(FLK_ERROR_MALFORMED, "PLY_NO_POSITIONS", "it has no element vertex with x, y and z in its header (to byte %" PRIu64
                       "): there is nothing to load, export it again", header.end);
  uint64_t strand_count = 0, strand_count_at = vertices->count_at;
  if (strands && header.find(*strands, segments)) {
    strand_count = strands->count, strand_count_at = strands->count_at;
  } else {
    strands = nullptr;
    const Element* faces = header.find(Kind::face);
    if (faces && faces->count != 0)
      return report.fail(FLK_ERROR_FORMAT_UNKNOWN, "PLY_MESH", "it is a mesh of %" PRIu64 " faces (byte %" PRIu64
                         "), not hair: give strands; a mesh can be the head beside them", faces->count, faces->count_at);
    const uint64_t points = limits.points_per_strand;
    if (points == 0)
      return report.fail(FLK_ERROR_FORMAT_UNKNOWN, "PLY_NO_STRANDS", "it has %" PRIu64 " points (byte %" PRIu64
                         ") and no element strand with nsegs, so that nothing says which points make a strand: if each has as many, say how many "
                         "(FlkAssetOptions.points_per_strand, --points-per-strand N), or export it with strands",
                         vertices->count, vertices->count_at);
    if (vertices->count % points != 0)
      return report.fail(FLK_ERROR_MALFORMED, "PLY_POINTS_DISAGREE", "its %" PRIu64 " points (byte %" PRIu64 ") make %" PRIu64
                         " strands of points_per_strand = %" PRIu64 " and leave %" PRIu64 " over: give the number that it was exported with",
                         vertices->count, vertices->count_at, vertices->count / points, points, vertices->count % points);
    strand_count = vertices->count / points;
  }
  if (strand_count == 0 || vertices->count == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "PLY_EMPTY", "it counts %" PRIu64 " strands (byte %" PRIu64 ") and %" PRIu64 " vertices (byte %" PRIu64
                       "): there is nothing to load, export it again", strand_count, strand_count_at, vertices->count, vertices->count_at);
  // Whatever is read, is proven against the bytes first: all records together, then (with lists) each one.
  uint64_t least = 0;
  for (std::size_t i = 0; i < header.element_count; ++i)
    least = saturatingSum(least, saturatingProduct(header.elements[i].count, recordSize(header, header.elements[i])));
  if (least > bytes.size() - header.end + (header.ascii ? 1 : 0))  // the last line may lack its end
    return pastEnd(report, "vertices and other records", vertices->count, vertices->count_at, header.end, bytes.size());
  if (strand_count > limits.strands || vertices->count > limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "PLY_TOO_LARGE", "it holds %" PRIu64 " strands (byte %" PRIu64 ") and %" PRIu64 " vertices (byte %" PRIu64
                       "), beyond the limit of %" PRIu32 " and %" PRIu32 ": split it or raise the limit",
                       strand_count, strand_count_at, vertices->count, vertices->count_at, limits.strands, limits.vertices);

  const auto has = [&](const Element& element, Use use) { return header.find(element, use) != nullptr; };
  const bool has_color = has(*vertices, red) && has(*vertices, green) && has(*vertices, blue);
  const bool has_uv = strands && has(*strands, u) && has(*strands, v);
  arrays.positions.resize(vertices->count * 3);
  if (has(*vertices, thickness)) arrays.radii.resize(vertices->count);
  if (has(*vertices, inverse_mass)) arrays.inverse_masses.resize(vertices->count);
  if (has_color) arrays.colors.resize(vertices->count * 3);
  if (has_uv) arrays.root_uvs.resize(strand_count * 2);
  arrays.first_vertex.resize(strand_count + 1);
  if (header.alpha) findings.note(FindingKind::ply_alpha_ignored, no_strand, no_byte);

  Values values(bytes, header);
  uint64_t used_vertices = strands ? 0 : vertices->count;
  for (uint64_t strand = 1; !strands && strand <= strand_count; ++strand)
    arrays.first_vertex[strand] = static_cast<uint32_t>(strand * limits.points_per_strand);
  for (std::size_t e = 0; e < header.element_count; ++e) {
    const Element& element = header.elements[e];
    const bool wanted = &element == vertices || &element == strands;
    const uint64_t begin = values.next_at();
    if (element.properties == 0) continue;
    if (!wanted && !header.ascii && !element.has_list) {
      values.skip(saturatingProduct(element.count, recordSize(header, element)));
      if (values.failed()) return pastEnd(report, "records", element.count, element.count_at, begin, bytes.size());
      continue;
    }
    if (&element == vertices && !header.ascii && !element.has_list) {
      const auto stride = static_cast<uint32_t>(recordSize(header, element));
      places.positions = places.radii = places.inverse_masses = places.colors = {begin, stride, false};
    }
    for (uint64_t record = 0; record < element.count; ++record) {
      double value[uses] = {};
      for (std::size_t i = 0; i < element.properties; ++i) {
        const Property& property = header.properties[element.first + i];
        if (!property.count) {
          value[property.use] = values.next(property.type->type);
          // Bytes are steps of 1/255.
          if (property.use >= red && property.use <= blue && property.type->whole) value[property.use] /= 255;
          continue;
        }
        const double length = values.next(property.count->type);
        if (!(length >= 0 && length <= static_cast<double>(values.left())))
          return pastEnd(report, "records with lists", element.count, element.count_at, begin, bytes.size());
        for (uint64_t item = 0; item < static_cast<uint64_t>(length) && !values.failed(); ++item) values.next(property.type->type);
      }
      if (values.failed())
        return pastEnd(report, &element == vertices ? "vertices" : &element == strands ? "strands" : "records",
                       element.count, element.count_at, begin, bytes.size());
      if (!wanted) continue;
      if (&element == vertices) {
        for (int axis = 0; axis < 3; ++axis) arrays.positions[record * 3 + std::size_t(axis)] = static_cast<float>(value[x + axis]);
        if (!arrays.radii.empty()) arrays.radii[record] = 0.5f * static_cast<float>(value[thickness]);
        if (!arrays.inverse_masses.empty()) arrays.inverse_masses[record] = static_cast<float>(value[inverse_mass]);
        for (int channel = 0; channel < 3 && has_color; ++channel)
          arrays.colors[record * 3 + std::size_t(channel)] = static_cast<float>(value[red + channel]);
      } else {
        const double count = value[segments] + 1;
        if (!(count >= 0 && count <= static_cast<double>(vertices->count - used_vertices)))
          return report.fail(FLK_ERROR_MALFORMED, "PLY_SEGMENTS_DISAGREE", "strand %" PRIu64 " (before byte %" PRIu64 ") has %s segments, but %" PRIu64
                             " of %" PRIu64 " vertices (byte %" PRIu64 ") are left: the file is damaged, export it again",
                             record, values.next_at(), Number(value[segments], 6).text, vertices->count - used_vertices, vertices->count, vertices->count_at);
        used_vertices += static_cast<uint64_t>(count);
        arrays.first_vertex[record + 1] = static_cast<uint32_t>(used_vertices);
        if (has_uv) arrays.root_uvs[record * 2] = static_cast<float>(value[u]), arrays.root_uvs[record * 2 + 1] = static_cast<float>(value[v]);
      }
    }
  }
  if (used_vertices < vertices->count) {
    findings.note(FindingKind::ply_vertices_unused, no_strand, no_byte, vertices->count - used_vertices);
    arrays.positions.resize(used_vertices * 3);
    if (!arrays.radii.empty()) arrays.radii.resize(used_vertices);
    if (!arrays.inverse_masses.empty()) arrays.inverse_masses.resize(used_vertices);
    if (!arrays.colors.empty()) arrays.colors.resize(used_vertices * 3);
  }
  if (!values.ended()) findings.note(FindingKind::trailing_bytes, no_strand, values.next_at(), values.left());
  return FLK_SUCCESS;
}

constexpr uint32_t largest_segment_count = 65'535;  // of ushort

// The header, into `text`; its length.
template <std::size_t N> uint64_t writtenHeader(const FlkStrands& strands, const FlkAssetInfo& info, char (&text)[N]) {
  const int length = std::snprintf(
      text, N,
      "ply\nformat binary_little_endian 1.0\ncomment strands of hair, root to tip, by Forelock; thickness is the diameter\n"
      "element vertex %" PRIu32 "\nproperty float x\nproperty float y\nproperty float z\n%s%s%s"
      "element strand %" PRIu32 "\nproperty ushort nsegs\n%s"
      "element edge %" PRIu32 "\nproperty int vertex1\nproperty int vertex2\nend_header\n",
      strands.vertex_count, info.has_radii ? "property float thickness\n" : "",
      strands.colors ? "property float red\nproperty float green\nproperty float blue\n" : "",
      strands.inverse_masses ? "property float inverse_mass\n" : "", strands.strand_count,
      strands.root_uvs ? "property float u\nproperty float v\n" : "", strands.vertex_count - strands.strand_count);
  return static_cast<uint64_t>(length);
}

FlkResult measure(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, uint64_t& bytes) {
  if (info.max_vertices_per_strand - 1 > largest_segment_count)
    return report.fail(FLK_ERROR_LIMIT, "WRITE_PLY_STRAND_TOO_LONG",
                       "its longest strand has %" PRIu32 " vertices, but 65,536 are the most in a PLY file of strands: resample it",
                       info.max_vertices_per_strand);
  char header[640];
  const uint64_t vertex = 12u + (info.has_radii ? 4u : 0u) + (strands.colors ? 12u : 0u) + (strands.inverse_masses ? 4u : 0u);
  bytes = writtenHeader(strands, info, header) + vertex * strands.vertex_count + (strands.root_uvs ? 10u : 2u) * uint64_t{strands.strand_count} +
          uint64_t{strands.vertex_count - strands.strand_count} * 8;
  return FLK_SUCCESS;
}

void write(const FlkStrands& strands, const FlkAssetInfo& info, const Report&, ByteSink& sink) {
  char header[640];
  sink.text(header, writtenHeader(strands, info, header));
  for (std::size_t i = 0; i < strands.vertex_count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) sink.f32(strands.positions[i * 3 + axis]);
    if (info.has_radii) sink.f32(2.0f * strands.radii[i]);
    for (std::size_t channel = 0; channel < 3 && strands.colors; ++channel) sink.f32(strands.colors[i * 3 + channel]);
    if (strands.inverse_masses) sink.f32(strands.inverse_masses[i]);
  }
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    sink.u16(static_cast<uint16_t>(strands.first_vertex[strand + 1] - strands.first_vertex[strand] - 1));
    for (std::size_t i = 0; i < 2 && strands.root_uvs; ++i) sink.f32(strands.root_uvs[strand * std::size_t{2} + i]);
  }
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand)
    for (uint32_t vertex = strands.first_vertex[strand]; vertex + 1 < strands.first_vertex[strand + 1]; ++vertex)
      sink.u32(vertex), sink.u32(vertex + 1);
}

}  // namespace

const Codec ply_codec{FLK_FORMAT_PLY, read, measure, write};

}  // namespace forelock
