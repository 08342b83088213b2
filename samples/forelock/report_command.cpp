// `forelock report`: pictures, plots and a page from what a study left. SPDX-License-Identifier: MIT
#include "commands.h"
#include "progress.h"
#include "report_page.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace forelock::samples {

namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string study, out, error = "rmse_exact";
  bool no_images = false;
};

constexpr const char* kExamples =
    "DIR is the folder of `forelock-study --out DIR`. Written beside it:\n"
    "  report.html                       everything in one file that needs no other and no network\n"
    "  error-vs-time.svg, .png           error against time of the view with most rows\n"
    "  report/                           every plot (.svg, .png), its gnuplot script and data, every picture (.png)\n"
    "What is missing is named and left out. Plots are drawn by gnuplot (Debian: gnuplot-nox). docs/report.md explains\n"
    "each figure.\n\n"
    "Examples:\n"
    "  forelock report study\n"
    "  forelock report study --error rmse_forward     against the paper's reference instead of exact order\n"
    "  forelock report study --error perceptual --out by-flip\n"
    "  forelock report study --no-images              plots and numbers only: a small page, sooner\n";

const std::vector<std::string>& errorColumns() {
  static const std::vector<std::string> columns = {"rmse_exact", "rmse_forward", "rmse_exact_channel", "rmse_cover", "p999_exact", "perceptual",
                                                   "temporal_drift", "order_noise", "frame_noise"};
  return columns;
}

// What a shell reads as one word.
std::string shellWord(const std::string& text) {
  const bool plain = !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+") == std::string::npos;
  if (plain) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string commandLine(const ReportArguments& arguments) {
  std::string line = "forelock report " + shellWord(arguments.study);
  if (arguments.error != "rmse_exact") line += " --error " + arguments.error;
  if (!arguments.out.empty()) line += " --out " + shellWord(arguments.out);
  return line + (arguments.no_images ? " --no-images" : "");
}

int runReport(const ReportArguments& arguments) {
  const StudyTable table = readStudy(arguments.study);
  for (const std::string& warning : table.warnings) {
    std::fprintf(stderr, "forelock: %s: %s\n", arguments.study.c_str(), warning.c_str());
  }
  const StudyFacts facts(table, arguments.error);
  const std::string folder = arguments.out.empty() ? arguments.study : arguments.out;
  std::error_code error;
  fs::create_directories(fs::path(folder) / "report", error);
  if (error) {
    throw StudyError((fs::path(folder) / "report").string() + ": cannot be made: " + error.message());
  }

  Pictures pictures;
  if (!arguments.no_images) {
    Progress progress("pictures");
    pictures = makePictures(facts, arguments.study, folder, [&](uint64_t done, uint64_t total) { progress.update(done, total); });
  }
  Plots plots;
  {
    Progress progress("plots");
    plots = drawPlots(facts, pictures.histograms, folder, [&](uint64_t done, uint64_t total) { progress.update(done, total); });
  }
  const std::string page = makePage({facts, plots, pictures, !arguments.no_images, folder, commandLine(arguments)});
  const fs::path page_path = fs::path(folder) / "report.html";
  std::ofstream file(page_path, std::ios::binary);
  file << page;
  file.close();
  if (!file) {
    throw StudyError(page_path.string() + ": cannot be written (disk full?)");
  }

  for (const auto* problems : {&plots.problems, &pictures.problems}) {
    for (const std::string& problem : *problems) std::fprintf(stderr, "forelock: %s\n", problem.c_str());
  }
  if (!pictures.missing.empty()) {
    std::fprintf(stderr, "forelock: %s: %zu pictures are missing, the first is %s; the report names them all\n", arguments.study.c_str(),
                 pictures.missing.size(), pictures.missing.front().c_str());
  }
  if (plots.no_gnuplot) {
    std::fprintf(stderr, "forelock: gnuplot was not found, so no plot was drawn; install the Debian package gnuplot-nox and run this again\n");
  }
  size_t image_count = pictures.layers.size();
  for (const PictureGroup& group : pictures.groups) image_count += 1 + (group.forward.empty() ? 0 : 1) + 3 * group.methods.size();
  std::printf("%s: %s, %zu rows, %zu of them doubtful; %zu plots, %zu pictures\n", page_path.c_str(), readableBytes(page.size()).c_str(),
              facts.liveRows().size(), facts.doubtfulRows().size(), plots.drawn.size(), image_count);
  return plots.no_gnuplot ? kFailed : kDone;
}

}  // namespace

void addReportCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("report", "Make plots, pictures and a page of a study's measurements.");
  auto arguments = std::make_shared<ReportArguments>();
  command->add_option("DIR", arguments->study, "The folder that forelock-study wrote")->required();
  command->add_option("--error", arguments->error, "Which error plots show, a column of study.csv [rmse_exact]")
      ->check(CLI::IsMember(errorColumns()))->type_name("COLUMN");
  command->add_option("--out", arguments->out, "Where to write [DIR]")->type_name("DIR2");
  command->add_flag("--no-images", arguments->no_images, "No pictures, only plots and numbers");
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runReport(*arguments); });
}

}  // namespace forelock::samples
