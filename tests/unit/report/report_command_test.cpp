// forelock report on a small study, from the outside.
#include "command_run.h"
#include "study_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using forelock::test::CommandRun;
using forelock::test::goodRow;
using forelock::test::readAll;
using forelock::test::runCommand;
using forelock::test::scratchFolder;
using forelock::test::writeText;
namespace fs = std::filesystem;

namespace {

fs::path freshStudy(const std::string& name) {
  const fs::path folder = scratchFolder() / name;
  fs::remove_all(folder);
  forelock::test::writeStudy(folder);
  return folder;
}

CommandRun report(const fs::path& folder, const std::string& more = {}, const std::string& environment = {}) {
  return runCommand("report \"" + folder.string() + "\" " + more, environment);
}

// Empty when every tag that opens is closed in the right order, else what is wrong.
std::string unbalanced(const std::string& page) {
  static const std::set<std::string> empty = {"meta", "img", "wbr", "br", "rect"};
  std::vector<std::string> open;
  for (size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag does not end";
    if (page[at + 1] == '!') continue;
    const bool closes = page[at + 1] == '/';
    const size_t from = at + (closes ? 2 : 1);
    const std::string name = page.substr(from, page.find_first_of(" />", from) - from);
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes <" + (open.empty() ? "nothing" : open.back()) + ">";
      open.pop_back();
    } else if (empty.count(name) > 0) {
      if (page[end - 1] != '/') return "<" + name + "> is not closed";
    } else {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

size_t countOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST(ReportCommand, WritesEveryFigureIntoOnePage) {
  const fs::path folder = freshStudy("study");
  const CommandRun run = report(folder);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("report.html"), std::string::npos) << run.out;
  for (const char* file : {"error-vs-time.svg", "error-vs-time.png", "report/error-vs-time.gp", "report/error-vs-time.dat", "report/passes-views-compute.svg",
                           "report/passes-methods-compute.png", "report/tail-cost-compute.svg", "report/fragments-histogram.svg", "report/sweep-k.svg",
                           "report/sweep-core_taps.svg", "report/198k-layers.png", "report/198k-dark-core_tail-compute-difference.png"}) {
    EXPECT_TRUE(fs::exists(folder / file) && fs::file_size(folder / file) > 0) << file;
  }
  const std::string page = readAll(folder / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_EQ(countOf(page, "src=\""), countOf(page, "src=\"data:image/")) << "nothing comes from elsewhere";
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  // error twice (both views), passes twice, tail, load, two sweeps
  EXPECT_EQ(countOf(page, "src=\"data:image/svg+xml"), 8u);
  // two layers, two references, core_tail with difference and detail, exact with a difference
  EXPECT_EQ(countOf(page, "src=\"data:image/png"), 9u);
  EXPECT_NE(page.find("core_tail at k 8 takes 0.54 of forward&#39;s time at an error of 1.40"), std::string::npos);
  EXPECT_NE(page.find("failed: the device was lost, twice"), std::string::npos);
  EXPECT_NE(page.find("Radeon HD 7970"), std::string::npos);
  EXPECT_NE(page.find("images/198k-dark-forward-compute.pfm"), std::string::npos) << "missing pictures are named";
  EXPECT_NE(run.err.find("pictures are missing"), std::string::npos) << run.err;
  EXPECT_NE(readAll(folder / "error-vs-time.svg").find("</svg>"), std::string::npos);
}

TEST(ReportCommand, WithoutGnuplotEverythingElseIsWritten) {
  const fs::path folder = freshStudy("no-gnuplot");
  const CommandRun run = report(folder, "", "PATH=/nonexistent ");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("gnuplot-nox"), std::string::npos) << run.err;
  const std::string page = readAll(folder / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_NE(page.find("gnuplot-nox"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "report/198k-layers.png"));
  EXPECT_TRUE(fs::exists(folder / "report/error-vs-time.gp"));
}

TEST(ReportCommand, AnotherErrorElsewhereWithoutPictures) {
  const fs::path folder = freshStudy("other"), out = scratchFolder() / "out it's";
  const CommandRun run = report(folder, "--error rmse_forward --no-images --out \"" + out.string() + "\"");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(fs::exists(folder / "report.html"));
  const std::string page = readAll(out / "report.html");
  EXPECT_NE(page.find("--no-images"), std::string::npos);
  EXPECT_EQ(countOf(page, "data:image/png"), 0u);
  EXPECT_NE(page.find("at an error of 1.50"), std::string::npos);
}

TEST(ReportCommand, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& csv) {
    const fs::path folder = scratchFolder() / "wrong";
    fs::create_directories(folder);
    writeText(folder / "study.csv", csv);
    const CommandRun run = report(folder);
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_NE(complaint("").find("study.csv: is empty"), std::string::npos);
  EXPECT_NE(complaint("asset,view\na,b\n").find("lacks the columns width, height"), std::string::npos);
  fs::remove(scratchFolder() / "wrong" / "study.csv");
  EXPECT_NE(report(scratchFolder() / "wrong").err.find("study.csv: not found"), std::string::npos);
}

TEST(ReportCommand, SurvivesAHostileTable) {
  const fs::path folder = scratchFolder() / "hostile";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::string csv = forelock::test::studyHeader();
  const char* odd[] = {"<img src=x onerror=alert(1)>", "'; system('touch " "owned') #", "`touch owned`", "../../../etc/passwd", "\"", "\xff\xfe", ""};
  for (int i = 0; i < 2500; ++i) {
    auto row = goodRow(i % 3 == 0 ? odd[i % 7] : "core_tail", i % 11 == 0 ? 1e-9 : 1e15, i % 5 == 0 ? 0.0 : 1e12);
    row["view"] = odd[(i / 7) % 7];
    row["hair_colour"] = odd[(i / 49) % 7];
    row["asset"] = odd[0];
    row["k"] = std::to_string(i);
    if (i % 13 == 0) row["ms_total"] = "-1";
    if (i % 17 == 0) row["rmse_exact"] = "nan";
    if (i % 19 == 0) row["status"] = std::string(5000, 'x');
    csv += forelock::test::studyLine(row);
  }
  writeText(folder / "study.csv", csv + "torn,\"");
  writeText(folder / "device.json", "{\"asset\": \"<b>paper-load\", \"views\": 3");
  const CommandRun run = report(folder, "", "PATH=/nonexistent ");  // dozens of plots take too long here; their scripts are written
  EXPECT_EQ(run.status, 1) << run.err;
  const std::string page = readAll(folder / "report.html");
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder / "report")) {
    const std::string script = readAll(entry.path());
    EXPECT_EQ(script.find("system('"), std::string::npos) << entry.path();
    EXPECT_EQ(script.find('`'), std::string::npos) << entry.path();
  }
}
