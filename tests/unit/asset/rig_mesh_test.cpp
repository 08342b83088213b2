// .tfxmesh: text of a collision mesh.
#include "rig_kit.h"

using namespace asset_test;

namespace {

std::unique_ptr<LoadedRig> loadText(const std::string& text, uint32_t max_bones = 0, uint32_t max_records = 0) {
  return loadRig(Bytes().text(text), nullptr, max_bones, max_records);
}

void expectRefusal(const std::string& text, FlkResult result, const char* id, const std::string& says) {
  expectRigRefused(Bytes().text(text), result, id, says);
}

}  // namespace

TEST(Mesh, ReadsEverything) {
  const auto loaded = loadText(smallTfxmesh());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  const FlkRigInfo info = loaded->info();
  EXPECT_EQ(info.kind, uint32_t{FLK_RIG_MESH});
  EXPECT_EQ(info.bone_count, 2u);
  EXPECT_EQ(info.record_count, 4u);
  EXPECT_EQ(info.triangle_count, 2u);
  const FlkRigArrays arrays = loaded->arrays();
  EXPECT_STREQ(arrays.bone_names[1], "upper arm") << "a name reaches to the end of its line";
  EXPECT_EQ(arrays.positions[10], 1.0f);
  EXPECT_EQ(arrays.normals[2], 1.0f);
  EXPECT_EQ(loaded->bones(1), (std::vector<uint32_t>{0, 1, 0, 0}));
  EXPECT_EQ(loaded->weights(1), (std::vector<float>{0.5f, 0.5f, 0, 0}));
  EXPECT_EQ(std::vector<uint32_t>(arrays.triangles, arrays.triangles + 6), (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(loaded->codes(), "BONE_PLACEHOLDER");
  EXPECT_EQ(loaded->finding("BONE_PLACEHOLDER").strands[0], 3u);
}

TEST(Mesh, Dialects) {
  std::string crlf, upper = smallTfxmesh();
  for (const char c : smallTfxmesh()) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& text : {crlf, "\xef\xbb\xbf" + smallTfxmesh(), replaced(smallTfxmesh(), "numOfBones", "  NUMOFBONES"),
                                  replaced(smallTfxmesh(), "0 0 1 2\n", "0,0,1,2\n"), smallTfxmesh().substr(0, smallTfxmesh().size() - 1),
                                  replaced(smallTfxmesh(), "# a square\n", "\n\n#\n  # a\n"), replaced(smallTfxmesh(), "arm\n", "arm \t \n")}) {
    const auto loaded = loadText(text);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    EXPECT_EQ(loaded->codes(), "BONE_PLACEHOLDER");
    EXPECT_STREQ(loaded->arrays().bone_names[1], "upper arm");
    EXPECT_EQ(loaded->arrays().triangles[5], 3u);
  }
}

TEST(Mesh, OneBadRecordIsNoReasonToLoseTheRest) {
  const std::string text = smallTfxmesh();
  const auto position = loadText(replaced(text, "3 0 1e0 0", "3 0 nan 0"));
  ASSERT_EQ(position->result, FLK_SUCCESS) << position->caught.text();
  EXPECT_EQ(position->finding("MESH_POSITION_INVALID").strands[0], 3u);
  EXPECT_NE(std::string(position->finding("MESH_POSITION_INVALID").text).find("the first in vertex 3 at byte"), std::string::npos);
  EXPECT_EQ(position->info().triangle_count, 1u);
  EXPECT_EQ(position->info().triangles_in_source, 2u);
  EXPECT_EQ(position->arrays().positions[10], 0.0f);
  EXPECT_EQ(loadText(replaced(text, "3 0 1e0 0", "3 0 1e300 0"))->finding("MESH_POSITION_INVALID").count, 1u);

  const auto normal = loadText(replaced(replaced(text, "0 0 0 0 0 0 1 ", "0 0 0 0 inf 0 1 "), "1 1 0 0 0 0 1 ", "1 1 0 0 0 0 0 "));
  ASSERT_EQ(normal->result, FLK_SUCCESS) << normal->caught.text();
  EXPECT_EQ(normal->finding("MESH_NORMAL_INVALID").count, 2u);
  EXPECT_EQ(normal->arrays().normals[0], 0.0f);
  EXPECT_EQ(normal->arrays().normals[8], 1.0f);

  const auto triangle = loadText(replaced(text, "1 0 2 3", "1 0 2 4"));
  ASSERT_EQ(triangle->result, FLK_SUCCESS);
  EXPECT_EQ(triangle->finding("TRIANGLE_OUT_OF_RANGE").count, 1u);
  EXPECT_NE(std::string(triangle->finding("TRIANGLE_OUT_OF_RANGE").text).find("the first in triangle 1"), std::string::npos);
  EXPECT_EQ(triangle->info().triangle_count, 1u);
  EXPECT_EQ(loadText(replaced(text, "1 0 2 3", "1 0 2 -1"))->finding("TRIANGLE_OUT_OF_RANGE").count, 1u);
  EXPECT_EQ(loadText(replaced(text, "1 0 2 3", "1 0 2 2"))->finding("TRIANGLE_DEGENERATE").count, 1u);

  const auto bone = loadText(replaced(text, "0 1 0 0 0.5 0.5 0 0", "0 9 0 0 0.5 0.5 0 0"));
  EXPECT_EQ(bone->finding("BONE_OUT_OF_RANGE").strands[0], 1u);
  EXPECT_EQ(bone->weights(1)[0], 1.0f);
  EXPECT_EQ(loadText(replaced(text, "0 1 0 0 0.5 0.5 0 0", "0 1 0 0 0.5 0.3 0 0"))->finding("WEIGHTS_NOT_NORMALISED").count, 1u);
  EXPECT_EQ(loadText(replaced(text, "1 upper arm", "1 root"))->finding("BONE_NAME_DUPLICATE").count, 1u);
  EXPECT_EQ(loadText(replaced(text, "1 upper arm", "1"))->finding("BONE_NAME_EMPTY").count, 1u);
  EXPECT_EQ(loadText(replaced(text, "1 upper arm", "7 upper arm"))->finding("RIG_INDEX_UNEXPECTED").count, 1u);
  EXPECT_GT(loadText(text + "more\n")->finding("TRAILING_BYTES").count, 0u);
  EXPECT_EQ(loadText(text + "# nothing\n\n")->finding("TRAILING_BYTES").count, 0u);
}

TEST(Mesh, Refusals) {
  const std::string text = smallTfxmesh();
  expectRefusal("numOfBones", FLK_ERROR_MALFORMED, "MESH_ROW", "in line 1 (byte 10) a count of bones should be");
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones two"), FLK_ERROR_MALFORMED, "MESH_ROW", "\"two\"");
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones -2"), FLK_ERROR_MALFORMED, "MESH_ROW", "\"-2\"");
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones 0"), FLK_ERROR_EMPTY_ASSET, "RIG_NO_BONES", "0 bones (line 2, byte 22)");
  expectRefusal(replaced(text, "numOfVertices 4", "numOfVertices 0"), FLK_ERROR_EMPTY_ASSET, "RIG_NO_RECORDS", "0 vertices");
  expectRefusal(replaced(text, "numOfTriangles 2", "numOfTriangles 0"), FLK_ERROR_EMPTY_ASSET, "RIG_NO_RECORDS", "0 triangles");
  // As many lines as a file of this length could have at the most, then one that does not begin with a number.
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones 3"), FLK_ERROR_MALFORMED, "MESH_ROW", "the number of bone 2 should be, but there is \"numOfVertices\"");
  expectRefusal(replaced(text, "numOfVertices 4", "numOfVertices 5"), FLK_ERROR_MALFORMED, "MESH_ROW", "the number of vertex 4");
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones 1"), FLK_ERROR_MALFORMED, "MESH_ROW", "\"numOfVertices\" should be, but there is \"1\"");
  for (const char* count : {"4294967295", "2147483649", "9223372036854775807", "143165577"}) {  // the last x 30 = 14 in 32 bits
    expectRefusal(replaced(text, "numOfBones 2", std::string("numOfBones ") + count), FLK_ERROR_MALFORMED, "MESH_TRUNCATED", count);
    expectRefusal(replaced(text, "numOfVertices 4", std::string("numOfVertices ") + count), FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "bytes follow");
    expectRefusal(replaced(text, "numOfTriangles 2", std::string("numOfTriangles ") + count), FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "numOfTriangles at byte");
  }
  expectRefusal(replaced(text, "numOfBones 2", "numOfBones 9223372036854775808"), FLK_ERROR_MALFORMED, "MESH_ROW", "a count of bones");
  expectRefusal(replaced(text, "numOfTriangles 2", "numOfTriangles 3\n#") + std::string(9, '\n'), FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "where triangle 2 should be");
  expectRefusal(text.substr(0, text.find("numOfTriangles")), FLK_ERROR_MALFORMED, "MESH_TRUNCATED", "where \"numOfTriangles\" should be");
  expectRefusal(replaced(text, "1.0 0.0 0.0 0.0", "1.0 0.0 0.0"), FLK_ERROR_MALFORMED, "MESH_ROW", "a weight should be, but there is \"\"");
  expectRefusal(replaced(text, "1.0 0.0 0.0 0.0", "1.0 0.0 0.0 0.0 0.0"), FLK_ERROR_MALFORMED, "MESH_ROW", "the end of the line should be");
  expectRefusal(replaced(text, "3 0 1e0 0", "3 0 1eO 0"), FLK_ERROR_MALFORMED, "MESH_ROW", "a coordinate of a position should be, but there is \"1eO\"");
  expectRefusal(replaced(text, "1 0 2 3", "1 0 2"), FLK_ERROR_MALFORMED, "MESH_ROW", "the vertex of a triangle");
  expectRefusal(replaced(text, "1 0 2 3", "1 0 2 3 4"), FLK_ERROR_MALFORMED, "MESH_ROW", "the end of the line");
  expectRefusal(replaced(text, "0 0 1 2\n1 0 2 3", "0 0 1 9\n1 0 2 2"), FLK_ERROR_EMPTY_ASSET, "MESH_NO_TRIANGLE_LEFT", "1 name vertices that do not exist, 1 name one twice");
  EXPECT_EQ(loadText(text, 1)->caught.error(), "RIG_TOO_LARGE");
  EXPECT_EQ(loadText(text, 2, 3)->caught.error(), "RIG_TOO_LARGE");
  EXPECT_EQ(loadText(text, 2, 4)->result, FLK_SUCCESS);
}
