// SPDX-License-Identifier: MIT
#include "inspect_batch.h"

#include "commands.h"
#include "progress.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

// Names that promise strands: such a file that cannot be read is a failure, also in a folder of other things.
bool namedLikeStrands(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {".tfx", ".hair", ".ply", ".data", ".gltf", ".glb", ".flk"})
    if (extension == known) return true;
  return false;
}

struct Source {
  std::string path;
  bool named;  // by the user, rather than found in a folder
};

std::vector<Source> listSources(const std::vector<std::string>& sources, std::vector<InspectedFile>& failures) {
  std::vector<Source> list;
  for (const std::string& source : sources) {
    std::error_code error;
    if (!fs::is_directory(source, error)) {
      list.push_back({source, true});
      continue;
    }
    std::vector<std::string> found;
    fs::recursive_directory_iterator entry(source, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
      std::error_code ignored;
      if (entry->path().filename().string().rfind('.', 0) == 0) {
        if (entry->is_directory(ignored)) entry.disable_recursion_pending();
      } else if (entry->is_regular_file(ignored)) {
        found.push_back(entry->path().string());
      }
    }
    if (error) failures.push_back({source, source + ": cannot be searched: " + error.message() + ", check path and permissions", {}});
    std::sort(found.begin(), found.end());
    for (std::string& path : found) list.push_back({std::move(path), false});
  }
  return list;
}

std::string shortened(const std::string& text, size_t width) { return text.size() <= width ? text : "..." + text.substr(text.size() - width + 3); }

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

bool InspectedFiles::failed() const {
  return files.empty() || std::any_of(files.begin(), files.end(), [](const InspectedFile& file) { return !file.error.empty(); });
}

bool InspectedFiles::clean() const {
  return !failed() && std::all_of(files.begin(), files.end(), [](const InspectedFile& file) {
    return file.seen.count(FLK_SEVERITY_WARNING) + file.seen.count(FLK_SEVERITY_ERROR) == 0;
  });
}

InspectedFiles inspectFiles(const std::vector<std::string>& sources, const std::function<OpenedAsset(const std::string&)>& open) {
  InspectedFiles all;
  const std::vector<Source> list = listSources(sources, all.files);
  Progress progress("inspecting");
  for (size_t i = 0; i < list.size(); ++i) {
    progress.update(i, list.size());
    InspectedFile file{list[i].path, {}, {}};
    try {
      const bool recipe = !list[i].named && fs::path(file.path).extension() == ".json";  // settings and scenes are JSON too
      if (recipe) {
        all.no_strands.push_back(file.path);
        continue;
      }
      file.seen = inspectAsset(open(file.path));
    } catch (const AssetError& error) {
      if (!list[i].named && error.result == FLK_ERROR_FORMAT_UNKNOWN && !namedLikeStrands(file.path)) {
        all.no_strands.push_back(file.path);
        continue;
      }
      file.error = error.what();
    } catch (const std::bad_alloc&) {
      file.error = file.path + ": does not fit into memory, inspect it alone or split it";
    }
    all.files.push_back(std::move(file));
  }
  return all;
}

void printTable(const InspectedFiles& all) {
  size_t width = 4;
  for (const InspectedFile& file : all.files) width = std::min<size_t>(60, std::max(width, file.path.size()));
  const int name = static_cast<int>(width);
  if (!all.files.empty()) std::printf("%-*s  %-11s %10s %12s  %8s  %s\n", name, "file", "format", "strands", "vertices", "warnings", "first finding");
  size_t failed = 0;
  for (const InspectedFile& file : all.files) {
    if (!file.error.empty()) {
      ++failed;
      std::printf("%-*s  failed\n", name, shortened(file.path, width).c_str());
      std::fprintf(stderr, "forelock: %s\n", file.error.c_str());
      continue;
    }
    const Inspected& seen = file.seen;
    std::printf("%-*s  %-11s %10s %12s  %8llu  %s\n", name, shortened(file.path, width).c_str(), seen.format.c_str(), groupedDigits(seen.info.strand_count).c_str(),
                groupedDigits(seen.info.vertex_count).c_str(), static_cast<unsigned long long>(seen.count(FLK_SEVERITY_WARNING) + seen.count(FLK_SEVERITY_ERROR)),
                seen.firstCode().c_str());
  }
  std::printf("%s%zu strand files, %zu of them failed", all.files.empty() ? "" : "\n", all.files.size(), failed);
  if (!all.no_strands.empty()) std::printf("; %zu other files left alone, %s%s", all.no_strands.size(), all.no_strands[0].c_str(), all.no_strands.size() > 1 ? " and so on" : "");
  std::printf("\n");
}

nlohmann::ordered_json filesJson(const InspectedFiles& all) {
  nlohmann::ordered_json json;
  json["schema"] = "forelock.inspect-list/1";
  json["assets"] = nlohmann::ordered_json::array();
  for (const InspectedFile& file : all.files) {
    if (file.error.empty()) json["assets"].push_back(inspectedJson(file.seen));
    else json["assets"].push_back({{"asset", file.path}, {"error", file.error}});
  }
  json["no_strands"] = all.no_strands;
  return json;
}

void writeCsv(const InspectedFiles& all, const std::string& path) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "file,format,strands,strands_in_source,duplicates,vertices,length_min,length_median,length_mean,length_max,width_median,width_source,"
          "turn_degrees_median,unit_guess,up_axis_guess,bytes_device,warnings,infos,first_code,error\r\n";
  for (const InspectedFile& file : all.files) {
    const Inspected& seen = file.seen;
    text << csvField(file.path) << ',';
    if (!file.error.empty()) {
      text << std::string(18, ',') << csvField(file.error) << "\r\n";
      continue;
    }
    text << csvField(seen.format) << ',' << seen.info.strand_count << ',' << seen.info.strands_in_source << ',' << seen.numbers.duplicates << ','
         << seen.info.vertex_count << ',' << seen.numbers.length.min << ',' << seen.numbers.length.median << ',' << seen.numbers.length.mean << ','
         << seen.numbers.length.max << ',' << seen.numbers.width.median << ',' << (seen.info.has_radii ? "asset" : "default") << ','
         << seen.numbers.turn_degrees.median << ',' << seen.unit.value << ',' << seen.up.value << ',' << hairBytes(seen.info) << ','
         << seen.count(FLK_SEVERITY_WARNING) + seen.count(FLK_SEVERITY_ERROR) << ',' << seen.count(FLK_SEVERITY_INFO) << ',' << seen.firstCode() << ",\r\n";
  }
  std::ofstream out(path, std::ios::binary);
  if (!(out << text.str()).flush()) throw AssetError(FLK_ERROR_IO, path + ": cannot be written, check path and permissions");
}

}  // namespace forelock::samples
