// TressFX 1 and 2: text.
#include "asset_kit.h"

#include <clocale>

using namespace asset_test;

namespace {

std::unique_ptr<Loaded> loadText(const std::string& text, uint32_t max_strands = 0, uint32_t max_vertices = 0) {
  return load(Bytes().text(text), "old.tfx", max_strands, max_vertices);
}

void expectRefusal(const std::string& text, FlkResult result, const char* id, const std::string& says) {
  expectRefused(Bytes().text(text), "old.tfx", result, id, says);
}

}  // namespace

TEST(TfxText, ReadsStrandsUvsAndMasses) {
  const auto loaded = loadText(smallTfxText());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().format, uint32_t{FLK_FORMAT_TFX_TEXT});
  const FlkStrands strands = loaded->strands();
  ASSERT_EQ(strands.strand_count, 2u);
  ASSERT_EQ(strands.vertex_count, 5u);
  EXPECT_EQ(strands.first_vertex[1], 2u);
  EXPECT_EQ(strands.positions[1], 0.125f);
  EXPECT_EQ(strands.positions[3], 0.0f) << "000000";
  EXPECT_EQ(strands.positions[5], 0.1f);
  EXPECT_EQ(strands.positions[11], -3.0f);
  EXPECT_EQ(strands.positions[12], 0.5f);
  EXPECT_EQ(strands.root_uvs[2], 0.75f);
  for (int vertex = 0; vertex < 5; ++vertex) EXPECT_EQ(strands.inverse_masses[vertex], 0.0f) << "both ends are held";
  const auto free = loadText(replaced(smallTfxText(), "bothEndsImmovable 1", "bothEndsImmovable 0"));
  ASSERT_EQ(free->result, FLK_SUCCESS);
  EXPECT_EQ(free->strands().inverse_masses[4], 1.0f);
}

TEST(TfxText, Dialects) {
  std::string text;
  for (const char c : smallTfxText()) {
    if (c == '\n') text.push_back('\r');
    text.push_back(c);
  }
  for (const std::string& dialect : {text, std::string("\xef\xbb\xbf").append(text), replaced(text, "0.0 0.125 0.25", "0.0\t0.125,0.25"),
                                     replaced(text, "numStrands 2\r\n", ""), smallTfxText().substr(0, smallTfxText().size() - 1)}) {
    const auto loaded = loadText(dialect);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    EXPECT_EQ(loaded->info().vertex_count, 5u);
    EXPECT_EQ(loaded->strands().positions[1], 0.125f);
  }
}

TEST(TfxText, NumbersDoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    const auto loaded = loadText(smallTfxText());
    ASSERT_EQ(loaded->result, FLK_SUCCESS);
    EXPECT_EQ(loaded->strands().positions[1], 0.125f) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

// No double is as large or as small: the first is beyond all bounds, the second 0.
TEST(TfxText, NumbersBeyondADouble) {
  for (const char* large : {"1e400", "-1e400", "1E+999"}) EXPECT_EQ(loadText(replaced(smallTfxText(), "0.0 0.125 0.25", std::string(large) + " 0.125 0.25"))->finding("POSITION_NOT_FINITE").count, 1u) << large;
  EXPECT_EQ(loadText(replaced(smallTfxText(), "0.0 0.125 0.25", std::string(400, '9') + " 0.125 0.25"))->finding("POSITION_NOT_FINITE").count, 1u);
  for (const std::string& small : {std::string("1e-400"), "0." + std::string(400, '0') + "1"}) {
    const auto loaded = loadText(replaced(smallTfxText(), "0.0 0.125 0.25", small + " 0.125 0.25"));
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << small;
    EXPECT_EQ(loaded->strands().positions[0], 0.0f) << small;
  }
}

TEST(TfxText, ProjectsOfTressFx3AreNoStrands) {
  const auto project = loadText("version 3.0\n\nproject_name Pony\nside.tfx 4 0.4 5.0 side.tfxsim side\n");
  EXPECT_EQ(project->result, FLK_ERROR_FORMAT_UNKNOWN);
  EXPECT_EQ(project->caught.error(), "TFX_PROJECT");
  EXPECT_EQ(loadText("version 4.0\n")->caught.error(), "TFX_TEXT_VERSION");
}

TEST(TfxText, SaysWhatItDoesNotUse) {
  const auto scaled = loadText(replaced(replaced(smallTfxText(), "scale 1.0", "scale 0.5\nwind 3 4"), "PerGuideHair 0", "PerGuideHair 4"));
  ASSERT_EQ(scaled->result, FLK_SUCCESS) << scaled->caught.text();
  EXPECT_EQ(scaled->codes(), "TFX_TEXT_TRANSFORM_IGNORED TFX_FOLLOW_STRANDS_IGNORED TFX_TEXT_KEY_UNKNOWN INVERSE_MASS_IMPLIED BOTH_ENDS_FIXED INVERSE_MASS_ALL_ZERO WIDTH_DEFAULTED");
  EXPECT_NE(std::string(scaled->finding("TFX_TEXT_TRANSFORM_IGNORED").text).find("a scale of 0.5"), std::string::npos);
  const auto more = loadText(replaced(smallTfxText(), "numStrands 2", "numStrands 1"));
  ASSERT_EQ(more->result, FLK_SUCCESS);
  EXPECT_EQ(more->info().strand_count, 1u);
  EXPECT_GT(more->finding("TRAILING_BYTES").count, 0u);
  const auto none = loadText(replaced(smallTfxText(), "texcoord 0.25 0.5", ""));
  ASSERT_EQ(none->result, FLK_SUCCESS);
  EXPECT_EQ(none->strands().root_uvs, nullptr) << "not all strands have one";
}

TEST(TfxText, OneBadStrandIsNoReasonToLoseTheRest) {
  const auto loaded = loadText(replaced(smallTfxText(), "0.0 0.125 0.25", "nan 0.125 0.25"));
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().strand_count, 1u);
  EXPECT_EQ(loaded->finding("POSITION_NOT_FINITE").strands[0], 0u);
  EXPECT_EQ(loadText(replaced(smallTfxText(), "0.0 0.125 0.25", "1e300 0.125 1e-300"))->finding("POSITION_NOT_FINITE").count, 1u);
}

