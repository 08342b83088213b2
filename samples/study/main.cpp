// `forelock-study`: error against run time. SPDX-License-Identifier: MIT
#include "runner.h"

#include <cstdio>
#include <exception>

namespace {

constexpr const char* kDescription =
    "forelock-study measures error against run time of every method: on any asset, on any device, each row against a\n"
    "float64 reference and in pairs with core_tail.";

std::string typed(int argc, char** argv) {
  std::string command = "forelock-study";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace forelock::study;
  CLI::App program(kDescription, "forelock-study");
  Arguments arguments;
  addOptions(program, arguments);
  if (argc < 2) {
    std::fputs(program.help().c_str(), stderr);
    return 2;
  }
  try {
    program.parse(argc, argv);
    Options options = checkOptions(arguments);
    options.command = typed(argc, argv);
    return runStudy(options);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help
    std::fprintf(stderr, "forelock-study: %s; `forelock-study --help` explains\n", error.what());
    return 2;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "forelock-study: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forelock-study: %s\n", error.what());
    return 1;
  }
}
