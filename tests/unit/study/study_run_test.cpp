// forelock-study as people run it: quick, on the paper's load, with validation layers; killed and gone on with.
#include "csv.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

namespace forelock::study {
namespace {

namespace fs = std::filesystem;

struct Folder {
  Folder() : path(fs::temp_directory_path() / ("forelock-study-run-" + std::to_string(getpid()))) { fs::remove_all(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
    fs::remove(path.string() + ".err", ignored);
  }
  fs::path path;
};

// One study for all tests: it takes a minute.
const std::string& folder() {
  static const Folder made;
  static const std::string path = made.path.string();
  return path;
}

std::string errors() {
  std::ifstream file(folder() + ".err");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

pid_t start(const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  std::vector<char*> argv;
  std::vector<std::string> words{FORELOCK_STUDY_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (!std::freopen((folder() + ".err").c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout)) _exit(126);
  execv(FORELOCK_STUDY_PROGRAM, argv.data());
  _exit(127);
}

int finish(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int run(const std::vector<std::string>& arguments) { return finish(start(arguments)); }

std::vector<std::string> quick(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"--asset", "groom:paper-load", "--out", folder(), "--quick", "--validation"});
  return more;
}

std::string fileText() {
  std::ifstream file(folder() + "/study.csv", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::size_t lines() {
  const std::string text = fileText();
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

double number(const Row& row, const char* column) { return row[column].empty() ? std::nan("") : std::stod(row[column]); }

TEST(StudyRun, KilledAndGoneOnWithItIsWhole) {
  const pid_t child = start(quick());
  while (waitpid(child, nullptr, WNOHANG) == 0 && lines() < 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_EQ(kill(child, SIGKILL), 0) << errors();
  finish(child);
  const std::string before = fileText();
  ASSERT_GE(lines(), 3u);
  // As if it had been killed while it wrote.
  std::ofstream(folder() + "/study.csv", std::ios::app) << "groom:paper-load,quick,48";

  EXPECT_EQ(run(quick()), 2);  // a study is there
  EXPECT_NE(errors().find("--resume"), std::string::npos) << errors();
  ASSERT_EQ(run(quick({"--resume"})), 0) << errors();
  EXPECT_TRUE(fileText().starts_with(before));

  const std::string whole = fileText();
  EXPECT_EQ(run(quick({"--resume"})), 0) << errors();
  EXPECT_EQ(fileText(), whole);  // nothing was left
  EXPECT_EQ(run({"--asset", "groom:long-wavy", "--out", folder(), "--quick", "--resume"}), 2);
  EXPECT_EQ(fileText(), whole);
}

TEST(StudyRun, EveryColumnOfTheMainRowsIsFilled) {
  const StudyFile file(folder() + "/study.csv");
  std::size_t main_rows = 0;
  for (const Row& row : file.rows()) {
    const std::string& method = row["method"];
    EXPECT_EQ(row["status"], "ok") << method;
    const bool main = row["temporal_drift"] != "";
    main_rows += main;
    for (const std::string column : columns()) {
      if (column == "tau" || column == "ms_shade") continue;  // of no method yet
      if (column == "ms_dense" && method != "forward") continue;
      if (column == "k" && !method.starts_with("core_")) continue;
      if (column == "k_sort" && (method == "exact" || method == "hard")) continue;
      if (column == "core_taps" && method.starts_with("all_low")) continue;
      if (column == "tail_taps" && (method == "forward" || method == "exact" || method == "hard")) continue;
      if (!main && (column == "temporal_drift" || column == "order_noise" || column == "deterministic")) continue;  // of a slow device
      EXPECT_NE(row[column], "") << method << " " << column;
    }
    EXPECT_EQ(row["overflow_fragments"], "0") << method;
    EXPECT_GT(number(row, "ms_total"), 0);
    EXPECT_LE(number(row, "ms_p5"), number(row, "ms_total"));
    EXPECT_GE(number(row, "ms_p95"), number(row, "ms_total"));
    EXPECT_LT(1e-3 * number(row, "limit_us"), number(row, "ms_total"));
  }
  EXPECT_GE(main_rows, 7u);
}

TEST(StudyRun, ErrorFallsWithKAndThePapersOrderHolds) {
  const StudyFile file(folder() + "/study.csv");
  std::map<int, double> by_k;
  std::map<std::string, double> exact, forward;
  for (const Row& row : file.rows()) {
    if (row["method"] == "core_tail") by_k[std::stoi(row["k"])] = number(row, "rmse_exact");
    if (row["k"] == "" || row["k"] == "8")
      exact[row["method"]] = number(row, "rmse_exact"), forward[row["method"]] = number(row, "rmse_forward");
  }
  ASSERT_GE(by_k.size(), 6u);
  double before = 1e9;
  for (const auto& [k, rmse] : by_k) {
    EXPECT_LT(rmse, before) << k;
    before = rmse;
  }
  // 1 is the bound of the load test for own maps; 9 the paper's own error.
  EXPECT_LT(exact["exact"], 1);
  EXPECT_LT(forward["forward"], 1.5);
  EXPECT_LT(forward["core_tail_list"], 9);
  EXPECT_LT(forward["core_tail_list"], forward["core_only"]);
  EXPECT_LT(forward["core_only"], forward["all_low"]);
}

TEST(StudyRun, ImagesAndFactsAreThere) {
  for (const char* name : {"device.json", "scene-quick.json", "images/quick-layers.pfm", "images/quick-R_cover.pfm", "images/quick-dark-R_exact.pfm",
                           "images/quick-dark-R_forward.pfm", "images/quick-dark-core_tail-raster.pfm", "images/quick-dark-hard-raster.pfm"})
    EXPECT_TRUE(fs::exists(folder() + "/" + name)) << name;
}

TEST(StudyRun, WrongUsageSaysWhatToDo) {
  EXPECT_EQ(run({"--out", folder() + "-none"}), 2);
  EXPECT_NE(errors().find("--asset"), std::string::npos) << errors();
  EXPECT_EQ(run({"--asset", "groom:no-such", "--out", folder() + "-none"}), 1);
  EXPECT_TRUE(errors().starts_with("forelock-study: groom:no-such: ")) << errors();
  EXPECT_EQ(run({"--asset", "groom:paper-load", "--out", folder() + "-none", "--device", "no such device"}), 3);
  EXPECT_FALSE(fs::exists(folder() + "-none"));
  EXPECT_EQ(run({"--help"}), 0);
}

}  // namespace
}  // namespace forelock::study
