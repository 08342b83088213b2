// Damages small files in every place: whatever the bytes, they are read or refused with a sentence, with little memory and time.
// SPDX-License-Identifier: MIT
#include "counted_memory.h"
#include "gltf_kit.h"
#include "gltf_writer.h"

#include <algorithm>

namespace forelock::samples {
namespace {

struct Seed {
  const char* name;
  std::vector<unsigned char> bytes;
};

OpenedAsset smallAsset() {
  static const uint32_t first[] = {0, 2, 5};
  static const float positions[15] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0}, values[15] = {0.5f, 0.25f, 0.5f, 0.5f, 0.25f, 0, 1, 0.5f};
  return assetOf({FLK_TYPE_STRANDS, nullptr, 2, 5, first, positions, values, values, values, values}, "small");
}

std::vector<Seed> seeds() {
  GltfMaker odd;  // every quirk at once
  odd.primitiveAlongX(kLines, 5, {1, 0, 1, 2, 1, 3, 4, 4});
  odd.primitive(kLineStrip, 0, odd.indices({0, 1, 0xffff, 2, 3}));
  const int small = odd.accessor<int8_t>(kByte, "VEC3", 2, {0, 1, 2, 0, 3, 4, 5, 0}, 4);
  odd.primitive(kLineLoop, small)["attributes"]["_WIDTH"] = odd.accessor<float>(kFloat, "SCALAR", 2, {1, 2});
  odd.accessor<uint8_t>(kUnsignedByte, "SCALAR", 1, {2});
  odd.json["accessors"][0]["sparse"] = Json::parse(R"({"count": 1, "indices": {"bufferView": 5, "componentType": 5121}, "values": {"bufferView": 0}})");
  odd.json["nodes"][0]["scale"] = {2, 2, 2};
  GltfMaker text;
  text.primitive(kLineStrip, text.positions({0, 0, 0, 0, 0, 0}));
  return {{"written", writeGltf(smallAsset(), "", "small").main},
          {"odd", odd.glb()},
          {"text", bytesOf(text.gltf("data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAEAAAAAA"))}};
}

// Reads and checks what holds whatever the bytes. True: it was read.
bool readAnything(const std::vector<unsigned char>& bytes) {
  counted.peak = counted.live;
  const size_t before = counted.live;
  bool was_read = false;
  try {
    const GltfStrands read = readGltf(bytes, "damaged", "");
    was_read = true;
    const EditableStrands& strands = read.strands;
    EXPECT_GE(strands.strands(), 1u);
    EXPECT_TRUE(std::is_sorted(strands.first_vertex.begin(), strands.first_vertex.end()));
    EXPECT_EQ(strands.positions.size(), 3 * size_t(strands.vertices()));
    for (const auto& [values, size] : {std::pair{&strands.radii, size_t(strands.vertices())}, {&strands.inverse_masses, size_t(strands.vertices())},
                                       {&strands.colors, 3 * size_t(strands.vertices())}, {&strands.root_uvs, 2 * size_t(strands.strands())}})
      EXPECT_TRUE(values->empty() || values->size() == size);
    EXPECT_EQ(read.groups.size(), strands.strands());
    for (const uint32_t group : read.groups) EXPECT_LT(group, read.group_names.size());
    for (const AssetFinding& finding : read.findings)
      for (const uint32_t strand : finding.strands) EXPECT_LT(strand, strands.strands()) << finding.code;
  } catch (const GltfError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("damaged: ", 0), 0u) << error.what();
    EXPECT_EQ(error.id.rfind("GLTF_", 0), 0u) << error.id;
  }
  EXPECT_LT(counted.peak - before, size_t{64} << 20);
  return was_read;
}

TEST(GltfMutation, TruncatedAtEveryByte) {
  for (const Seed& seed : seeds()) {
    ASSERT_LE(seed.bytes.size(), 2048u) << seed.name;
    ASSERT_TRUE(readAnything(seed.bytes)) << seed.name;
    for (size_t length = 0; length < seed.bytes.size(); ++length)
      EXPECT_FALSE(readAnything({seed.bytes.begin(), seed.bytes.begin() + std::ptrdiff_t(length)})) << seed.name << " cut at " << length;
  }
}

