#include "asset/findings.h"

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <iterator>

namespace forelock {
namespace {

struct Meaning {
  const char* code;
  uint32_t severity;
  uint32_t repaired;
  const char* what;
  const char* advice;
  const char* noun = nullptr;  // what its numbers count, if always the same
};

constexpr uint32_t info = FLK_SEVERITY_INFO;
constexpr uint32_t warning = FLK_SEVERITY_WARNING;

constexpr Meaning meanings[] = {
    {"STRAND_TOO_SHORT", warning, 1, "strands with fewer than two vertices were dropped",
     "remove them where the file was made"},
    {"POSITION_NOT_FINITE", warning, 1, "strands with a NaN or infinite coordinate were dropped",
     "export them again, the values are lost"},
    {"POSITION_OUT_OF_RANGE", warning, 1, "strands with a coordinate beyond 1e6 were dropped",
     "check the unit and the scale of the export"},
    {"STRAND_ZERO_LENGTH", warning, 1, "strands of zero length were dropped", "remove them where the file was made"},
    {"RADIUS_INVALID", warning, 1, "widths that are negative, NaN, infinite or beyond 1e6 were replaced by the default",
     "correct the width attribute and export again"},
    {"RADIUS_ALL_ZERO", warning, 0, "every width is zero, so nothing would be visible",
     "set a width on the hair or export without the width attribute"},
    {"ROOT_UV_NOT_FINITE", warning, 1, "root UVs that are NaN or infinite were replaced by 0",
     "project the roots onto the scalp again"},
    {"INVERSE_MASS_INVALID", warning, 1, "inverse masses that are negative, NaN or infinite were replaced by 0 (pinned)",
     "export with 0 for pinned and 1 for free vertices"},
    {"COLOR_NOT_FINITE", warning, 1, "colours with a NaN or infinite component were replaced by white",
     "correct the colour attribute and export again"},
    {"COLOR_OUTSIDE_UNIT", warning, 1, "colours outside 0..1 were clamped", "export linear colours between 0 and 1"},
    {"HAIR_POINTS_UNUSED", warning, 0, "points at the end belong to no strand and were left out",
     "check the segment counts of the exporter"},
    {"PLY_VERTICES_UNUSED", warning, 0, "vertices at the end belong to no strand and were left out",
     "check the segment counts of the exporter"},
    {"TFX_TEXT_TRANSFORM_IGNORED", warning, 0, "the header asks for a scale, rotation or shift, which is not applied",
     "transform the hair where it is placed"},
    {"HAIR_FLAGS_RESERVED", warning, 0, "bits of the flag field that have no meaning are set and were ignored",
     "if arrays are missing, export without attributes of your own"},
    {"TFX_OFFSET_UNALIGNED", warning, 0, "blocks do not start at a multiple of 4 bytes",
     "check the first strand: the offset may be damaged"},
    {"TRAILING_BYTES", warning, 0, "bytes follow the last block of the file and were ignored",
     "check that the header counts what the exporter wrote"},
    {"UNIT_SUSPECT", warning, 0, "the size of the coordinates suggests another unit than metres", "scale the asset"},
    {"ROOT_AT_TIP", warning, 0, "the strands seem to run from tip to root", "reverse them"},
    {"STRAND_DUPLICATE", warning, 0, "strands are copies of one before them, vertex for vertex, and are drawn twice",
     "remove the copies; some exporters pad with them"},
    {"WIDTH_SUSPECT", warning, 0, "the widths are out of proportion to the strands", "check their unit"},
    {"ROOT_UV_ALL_ZERO", warning, 0, "every root UV is (0, 0), so that all strands would take their colour from one corner of an image",
     "project the roots onto the scalp, or export without root UVs"},
    {"ROOT_UV_CONSTANT", warning, 0, "all root UVs are the same, so that all strands would take one colour of an image",
     "project the roots onto the scalp again"},
    {"FAR_FROM_ORIGIN", warning, 0, "the hair is far from the origin for its size", "move it to the origin"},
    {"SEGMENT_ZERO_LENGTH", info, 0, "segments have zero length (equal consecutive vertices); they are kept",
     "resample if a solver needs a length for every segment"},
    {"STRAND_MICRO", info, 0, "strands are shorter than 1/10,000 of the median length; they are kept",
     "remove them if they are stray roots"},
    {"ROOT_UV_OUTSIDE_UNIT", info, 0, "root UVs lie outside 0..1", "expected for UDIM or wrapped textures only"},
    {"TFX_RESERVED_SET", info, 0, "reserved header words are not zero and were ignored", "nothing, if the hair looks right"},
    {"TFX_FOLLOW_STRANDS_IGNORED", info, 0, "the file asks for follow strands around each guide, which are not grown",
     "only its guides are loaded; set a greater width, or export with the follow strands in place"},
    {"TFX_VERTEX_UV_IGNORED", info, 0, "the file has UVs per vertex, which are not used", "root UVs are taken per strand"},
    {"TFX_VERTEX_COLOR_IGNORED", info, 0, "the file has colours per vertex, which are not used",
     "colour comes from the material"},
    {"HAIR_TRANSPARENCY_IGNORED", info, 0, "the file has transparency per point, which is not used",
     "opacity comes from the material"},
    {"HAIR_DEFAULT_COLOR_IGNORED", info, 0, "the header names one colour for all of the hair, which is not used",
     "colour comes from the material: set it there"},
    {"STRAND_ROOT_ONLY", info, 1, "entries of one point, which mark roots without hair, were left out", "nothing, data sets of heads have them"},
    {"DATA_VALUES_IGNORED", info, 0, "four values of each point after its position are not used", "nothing, if the hair looks right"},
    {"TFX_TEXT_KEY_UNKNOWN", info, 0, "lines of the header have a key that is not known and were ignored", "nothing, if the hair looks right"},
    {"PLY_ALPHA_IGNORED", info, 0, "the vertices have an alpha, which is not used", "opacity comes from the material"},
    {"STRAND_LONG", info, 0, "strands are more than ten times as long as the median", "look for vertices left at the origin and for strands that were joined"},
    {"WIDTH_GROWS", info, 0, "strands are thicker at the tip than at the root", "if that is not meant, the widths are stored from tip to root"},
    {"INVERSE_MASS_IMPLIED", info, 0, "the file stores no inverse masses: the first two vertices of each strand are pinned, the others free, as TressFX does it",
     "nothing, if the hair is held at its roots"},
    {"BOTH_ENDS_FIXED", info, 0, "strands are pinned at root and tip, as of a ponytail held by a band", "nothing, if both ends are held"},
    {"INVERSE_MASS_ALL_ZERO", info, 0, "every vertex is pinned, so that nothing would move", "export 1 for free vertices if the hair should move"},
    {"ROOT_NOT_PINNED", info, 0, "strands are pinned at neither end, so that they would fall", "export 0 for their roots"},
    {"HAIR_DEFAULT_THICKNESS_ZERO", info, 0, "the header's default thickness is 0; the thickness of each point is used", "nothing, if the hair looks right"},
    {"WIDTH_DEFAULTED", info, 0, "no widths in the source, a default is used", "give radii or set a width on the hair"},
    {"BONE_NAME_EMPTY", warning, 0, "bones have no name, so that no look-up finds them", "name the joints and export again", "bone"},
    {"BONE_NAME_DUPLICATE", warning, 0, "bones have the name of a bone before them", "rename the joints", "bone"},
    {"BONE_NAME_UNTERMINATED", warning, 0, "bone names lack the NUL at their end, without which AMD's loader reads on; they were taken whole",
     "correct the exporter: the length counts the NUL", "bone"},
    {"BONE_NAME_CUT", warning, 1, "bone names have a NUL before their end; what follows it was left out", "export again", "bone"},
    {"BONE_NAME_LONG", warning, 0, "bone names are longer than the 127 bytes that AMD's loader has room for; they were kept",
     "shorten them if the file is for TressFX itself", "bone"},
    {"RIG_INDEX_UNEXPECTED", warning, 0, "entries of the file are not numbered 0, 1, 2 in order; their order in the file counts",
     "check that they were not sorted or cut by hand"},
    {"BONE_OUT_OF_RANGE", warning, 1, "weights of bones that the file does not have were taken as 0", "export again with all bones that the skin uses"},
    {"WEIGHT_INVALID", warning, 1, "weights that are negative, NaN or infinite were taken as 0", "correct the skin weights and export again"},
    {"WEIGHTS_ALL_ZERO", warning, 0, "entries have no weight above 0 and hang on nothing", "bind them to a bone and export again"},
    {"WEIGHTS_NOT_NORMALISED", warning, 1, "weights do not make 1 and were scaled", "export with normalised weights"},
    {"SKIN_STRANDS_SURPLUS", warning, 1, "records are of strands that the hair does not have", "export both files together"},
    {"SKIN_STRANDS_MISSING", warning, 0, "strands of the hair have no record", "export both files together"},
    {"SKIN_STRANDS_DROPPED", info, 1, "records of strands that the hair dropped while it was loaded were left out", "nothing, see the findings of the hair"},
    {"MESH_POSITION_INVALID", warning, 1, "vertices with a coordinate that is NaN, infinite or beyond 1e6 lost their triangles and lie at the origin",
     "export them again"},
    {"MESH_NORMAL_INVALID", warning, 1, "normals that are NaN, infinite or 0 were taken as none (0, 0, 0)", "recompute the normals and export again"},
    {"TRIANGLE_OUT_OF_RANGE", warning, 1, "triangles with a vertex that does not exist were dropped", "export the mesh again", "triangle"},
    {"TRIANGLE_DEGENERATE", warning, 1, "triangles that name a vertex twice were dropped", "clean the mesh and export it again", "triangle"},
    {"BONE_PLACEHOLDER", info, 1, "bones of -1 without weight, an exporter's word for none, became bone 0 without weight", "nothing"},
    {"SKIN_RECORDS_UNALIGNED", info, 0, "records do not start at a multiple of 4 bytes", "nothing: names are not padded in this format"},
};
static_assert(std::size(meanings) == static_cast<std::size_t>(FindingKind::kinds));

}  // namespace

void Findings::note(FindingKind kind, uint32_t strand, uint64_t byte, uint64_t times) noexcept {
  Slot& slot = slots_[static_cast<std::size_t>(kind)];
  if (slot.count == 0) slot.byte = byte;
  slot.count += times;
  if (strand == no_strand || slot.strands_listed == std::size(slot.strands)) return;
  if (slot.strands_listed != 0 && slot.strands[slot.strands_listed - 1] == strand) return;
  slot.strands[slot.strands_listed++] = strand;
}

void Findings::describe(FindingKind kind, const char* format, ...) noexcept {
  for (Description& description : descriptions_) {
    if (description.kind != FindingKind::kinds && description.kind != kind) continue;
    description.kind = kind;
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(description.text, sizeof description.text, format, arguments);
    va_end(arguments);
    return;
  }
}

void Findings::finish() {
  for (std::size_t kind = 0; kind < slots_.size(); ++kind) {
    const Slot& slot = slots_[kind];
    if (slot.count == 0) continue;
    const Meaning& meaning = meanings[kind];

    const char* noun = meaning.noun ? meaning.noun : noun_;
    char where[96] = "";
    if (slot.strands_listed != 0 && slot.byte != no_byte)
      std::snprintf(where, sizeof where, ", the first in %s %" PRIu32 " at byte %" PRIu64, noun, slot.strands[0], slot.byte);
    else if (slot.strands_listed != 0)
      std::snprintf(where, sizeof where, ", the first in %s %" PRIu32, noun, slot.strands[0]);
    else if (slot.byte != no_byte)
      std::snprintf(where, sizeof where, ", from byte %" PRIu64, slot.byte);

    char text[640];
    std::snprintf(text, sizeof text, "%s (%" PRIu64 "%s); %s", meaning.what, slot.count, where, meaning.advice);
    for (const Description& description : descriptions_)
      if (description.kind == static_cast<FindingKind>(kind)) std::snprintf(text, sizeof text, "%s", description.text);

    FlkFinding finding{};
    finding.code = meaning.code;
    finding.severity = meaning.severity;
    finding.repaired = meaning.repaired;
    finding.count = slot.count;
    std::memcpy(finding.strands, slot.strands, sizeof finding.strands);
    finding.strands_listed = slot.strands_listed;
    finding.byte_offset = slot.byte;
    std::pmr::memory_resource* memory = list_.get_allocator().resource();
    list_.push_back({finding, std::pmr::string(text, memory), std::pmr::string(memory)});
  }
}

void Findings::restore(const FlkFinding& finding, std::string_view code, std::string_view text) {
  std::pmr::memory_resource* memory = list_.get_allocator().resource();
  list_.push_back({finding, std::pmr::string(text, memory), std::pmr::string(memory)});
  list_.back().finding.code = nullptr;
  for (const Meaning& meaning : meanings)
    if (meaning.code == code) list_.back().finding.code = meaning.code;
  if (!list_.back().finding.code) list_.back().code.assign(code);  // of a later version
}

void Findings::tell(const Report& report) const noexcept {
  for (const Entry& entry : list_)
    if (entry.finding.severity >= FLK_SEVERITY_WARNING)
      report.say(entry.finding.severity, entry.finding.code ? entry.finding.code : entry.code.c_str(), "%s", entry.text.c_str());
}

FlkFinding Findings::get(uint32_t index) const noexcept {
  FlkFinding finding = list_[index].finding;
  finding.text = list_[index].text.c_str();
  if (!finding.code) finding.code = list_[index].code.c_str();
  return finding;
}

uint64_t Findings::bytes() const noexcept {
  uint64_t bytes = list_.capacity() * sizeof(Entry);
  for (const Entry& entry : list_) bytes += entry.text.capacity() + 1 + (entry.finding.code ? 0 : entry.code.capacity() + 1);
  return bytes;
}

}  // namespace forelock
