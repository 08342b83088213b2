// The catalogue of malformed files: each is refused with the name of the field. SPDX-License-Identifier: MIT
#include "gltf_kit.h"

#include <functional>

namespace forelock::samples {
namespace {

// A strand of four vertices with widths, as LINES.
GltfMaker whole() {
  GltfMaker maker;
  Json& primitive = maker.primitiveAlongX(kLines, 4, {0, 1, 1, 2, 2, 3});
  primitive["attributes"]["_WIDTH"] = maker.accessor<float>(kFloat, "SCALAR", 4, {1, 1, 1, 1});
  maker.json["buffers"] = Json::array({Json{{"byteLength", maker.bytes.size()}}});
  return maker;
}

// The refusal is `id`, and its sentence holds `part`.
void expectRefusal(const std::string& refusal, const std::string& id, const std::string& part) {
  EXPECT_EQ(refusal.rfind(id + ": ", 0), 0u) << "wanted " << id << ", got " << (refusal.empty() ? "a strand" : refusal);
  EXPECT_NE(refusal.find(part), std::string::npos) << "wanted " << part << " in " << refusal;
}

struct Damage {
  const char* pointer;  // RFC 6901
  const char* value;    // JSON; "": removed
  const char* id;
  const char* part;
};

constexpr Damage damages[] = {
    // Counts and lengths.
    {"/accessors/0/count", "4611686018427387904", "GLTF_FIELD", "accessors[0].count is 4611686018427387904"},
    {"/accessors/0/count", "-5", "GLTF_FIELD", "accessors[0].count is -5"},
    {"/accessors/0/count", "0", "GLTF_FIELD", "accessors[0].count is 0"},
    {"/accessors/0/count", "1.5", "GLTF_FIELD", "accessors[0].count is 1.5"},
    {"/accessors/0/count", "\"4\"", "GLTF_FIELD", "accessors[0].count is \"4\""},
    {"/accessors/0/count", "", "GLTF_FIELD", "accessors[0].count is missing"},
    {"/accessors/0/count", "5", "GLTF_ACCESSOR_PAST_END", "accessors[0] (POSITION of meshes[0].primitives[0])"},
    {"/accessors/0/count", "3", "GLTF_COUNTS_DISAGREE", "meshes[0].primitives[0] has 3 positions, but an attribute of 4"},
    {"/accessors/0/count", "9007199254740992", "GLTF_ACCESSOR_PAST_END", "accessors[0]"},
    {"/accessors/0/count", "768614336404564651", "GLTF_FIELD", "accessors[0].count"},  // x 24 is 8 modulo 2^64
    {"/accessors/1/count", "7", "GLTF_ACCESSOR_PAST_END", "accessors[1] (indices of meshes[0].primitives[0])"},
    {"/accessors/2/count", "3", "GLTF_COUNTS_DISAGREE", "4 positions, but an attribute of 3"},
    {"/buffers/0/byteLength", "1e12", "GLTF_BUFFER_SHORT", "buffers[0].byteLength is 1000000000000"},
    {"/buffers/0/byteLength", "-1", "GLTF_FIELD", "buffers[0].byteLength is -1"},
    {"/buffers/0/byteLength", "8", "GLTF_VIEW_PAST_END", "bufferViews[0]"},
    {"/bufferViews/0/byteLength", "1000", "GLTF_VIEW_PAST_END", "bufferViews[0] asks for 1000 bytes"},
    {"/bufferViews/0/byteLength", "47", "GLTF_ACCESSOR_PAST_END", "bufferViews[0] has 47 bytes"},
    {"/bufferViews/0/byteLength", "0", "GLTF_FIELD", "bufferViews[0].byteLength is 0"},
    // Offsets and strides.
    {"/bufferViews/0/byteOffset", "9223372036854775808", "GLTF_FIELD", "bufferViews[0].byteOffset is 9223372036854775808"},
    {"/bufferViews/0/byteOffset", "9007199254740991", "GLTF_VIEW_PAST_END", "byteOffset 9007199254740991"},
    {"/bufferViews/0/byteOffset", "-4", "GLTF_FIELD", "bufferViews[0].byteOffset is -4"},
    {"/accessors/0/byteOffset", "9223372036854775808", "GLTF_FIELD", "accessors[0].byteOffset"},
    {"/accessors/0/byteOffset", "-4", "GLTF_FIELD", "accessors[0].byteOffset is -4"},
    {"/accessors/0/byteOffset", "40", "GLTF_ACCESSOR_PAST_END", "from byteOffset 40"},
    {"/bufferViews/0/byteStride", "-4", "GLTF_FIELD", "bufferViews[0].byteStride is -4"},
    {"/bufferViews/0/byteStride", "8", "GLTF_FIELD", "bufferViews[0].byteStride is 8"},
    {"/bufferViews/0/byteStride", "13", "GLTF_FIELD", "bufferViews[0].byteStride is 13"},
    {"/bufferViews/0/byteStride", "256", "GLTF_FIELD", "bufferViews[0].byteStride is 256"},
    {"/bufferViews/0/byteStride", "16", "GLTF_ACCESSOR_PAST_END", "16 apart"},
    // Types.
    {"/accessors/0/componentType", "5130", "GLTF_FIELD", "accessors[0].componentType is 5130"},
    {"/accessors/0/componentType", "5124", "GLTF_FIELD", "componentType is 5124"},
    {"/accessors/0/componentType", "4294972422", "GLTF_FIELD", "accessors[0].componentType is 4294972422"},  // 5126 + 2^32
    {"/accessors/0/type", "\"VEC5\"", "GLTF_FIELD", "accessors[0].type is \"VEC5\""},
    {"/accessors/0/type", "\"MAT4\"", "GLTF_FIELD", ".type is a matrix"},
    {"/accessors/0/type", "\"VEC2\"", "GLTF_FIELD", "attributes.POSITION is no VEC3"},
    {"/accessors/0/bufferView", "", "GLTF_FIELD", ".bufferView is missing"},
    {"/accessors/1/componentType", "5126", "GLTF_ACCESSOR_PAST_END", "accessors[1]"},
    {"/accessors/1/componentType", "5122", "GLTF_FIELD", "accessors[1] (indices of meshes[0].primitives[0]) is not of an unsigned integer type"},
    {"/accessors/0/normalized", "1", "GLTF_FIELD", "accessors[0].normalized is 1"},
    {"/meshes/0/primitives/0/mode", "7", "GLTF_FIELD", "meshes[0].primitives[0].mode is 7"},
    {"/meshes/0/primitives/0/mode", "-1", "GLTF_FIELD", "meshes[0].primitives[0].mode is -1"},
    {"/meshes/0/primitives/0/attributes", "", "GLTF_FIELD", "meshes[0].primitives[0].attributes is missing"},
    {"/meshes/0/primitives/0/attributes", "[]", "GLTF_FIELD", "meshes[0].primitives[0].attributes is an array"},
    {"/meshes/0/primitives/0/attributes/POSITION", "", "GLTF_FIELD", "attributes.POSITION is missing"},
    {"/meshes/0/primitives", "{}", "GLTF_FIELD", "meshes[0].primitives is an object"},
    {"/meshes/0/primitives/0", "5", "GLTF_FIELD", "meshes[0].primitives[0] is 5"},
    {"/meshes/0", "null", "GLTF_FIELD", "meshes[0] is null"},
    {"/accessors", "5", "GLTF_FIELD", "accessors is 5"},
    // References of every kind.
    {"/meshes/0/primitives/0/attributes/POSITION", "99", "GLTF_REFERENCE", "meshes[0].primitives[0].attributes.POSITION is 99, but there are 3 accessors"},
    {"/meshes/0/primitives/0/attributes/POSITION", "-1", "GLTF_FIELD", "attributes.POSITION is -1"},
    {"/meshes/0/primitives/0/attributes/POSITION", "4294967296", "GLTF_REFERENCE", "4294967296"},
    {"/meshes/0/primitives/0/indices", "99", "GLTF_REFERENCE", "meshes[0].primitives[0].indices is 99"},
    {"/accessors/0/bufferView", "99", "GLTF_REFERENCE", "accessors[0].bufferView is 99, but there are 3 bufferViews"},
    {"/bufferViews/0/buffer", "1", "GLTF_REFERENCE", "bufferViews[0].buffer is 1, but there are 1 buffers"},
    {"/bufferViews/0/buffer", "", "GLTF_FIELD", "bufferViews[0].buffer is missing"},
    {"/nodes/0/mesh", "1", "GLTF_REFERENCE", "nodes[0].mesh is 1"},
    {"/nodes/0/children", "[7]", "GLTF_REFERENCE", "nodes[0].children[0] is 7"},
    {"/nodes/0/children", "7", "GLTF_FIELD", "nodes[0].children is 7"},
    {"/nodes/0/children", "[0]", "GLTF_NODE_CYCLE", "nodes[0] is reached twice"},
    {"/scenes/0/nodes", "[0, 0]", "GLTF_NODE_CYCLE", "nodes[0] is reached twice"},
    {"/scenes/0/nodes", "[3]", "GLTF_REFERENCE", "scenes[0].nodes[0] is 3"},
    {"/scene", "1", "GLTF_REFERENCE", "the file.scene is 1"},
    {"/nodes/0/matrix", "[1, 2]", "GLTF_FIELD", "nodes[0].matrix is an array"},
    {"/nodes/0/scale", "[1, 2, \"x\"]", "GLTF_FIELD", "nodes[0].scale"},
    // Sparse accessors.
    {"/accessors/0/sparse", "5", "GLTF_FIELD", "accessors[0].sparse is 5"},
    {"/accessors/0/sparse", R"({"count": 1, "values": {"bufferView": 0}})", "GLTF_FIELD", "accessors[0].sparse.indices is missing"},
    {"/accessors/0/sparse", R"({"count": 1, "indices": {"bufferView": 9, "componentType": 5123}, "values": {"bufferView": 0}})", "GLTF_REFERENCE",
     "accessors[0].sparse.indices.bufferView is 9"},
    {"/accessors/0/sparse", R"({"count": 5, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})", "GLTF_FIELD", "sparse.count is 5"},
    {"/accessors/0/sparse", R"({"count": 4294967297, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})", "GLTF_FIELD",
     "accessors[0].sparse.count is 4294967297"},
    {"/accessors/0/sparse", R"({"count": 1, "indices": {"bufferView": 0, "byteOffset": 14, "componentType": 5121}, "values": {"bufferView": 0}})", "GLTF_INDEX_STRAY",
     "sparse.indices holds 128"},
    {"/accessors/0/sparse", R"({"count": 4, "indices": {"bufferView": 1, "byteOffset": 8, "componentType": 5123}, "values": {"bufferView": 0}})", "GLTF_ACCESSOR_PAST_END",
     "sparse.indices"},
    {"/accessors/0/sparse", R"({"count": 4, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}})", "GLTF_ACCESSOR_PAST_END", "sparse.values"},
    {"/accessors/0/sparse", R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5126}, "values": {"bufferView": 0}})", "GLTF_FIELD", "sparse.indices.componentType is 5126"},
    // The document.
    {"/asset", "", "GLTF_FIELD", "asset is missing"},
    {"/asset/version", "\"1.0\"", "GLTF_VERSION", "asset.version is 1.0"},
    {"/asset/version", "2.0", "GLTF_FIELD", "asset.version is 2.0"},
    {"/extensionsRequired", R"(["ACME_hair"])", "GLTF_EXTENSION_REQUIRED", "extensionsRequired names ACME_hair"},
    {"/extensionsRequired", R"(["KHR_draco_mesh_compression"])", "GLTF_COMPRESSED", "KHR_draco_mesh_compression"},
    {"/extensionsRequired", R"(["EXT_meshopt_compression"])", "GLTF_COMPRESSED", "EXT_meshopt_compression"},
    {"/extensionsRequired", "[5]", "GLTF_FIELD", "extensionsRequired"},
    {"/buffers/0/uri", "5", "GLTF_FIELD", "buffers[0].uri is 5"},
    {"/buffers/0/uri", "\"\"", "GLTF_FIELD", "buffers[0].uri is \"\""},
};

