// SPDX-License-Identifier: MIT
#include "gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace forelock::samples {

GnuplotResult runGnuplot(const std::string& folder, const std::string& script, std::string& complaint) {
  const std::filesystem::path log = std::filesystem::path(folder) / (script + ".log");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot", settings = "--default-settings", argument = script;
  char* arguments[] = {program.data(), settings.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  std::error_code ignored;
  if (error != 0) {
    std::filesystem::remove(log, ignored);
    complaint = std::generic_category().message(error);
    return error == ENOENT || error == EACCES ? GnuplotResult::not_found : GnuplotResult::failed;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::ifstream file(log);
  const std::string said{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  file.close();
  std::filesystem::remove(log, ignored);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return GnuplotResult::done;
  }
  // The last line that is not empty says what is wrong; those before it show the place.
  const size_t end = said.find_last_not_of(" \n"), begin = end == std::string::npos ? end : said.rfind('\n', end);
  complaint = end == std::string::npos ? "it ended without a word"
                                       : said.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin + 1) + 1);
  return GnuplotResult::failed;
}

}  // namespace forelock::samples
