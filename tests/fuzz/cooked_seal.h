// Makes the checksums of a damaged cooked file right again, so that what lies behind them is tested. Written from docs/findings.md and the
// description of XXH64, apart from the library's own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace asset_test {

inline uint64_t littleEndian(const unsigned char* at, int bytes) {
  uint64_t value = 0;
  for (int i = bytes; i-- > 0;) value = value << 8 | at[i];
  return value;
}

inline void putLittleEndian(std::vector<unsigned char>& bytes, size_t at, uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes[at + static_cast<size_t>(i)] = static_cast<unsigned char>(value >> (8 * i));
}

inline uint64_t xxh64(const unsigned char* at, size_t size) {
  const uint64_t prime[6] = {0, 11400714785074694791u, 14029467366897019727u, 1609587929392839161u, 9650029242287828579u, 2870177450012600261u};
  const auto rotate = [](uint64_t value, int bits) { return value << bits | value >> (64 - bits); };
  const auto round = [&](uint64_t lane, uint64_t input) { return rotate(lane + input * prime[2], 31) * prime[1]; };
  const unsigned char* const end = at + size;
  uint64_t hash = prime[5];
  if (size >= 32) {
    uint64_t lanes[4] = {prime[1] + prime[2], prime[2], 0, uint64_t{0} - prime[1]};
    for (; end - at >= 32; at += 32)
      for (int lane = 0; lane < 4; ++lane) lanes[lane] = round(lanes[lane], littleEndian(at + 8 * lane, 8));
    hash = rotate(lanes[0], 1) + rotate(lanes[1], 7) + rotate(lanes[2], 12) + rotate(lanes[3], 18);
    for (const uint64_t lane : lanes) hash = (hash ^ round(0, lane)) * prime[1] + prime[4];
  }
  hash += size;
  for (; end - at >= 8; at += 8) hash = rotate(hash ^ round(0, littleEndian(at, 8)), 27) * prime[1] + prime[4];
  for (; end - at >= 4; at += 4) hash = rotate(hash ^ littleEndian(at, 4) * prime[1], 23) * prime[2] + prime[3];
  for (; at < end; ++at) hash = rotate(hash ^ *at * prime[5], 11) * prime[1];
  hash ^= hash >> 33, hash *= prime[2];
  hash ^= hash >> 29, hash *= prime[3];
  return hash ^ hash >> 32;
}

// Where the header says that a block is, its checksum is set; then that of the header.
inline void sealCooked(std::vector<unsigned char>& bytes) {
  constexpr size_t table = 128, blocks = 7, entry = 24, header_checksum = 312;
  if (bytes.size() < header_checksum + 8) return;
  for (size_t block = 0; block < blocks; ++block) {
    const size_t at = table + block * entry;
    const uint64_t offset = littleEndian(&bytes[at], 8), size = littleEndian(&bytes[at + 8], 8);
    if (size == 0 || offset > bytes.size() || size > bytes.size() - offset) continue;
    putLittleEndian(bytes, at + 16, xxh64(bytes.data() + offset, static_cast<size_t>(size)), 8);
  }
  putLittleEndian(bytes, header_checksum, xxh64(bytes.data(), header_checksum), 8);
}

}  // namespace asset_test