TEST(GltfMalformed, EachFieldIsNamed) {
  ASSERT_EQ(refusalOf(whole().glb()), "");
  for (const Damage& damage : damages) {
    GltfMaker maker = whole();
    const Json::json_pointer pointer(damage.pointer);
    if (*damage.value) {
      maker.json[pointer] = Json::parse(damage.value);
    } else {
      maker.json[pointer.parent_pointer()].erase(pointer.back());
    }
    SCOPED_TRACE(std::string(damage.pointer) + " = " + damage.value);
    expectRefusal(refusalOf(maker.glb()), damage.id, damage.part);
  }
}

TEST(GltfMalformed, SparseOverNothingIsBoundByTheFile) {
  GltfMaker maker = whole();
  maker.json["accessors"][0].erase("bufferView");
  maker.json["accessors"][0]["count"] = 200'000'000;
  maker.json["accessors"][0]["sparse"] = Json::parse(R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})");
  expectRefusal(refusalOf(maker.glb()), "GLTF_FIELD", "accessors[0] (POSITION of meshes[0].primitives[0]).count is 200000000");
}

TEST(GltfMalformed, CyclesOfNodes) {
  GltfMaker maker = whole();
  maker.json["nodes"] = Json::parse(R"([{"children": [1]}, {"children": [2]}, {"mesh": 0, "children": [1]}])");
  expectRefusal(refusalOf(maker.glb()), "GLTF_NODE_CYCLE", "nodes[1] is reached twice");
  maker.json["nodes"] = Json::parse(R"([{"mesh": 0, "children": [1]}, {"children": [0]}])");
  maker.json.erase("scenes"), maker.json.erase("scene");
  expectRefusal(refusalOf(maker.glb()), "GLTF_NODE_CYCLE", "every node is a child");
}

