// A program that a test starts, watches and ends. SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::view_test {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Process {
public:
  // What it says goes to `log`. `kept` is a descriptor of ours that it is to have too, -1: none. It ends with the test.
  Process(const std::vector<std::string>& words, const std::string& log, int kept = -1);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  bool ended();                     // does not wait
  std::string ending() const;       // "exit status 0", "signal 11"; after it has ended
  bool bySignal() const;
  int exitStatus() const;           // -1: by a signal
  void kill();                      // at once, and waits
  void freeze(bool on);             // it does nothing meanwhile, as in a frame that takes long
  double cpu_s() const;             // user and system time of all its threads so far
  std::string said() const;         // its log

private:
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string log_;
};

}  // namespace forelock::view_test
