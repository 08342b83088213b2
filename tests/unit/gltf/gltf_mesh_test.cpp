// Triangles of glTF files as opaque meshes. SPDX-License-Identifier: MIT
#include "gltf_kit.h"
#include "opaque_mesh.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <unistd.h>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

constexpr int kTriangleStrip = 5, kTriangleFan = 6;

class GltfMesh : public testing::Test {
protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string put(const std::vector<unsigned char>& bytes, const std::string& name = "made.glb") const {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return path.string();
  }
  OpaqueMesh read(const GltfMaker& maker) const { return readMesh(put(maker.glb())); }
  // "ID: sentence" of a refusal; "" if the file is read.
  std::string refusal(const std::vector<unsigned char>& bytes, const MeshLimits& limits = {}) const {
    const std::string path = put(bytes);
    try {
      readMesh(path, {}, limits);
    } catch (const GltfError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path + ": ", 0), 0u) << error.what();
      return error.id + ": " + (error.what() + path.size() + 2);
    }
    return "";
  }
  static std::string indicesOf(const OpaqueMesh& mesh) {
    std::string text;
    for (size_t i = 0; i < mesh.indices.size(); ++i) text += (i == 0 ? "" : i % 3 == 0 ? " | " : " ") + std::to_string(mesh.indices[i]);
    return text;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("forelock_gltf_mesh_test." + std::to_string(::getpid()));
};

// Counterclockwise about +z.
const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

TEST_F(GltfMesh, TrianglesStripsAndFans) {
  GltfMaker separate;
  separate.primitive(kTriangles, separate.positions(kSquare), separate.indices({0, 1, 2, 0, 2, 3, 1, 1, 2, 0}));
  EXPECT_EQ(indicesOf(read(separate)), "0 1 2 | 0 2 3") << "one without an area and a rest of one index are left out";

  GltfMaker strip;
  strip.primitive(kTriangleStrip, strip.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}));
  EXPECT_EQ(indicesOf(read(strip)), "0 1 2 | 2 1 3 | 2 3 4");

  GltfMaker restarted;
  restarted.primitive(kTriangleStrip, restarted.positions(kSquare), restarted.indices({0, 1, 2, 65535, 0, 2, 3}));
  EXPECT_EQ(indicesOf(read(restarted)), "0 1 2 | 0 2 3");

  GltfMaker fan;
  fan.primitive(kTriangleFan, fan.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0}));
  EXPECT_EQ(indicesOf(read(fan)), "0 1 2 | 0 2 3 | 0 3 4");
}

TEST_F(GltfMesh, NormalsAreMadeWhereMissing) {
  GltfMaker maker;
  maker.primitive(kTriangles, maker.positions(kSquare), maker.indices({0, 1, 2, 0, 2, 3}));
  const OpaqueMesh made = read(maker);
  for (size_t v = 0; v < 4; ++v) EXPECT_EQ(made.normals[3 * v + 2], 1.0f);

  Json& primitive = maker.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["NORMAL"] = maker.positions({0, 3, 4, 0, 3, 4, 0, 0, 0, 0, NAN, 0});
  const OpaqueMesh given = read(maker);
  EXPECT_FLOAT_EQ(given.normals[1], 0.6f);
  EXPECT_FLOAT_EQ(given.normals[2], 0.8f);
  for (size_t v = 2; v < 4; ++v) EXPECT_EQ(given.normals[3 * v + 2], 1.0f) << "what says no direction is made";

  primitive["attributes"]["NORMAL"] = maker.positions({0, 0, 1});
  EXPECT_EQ(refusal(maker.glb()).rfind("GLTF_COUNTS_DISAGREE: ", 0), 0u) << refusal(maker.glb());
}

TEST_F(GltfMesh, NodesPlaceMeshes) {
  GltfMaker maker;
  maker.primitive(kTriangles, maker.positions({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  maker.json["scenes"][0]["nodes"] = {0, 1};
  maker.json["nodes"] = Json::array({Json{{"mesh", 0}, {"translation", {0, 0, 5}}}, Json{{"mesh", 0}, {"scale", {-2, 1, 4}}}});
  const OpaqueMesh mesh = read(maker);
  EXPECT_EQ(mesh.positions, (std::vector<float>{0, 0, 5, 1, 0, 5, 0, 1, 5, 0, 0, 0, -2, 0, 0, 0, 1, 0}));
  EXPECT_EQ(indicesOf(mesh), "0 1 2 | 3 5 4") << "a mirror turns triangles around, so that they face as they did";
  for (size_t v = 0; v < 6; ++v) EXPECT_EQ(mesh.normals[3 * v + 2], 1.0f) << v;

  maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = maker.positions({0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f});
  const OpaqueMesh turned = read(maker);
  // The inverse transpose of diag(-2, 1, 4): (-0.3, 0, 0.2), to length 1.
  EXPECT_NEAR(turned.normals[9], -0.3 / std::hypot(0.3, 0.2), 1e-6);
  EXPECT_NEAR(turned.normals[11], 0.2 / std::hypot(0.3, 0.2), 1e-6);
}

TEST_F(GltfMesh, ColorIsTheFirstMaterials) {
  GltfMaker maker;
  maker.primitive(kTriangles, maker.positions(kSquare));
  EXPECT_EQ(read(maker).albedo, OpaqueMesh().albedo);
  maker.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1]}}, {}])");
  EXPECT_EQ(read(maker).albedo, glm::vec3(0.25f, 0.5f, 0.75f));
  for (const char* damaged : {R"({})", R"([1])", R"([{"pbrMetallicRoughness": 3}])", R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 2, "x"]}}])",
                              R"([{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1e300]}}])"}) {
    maker.json["materials"] = Json::parse(damaged);
    EXPECT_EQ(read(maker).albedo, OpaqueMesh().albedo) << damaged;
  }
}

