// Drives the viewer as a person would, from a text file: for tests, and for the pictures of its manual. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

// What a script asks of the viewer that is no input of a person's.
struct ScriptAction {
  enum class Kind { resize, minimise, restore, drop, window_picture, picture, lose_device, copy_command } kind;
  std::string text;
  int width = 0, height = 0;
};

class ViewScript {
public:
  ViewScript() = default;
  // Throws std::runtime_error with the line that is wrong.
  explicit ViewScript(const std::string& path);

  bool active() const { return active_; }
  bool done() const { return active_ && at_ >= steps_.size() && pending_.empty(); }
  // Puts this frame's mouse and keys into Dear ImGui, between its back end's new frame and its own. `settled`: nothing is loading, and the
  // picture is the full one.
  void drive(bool settled);
  std::optional<ScriptAction> takeAction();
  const std::vector<std::string>& failures() const { return failures_; }
  uint32_t clicks() const { return clicks_; }

private:
  struct Step {
    int line = 0;
    std::string verb;
    std::vector<std::string> words;
    std::string rest;
  };
  struct Input {  // of one frame
    float x = -1.0f, y = -1.0f;
    bool down[3] = {};
    float wheel = 0.0f;
    int key = 0;
    bool ctrl = false, shift = false;
    std::string text;
    std::string find;   // go to the middle of this item first
    bool wait = false;  // until settled
  };
  void begin(const Step& step);
  void clickAt(float x, float y);
  void clickItem(const std::string& name);
  void walkNext();
  bool place(Input& input);
  void fail(const std::string& text);

  bool active_ = false;
  std::vector<Step> steps_;
  size_t at_ = 0;
  std::vector<Input> pending_;
  std::vector<ScriptAction> actions_;
  std::vector<std::string> failures_, walked_;
  bool walking_ = false;
  std::string walk_only_;
  Input held_;
  int key_down_ = 0, tries_ = 0;
  float seen_x_ = 0.0f, seen_y_ = 0.0f;
  uint32_t clicks_ = 0;
  int line_ = 0;
};

}  // namespace forelock::samples
