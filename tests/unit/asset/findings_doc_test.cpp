// Every code that the sources can say is in docs/findings.md, and every code there can be said.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Codes between two `mark`s: capitals, digits and at least one underscore.
void collect(const std::string& text, char mark, std::set<std::string>& codes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  for (size_t begin = 0; (begin = text.find(mark, begin)) != std::string::npos; ++begin) {
    const size_t end = text.find_first_not_of(letters, begin + 1);
    if (end == std::string::npos || text[end] != mark) continue;
    if (text.compare(end + 1, 2, "sv") == 0) continue;  // bytes of a file
    const std::string code = text.substr(begin + 1, end - begin - 1);
    if (code.find('_') != std::string::npos) codes.insert(code);
  }
}

}  // namespace

TEST(FindingsDoc, ListsEveryCode) {
  const std::filesystem::path root = FORELOCK_SOURCE_DIR;
  std::set<std::string> said, listed;
  for (const auto& entry : std::filesystem::directory_iterator(root / "sdk/src/asset"))
    collect(contents(entry.path()), '"', said);
  for (const char* name : {"asset_api.cpp", "rig_api.cpp", "load_call.h"}) collect(contents(root / "sdk/src/api" / name), '"', said);
  collect(contents(root / "samples/common/tfx_project.cpp"), '"', said);
  // Readers and writers of the programs: what else they quote in capitals are names of attributes.
  std::set<std::string> quoted;
  for (const auto& entry : std::filesystem::directory_iterator(root / "samples/common"))
    if (entry.path().extension() == ".cpp") collect(contents(entry.path()), '"', quoted);
  for (const std::string& code : quoted)
    if (code.rfind("GLTF_", 0) == 0 || code.rfind("WRITE_", 0) == 0) said.insert(code);
  ASSERT_TRUE(said.count("GLTF_BRANCH"));
  ASSERT_GT(said.size(), 60u);

  // Of a table's row the first cell: results in later cells are not codes.
  std::ifstream document(root / "docs/findings.md");
  for (std::string line; std::getline(document, line);)
    if (!line.empty() && line[0] == '|') collect(line.substr(0, line.find('|', 1)), '`', listed);

  for (const std::string& code : said) EXPECT_TRUE(listed.count(code)) << code << " is missing in docs/findings.md";
  for (const std::string& code : listed) EXPECT_TRUE(said.count(code)) << code << " is said nowhere";
}
