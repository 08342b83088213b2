// Modes of lines, scenes and topology. SPDX-License-Identifier: MIT
#include "gltf_kit.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace forelock::samples {
namespace {

TEST(GltfModes, LinesWithIndices) {
  GltfMaker maker;
  maker.primitiveAlongX(kLines, 5, {4, 3, 1, 2, 0, 1});
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "0 1 2 | 3 4");
  EXPECT_EQ(codesOf(read), "");
  EXPECT_EQ(read.groups, (std::vector<uint32_t>{0, 0}));
  EXPECT_EQ(read.group_names, std::vector<std::string>{"mesh 0"});
}

TEST(GltfModes, LinesWithoutIndicesAreJoinedWhereTheyMeet) {
  GltfMaker maker;
  maker.primitive(kLines, maker.positions({0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 5, 0, 0, 6, 0, 0}));
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "0 1 2 | 5 6");
  EXPECT_EQ(codesOf(read), "GLTF_LINES_JOINED");
}

TEST(GltfModes, OddLines) {
  GltfMaker maker;
  maker.primitive(kLines, maker.positionsAlongX(3));
  EXPECT_EQ(codesOf(readMade(maker)), "GLTF_INDEX_ODD GLTF_VERTICES_UNUSED");
}

TEST(GltfModes, StripsWithAndWithoutIndices) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(4);
  maker.primitive(kLineStrip, positions);
  maker.primitive(kLineStrip, positions, maker.indices({3, 1}));
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "0 1 2 3 | 3 1");
  EXPECT_EQ(codesOf(read), "");
}

TEST(GltfModes, LoopsAreOpenedAndSayWhich) {
  GltfMaker maker;
  maker.primitive(kLineLoop, maker.positionsAlongX(3));
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "0 1 2");
  ASSERT_NE(findingIn(read, "GLTF_LOOP_OPENED"), nullptr);
  EXPECT_EQ(findingIn(read, "GLTF_LOOP_OPENED")->strands, std::vector<uint32_t>{0});
  EXPECT_TRUE(findingIn(read, "GLTF_LOOP_OPENED")->repaired);
}

TEST(GltfModes, PrimitiveRestartOfEveryIndexType) {
  for (const char* extension : {"KHR_mesh_primitive_restart", "EXT_mesh_primitive_restart"})
    for (const int type : {kUnsignedByte, kUnsignedShort, kUnsignedInt}) {
      GltfMaker maker;
      const int positions = maker.positionsAlongX(6);
      const int indices = type == kUnsignedByte    ? maker.accessor<uint8_t>(type, "SCALAR", 7, {0, 1, 2, 0xff, 3, 4, 5})
                          : type == kUnsignedShort ? maker.accessor<uint16_t>(type, "SCALAR", 7, {0, 1, 2, 0xffff, 3, 4, 5})
                                                   : maker.accessor<uint32_t>(type, "SCALAR", 7, {0, 1, 2, 0xffffffff, 3, 4, 5});
      maker.primitive(kLineStrip, positions, indices);
      EXPECT_EQ(codesOf(readMade(maker)), "GLTF_RESTART_UNDECLARED");
      maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {extension};
      const GltfStrands read = readMade(maker);
      EXPECT_EQ(xOf(read), "0 1 2 | 3 4 5");
      EXPECT_EQ(codesOf(read), "");
    }
}

TEST(GltfModes, BranchesCyclesAndStrayEdgesAreFindingsNotFailures) {
  GltfMaker maker;
  maker.primitiveAlongX(kLines, 9, {0, 1, 1, 2, 1, 3, 4, 5, 5, 6, 6, 4, 7, 7});
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "0 1 | 1 2 | 1 3 | 4 5 6");
  EXPECT_EQ(codesOf(read), "GLTF_BRANCH GLTF_CYCLE GLTF_EDGE_DEGENERATE GLTF_VERTICES_UNUSED");
  EXPECT_EQ(findingIn(read, "GLTF_BRANCH")->count, 3u);
  EXPECT_EQ(findingIn(read, "GLTF_CYCLE")->strands, std::vector<uint32_t>{3});
  EXPECT_EQ(findingIn(read, "GLTF_VERTICES_UNUSED")->count, 1u) << "vertex 8; 7 is at least named";
}

