// What the tests of this room share: bytes written by hand, messages caught, an allocator that counts and refuses.
#pragma once

#include "../../fuzz/asset_invariants.h"
#include "../../fuzz/text_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace asset_test {

class Bytes {
public:
  Bytes& u16(unsigned value) { return raw(value, 2); }
  Bytes& u32(uint64_t value) { return raw(value, 4); }
  Bytes& f32(float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, 4);
    return u32(bits);
  }
  Bytes& f32s(std::initializer_list<float> values) {
    for (const float value : values) f32(value);
    return *this;
  }
  Bytes& text(const std::string& value) {
    for (const char c : value) bytes.push_back(static_cast<unsigned char>(c));
    return *this;
  }
  Bytes& zeros(size_t count) {
    bytes.resize(bytes.size() + count);
    return *this;
  }
  Bytes& setU32(size_t at, uint64_t value) {
    for (size_t i = 0; i < 4; ++i) bytes.at(at + i) = static_cast<unsigned char>(value >> (8 * i));
    return *this;
  }
  Bytes& setF32(size_t at, float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, 4);
    return setU32(at, bits);
  }
  Bytes cut(size_t length) const {
    Bytes shorter;
    shorter.bytes.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    return shorter;
  }
  size_t size() const { return bytes.size(); }

  std::vector<unsigned char> bytes;

private:
  Bytes& raw(uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
    return *this;
  }
};

struct Caught {
  struct Message {
    uint32_t severity;
    std::string id, text;
  };
  std::vector<Message> all;

  static void receive(void* user, const FlkMessage* message) {
    static_cast<Caught*>(user)->all.push_back({message->severity, message->id, message->text});
  }
  const Message* find(const std::string& id) const {
    for (const Message& message : all)
      if (message.id == id) return &message;
    return nullptr;
  }
  std::string error() const {
    for (const Message& message : all)
      if (message.severity == FLK_SEVERITY_ERROR) return message.id;
    return "";
  }
  std::string text() const {
    std::string joined;
    for (const Message& message : all) joined += message.id + ": " + message.text + "\n";
    return joined;
  }
};

// Refuses the allocation number `refuse` (from 0) and every later one; checks that sizes given back are those taken.
class CountingAllocator {
public:
  explicit CountingAllocator(size_t refuse_from = SIZE_MAX) : refuse(refuse_from) {}
  FlkHostAllocator callbacks() { return {this, allocate, release}; }

  size_t refuse;
  size_t asked = 0, live = 0, live_bytes = 0, largest = 0;
  bool refused = false;

private:
  static void* allocate(void* user, size_t size, size_t alignment) {
    auto& self = *static_cast<CountingAllocator*>(user);
    if (self.asked++ >= self.refuse) {
      self.refused = true;
      return nullptr;
    }
    EXPECT_LE(alignment, alignof(std::max_align_t));
    ++self.live;
    self.live_bytes += size;
    self.largest = size > self.largest ? size : self.largest;
    return std::malloc(size ? size : 1);
  }
  static void release(void* user, void* memory, size_t size, size_t) {
    auto& self = *static_cast<CountingAllocator*>(user);
    --self.live;
    self.live_bytes -= size;
    std::free(memory);
  }
};

struct Destroy {
  void operator()(FlkAsset asset) const { flkAssetDestroy(asset); }
};
using Owned = std::unique_ptr<FlkAsset_T, Destroy>;

inline FlkAssetOptions optionsFor(Caught& caught, const char* name) {
  FlkAssetOptions options{};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.message = Caught::receive;
  options.message_user = &caught;
  options.name = name;
  return options;
}

struct Loaded {
  FlkResult result = FLK_NOT_READY;
  Caught caught;
  Owned asset;

  const FlkAssetInfo info() const {
    FlkAssetInfo info{};
    flkAssetGetInfo(asset.get(), &info);
    return info;
  }
  FlkStrands strands() const {
    FlkStrands strands{};
    flkAssetGetStrands(asset.get(), &strands);
    return strands;
  }
  // count 0: there is no such finding.
  FlkFinding finding(const std::string& code) const {
    FlkFinding finding{};
    for (uint32_t i = 0; asset && i < info().finding_count; ++i)
      if (flkAssetGetFinding(asset.get(), i, &finding) == FLK_SUCCESS && finding.code == code) return finding;
    return FlkFinding{};
  }
  std::string codes() const {
    std::string joined;
    FlkFinding finding{};
    for (uint32_t i = 0; asset && i < info().finding_count; ++i)
      if (flkAssetGetFinding(asset.get(), i, &finding) == FLK_SUCCESS) joined += std::string(i ? " " : "") + finding.code;
    return joined;
  }
};