TEST(GltfMalformed, AChainOfManyNodesIsNoDepthOfCalls) {
  GltfMaker maker = whole();
  Json nodes = Json::array();
  for (int i = 0; i < 100'000; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  maker.json["nodes"] = nodes;
  EXPECT_EQ(refusalOf(maker.glb()), "");
}

TEST(GltfMalformed, BufferWithoutBytes) {
  GltfMaker maker = whole();
  const std::string text = maker.json.dump();
  expectRefusal(refusalOf(bytesOf(text)), "GLTF_FIELD", "buffers[0].uri is missing, and there is no BIN chunk");
  maker.json["buffers"].push_back({{"byteLength", 4}});
  expectRefusal(refusalOf(maker.glb()), "GLTF_FIELD", "buffers[1].uri is missing");
  maker.json["extensionsUsed"] = {"EXT_meshopt_compression"};
  expectRefusal(refusalOf(maker.glb()), "GLTF_COMPRESSED", "buffers[1] is left out in favour of EXT_meshopt_compression");
}

TEST(GltfMalformed, LimitsOnStrandsAndVertices) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(10);
  maker.primitive(kLineStrip, positions);
  maker.primitive(kLineStrip, positions);
  const auto refusal = [&](GltfLimits limits) {
    try {
      readGltf(maker.glb(), "made.glb", "", limits);
    } catch (const GltfError& error) {
      EXPECT_EQ(error.result, FLK_ERROR_LIMIT);
      return error.id + ": " + error.what();
    }
    return std::string();
  };
  EXPECT_EQ(refusal({2, 20}), "");
  expectRefusal(refusal({1, 20}), "GLTF_TOO_LARGE", "primitives[1]");
  expectRefusal(refusal({2, 19}), "GLTF_TOO_LARGE", "primitives[1]");
  expectRefusal(refusal({2, 9}), "GLTF_TOO_LARGE", "primitives[0] has 10 vertices");
  maker.json["meshes"][0]["primitives"][0]["indices"] = maker.accessor<uint16_t>(kUnsignedShort, "SCALAR", 30, std::vector<uint16_t>(30, 1));
  expectRefusal(refusal({2, 14}), "GLTF_TOO_LARGE", "30 indices");
}

