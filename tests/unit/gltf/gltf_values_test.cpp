// Attributes: types, quantisation, sparse accessors, strides. SPDX-License-Identifier: MIT
#include "gltf_kit.h"

#include <limits>

namespace forelock::samples {
namespace {

GltfMaker strip(size_t vertices = 2) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positionsAlongX(vertices));
  return maker;
}

Json& attributesOf(GltfMaker& maker) { return maker.json["meshes"][0]["primitives"][0]["attributes"]; }

TEST(GltfValues, PositionsAreBitExact) {
  GltfMaker maker;
  const std::vector<float> values{-0.0f, 1e-40f, 0.1f, 1e6f, -1e-30f, 3.1415927f};
  maker.primitive(kLineStrip, maker.positions(values));
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(std::memcmp(read.strands.positions.data(), values.data(), 24), 0);
}

// Steps of KHR_mesh_quantization: c / 127, c / 255, c / 32767, c / 65535, and whole numbers where not normalised.
TEST(GltfValues, QuantisedPositions) {
  struct Case {
    int type;
    bool normalized;
    std::vector<float> wanted;
  };
  for (const Case& test : {Case{kByte, true, {-1, 1.0f / 127, 1, -1, 0, 1}}, Case{kByte, false, {-128, 1, 127, -127, 0, 127}},
                           Case{kShort, true, {-1, 1.0f / 32767, 1, -1, 0, 1}}, Case{kShort, false, {-32768, 1, 32767, -32767, 0, 32767}},
                           Case{kUnsignedByte, true, {0, 1.0f / 255, 1, 0, 0, 1}}, Case{kUnsignedByte, false, {0, 1, 255, 0, 0, 255}},
                           Case{kUnsignedShort, true, {0, 1.0f / 65535, 1, 0, 0, 1}}, Case{kUnsignedShort, false, {0, 1, 65535, 0, 0, 65535}}}) {
    GltfMaker maker;
    const int position = test.type == kByte      ? maker.accessor<int8_t>(test.type, "VEC3", 2, {-128, 1, 127, 0, -127, 0, 127, 0}, 4)
                         : test.type == kShort   ? maker.accessor<int16_t>(test.type, "VEC3", 2, {-32768, 1, 32767, 0, -32767, 0, 32767, 0}, 8)
                         : test.type == kUnsignedByte ? maker.accessor<uint8_t>(test.type, "VEC3", 2, {0, 1, 255, 9, 0, 0, 255, 9}, 4)
                                                      : maker.accessor<uint16_t>(test.type, "VEC3", 2, {0, 1, 65535, 9, 0, 0, 65535, 9}, 8);
    maker.json["accessors"][size_t(position)]["normalized"] = test.normalized;
    maker.primitive(kLineStrip, position);
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const GltfStrands read = readMade(maker);
    EXPECT_EQ(read.strands.positions, test.wanted) << test.type << (test.normalized ? " normalised" : "");
    EXPECT_EQ(codesOf(read), "GLTF_POSITIONS_QUANTIZED");
  }
}

