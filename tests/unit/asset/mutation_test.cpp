// Damages small files in every place: whatever the bytes, the reader either refuses with a sentence that names the file
// or gives an asset that keeps its promises (load() of the kit checks both).
#include "asset_kit.h"

using namespace asset_test;

namespace {

struct Seed {
  const char* name;
  Bytes bytes;
};

std::vector<Seed> seeds() {
  Bytes full_tfx = smallTfx();
  full_tfx.setU32(24, full_tfx.size()).f32s({0.5f, 0.25f, 0.125f});
  full_tfx.setU32(20, full_tfx.size()).zeros(12 * 8);
  full_tfx.setU32(28, full_tfx.size()).zeros(12 * 16);
  Bytes full_tfx3 = smallTfx3();
  full_tfx3.setU32(148, full_tfx3.size()).f32s({0.5f, 0.25f, 0.125f});
  for (const auto& [field, bytes] : {std::pair{156u, 192u}, {160u, 12u}, {164u, 96u}})
    full_tfx3.setU32(field, full_tfx3.size()).zeros(bytes);
  return {{"uv.tfx", smallTfx()},      {"plain.tfx", smallTfx(false)}, {"full.tfx", full_tfx},
          {"uv3.tfx", smallTfx3()},    {"plain3.tfx", smallTfx3(false)}, {"full3.tfx", full_tfx3},
          {"narrow.data", smallStrandData(3)}, {"wide.bin", smallStrandData(7)},
          {"odd.hair", smallHair(7)},  {"plain.hair", smallHair(2)},   {"full.hair", smallHair(63)}};
}

// The library's own PLY file of an asset with every array.
Bytes writtenPly() {
  const auto loaded = load(smallHair(63));
  FlkResult result;
  Bytes file;
  file.bytes = saved(loaded->asset.get(), FLK_FORMAT_PLY, result);
  return file;
}

std::vector<Seed> textSeeds() {
  return {{"text.tfx", Bytes().text(smallTfxText())}, {"text.ply", Bytes().text(smallPlyText())}, {"written.ply", writtenPly()}};
}

// And its cooked file.
Bytes writtenCooked() {
  const auto loaded = load(smallHair(63));
  FlkResult result;
  Bytes file;
  file.bytes = saved(loaded->asset.get(), FLK_FORMAT_COOKED, result);
  return file;
}

std::vector<Seed> allSeeds() {
  std::vector<Seed> all = seeds();
  all.push_back({"written.flk", writtenCooked()});
  for (Seed& seed : textSeeds()) all.push_back(std::move(seed));
  return all;
}

FlkResult loadWith(const Bytes& bytes, CountingAllocator& counter, FlkAsset* asset, Caught* caught = nullptr) {
  const FlkHostAllocator allocator = counter.callbacks();
  FlkAssetOptions options{};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.allocator = &allocator;
  options.name = "a file whose name is too long for the small string optimisation.hair";
  if (caught) {
    options.message = Caught::receive;
    options.message_user = caught;
  }
  return flkAssetLoadMemory(bytes.bytes.data(), bytes.size(), &options, asset);
}

}  // namespace

TEST(Mutation, TruncatedAtEveryLength) {
  for (const Seed& seed : seeds()) {
    ASSERT_EQ(load(seed.bytes, seed.name)->result, FLK_SUCCESS);
    for (size_t length = 0; length < seed.bytes.size(); ++length) {
      const auto loaded = load(seed.bytes.cut(length), seed.name);
      EXPECT_NE(loaded->result, FLK_SUCCESS) << seed.name << " cut at " << length;
    }
  }
}

// Text has no last byte that must be there: cut inside its last number it may still be read.
TEST(Mutation, TextTruncatedAtEveryLength) {
  for (const Seed& seed : textSeeds()) {
    ASSERT_EQ(load(seed.bytes, seed.name)->result, FLK_SUCCESS) << seed.name;
    for (size_t length = 0; length + 6 < seed.bytes.size(); ++length) {
      const auto loaded = load(seed.bytes.cut(length), seed.name);
      EXPECT_NE(loaded->result, FLK_SUCCESS) << seed.name << " cut at " << length;
    }
  }
}

