// What people give by mistake is named for what it is.
#include "asset_kit.h"

using namespace asset_test;

TEST(Sniff, NamesWhatItIsNot) {
  const std::string nul(1, '\0');
  const struct {
    std::string bytes;
    const char* id;
    const char* says;
  } files[] = {
      {"", "FILE_EMPTY", "empty"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 1158720\n", "GIT_LFS_POINTER", "git lfs pull"},
      {"<!DOCTYPE html>\n<html lang=\"en\">", "HTML_PAGE", "web page"},
      {"\xef\xbb\xbf\r\n <html><head>", "HTML_PAGE", "web page"},
      {"<HEAD><TITLE>404</TITLE>", "HTML_PAGE", "web page"},
      {"<?xml version=\"1.0\"?>", "XML_FILE", "XML"},
      {"\x40\x40" + nul + nul + std::string(300, '\0'), "TFX_BYTE_SWAPPED", "a TressFX 3 file in big-endian"},
      {"\x40\x80" + nul + nul + std::string(156, '\0'), "TFX_BYTE_SWAPPED", "a TressFX 4 file in big-endian"},
      {"RIAH" + std::string(124, '\0'), "HAIR_BYTE_SWAPPED", "byte order"},
      {"glTF\x02" + nul + nul + nul, "GLTF_BINARY", "glTF"},
      {"{\n  \"asset\": { \"version\": \"2.0\" }\n}", "GLTF_TEXT", "glTF"},
      {"{ \"strands\": [] }", "JSON_FILE", "JSON"},
      {"Ogawa\xff" + nul + "\x01", "ALEMBIC_FILE", "Alembic"},
      {"\x89HDF\r\n\x1a\n" + nul, "ALEMBIC_FILE", "HDF5"},
      {"#usda 1.0\n", "USD_FILE", "USD text"},
      {"PXR-USDC" + nul, "USD_FILE", "USD"},
      {"PK\x03\x04" + nul, "ARCHIVE_FILE", "ZIP"},
      {"\x1f\x8b\x08" + nul, "ARCHIVE_FILE", "gzip"},
      {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "PLY_MESH", "mesh"},
      {"# hair\no strand\nv 0 0 0\nv 0 1 0\nl 1 2\n", "OBJ_FILE", "OBJ"},
      {"mtllib a.mtl\nv 0 0 0\n", "OBJ_FILE", "OBJ"},
      {"Kaydara FBX Binary  " + nul, "FBX_FILE", "FBX"},
      {"; FBX 7.4.0 project file\n", "FBX_FILE", "FBX file as text"},
      {"//Maya ASCII 2018 scene\n", "MAYA_FILE", "Maya"},
      {"solid cube\nfacet normal 0 0 1\n", "STL_FILE", "STL mesh"},
      {"\x89PNG\r\n\x1a\n" + nul, "IMAGE_FILE", "PNG"},
      {"\xff\xd8\xff\xe0" + nul, "IMAGE_FILE", "JPEG"},
      {"\x76\x2f\x31\x01" + nul, "IMAGE_FILE", "OpenEXR"},
      {"\x93NUMPY\x01" + nul, "NUMPY_FILE", "NumPy"},
      {"BINARY_HAIR\x01" + nul, "MITSUBA_FILE", "Mitsuba"},
      {"BLENDER-v304", "BLEND_FILE", "Blender"},
      {"x", "FORMAT_UNKNOWN", "(78 at byte 0)"},
      {"hello, this is prose", "FORMAT_UNKNOWN", "68 65 6c 6c"},
      {std::string(200, '\0'), "FORMAT_UNKNOWN", "00 00 00 00"},
  };
  for (const auto& file : files) {
    const auto loaded = load(Bytes().text(file.bytes), "thing");
    EXPECT_TRUE(loaded->result == FLK_ERROR_FORMAT_UNKNOWN || loaded->result == FLK_ERROR_MALFORMED);
    EXPECT_EQ(loaded->caught.error(), file.id) << loaded->caught.text();
    EXPECT_NE(loaded->caught.text().find(file.says), std::string::npos) << loaded->caught.text();
    EXPECT_EQ(loaded->caught.all.size(), 1u);
  }
}

TEST(Sniff, LongNamesKeepTheirEnd) {
  const std::string folder(2000, 'x');
  Loaded loaded;
  const std::string name = folder + "/\xc3\xa9t\xc3\xa9.tfx";
  const FlkAssetOptions options = optionsFor(loaded.caught, name.c_str());
  FlkAsset asset = nullptr;
  EXPECT_EQ(flkAssetLoadMemory("x", 1, &options, &asset), FLK_ERROR_FORMAT_UNKNOWN);
  ASSERT_EQ(loaded.caught.all.size(), 1u);
  EXPECT_NE(loaded.caught.all[0].text.find("/\xc3\xa9t\xc3\xa9.tfx: "), std::string::npos);
  EXPECT_EQ(loaded.caught.all[0].text.rfind("...xxx", 0), 0u);
  EXPECT_NE(loaded.caught.all[0].text.find(".hair file"), std::string::npos) << "the sentence is whole";
}
