#include "asset/sniff.h"

#include "asset/cursor.h"
#include "asset/strand_arrays.h"
#include "asset/text_cursor.h"
#include "asset/tfxbone_reader.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace forelock {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view start;
  FlkResult result;
  const char* id;
  const char* text;
};

constexpr FlkResult unknown = FLK_ERROR_FORMAT_UNKNOWN;
constexpr FlkResult malformed = FLK_ERROR_MALFORMED;

// Longer starts before the shorter ones that they begin with.
constexpr Signature binary_signatures[] = {
    {"\x40\x80\x00\x00"sv, malformed, "TFX_BYTE_SWAPPED",
     "a TressFX 4 file in big-endian byte order (version at byte 0 is 4.0 backwards): write it in little-endian order"},
    {"\x40\x40\x00\x00"sv, malformed, "TFX_BYTE_SWAPPED",
     "a TressFX 3 file in big-endian byte order (version at byte 0 is 3.0 backwards): write it in little-endian order"},
    {"RIAH"sv, malformed, "HAIR_BYTE_SWAPPED",
     "a .hair file in swapped byte order (the magic at byte 0 reads RIAH): write it in little-endian order"},
    {"glTF"sv, unknown, "GLTF_BINARY",
     "a binary glTF file, which is not read here: convert its strands to .tfx or .hair first"},
    {"Ogawa"sv, unknown, "ALEMBIC_FILE",
     "an Alembic file (Ogawa), which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"\x89HDF\r\n\x1a\n"sv, unknown, "ALEMBIC_FILE",
     "an HDF5 file, most likely an old Alembic: export the curves as .tfx or .hair from the program that made it"},
    {"PXR-USDC"sv, unknown, "USD_FILE",
     "a binary USD layer, which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"#usda"sv, unknown, "USD_FILE",
     "a USD text layer, which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"Kaydara FBX Binary"sv, unknown, "FBX_FILE",
     "an FBX file, which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"BLENDER"sv, unknown, "BLEND_FILE", "a Blender scene, which is not read: export its hair as .tfx or .hair from Blender"},
    {"BINARY_HAIR"sv, unknown, "MITSUBA_FILE",
     "hair of the renderer Mitsuba, which is not read: export it as .tfx or .hair from the program that made it"},
    {"\x93NUMPY"sv, unknown, "NUMPY_FILE", "a NumPy array, which is not read: write its strands as .hair or PLY"},
    {"\x89PNG"sv, unknown, "IMAGE_FILE", "a picture (PNG), not a strand file: check what was given"},
    {"\xff\xd8\xff"sv, unknown, "IMAGE_FILE", "a picture (JPEG), not a strand file: check what was given"},
    {"\x76\x2f\x31\x01"sv, unknown, "IMAGE_FILE", "a picture (OpenEXR), not a strand file: check what was given"},
    {"PK\x03\x04"sv, unknown, "ARCHIVE_FILE", "a ZIP archive (or USDZ): unpack it and load the strand file inside"},
    {"\x1f\x8b"sv, unknown, "ARCHIVE_FILE", "compressed with gzip: unpack it first"},
};

// Compared without case, after a byte order mark and white space.
constexpr Signature text_signatures[] = {
    {"version https://git-lfs"sv, unknown, "GIT_LFS_POINTER",
     "a Git LFS pointer, not the file itself: run 'git lfs pull' where it was cloned, or download the file"},
    {"<!doctype"sv, unknown, "HTML_PAGE", "a web page, not the file itself: download it again, through its raw link"},
    {"<html"sv, unknown, "HTML_PAGE", "a web page, not the file itself: download it again, through its raw link"},
    {"<?xml"sv, unknown, "XML_FILE", "an XML document, not a strand file: check what was downloaded"},
    {"<"sv, unknown, "HTML_PAGE", "a web page or XML document, not the file itself: download it again, through its raw link"},
    {"#usda"sv, unknown, "USD_FILE",
     "a USD text layer, which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"; fbx"sv, unknown, "FBX_FILE",
     "an FBX file as text, which is not read: export the curves as .tfx or .hair from the program that made it"},
    {"//maya ascii"sv, unknown, "MAYA_FILE", "a Maya scene as text, which is not read: export its curves as .tfx or .hair from Maya"},
    {"solid "sv, unknown, "STL_FILE", "an STL mesh as text, which holds no strands: give the hair, as .tfx, .hair or PLY"},
};

bool startsWithoutCase(std::string_view text, std::string_view start) noexcept {
  return text.size() >= start.size() && sameWord(text.substr(0, start.size()), start);
}

bool isText(std::string_view head) noexcept {
  for (const char c : head)
    if (static_cast<unsigned char>(c) < 9) return false;
  return true;
}

// Lines that begin like those of Wavefront OBJ.
bool looksLikeObj(std::string_view text) noexcept {
  while (!text.empty()) {
    for (const std::string_view keyword : {"v "sv, "mtllib "sv, "vt "sv, "vn "sv})
      if (text.starts_with(keyword)) return true;
    const bool skippable = text[0] == '#' || text[0] == '\n' || text[0] == '\r' || text.starts_with("o ") ||
                           text.starts_with("g ") || text.starts_with("s ") || text.starts_with("usemtl ");
    if (!skippable) return false;
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return false;
}

// Counts of strands and of points, then a point: USC-HairSalon and CT2Hair have nothing else to be known by.
bool looksLikeStrandData(std::span<const std::byte> head) noexcept {
  Cursor cursor(head);
  const uint32_t strands = cursor.u32(), points = cursor.u32();
  if (cursor.failed() || strands == 0 || strands > limit_strands || points == 0 || points > 65'536) return false;
  for (int axis = 0; axis < 3 && cursor.left() >= 4; ++axis)
    if (!(std::fabs(cursor.f32()) <= 1e6f)) return false;
  return true;
}

// The count of bones after comments: how .tfxmesh files begin.
bool looksLikeTfxmesh(std::span<const std::byte> head) noexcept {
  TextCursor text(head);
  std::string_view word = text.word();
  for (; word.starts_with('#'); word = text.word()) text.skipLine();
  return sameWord(word, "numOfBones"sv);
}

// FLK_NOT_READY: nothing that is known, and nothing was said.
FlkResult sniffKnown(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept {
  format = FLK_FORMAT_UNKNOWN;
  if (head.empty()) return report.fail(unknown, "FILE_EMPTY", "it is empty (0 bytes): write or download it again");

  const std::string_view all(reinterpret_cast<const char*>(head.data()), std::min(head.size(), sniffed_bytes));
  if (all.starts_with("\x00\x00\x80\x40"sv) || all.starts_with("\x00\x00\x40\x40"sv)) return format = FLK_FORMAT_TFX, FLK_SUCCESS;
  if (all.starts_with("HAIR")) return format = FLK_FORMAT_HAIR, FLK_SUCCESS;
  if (all.starts_with("ply\n") || all.starts_with("ply\r")) return format = FLK_FORMAT_PLY, FLK_SUCCESS;
  if (all.starts_with("\x8a" "FLK")) return format = FLK_FORMAT_COOKED, FLK_SUCCESS;
  for (const Signature& signature : binary_signatures)
    if (all.starts_with(signature.start)) return report.fail(signature.result, signature.id, "it is %s", signature.text);

  if (isText(all)) {
    std::string_view text = all;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty() && (text[0] == ' ' || text[0] == '\t' || text[0] == '\r' || text[0] == '\n')) text.remove_prefix(1);
    for (const Signature& signature : text_signatures)
      if (startsWithoutCase(text, signature.start))
        return report.fail(signature.result, signature.id, "it is %s", signature.text);
    if (startsWithoutCase(text, "version "sv)) return format = FLK_FORMAT_TFX_TEXT, FLK_SUCCESS;
    if (looksLikeTfxmesh(head.first(all.size()))) return format = format_tfxmesh, FLK_SUCCESS;
    if (text.starts_with('{')) {
      if (text.find("\"asset\"") != std::string_view::npos || text.find("\"accessors\"") != std::string_view::npos)
        return report.fail(unknown, "GLTF_TEXT",
                           "it is a glTF file, which is not read here: convert its strands to .tfx or .hair first");
      return report.fail(unknown, "JSON_FILE", "it is a JSON document, not a strand file: check what was given");
    }
    if (looksLikeObj(text))
      return report.fail(unknown, "OBJ_FILE", "it is a Wavefront OBJ text file, a mesh or curves, which is not read: give the "
                                              "hair, as .tfx, .hair or PLY from the program that made it");
  }

  Cursor header(head);
  if (header.holds(4, 4)) {
    const float version = header.f32();
    header.u32(), header.u32();
    // Where version 4 and version 3 keep the offset of their positions, which start right behind the header.
    if (header.u32() == 160 || Cursor(head, 144).u32() == 296)
      return report.fail(unknown, "TFX_VERSION_UNKNOWN",
                         "it looks like a .tfx file, but its version (byte 0) is %s where 3 and 4 are read: the file is damaged or "
                         "newer, export it again as TressFX 4",
                         Number(double{version}, 6).text);
  }

  if (looksLikeTfxbone(head) || fitsTfxbone(head)) return format = format_tfxbone, FLK_SUCCESS;
  if (looksLikeStrandData(head)) return format = FLK_FORMAT_STRAND_DATA, FLK_SUCCESS;
  return FLK_NOT_READY;
}

struct FormatName {
  uint32_t format;
  const char* text;
};

constexpr FormatName strand_names[] = {{FLK_FORMAT_TFX, "TressFX hair (.tfx)"},
                                       {FLK_FORMAT_HAIR, "hair of Cem Yuksel's format (.hair)"},
                                       {FLK_FORMAT_TFX_TEXT, "TressFX hair as text (.tfx)"},
                                       {FLK_FORMAT_STRAND_DATA, "strands of USC-HairSalon or CT2Hair"},
                                       {FLK_FORMAT_COOKED, "a cooked file of hair"}, {FLK_FORMAT_PLY, "a PLY file"}};

}  // namespace

FlkResult sniffRig(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept {
  FlkResult result = sniffKnown(head, report, format);
  if (result == FLK_NOT_READY && isText({reinterpret_cast<const char*>(head.data()), std::min(head.size(), sniffed_bytes)}))
    return report.fail(unknown, "FORMAT_UNKNOWN", "it is text, but does not begin with numOfBones (byte 0) as a .tfxmesh file does: "
                                                  "give a .tfxbone or .tfxmesh file of TressFX");
  if (result == FLK_NOT_READY) return format = format_tfxbone, FLK_SUCCESS;
  for (const FormatName& name : strand_names)
    if (result == FLK_SUCCESS && format == name.format)
      return report.fail(unknown, "STRANDS_NOT_RIG", "it is %s, not what hair hangs on: load it with flkAssetLoadFile, and give the .tfxbone "
                                                     "or .tfxmesh file beside it here", name.text);
  return result;
}

FlkResult sniffStrands(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept {
  const FlkResult result = sniffKnown(head, report, format);
  if (result == FLK_SUCCESS && format == format_tfxbone)
    return report.fail(unknown, "RIG_NOT_STRANDS", "it is a .tfxbone file, the skin weights of strands, not the strands: give the .tfx beside it, "
                                                   "and this one to flkRigLoadFile or to forelock inspect (alone, or with --bones)");
  if (result == FLK_SUCCESS && format == format_tfxmesh)
    return report.fail(unknown, "RIG_NOT_STRANDS", "it is a .tfxmesh file, the mesh that hair collides with, not hair: give the .tfx beside it, "
                                                   "and this one to flkRigLoadFile or to forelock inspect");
  if (result != FLK_NOT_READY) return result;

  char hex[4 * 3 + 1] = "";
  constexpr char digits[] = "0123456789abcdef";
  for (std::size_t i = 0; i < 4 && i < head.size(); ++i) {
    const unsigned value = std::to_integer<unsigned>(head[i]);
    hex[i * 3] = digits[value >> 4];
    hex[i * 3 + 1] = digits[value & 15];
    hex[i * 3 + 2] = ' ';
    hex[i * 3 + 3] = '\0';
  }
  return report.fail(unknown, "FORMAT_UNKNOWN",
                     "the bytes at its start (%sat byte 0) belong to no strand format that is read: give a .tfx "
                     "(TressFX 3 or 4: 00 00 40 40, 00 00 80 40; 1 or 2: text that begins with version), a .hair file (48 41 49 52), a PLY "
                     "file of strands, a cooked file (8a 46 4c 4b), with the tools glTF, or the data of USC-HairSalon or CT2Hair",
                     hex);
}

}  // namespace forelock