TEST(Mutation, EveryByteReplaced) {
  for (const Seed& seed : allSeeds())
    for (size_t at = 0; at < seed.bytes.size(); ++at) {
      const unsigned char old = seed.bytes.bytes[at];
      for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff, old ^ 0x01, old ^ 0x80, old + 1, old - 1}) {
        Bytes damaged = seed.bytes;
        damaged.bytes[at] = static_cast<unsigned char>(value);
        const auto loaded = load(damaged, seed.name);
        if (loaded->result == FLK_SUCCESS) {
          const char* broken = brokenRoundTrip(loaded->asset.get());
          EXPECT_EQ(broken, nullptr) << seed.name << " byte " << at << " = " << value << ": " << broken;
        }
        if (HasFailure()) return;
      }
    }
}

TEST(Mutation, EveryWordReplaced) {
  for (const Seed& seed : allSeeds())
    for (size_t at = 0; at + 4 <= seed.bytes.size(); at += 2)
      for (const uint32_t value : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x7f800000u, 0x7fc00000u, 0x00000001u,
                                   0x10000001u, 0x40000000u, 0x7f7fffffu}) {
        Bytes damaged = seed.bytes;
        load(damaged.setU32(at, value), seed.name);
        if (HasFailure()) return;
      }
}

TEST(Mutation, EveryAllocationRefused) {
  Bytes defective = smallTfx();
  defective.setU32(160, 0x7fc00000u).zeros(1);  // a dropped strand and findings that need sentences
  std::vector<Seed> all = allSeeds();
  all.push_back({"defective.tfx", defective});
  for (const Seed& seed : all) {
    bool completed = false;
    for (size_t refuse = 0; !completed; ++refuse) {
      ASSERT_LT(refuse, 1000u);
      CountingAllocator counter(refuse);
      Caught caught;
      FlkAsset asset = nullptr;
      const FlkResult result = loadWith(seed.bytes, counter, &asset, &caught);
      completed = !counter.refused;
      if (completed) {
        EXPECT_EQ(result, FLK_SUCCESS);
        EXPECT_EQ(brokenPromise(asset), nullptr);
        EXPECT_GT(refuse, 5u) << "the host's allocator is asked for everything";
      } else {
        EXPECT_EQ(result, FLK_ERROR_OUT_OF_HOST_MEMORY) << seed.name << " allocation " << refuse;
        EXPECT_EQ(asset, nullptr);
        EXPECT_EQ(caught.error(), "OUT_OF_HOST_MEMORY");
      }
      flkAssetDestroy(asset);
      EXPECT_EQ(counter.live, 0u) << seed.name << " allocation " << refuse;
      EXPECT_EQ(counter.live_bytes, 0u);
    }
  }
}

TEST(Mutation, EveryAllocationRefusedInCreate) {
  const uint32_t first_vertex[] = {0, 2, 4};
  const float positions[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}, values[4] = {0.5f, 0.5f, 0.5f, 0.5f};
  FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 2, 4, first_vertex, positions, values, values, values, positions};
  bool completed = false;
  for (size_t refuse = 0; !completed; ++refuse) {
    CountingAllocator counter(refuse);
    const FlkHostAllocator allocator = counter.callbacks();
    FlkAssetOptions options{};
    options.type = FLK_TYPE_ASSET_OPTIONS;
    options.allocator = &allocator;
    FlkAsset asset = nullptr;
    const FlkResult result = flkAssetCreate(&strands, &options, &asset);
    completed = !counter.refused;
    EXPECT_EQ(result, completed ? FLK_SUCCESS : FLK_ERROR_OUT_OF_HOST_MEMORY);
    flkAssetDestroy(asset);
    EXPECT_EQ(counter.live, 0u);
  }
}