TEST(GltfMutation, EveryByteReplaced) {
  for (const Seed& seed : seeds())
    for (size_t at = 0; at < seed.bytes.size(); ++at) {
      const unsigned char old = seed.bytes[at];
      for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff, old ^ 0x01, old ^ 0x80, old + 1, old - 1, int('9'), int('-'), int('"'), int('['), int('e')}) {
        std::vector<unsigned char> damaged = seed.bytes;
        damaged[at] = static_cast<unsigned char>(value);
        readAnything(damaged);
        ASSERT_FALSE(HasFailure()) << seed.name << " byte " << at << " = " << value;
      }
    }
}

// Every number of the JSON, by numbers that readers go wrong on.
TEST(GltfMutation, EveryNumberReplaced) {
  for (const Seed& seed : seeds()) {
    const bool glb = seed.bytes[0] == 'g';
    const size_t begin = glb ? 20 : 0, end = glb ? 20 + (seed.bytes[12] | size_t{seed.bytes[13]} << 8) : seed.bytes.size();
    const std::string text(seed.bytes.begin() + std::ptrdiff_t(begin), seed.bytes.begin() + std::ptrdiff_t(end));
    GltfMaker maker;
    maker.bytes.assign(seed.bytes.begin() + std::ptrdiff_t(std::min(end + 8, seed.bytes.size())), seed.bytes.end());
    for (size_t at = 0; at < text.size();) {
      const size_t last = text.find_first_not_of("0123456789.-", at);
      if (last == at) {
        ++at;
        continue;
      }
      for (const char* number : {"0", "1", "-1", "2", "3", "255", "65535", "2147483648", "4294967295", "4294967296", "9007199254740992", "9223372036854775807",
                                 "18446744073709551615", "1e12", "1e300", "null", "[]", "\"\""}) {
        const std::string damaged = text.substr(0, at) + number + text.substr(std::min(last, text.size()));
        readAnything(glb ? maker.glbOf(damaged) : bytesOf(damaged));
        ASSERT_FALSE(HasFailure()) << seed.name << " byte " << at << " = " << number;
      }
      at = std::min(last, text.size());
    }
  }
}

TEST(GltfMutation, EveryLargeAllocationRefused) {
  GltfMaker maker;
  std::vector<uint16_t> zigzag;
  for (uint16_t i = 0; i < 9'998; ++i) zigzag.insert(zigzag.end(), {i, uint16_t(i + 2)});  // no chain of neighbours
  Json& primitive = maker.primitiveAlongX(kLines, 10'000, zigzag);
  primitive["attributes"]["_WIDTH"] = maker.accessor<float>(kFloat, "SCALAR", 10'000, std::vector<float>(10'000, 1));
  const std::vector<unsigned char> file = maker.glb();
  bool completed = false;
  size_t refuse = 0;
  for (; !completed; ++refuse) {
    ASSERT_LT(refuse, 1'000u);
    std::vector<unsigned char> bytes = file;
    counted.refuse = counted.large + refuse;
    FlkResult result = FLK_SUCCESS;
    std::string said;
    try {
      const GltfStrands read = readGltf(std::move(bytes), "small", "");
    } catch (const GltfError& error) {
      result = error.result;
      said = error.id + " " + error.what();
    }
    completed = counted.large <= counted.refuse;
    counted.refuse = SIZE_MAX;
    EXPECT_EQ(result, completed ? FLK_SUCCESS : FLK_ERROR_OUT_OF_HOST_MEMORY) << "allocation " << refuse;
    EXPECT_EQ(said.rfind(completed ? "" : "OUT_OF_HOST_MEMORY small: there is not enough memory", 0), 0u) << said;
  }
  EXPECT_GT(refuse, 10u) << "positions, widths, indices and what chains are made with";
}

}  // namespace
}  // namespace forelock::samples
