// SPDX-License-Identifier: MIT
#include "x11_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace forelock::view_test {

Process::Process(const std::vector<std::string>& words, const std::string& log, int kept) : log_(log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (out < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || dup2(in, 0) < 0) {
      _exit(126);
    }
    if (kept >= 0) {
      fcntl(kept, F_SETFD, 0);
    }
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  if (pid_ < 0) {
    throw Failure(words[0] + " could not be started");
  }
}

Process::~Process() { kill(); }

bool Process::ended() {
  if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) {
    ended_ = true;
  }
  return ended_;
}

bool Process::bySignal() const { return WIFSIGNALED(status_); }
int Process::exitStatus() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

std::string Process::ending() const {
  return bySignal() ? "signal " + std::to_string(WTERMSIG(status_)) : "exit status " + std::to_string(exitStatus());
}

void Process::kill() {
  if (!ended()) {
    ::kill(pid_, SIGKILL);
    waitpid(pid_, &status_, 0);
    ended_ = true;
  }
}

void Process::freeze(bool on) { ::kill(pid_, on ? SIGSTOP : SIGCONT); }

double Process::cpu_s() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) {
    return 0.0;
  }
  std::istringstream rest(text.substr(name_end + 1));
  std::string word;
  double ticks = 0.0;
  for (int field = 3; field <= 15 && rest >> word; ++field) {  // proc(5): 14 is utime, 15 stime
    ticks += field >= 14 ? std::stod(word) : 0.0;
  }
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::string Process::said() const {
  std::ifstream file(log_);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace forelock::view_test