TEST(GltfMalformed, GlbHeaderAndChunks) {
  const std::vector<unsigned char> good = whole().glb();
  const auto patched = [&](size_t at, std::vector<unsigned char> with) {
    std::vector<unsigned char> file = good;
    std::copy(with.begin(), with.end(), file.begin() + std::ptrdiff_t(at));
    return refusalOf(file);
  };
  expectRefusal(patched(4, {1}), "GLTF_VERSION", "GLB version (byte 4) is 1");
  expectRefusal(patched(8, {0xff, 0xff, 0xff, 0xff}), "GLTF_TRUNCATED", "length (byte 8) is 4294967295");
  expectRefusal(patched(12, {0xff, 0xff, 0xff, 0xff}), "GLTF_TRUNCATED", "chunk 0 (byte 12) is 4294967295");
  expectRefusal(patched(16, {'B', 'I', 'N', 0}), "GLTF_CHUNK", "first chunk (byte 12) is not JSON");
  expectRefusal(patched(0, {'g', 'l', 'T', 'X'}), "GLTF_JSON", "damaged at byte 1");
  expectRefusal(refusalOf({good.begin(), good.begin() + 12}), "GLTF_TRUNCATED", "length (byte 8)");
  expectRefusal(refusalOf({'g', 'l', 'T', 'F'}), "GLTF_TRUNCATED", "after 4 of 12 bytes");
  expectRefusal(refusalOf({'g', 'l', 'T', 'F', 2, 0, 0, 0, 12, 0, 0, 0}), "GLTF_TRUNCATED", "where its JSON should begin");
  expectRefusal(refusalOf({}), "GLTF_JSON", "it ends too early");

  std::vector<unsigned char> longer = good;
  longer.insert(longer.end(), 5, 0);
  const GltfStrands read = readBytes(longer);
  EXPECT_EQ(codesOf(read), "GLTF_TRAILING_BYTES");
  EXPECT_EQ(read.findings[0].count, 5u);
}

