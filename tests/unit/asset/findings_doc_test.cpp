// Every code that the sources can say is in docs/findings.md, and every code there can be said.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void collect(const std::string& text, const std::regex& pattern, std::set<std::string>& codes) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) codes.insert((*match)[1]);
}

}  // namespace

TEST(FindingsDoc, ListsEveryCode) {
  const std::filesystem::path root = FORELOCK_SOURCE_DIR;
  std::set<std::string> said, listed;
  const std::regex quoted("\"([A-Z][A-Z0-9]+(_[A-Z0-9]+)+)\"");
  for (const auto& entry : std::filesystem::directory_iterator(root / "sdk/src/asset"))
    collect(contents(entry.path()), quoted, said);
  collect(contents(root / "sdk/src/api/asset_api.cpp"), quoted, said);
  ASSERT_GT(said.size(), 60u);

  // First cells of table rows; results in later cells are not codes.
  std::string first_cells;
  const std::string document = contents(root / "docs/findings.md");
  const std::regex row("(?:^|\n)\\|([^|]*)\\|");
  for (std::sregex_iterator match(document.begin(), document.end(), row), end; match != end; ++match)
    first_cells += (*match)[1].str() + "\n";
  collect(first_cells, std::regex("`([A-Z][A-Z0-9]+(_[A-Z0-9]+)+)`"), listed);

  for (const std::string& code : said) EXPECT_TRUE(listed.count(code)) << code << " is missing in docs/findings.md";
  for (const std::string& code : listed) EXPECT_TRUE(said.count(code)) << code << " is said nowhere";
}