TEST(TfxText, Refusals) {
  const std::string text = smallTfxText();
  expectRefusal(replaced(text, "version 2.0", "version 5"), FLK_ERROR_FORMAT_UNKNOWN, "TFX_TEXT_VERSION", "TressFX 5");
  expectRefusal("version two\n", FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "\"two\"");
  expectRefusal(replaced(text, "numStrands 2", "numStrands 0"), FLK_ERROR_EMPTY_ASSET, "TFX_TEXT_NO_STRANDS", "nothing to load");
  expectRefusal("version 2.0\nscale 1\n", FLK_ERROR_EMPTY_ASSET, "TFX_TEXT_NO_STRANDS", "none follow");
  expectRefusal(replaced(text, "numStrands 2", "numStrands 3"), FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "after strand 1");
  expectRefusal(replaced(text, "numStrands 2", "numStrands 99999999"), FLK_ERROR_LIMIT, "TFX_TEXT_TOO_LARGE", "99999999");
  expectRefusal(replaced(text, "numVerts 3", "numVerts 4"), FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "truncated");
  expectRefusal(replaced(text, "numVerts 3", "numVerts 4000000000"), FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "4000000000 vertices");
  expectRefusal(replaced(text, "numVerts 3", "numVerts -3"), FLK_ERROR_MALFORMED, "TFX_TEXT_TRUNCATED", "-3 vertices");
  expectRefusal(replaced(text, "numVerts 2", "numVerts 1"), FLK_ERROR_MALFORMED, "TFX_TEXT_NO_STRAND", "strand 1 should begin");
  expectRefusal(replaced(text, "1.5, +2", "1.5, x2"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "\"x2\"");
  expectRefusal(replaced(text, "0.75,0.5", "0.75,u"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "texture coordinate");
  expectRefusal(replaced(text, "strand 1 numVerts", "strand 1 verts"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "numVerts");
  expectRefusal(replaced(text, "strand 1 numVerts", "strand one numVerts"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "one");
  expectRefusal(replaced(text, "scale 1.0", "scale big"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "\"scale\"");
  expectRefusal(replaced(text, "is sorted 1", "is sorted yes"), FLK_ERROR_MALFORMED, "TFX_TEXT_NOT_A_NUMBER", "sorted");
  EXPECT_EQ(loadText(text, 0, 4)->caught.error(), "TFX_TEXT_TOO_LARGE");
  EXPECT_EQ(loadText(text, 1)->caught.error(), "TFX_TEXT_TOO_LARGE");
  const auto unnamed = loadText(replaced(text, "numStrands 2", ""), 1);
  EXPECT_EQ(unnamed->caught.error(), "TFX_TEXT_TOO_LARGE");
}
