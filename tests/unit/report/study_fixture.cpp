#include "study_fixture.h"

#include "study_table.h"

#include <fstream>

namespace forelock::test {

namespace fs = std::filesystem;

namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n") == std::string::npos) return field;
  std::string text(1, '"');
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  text += '"';
  return text;
}

}  // namespace

std::string studyHeader() {
  std::string line;
  for (const samples::StudyColumn& column : samples::studyColumns()) line.append(line.empty() ? "" : ",").append(column.name);
  return line + "\n";
}

std::string studyLine(const StudyFields& fields) {
  std::string line;
  for (const samples::StudyColumn& column : samples::studyColumns()) {
    const auto found = fields.find(column.name);
    if (&column != &samples::studyColumns().front()) line += ',';
    line += found == fields.end() ? "" : quoted(found->second);
  }
  return line + "\n";
}

StudyFields goodRow(const std::string& method, double ms, double error) {
  const auto share = [ms](double part) { return std::to_string(part * ms); };
  return {{"asset", "groom:paper-load"}, {"view", "198k"}, {"width", "1920"}, {"height", "1200"}, {"hair_pixels", "198000"},
          {"fragments", "3957012"}, {"mean_overdraw", "19.9"}, {"max_overdraw", "134"}, {"method", method}, {"store", "linked_list"},
          {"capture", "compute"}, {"k", "8"}, {"k_sort", "8"}, {"core_taps", "25"}, {"tail_taps", "1"}, {"payload", "default"},
          {"lights", "1"}, {"hair_colour", "dark"}, {"shadow_size", "1024"}, {"frames", "9"}, {"ms_total", std::to_string(ms)},
          {"ms_p5", share(0.95)}, {"ms_p95", share(1.1)}, {"ms_prepare", share(0.05)}, {"ms_shadow", share(0.15)},
          {"ms_capture", share(0.5)}, {"ms_resolve", share(0.3)}, {"limit_us", "70"}, {"rmse_forward", std::to_string(error + 0.1)},
          {"rmse_exact", std::to_string(error)}, {"p999_exact", std::to_string(8 * error)}, {"perceptual", std::to_string(error / 200)},
          {"order_noise", "0"}, {"deterministic", "1"}, {"device", "a device"}, {"driver", "1.2.3"}, {"status", "ok"},
          {"pair_ratio", std::to_string(0.7 / ms)}, {"pair_spread", "0.05"}};
}

void writeText(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

void writePfm(const fs::path& path, uint32_t width, uint32_t height, uint32_t channels, const std::vector<float>& values) {
  std::ofstream file(path, std::ios::binary);
  file << (channels == 3 ? "PF" : "Pf") << '\n' << width << ' ' << height << "\n-1.0\n";  // little endian, bottom row first
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
}

void writeStudy(const fs::path& folder) {
  fs::create_directories(folder / "images");
  std::string csv = studyHeader();
  const auto add = [&csv](StudyFields row, const StudyFields& changes = {}) {
    for (const auto& [column, value] : changes) row[column] = value;
    csv += studyLine(row);
  };
  add(goodRow("forward", 1.3, 2.4), {{"deterministic", "0"}, {"order_noise", "1.9"}});
  add(goodRow("core_tail", 0.7, 1.4));
  add(goodRow("core_only", 0.68, 2.7));
  add(goodRow("all_low", 0.6, 45), {{"k", "0"}});
  add(goodRow("exact", 2.0, 0.4), {{"k", ""}});
  add(goodRow("core_tail", 0.66, 40), {{"k", "0"}});
  add(goodRow("core_tail", 0.67, 6), {{"k", "4"}});
  add(goodRow("core_tail", 0.75, 0.5), {{"k", "16"}, {"k_sort", "16"}});
  add(goodRow("core_tail", 0.69, 2), {{"core_taps", "9"}});
  add(goodRow("core_only", 0.8, 1), {{"k", "16"}, {"ms_total", ""}, {"rmse_exact", ""}, {"status", "failed: the device was lost, twice"}});
  for (const char* method : {"forward", "core_tail", "core_only"}) {
    add(goodRow(method, method[0] == 'f' ? 0.5 : 0.3, 1.2), {{"view", "35k"}, {"hair_pixels", "35000"}, {"fragments", "1069000"}, {"mean_overdraw", "30.4"}});
  }
  writeText(folder / "study.csv", csv);
  writeText(folder / "device.json", R"({"device": "a device", "driver": "1.2.3", "type": "cpu", "bandwidth_gb_s": 20, "lane_operations_per_s": 1e11,
    "calibration": "given", "commit": "abc", "date": "2024-01-01", "asset": "groom:paper-load", "command": "forelock-study --out study",
    "views": [{"name": "35k", "width": 1920, "height": 1200, "hair_pixels": 35000}]})");

  constexpr uint32_t width = 24, height = 16;
  std::vector<float> layers(width * height), exact(3 * width * height);
  for (uint32_t i = 0; i < width * height; ++i) {
    layers[i] = i % width < 4 ? 0.0f : static_cast<float>(1 + i % 120);
    for (uint32_t channel = 0; channel < 3 && layers[i] > 0.0f; ++channel) exact[3 * i + channel] = 0.2f + 0.1f * static_cast<float>(channel);
  }
  for (const char* view : {"198k", "35k"}) writePfm(folder / "images" / (std::string(view) + "-layers.pfm"), width, height, 1, layers);
  writePfm(folder / "images" / "198k-dark-R_exact.pfm", width, height, 3, exact);
  writePfm(folder / "images" / "198k-dark-R_forward.pfm", width, height, 3, exact);
  writePfm(folder / "images" / "198k-dark-exact-compute.pfm", width, height, 3, exact);
  std::vector<float> method = exact;
  method[3 * (5 * width + 10)] += 0.1f;
  writePfm(folder / "images" / "198k-dark-core_tail-compute.pfm", width, height, 3, method);
}

}  // namespace forelock::test