TEST_F(GltfMesh, HairIsToldFromMeshes) {
  GltfMaker lines;
  lines.primitive(kLineStrip, lines.positionsAlongX(3));
  EXPECT_EQ(refusal(lines.glb()), "GLTF_NO_TRIANGLES: it holds lines and no triangles: it is hair, not a mesh; name it as ASSET");
  GltfMaker points;
  points.primitive(kPoints, points.positionsAlongX(3));
  EXPECT_EQ(refusal(points.glb()).rfind("GLTF_NO_TRIANGLES: it holds no primitive of triangles", 0), 0u);
  GltfMaker unused;
  unused.primitive(kTriangles, unused.positions(kSquare));
  unused.json["nodes"][0].erase("mesh");
  EXPECT_EQ(refusal(unused.glb()).rfind("GLTF_NO_TRIANGLES: its scene shows none", 0), 0u);
  EXPECT_EQ(refusal(bytesOf("ply\n")).rfind("GLTF_JSON: it is no glTF file", 0), 0u);
  EXPECT_THROW(readMesh((folder_ / "absent.glb").string()), AssetError);
  EXPECT_THROW(readMesh(folder_.string()), AssetError);
}

TEST_F(GltfMesh, DamagedFilesAreRefused) {
  const auto made = [] {
    GltfMaker maker;
    const int positions = maker.positions(kSquare);  // accessor 0
    maker.primitive(kTriangles, positions, maker.indices({0, 1, 2}));
    return maker;
  };
  GltfMaker stray = made();
  stray.json["meshes"][0]["primitives"][0]["indices"] = stray.indices({0, 1, 4});
  EXPECT_EQ(refusal(stray.glb()).rfind("GLTF_INDEX_STRAY: ", 0), 0u) << refusal(stray.glb());
  GltfMaker strip = stray;  // only a strip has a restart
  strip.json["meshes"][0]["primitives"][0]["indices"] = strip.indices({0, 1, 65535});
  EXPECT_EQ(refusal(strip.glb()).rfind("GLTF_INDEX_STRAY: ", 0), 0u) << refusal(strip.glb());
  GltfMaker long_count = made();
  long_count.json["accessors"][0]["count"] = 1'000'000'000'000;
  EXPECT_EQ(refusal(long_count.glb()).rfind("GLTF_", 0), 0u);
  GltfMaker past_end = made();
  past_end.json["accessors"][0]["count"] = 5;
  EXPECT_EQ(refusal(past_end.glb()).rfind("GLTF_ACCESSOR_PAST_END: ", 0), 0u) << refusal(past_end.glb());
  GltfMaker nan;
  nan.primitive(kTriangles, nan.positions({0, 0, 0, 1, NAN, 0, 0, 1, 0}));
  EXPECT_EQ(refusal(nan.glb()).rfind("GLTF_FIELD: POSITION of meshes[0].primitives[0] is not finite, or beyond 1e15 m, at its vertex 1", 0), 0u) << refusal(nan.glb());
  GltfMaker far = made();
  far.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
  EXPECT_EQ(refusal(far.glb()).rfind("GLTF_FIELD: POSITION", 0), 0u) << refusal(far.glb());
  GltfMaker flat = made();
  flat.json["accessors"][0]["type"] = "VEC2";
  EXPECT_EQ(refusal(flat.glb()).rfind("GLTF_FIELD: ", 0), 0u) << refusal(flat.glb());
  GltfMaker missing = made();
  missing.json["meshes"][0]["primitives"][0]["attributes"] = Json::object();
  EXPECT_EQ(refusal(missing.glb()).rfind("GLTF_FIELD: ", 0), 0u) << refusal(missing.glb());
  GltfMaker cycle = made();
  cycle.json["nodes"][0]["children"] = {0};
  EXPECT_EQ(refusal(cycle.glb()).rfind("GLTF_NODE_CYCLE: ", 0), 0u) << refusal(cycle.glb());
  EXPECT_EQ(refusal(made().glb(), {3, 100}).rfind("GLTF_TOO_LARGE: ", 0), 0u);
  EXPECT_EQ(refusal(made().glb(), {100, 0}).rfind("GLTF_TOO_LARGE: ", 0), 0u);
  EXPECT_EQ(refusal(bytesOf(made().gltf("../outside.bin"))).rfind("GLTF_URI: ", 0), 0u) << "nothing outside of the folder";
}

// Any byte may be anything: the file is read or refused, and what is read holds together.
TEST_F(GltfMesh, ChangedBytesAreReadOrRefused) {
  GltfMaker maker;
  const int positions = maker.positions(kSquare);
  maker.primitive(kTriangles, positions, maker.indices({0, 1, 2, 0, 2, 3}));
  maker.primitive(kTriangleStrip, positions, maker.indices({0, 1, 3, 2}));
  maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = maker.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const std::vector<unsigned char> whole = maker.glb();
  std::mt19937 random(1);
  int read = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<unsigned char> bytes = whole;
    for (uint32_t changes = 1 + random() % 3; changes-- > 0;) bytes[random() % bytes.size()] = static_cast<unsigned char>(random());
    if (i % 5 == 0) bytes.resize(random() % bytes.size());
    try {
      const OpaqueMesh mesh = readMesh(put(bytes));
      ++read;
      EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
      for (const uint32_t index : mesh.indices) EXPECT_LT(index, mesh.vertices());
      for (const float value : mesh.positions) EXPECT_TRUE(std::isfinite(value));
      for (const float value : mesh.normals) EXPECT_TRUE(std::isfinite(value));
    } catch (const AssetError&) {
    }
  }
  EXPECT_GT(read, 10);
}

}  // namespace
}  // namespace forelock::samples
