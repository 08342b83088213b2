// Runs build/forelock and keeps what it says.
#pragma once

#include <filesystem>
#include <string>

namespace forelock::test {

struct CommandRun {
  int status = -1;  // what it exited with; -1: it did not exit by itself
  std::string out, err;
};

// `arguments` as a shell reads them; `environment` like "NAME=value ".
CommandRun runCommand(const std::string& arguments, const std::string& environment = {});

// A folder of this process, emptied at the start and removed at the end.
std::filesystem::path scratchFolder();

// A file in the scratch folder. Gives its path.
std::string writeScratch(const std::string& name, const std::string& text);

std::string readAll(const std::filesystem::path& path);

// A recipe that grows in a few milliseconds.
std::string smallRecipe();

}  // namespace forelock::test
