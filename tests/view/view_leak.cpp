// `forelock view` alone, linked with LeakSanitizer. SPDX-License-Identifier: MIT
#include "view_command.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  CLI::App program("forelock view", "forelock");
  int exit_code = 0;
  forelock::samples::addViewCommand(program, exit_code);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forelock: %s\n", error.what());
    return 1;
  }
  return exit_code;
}