TEST(GltfMalformed, JsonThatIsNone) {
  const GltfMaker maker = whole();
  const std::string text = maker.json.dump();
  expectRefusal(refusalOf(maker.glbOf(text.substr(0, text.size() / 2))), "GLTF_JSON", "it ends too early");
  std::string nan = text;
  nan.replace(nan.find("\"count\":4"), 9, "\"count\":NaN");
  expectRefusal(refusalOf(maker.glbOf(nan)), "GLTF_JSON", "damaged at byte");
  expectRefusal(refusalOf(maker.glbOf("{\"asset\": {\"version\": \"2.0\"}, \"x\": 1e999}")), "GLTF_JSON", "64-bit float");
  expectRefusal(refusalOf(maker.glbOf("[]")), "GLTF_JSON", "an array where glTF has an object");
  expectRefusal(refusalOf(bytesOf("{\"asset\": \"\xff\"}")), "GLTF_JSON", "damaged at byte");
}

TEST(GltfMalformed, NestingBombs) {
  const GltfMaker maker = whole();
  for (const size_t depth : {size_t{65}, size_t{1'000'000}}) {
    expectRefusal(refusalOf(bytesOf(std::string(depth, '['))), "GLTF_NESTING", "deeper than 64 levels (byte 64");
    std::string objects;
    for (size_t i = 0; i < depth; ++i) objects += "{\"a\":";
    expectRefusal(refusalOf(maker.glbOf(objects)), "GLTF_NESTING", "deeper than 64 levels");
  }
  GltfMaker quoted = whole();
  quoted.json["nodes"][0]["name"] = std::string(100, '[') + "\\\"" + std::string(100, '{');
  EXPECT_EQ(refusalOf(quoted.glb()), "") << "what is quoted does not nest";
}

TEST(GltfMalformed, RestartsOutsideStripsAreStray) {
  GltfMaker maker;
  maker.primitiveAlongX(kLines, 3, {0, 1, 0xffff, 2});
  expectRefusal(refusalOf(maker.glb()), "GLTF_INDEX_STRAY", "holds 65535 at its element 2, but there are 3 vertices");
  GltfMaker strip;
  strip.primitiveAlongX(kLineStrip, 3, {0, 1, 3});
  expectRefusal(refusalOf(strip.glb()), "GLTF_INDEX_STRAY", "holds 3 at its element 2");
}

}  // namespace
}  // namespace forelock::samples