TEST(GltfModes, ShuffledVerticesSayThatTheRootIsAGuess) {
  GltfMaker maker;
  maker.primitiveAlongX(kLines, 4, {2, 0, 0, 3, 3, 1});
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(xOf(read), "1 3 0 2");
  EXPECT_EQ(codesOf(read), "GLTF_ROOT_GUESSED");
}

// Whatever the order of vertices and segments and the direction of these, the same polylines come out, if some of them upside down.
TEST(GltfModes, AnyOrderGivesTheSamePolylines) {
  std::mt19937 random(5);
  std::vector<std::vector<float>> wanted;
  std::vector<std::pair<uint32_t, uint32_t>> segments;
  uint32_t vertices = 0;
  for (int strand = 0; strand < 50; ++strand) {
    wanted.emplace_back();
    for (uint32_t i = 0, count = 2 + random() % 9; i < count; ++i, ++vertices) {
      wanted.back().push_back(float(vertices));
      if (i > 0) segments.emplace_back(vertices - 1, vertices);
    }
  }
  std::vector<uint32_t> place(vertices);  // of each vertex in the file
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  std::shuffle(segments.begin(), segments.end(), random);
  std::vector<float> positions(3 * size_t(vertices));
  for (uint32_t v = 0; v < vertices; ++v) positions[3 * size_t(place[v])] = float(v);
  std::vector<uint16_t> pairs;
  for (const auto& [a, b] : segments) {
    const bool turned = random() % 2;
    pairs.push_back(uint16_t(place[turned ? b : a])), pairs.push_back(uint16_t(place[turned ? a : b]));
  }
  GltfMaker maker;
  const int position = maker.positions(positions);
  maker.primitive(kLines, position, maker.indices(pairs));
  const GltfStrands read = readMade(maker);
  std::vector<std::vector<float>> found;
  for (uint32_t strand = 0; strand < read.strands.strands(); ++strand) {
    found.emplace_back();
    for (uint32_t v = read.strands.first_vertex[strand]; v < read.strands.first_vertex[strand + 1]; ++v) found.back().push_back(read.strands.positions[3 * size_t(v)]);
    if (found.back().front() > found.back().back()) std::reverse(found.back().begin(), found.back().end());
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, wanted);
  EXPECT_EQ(codesOf(read), "GLTF_ROOT_GUESSED");
}

TEST(GltfModes, MeshesBesideLinesArePassedOverAndAloneRefused) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(3);
  maker.primitive(kTriangles, positions);
  const std::string refusal = refusalOf(maker.glb());
  EXPECT_EQ(refusal.rfind("GLTF_MESH_ONLY: it is a mesh", 0), 0u) << refusal;
  EXPECT_NE(refusal.find("head"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("LINES or LINE_STRIP"), std::string::npos) << refusal;
  maker.primitive(kLineStrip, positions);
  EXPECT_EQ(codesOf(readMade(maker)), "GLTF_PRIMITIVE_SKIPPED");

  GltfMaker points;
  points.primitive(kPoints, points.positionsAlongX(3));
  EXPECT_EQ(refusalOf(points.glb()).rfind("GLTF_NO_LINES: ", 0), 0u);
  GltfMaker nothing;
  nothing.positionsAlongX(2);
  EXPECT_EQ(refusalOf(nothing.glb()).rfind("GLTF_NO_LINES: ", 0), 0u);
  GltfMaker point;
  point.primitive(kLineStrip, point.positionsAlongX(3), point.indices({1}));
  EXPECT_EQ(refusalOf(point.glb()).rfind("GLTF_NO_LINES: ", 0), 0u) << "a strip of one vertex";
}

