#include "command_run.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace forelock::test {

namespace fs = std::filesystem;

namespace {

struct Scratch {
  Scratch() : path(fs::temp_directory_path() / ("forelock-command-" + std::to_string(getpid()))) {
    fs::create_directories(path);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

}  // namespace

fs::path scratchFolder() {
  static const Scratch scratch;
  return scratch.path;
}

std::string readAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

CommandRun runCommand(const std::string& arguments, const std::string& environment) {
  const fs::path out = scratchFolder() / "stdout", err = scratchFolder() / "stderr";
  const std::string line = environment + "\"" FORELOCK_PROGRAM "\" " + arguments + " >\"" + out.string() + "\" 2>\"" +
                           err.string() + "\"";
  const int raw = std::system(line.c_str());
  CommandRun run;
  run.status = raw != -1 && WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
  run.out = readAll(out);
  run.err = readAll(err);
  return run;
}

std::string writeScratch(const std::string& name, const std::string& text) {
  const fs::path path = scratchFolder() / name;
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

std::string smallRecipe() {
  return writeScratch("small.json", R"({"strands": 300, "vertices": 8, "length": {"mean": 0.15},
    "width": {"root": 0.001}, "cameras": [{"name": "side", "eye": [1, 0, 0], "target": [0, 0, 0], "vertical_fov": 30,
    "width": 60, "height": 40}]})");
}

}  // namespace forelock::test
