// A dialogue that asks for a file, inside the window. SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

class FileBrowser {
public:
  // `offer` tells which files are shown at first. A name to start with makes it ask where to write, and gives
  // names without an extension its own; `ask` before a file is written over.
  void open(const std::string& title, const std::string& folder, std::function<bool(const std::string&)> offer, const std::string& name = {},
            bool ask = true);
  bool isOpen() const { return open_; }
  // Draws it; the path once one is chosen.
  std::optional<std::string> draw();
  const std::string& folder() const { return folder_; }

private:
  struct Entry {
    std::string name;
    bool folder = false, offered = false;
    uintmax_t bytes = 0;
  };
  void go(const std::string& folder);

  std::string title_, folder_, name_, suffix_, typed_, problem_, overwrite_;
  std::function<bool(const std::string&)> offer_;
  std::vector<Entry> entries_;
  double entered_s_ = 0.0;  // when a folder was opened
  bool open_ = false, saving_ = false, all_ = false, opening_ = false, ask_ = true;
};

}  // namespace forelock::samples