TEST(GltfValues, EveryAttributeOfAStrand) {
  GltfMaker maker = strip(3);
  attributesOf(maker)["_WIDTH"] = maker.accessor<float>(kFloat, "SCALAR", 3, {0.5f, 0.25f, 0.125f});
  attributesOf(maker)["COLOR_0"] = maker.accessor<float>(kFloat, "VEC3", 3, {0, 0.25f, 0.5f, 1, 1, 1, 0.5f, 0.5f, 0.5f});
  attributesOf(maker)["TEXCOORD_0"] = maker.accessor<float>(kFloat, "VEC2", 3, {0.25f, 0.75f, 0.25f, 0.75f, 0.25f, 0.75f});
  attributesOf(maker)["_INVERSE_MASS"] = maker.accessor<float>(kFloat, "SCALAR", 3, {0, 0.5f, 1});
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(read.strands.radii, (std::vector<float>{0.25f, 0.125f, 0.0625f}));
  EXPECT_EQ(read.strands.colors, (std::vector<float>{0, 0.25f, 0.5f, 1, 1, 1, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(read.strands.root_uvs, (std::vector<float>{0.25f, 0.75f}));
  EXPECT_EQ(read.strands.inverse_masses, (std::vector<float>{0, 0.5f, 1}));
  EXPECT_EQ(codesOf(read), "");
}

TEST(GltfValues, RadiiAndNormalisedColoursWithAlpha) {
  GltfMaker maker = strip();
  attributesOf(maker)["_RADIUS"] = maker.accessor<float>(kFloat, "SCALAR", 2, {0.5f, 0.25f});
  const int color = maker.accessor<uint8_t>(kUnsignedByte, "VEC4", 2, {255, 0, 51, 255, 0, 255, 0, 128});
  maker.json["accessors"][size_t(color)]["normalized"] = true;
  attributesOf(maker)["COLOR_0"] = color;
  GltfStrands read = readMade(maker);
  EXPECT_EQ(read.strands.radii, (std::vector<float>{0.5f, 0.25f}));
  EXPECT_EQ(read.strands.colors, (std::vector<float>{1, 0, 51.0f / 255, 0, 1, 0}));
  EXPECT_EQ(codesOf(read), "GLTF_ALPHA_IGNORED");
  EXPECT_EQ(findingIn(read, "GLTF_ALPHA_IGNORED")->count, 1u);

  const int wide = maker.accessor<uint16_t>(kUnsignedShort, "VEC3", 2, {65535, 0, 13107, 0, 0, 0, 0, 0}, 8);
  maker.json["accessors"][size_t(wide)]["normalized"] = true;
  attributesOf(maker)["COLOR_0"] = wide;
  read = readMade(maker);
  EXPECT_EQ(read.strands.colors, (std::vector<float>{1, 0, 13107.0f / 65535, 0, 0, 0}));
}

TEST(GltfValues, AttributesThatStrandsDoNotHaveAreNamed) {
  GltfMaker maker = strip();
  attributesOf(maker)["NORMAL"] = 0;
  attributesOf(maker)["_MINE"] = 0;
  attributesOf(maker)["_WIDTH"] = 0;  // three components
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(codesOf(read), "GLTF_ATTRIBUTE_IGNORED");
  EXPECT_NE(read.findings[0].text.find("(NORMAL, _MINE, _WIDTH)"), std::string::npos) << read.findings[0].text;
  EXPECT_TRUE(read.strands.radii.empty());
}

TEST(GltfValues, AttributesOnSomePrimitivesAreFilledWithDefaultsAndNamed) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(2);
  maker.primitive(kLineStrip, positions);
  maker.primitive(kLineStrip, positions);
  maker.primitive(kLineStrip, positions);
  Json& middle = maker.json["meshes"][0]["primitives"][1]["attributes"];
  middle["_WIDTH"] = maker.accessor<float>(kFloat, "SCALAR", 2, {0.5f, std::numeric_limits<float>::quiet_NaN()});
  middle["TEXCOORD_0"] = maker.accessor<float>(kFloat, "VEC2", 2, {0.5f, 0.5f, 0.5f, 0.5f});
  middle["COLOR_0"] = maker.accessor<float>(kFloat, "VEC3", 2, {0, 0, 0, 0, 0, 0});
  middle["_INVERSE_MASS"] = maker.accessor<float>(kFloat, "SCALAR", 2, {0, 0});
  const GltfStrands read = readMade(maker);
  const float usual = 0.5f * 1.0f / 1000;  // three strands, one unit long: the cap of the rule
  EXPECT_EQ(read.strands.radii[0], usual);
  EXPECT_EQ(read.strands.radii[2], 0.25f);
  EXPECT_NE(read.strands.radii[3], read.strands.radii[3]) << "what is in the file is left to the library to judge";
  EXPECT_EQ(read.strands.radii[5], usual);
  EXPECT_EQ(read.strands.root_uvs, (std::vector<float>{0, 0, 0.5f, 0.5f, 0, 0}));
  EXPECT_EQ(read.strands.colors, (std::vector<float>{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(read.strands.inverse_masses, (std::vector<float>{1, 1, 0, 0, 1, 1}));
  EXPECT_EQ(codesOf(read), "GLTF_ATTRIBUTE_PARTIAL");
  EXPECT_EQ(read.findings[0].count, 4u);
}

TEST(GltfValues, RootUvsStrandIdsAndGuides) {
  GltfMaker maker;
  maker.primitiveAlongX(kLines, 4, {0, 1, 2, 3});
  attributesOf(maker)["TEXCOORD_0"] = maker.accessor<float>(kFloat, "VEC2", 4, {0, 0, 0, 0, 0.5f, 0, 1, 1});
  attributesOf(maker)["_STRAND_ID"] = maker.accessor<float>(kFloat, "SCALAR", 4, {7, 8, 9, 9});
  attributesOf(maker)["_GUIDE"] = maker.accessor<uint8_t>(kUnsignedByte, "SCALAR", 4, {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(read.strands.root_uvs, (std::vector<float>{0, 0, 0.5f, 0}));
  EXPECT_EQ(codesOf(read), "GLTF_STRAND_ID_DISAGREES GLTF_ROOT_UV_VARIES GLTF_GUIDES_IGNORED");
  EXPECT_EQ(findingIn(read, "GLTF_ROOT_UV_VARIES")->strands, std::vector<uint32_t>{1});
  EXPECT_EQ(findingIn(read, "GLTF_STRAND_ID_DISAGREES")->strands, std::vector<uint32_t>{0});
  EXPECT_EQ(findingIn(read, "GLTF_GUIDES_IGNORED")->count, 1u);
}

TEST(GltfValues, SparseAccessorsReplaceValues) {
  GltfMaker maker = strip(3);
  maker.accessor<uint8_t>(kUnsignedByte, "SCALAR", 1, {2});
  maker.accessor<float>(kFloat, "VEC3", 1, {9, 8, 7});
  maker.json["accessors"][0]["sparse"] = Json::parse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 2}})");
  EXPECT_EQ(readMade(maker).strands.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 9, 8, 7}));
  maker.json["accessors"][0].erase("bufferView");
  EXPECT_EQ(readMade(maker).strands.positions, (std::vector<float>{0, 0, 0, 0, 0, 0, 9, 8, 7})) << "zeros below";
}

TEST(GltfValues, InterleavedAttributes) {
  GltfMaker maker;
  const int position = maker.accessor<float>(kFloat, "VEC3", 2, {1, 2, 3, 0.5f, 4, 5, 6, 0.25f}, 16);
  maker.json["accessors"].push_back({{"bufferView", 0}, {"byteOffset", 12}, {"componentType", kFloat}, {"count", 2}, {"type", "SCALAR"}});
  maker.primitive(kLineStrip, position)["attributes"]["_RADIUS"] = 1;
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(read.strands.positions, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.strands.radii, (std::vector<float>{0.5f, 0.25f}));
}

TEST(GltfValues, ManyPrimitivesMayShareTheirVertices) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(100'000);
  for (uint16_t i = 0; i < 2'000; ++i) maker.primitive(kLines, positions, maker.indices({i, uint16_t(i + 1), uint16_t(i + 30'000), i}));
  // 2,000 passes over 100,000 vertices would be felt.
  EXPECT_EQ(readMade(maker).strands.strands(), 2'000u);
}

}  // namespace
}  // namespace forelock::samples