// Loads and checks what holds whatever comes of it. Messages go to the heap: `caught` must not move while the asset lives.
inline std::unique_ptr<Loaded> load(const Bytes& bytes, const char* name = "seed", uint32_t max_strands = 0,
                                    uint32_t max_vertices = 0) {
  auto loaded = std::make_unique<Loaded>();
  FlkAssetOptions options = optionsFor(loaded->caught, name);
  options.max_strands = max_strands;
  options.max_vertices = max_vertices;
  // An exact copy on the heap, so that a sanitizer sees a read one byte past the end.
  std::unique_ptr<unsigned char[]> exact(new unsigned char[bytes.size() ? bytes.size() : 1]);
  if (bytes.size()) std::memcpy(exact.get(), bytes.bytes.data(), bytes.size());
  FlkAsset asset = reinterpret_cast<FlkAsset>(&options);
  loaded->result = flkAssetLoadMemory(exact.get(), bytes.size(), &options, &asset);
  loaded->asset.reset(asset);
  if (loaded->result == FLK_SUCCESS) {
    EXPECT_NE(asset, nullptr);
    if (const char* broken = brokenPromise(asset)) ADD_FAILURE() << "broken promise: " << broken;
  } else {
    EXPECT_EQ(asset, nullptr);
    EXPECT_LT(loaded->result, 0);
    const std::string error = loaded->caught.error();
    EXPECT_FALSE(error.empty());
    for (const Caught::Message& message : loaded->caught.all) {
      EXPECT_EQ(message.text.rfind(std::string(name) + ": ", 0), 0u) << message.text;
      EXPECT_TRUE(isSentence(message.text.c_str())) << message.text;
    }
  }
  return loaded;
}

// Refused with this result and message id, in a sentence that says `says`.
inline void expectRefused(const Bytes& file, const char* name, FlkResult result, const char* id, const std::string& says) {
  const auto loaded = load(file, name);
  EXPECT_EQ(loaded->result, result) << flkResultName(loaded->result) << "\n" << loaded->caught.text();
  EXPECT_EQ(loaded->caught.error(), id) << loaded->caught.text();
  EXPECT_NE(loaded->caught.text().find(says), std::string::npos) << loaded->caught.text();
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

// Three strands of four vertices, with UVs unless asked otherwise: 160 + 192 + 24 bytes.
inline Bytes smallTfx(bool with_uvs = true) {
  Bytes file;
  file.f32(4).u32(3).u32(4).u32(160).u32(with_uvs ? 160 + 192 : 0).zeros(12 + 128);
  for (int strand = 0; strand < 3; ++strand)
    for (int vertex = 0; vertex < 4; ++vertex)
      file.f32s({0.25f * static_cast<float>(strand), 0.125f * static_cast<float>(vertex),
                 0.0625f * static_cast<float>(strand * vertex), vertex < 2 ? 0.0f : 1.0f});
  for (int strand = 0; strand < 3 && with_uvs; ++strand) file.f32s({0.25f * static_cast<float>(strand), 0.5f});
  return file;
}

// The same strands as TressFX 3 lays them out: 296 + 144 + 24 bytes.
inline Bytes smallTfx3(bool with_uvs = true) {
  Bytes file;
  file.f32(3).u32(3).u32(4).zeros(132).u32(296).u32(0).u32(with_uvs ? 296 + 144 : 0).zeros(12 + 128);
  for (int strand = 0; strand < 3; ++strand)
    for (int vertex = 0; vertex < 4; ++vertex)
      file.f32s({0.25f * static_cast<float>(strand), 0.125f * static_cast<float>(vertex),
                 0.0625f * static_cast<float>(strand * vertex)});
  for (int strand = 0; strand < 3 && with_uvs; ++strand) file.f32s({0.25f * static_cast<float>(strand), 0.5f});
  return file;
}

// Three strands of 2, 4 and 3 points with the arrays of `flags`; the default thickness is the greatest of the array.
inline Bytes smallHair(unsigned flags = 7) {
  Bytes file;
  file.text("HAIR").u32(3).u32(9).u32(flags).u32(2).f32s({flags & 4 ? 0.009f : 0, 0, 1, 1, 1}).text("by hand").zeros(81);
  if (flags & 1) file.u16(1).u16(3).u16(2);
  if (flags & 2)
    for (int point = 0; point < 9; ++point)
      file.f32s({0.125f * static_cast<float>(point), 0.25f, 0.0625f * static_cast<float>(point * point)});
  if (flags & 4)
    for (int point = 0; point < 9; ++point) file.f32(0.001f * static_cast<float>(point + 1));
  if (flags & 8) file.zeros(9 * 4);
  if (flags & 16)
    for (int point = 0; point < 9; ++point) file.f32s({0.125f * static_cast<float>(point), 0.25f, 1});
  if (flags & 32)
    for (int point = 0; point < 9; ++point) file.f32s({0.0625f * static_cast<float>(point), 0.75f});
  return file;
}

// Three strands of 2, 1 and 3 points, `floats` a point.
inline Bytes smallStrandData(int floats = 3) {
  Bytes file;
  file.u32(3);
  float at = 0;
  for (const unsigned points : {2u, 1u, 3u}) {
    file.u32(points);
    for (unsigned point = 0; point < points; ++point)
      for (int i = 0; i < floats; ++i) file.f32(at += 0.125f);
  }
  return file;
}

}  // namespace asset_test
