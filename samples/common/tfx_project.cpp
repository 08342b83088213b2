// SPDX-License-Identifier: MIT
#include "tfx_project.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kLargestProject = 1 << 20;

// A whole word as a number, whatever the locale; 0 where it is none.
template <class T> T number(const std::string& word) {
  T value{};
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc() && result.ptr == word.data() + word.size() ? value : T{};
}

// A line of a project: the strand file, follow strands a guide, radius around it, how much further apart tips are.
bool addFinding(const std::string& project, const std::string& line, const std::string& file, std::vector<AssetFinding>& findings) {
  std::istringstream words(line);
  std::string name, count_word, radius_word, tip_word;
  words >> name >> count_word >> radius_word >> tip_word;
  const auto count = number<uint32_t>(count_word);
  if (fs::path(name).filename() != file || count == 0) return false;
  const double radius = number<double>(radius_word), tip = number<double>(tip_word);
  char text[400];
  std::snprintf(text, sizeof text,
                "the project %s beside the file grows %u follow strands around each guide, within %g (unit of the positions) at the root and %g times that at the tip; only the "
                "guides are loaded: draw them with preview --follow %u, or set a greater width",
                project.c_str(), count, radius, tip, count);
  findings.push_back({"TFX_PROJECT_FOLLOW_STRANDS", text, FLK_SEVERITY_INFO, false, count, {}, UINT64_MAX});
  return true;
}

}  // namespace

void noteTfxProject(const std::string& path, std::vector<AssetFinding>& findings) {
  std::error_code error;
  std::vector<fs::path> projects;
  fs::directory_iterator entry(fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path("."), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().extension() == ".tfxproj" && entry->is_regular_file(ignored) && entry->file_size(ignored) <= kLargestProject) projects.push_back(entry->path());
  }
  std::sort(projects.begin(), projects.end());
  const std::string file = fs::path(path).filename().string();
  for (const fs::path& project : projects) {
    std::ifstream lines(project);
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && line[0] != '#' && addFinding(project.filename().string(), line, file, findings)) return;
  }
}

}  // namespace forelock::samples