TEST(GltfModes, AStripOfOneVertexIsLeftToTheLibraryToDrop) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positionsAlongX(1));
  maker.primitive(kLineStrip, maker.positionsAlongX(2));
  EXPECT_EQ(readMade(maker).strands.first_vertex, (std::vector<uint32_t>{0, 1, 3}));
}

TEST(GltfModes, NodesMoveTurnAndScaleStrandsAndWidths) {
  GltfMaker maker;
  Json& primitive = maker.primitive(kLineStrip, maker.positionsAlongX(2));
  primitive["attributes"]["_WIDTH"] = maker.accessor<float>(kFloat, "SCALAR", 2, {2.0f, 4.0f});
  // A parent that moves, a child that turns x into y and doubles.
  maker.json["nodes"] = Json::parse(R"([{"children": [1], "translation": [10, 20, 30]},
                                        {"mesh": 0, "name": "fringe", "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757], "scale": [2, 2, 2]}])");
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(codesOf(read), "GLTF_TRANSFORM_APPLIED");
  EXPECT_EQ(read.group_names, std::vector<std::string>{"fringe"});
  const float wanted[6] = {10, 20, 30, 10, 22, 30};
  // The rotation is exact to a few units of a double, the result is rounded to a float.
  for (int i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(read.strands.positions[size_t(i)], wanted[i]);
  EXPECT_FLOAT_EQ(read.strands.radii[0], 2.0f);
  EXPECT_FLOAT_EQ(read.strands.radii[1], 4.0f);
  maker.json["nodes"][1]["scale"] = {1, 2, 4};
  const GltfStrands uneven = readMade(maker);
  EXPECT_EQ(codesOf(uneven), "GLTF_SCALE_NOT_UNIFORM GLTF_TRANSFORM_APPLIED");
  EXPECT_FLOAT_EQ(uneven.strands.radii[0], 2.0f) << "the mean of 1, 2 and 4 is 2";
}

TEST(GltfModes, AMatrixIsReadColumnByColumn) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positionsAlongX(2));
  maker.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(read.strands.positions, (std::vector<float>{5, 6, 7, 5, 7, 7}));
}

TEST(GltfModes, AGroupForEachNodeWithLinesAndUnusedMeshesAreNamed) {
  GltfMaker maker;
  const int positions = maker.positionsAlongX(2);
  maker.primitive(kLineStrip, positions);
  maker.json["meshes"][0]["name"] = "brows";
  maker.json["meshes"].push_back(maker.json["meshes"][0]);
  maker.json["nodes"] = Json::parse(R"([{"mesh": 0}, {"mesh": 0, "name": "left"}, {"name": "empty"}])");
  maker.json["scenes"][0]["nodes"] = {0, 1, 2};
  const GltfStrands read = readMade(maker);
  EXPECT_EQ(read.groups, (std::vector<uint32_t>{0, 1}));
  EXPECT_EQ(read.group_names, (std::vector<std::string>{"brows", "left"}));
  EXPECT_EQ(codesOf(read), "GLTF_MESH_UNUSED");
  maker.json["scenes"][0]["nodes"] = {2};
  EXPECT_EQ(refusalOf(maker.glb()).rfind("GLTF_NO_LINES: its scene uses none", 0), 0u);
}

TEST(GltfModes, WithoutScenesAllNodesAndWithoutNodesAllMeshes) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positionsAlongX(2));
  maker.json.erase("scene"), maker.json.erase("scenes");
  EXPECT_EQ(xOf(readMade(maker)), "0 1");
  maker.json.erase("nodes");
  EXPECT_EQ(xOf(readMade(maker)), "0 1");
}

TEST(GltfModes, NamesOfTheFileCannotWriteToATerminal) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positionsAlongX(2));
  maker.json["nodes"][0]["name"] = "a\x1b[2Jb";
  EXPECT_EQ(readMade(maker).group_names[0], "a?[2Jb");
}

}  // namespace
}  // namespace forelock::samples
