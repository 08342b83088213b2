#include "asset/checksum.h"
#include "asset/cooked_format.h"
#include "asset/cooked_layout.h"

#include <cinttypes>
#include <cstdio>
#include <string_view>

namespace forelock {
namespace {

using namespace cooked;

// A finding's sentence without the byte of the source, which means nothing in another file: in two parts.
struct Sentence {
  std::string_view begin, end;
  uint64_t size() const noexcept { return begin.size() + end.size(); }
};

Sentence sentenceOf(const FlkFinding& finding) noexcept {
  const std::string_view text = finding.text;
  if (finding.byte_offset != no_byte)
    for (const char* where : {" at byte %" PRIu64 ")", ", from byte %" PRIu64 ")"}) {
      char named[48];
      std::snprintf(named, sizeof named, where, finding.byte_offset);
      const std::size_t at = text.find(named);
      if (at != std::string_view::npos) return {text.substr(0, at), text.substr(at + std::string_view(named).size() - 1)};
    }
  return {text, {}};
}

constexpr uint64_t finding_record = 64;  // bytes before its code and sentence

uint64_t findingsBytes(const Findings& findings) noexcept {
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < findings.size(); ++i) {
    const FlkFinding finding = findings.get(i);
    bytes += finding_record + std::string_view(finding.code).size() + sentenceOf(finding).size();
  }
  return bytes;
}

void writeFinding(const FlkFinding& finding, ByteSink& sink) noexcept {
  const std::string_view code = finding.code;
  const Sentence sentence = sentenceOf(finding);
  sink.u64(finding.count);
  sink.u32(finding.severity);
  sink.u32(finding.repaired);
  sink.u32(finding.strands_listed);
  for (const uint32_t strand : finding.strands) sink.u32(strand);
  sink.u32(static_cast<uint32_t>(code.size()));
  sink.u32(static_cast<uint32_t>(sentence.size()));
  sink.u32(0);
  for (const std::string_view part : {code, sentence.begin, sentence.end}) sink.text(part);
}

uint64_t layOutAsset(const FlkAsset_T& asset, Table& table) noexcept {
  const FlkStrands& strands = asset.view();
  return layOut(strands.strand_count, strands.vertex_count, strands.root_uvs, strands.inverse_masses, strands.colors, findingsBytes(asset.findings), table);
}

}  // namespace

uint64_t measureCooked(const FlkAsset_T& asset) noexcept {
  Table table;
  return layOutAsset(asset, table);
}

void writeCooked(const FlkAsset_T& asset, ByteSink& sink) {
  const FlkStrands& strands = asset.view();
  const FlkAssetInfo& info = asset.info;
  Table table;
  const uint64_t file_size = layOutAsset(asset, table);
  sink.zeros(header_size);
  for (std::size_t block = 0; block < blocks; ++block) {
    BlockPlace& place = table[block];
    if (place.bytes == 0) continue;
    sink.zeros(place.offset - sink.at());
    const auto floats = [&](const float* values) { sink.words(std::span(values, static_cast<std::size_t>(place.bytes / 4))); };
    switch (block) {
      case first_vertex: sink.words(std::span(strands.first_vertex, std::size_t{strands.strand_count} + 1)); break;
      case positions: floats(strands.positions); break;
      case radii: floats(strands.radii); break;
      case root_uvs: floats(strands.root_uvs); break;
      case inverse_masses: floats(strands.inverse_masses); break;
      case colors: floats(strands.colors); break;
      default:
        for (uint32_t i = 0; i < asset.findings.size(); ++i) writeFinding(asset.findings.get(i), sink);
    }
    place.checksum = Checksum::of(sink.written().subspan(static_cast<std::size_t>(place.offset), static_cast<std::size_t>(place.bytes)));
  }

  const std::span<std::byte> header_bytes = sink.written().first(header_size);
  ByteSink header(header_bytes);
  header.text(magic);
  header.u32(version);
  header.u32(static_cast<uint32_t>(header_size));
  header.u64(file_size);
  header.u32(strands.strand_count);
  header.u32(strands.vertex_count);
  header.u32(info.min_vertices_per_strand);
  header.u32(info.max_vertices_per_strand);
  header.u32(info.source_format);
  header.u32(info.has_radii ? flag_radii_from_source : 0);
  header.u32(asset.findings.size());
  header.u32(info.strands_in_source);
  for (const float value : info.min_bounds) header.f32(value);
  for (const float value : info.max_bounds) header.f32(value);
  for (const float value : {info.min_length, info.mean_length, info.max_length, info.min_radius, info.max_radius}) header.f32(value);
  header.zeros(table_at - reserved_at);
  for (const BlockPlace& place : table)
    for (const uint64_t value : {place.offset, place.bytes, place.checksum}) header.u64(value);
  header.zeros(checksum_at - table_end);
  header.u64(Checksum::of(header_bytes.first(checksum_at)));
}

}  // namespace forelock
