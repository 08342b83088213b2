// The `forelock` command. SPDX-License-Identifier: MIT
#include "commands.h"

#ifdef FORELOCK_VIEWER
#include "view_command.h"
#endif

#include <cstdio>
#include <exception>

namespace {

constexpr const char* kDescription =
    "Forelock draws, checks, converts and makes strand hair.\n\n"
    "An ASSET is a strand file (.tfx, .hair, .ply, .gltf, .glb, .flk, .data), a groom recipe (.json) or groom:NAME for a recipe that comes with\n"
    "Forelock; `forelock groom --list` names them.";

constexpr const char* kExamples =
    "Examples:\n"
    "  forelock preview groom:long-wavy -o hair.png     a picture, framed and lit by itself\n"
    "  forelock view groom:long-wavy                    a window: turn it, light it, compare methods, see what they cost\n"
    "  forelock plan groom:long-wavy             the passes and bytes that it takes; needs no device\n"
    "  forelock inspect pony.tfx                 what is in a file, and what is wrong with it\n"
    "  forelock convert pony.tfx pony.hair       another format; says what is lost\n"
    "  forelock diff old.tfx new.tfx             the same hair in another unit? and where it differs\n"
    "  forelock groom long-wavy hair.hair        write a procedural groom to a strand file\n"
    "  forelock report study                     plots, pictures and a page of what forelock-study measured\n\n"
    "Exit status: 0 done; 1 the asset or a check failed; 2 wrong usage; 3 no usable device.\n"
    "Each subcommand has its own --help.";

}  // namespace

int main(int argc, char** argv) {
  using namespace forelock::samples;
  CLI::App program(kDescription, "forelock");
  program.footer(kExamples);
  program.require_subcommand(1);
  program.set_version_flag("--version", [] {
    const uint32_t version = flkGetVersion();
    return "forelock " + std::to_string(version >> 22) + "." + std::to_string((version >> 12) & 0x3ff) + "." +
           std::to_string(version & 0xfff);
  });
  int exit_code = kDone;
  addPreviewCommand(program, exit_code);
  addPlanCommand(program, exit_code);
  addInspectCommand(program, exit_code);
  addConvertCommand(program, exit_code);
  addDiffCommand(program, exit_code);
  addGroomCommand(program, exit_code);
  addReportCommand(program, exit_code);
#ifdef FORELOCK_VIEWER
  addViewCommand(program, exit_code);
#endif

  if (argc < 2) {
    std::fputs(program.help().c_str(), stderr);
    return kUsage;
  }
  try {
    program.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      return program.exit(error);
    }
    if (program.get_subcommands().empty() && argv[1][0] != '-') {
      std::fprintf(stderr, "forelock: %s is no subcommand; `forelock --help` names them\n", argv[1]);
      return kUsage;
    }
    std::string command = "forelock";
    for (const CLI::App* chosen : program.get_subcommands()) {
      command += " " + chosen->get_name();
    }
    std::fprintf(stderr, "forelock: %s; `%s --help` explains\n", error.what(), command.c_str());
    return kUsage;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "forelock: %s\n", error.what());
    return kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forelock: %s\n", error.what());
    return kFailed;
  }
}
