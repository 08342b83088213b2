// SPDX-License-Identifier: MIT
#include "view_script.h"

#include "ui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace forelock::samples {

namespace {

constexpr int kMostTries = 200;  // frames until an item that is to be clicked must have appeared

const std::map<std::string, int>& keyNames() {
  static const std::map<std::string, int> names = [] {
    std::map<std::string, int> map{{"escape", GLFW_KEY_ESCAPE}, {"enter", GLFW_KEY_ENTER}, {"tab", GLFW_KEY_TAB}, {"space", GLFW_KEY_SPACE}};
    for (int i = 0; i < 26; ++i) {
      map[std::string(1, static_cast<char>('a' + i))] = GLFW_KEY_A + i;
    }
    for (int i = 0; i < 10; ++i) {
      map[std::string(1, static_cast<char>('0' + i))] = GLFW_KEY_0 + i;
    }
    for (int i = 1; i <= 12; ++i) {
      map[std::string("f") + std::to_string(i)] = GLFW_KEY_F1 + i - 1;
    }
    return map;
  }();
  return names;
}

struct Verb {
  size_t least_words, most_words;
};
const std::map<std::string, Verb> kVerbs{{"wait", {0, 0}},     {"frames", {1, 1}},  {"click", {1, 99}},   {"click-at", {2, 2}}, {"drag", {4, 6}},
                                         {"wheel", {1, 3}},    {"key", {1, 3}},     {"type", {1, 99}},    {"resize", {2, 2}},   {"minimise", {0, 0}},
                                         {"restore", {0, 0}},  {"drop", {1, 99}},   {"shot", {1, 1}},     {"picture", {1, 1}},  {"walk", {1, 99}},
                                         {"lose-device", {0, 0}}, {"move", {2, 2}}, {"command", {1, 1}}};

}  // namespace

ViewScript::ViewScript(const std::string& path) : active_(true) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error(path + ": cannot be read");
  }
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line);
    Step step;
    step.line = number;
    if (!(words >> step.verb) || step.verb[0] == '#') {
      continue;
    }
    std::getline(words >> std::ws, step.rest);
    std::istringstream rest(step.rest);
    for (std::string word; rest >> word;) {
      step.words.push_back(word);
    }
    const auto verb = kVerbs.find(step.verb);
    if (verb == kVerbs.end() || step.words.size() < verb->second.least_words || step.words.size() > verb->second.most_words) {
      throw std::runtime_error(path + ", line " + std::to_string(number) + ": \"" + line + "\" is no step; docs/viewer.md has them");
    }
    steps_.push_back(step);
  }
}

void ViewScript::fail(const std::string& text) { failures_.push_back(std::string("line ") + std::to_string(line_) + ": " + text); }

std::optional<ScriptAction> ViewScript::takeAction() {
  if (actions_.empty()) {
    return std::nullopt;
  }
  const ScriptAction action = actions_.front();
  actions_.erase(actions_.begin());
  return action;
}

void ViewScript::clickAt(float x, float y) {
  for (int i = 0; i < 3; ++i) {  // there, down, up
    Input input;
    input.x = x;
    input.y = y;
    input.down[0] = i == 1;
    pending_.push_back(input);
  }
  ++clicks_;
}

void ViewScript::clickItem(const std::string& name) {
  Input find;
  find.find = name;
  pending_.push_back(find);
}

// Every item of the panels that is there, once: those that appear by a click too. What would leave the viewer or ask for a file is left.
void ViewScript::walkNext() {
  static const char* const kLeft[] = {"Quit", "Open...", "Add...", "Add to scene...", "Open a scene...", "Open scene...", "Save scene...", "Save picture...",
                                      "Save the scene...", "Save the picture...", "Add a mesh...", "Remove", "Turntable/", "V-sync",
                                      "UI scale", "Recent", "Open a groom"};
  // A click closes a menu: it is opened again for each of its lines.
  const auto menu = std::find_if(ui::items().begin(), ui::items().end(), [&](const ui::Item& item) { return item.menu && item.name == walk_only_; });
  if (menu != ui::items().end() && !menu->open) {
    clickItem(walk_only_);
    pending_.insert(pending_.end(), 3, held_);  // until it is open
    return;
  }
  for (const ui::Item& item : ui::items()) {
    const bool leave = std::any_of(std::begin(kLeft), std::end(kLeft), [&](const char* part) { return item.name.find(part) != std::string::npos; });
    const bool wanted = walk_only_.empty() || item.name.rfind(walk_only_, 0) == 0;
    if (leave || !wanted || item.menu || item.name.rfind("Second/", 0) == 0 ||
        std::find(walked_.begin(), walked_.end(), item.name) != walked_.end()) {
      continue;
    }
    walked_.push_back(item.name);
    if (item.open && item.name.find('/') == std::string::npos) {
      continue;  // a section that is open stays so
    }
    clickItem(item.name);
    return;
  }
  if (menu != ui::items().end()) {
    clickItem(walk_only_);  // shuts it
  }
  walking_ = false;
}

void ViewScript::begin(const Step& step) {
  line_ = step.line;
  const auto number = [&](size_t i) { return std::strtof(step.words[i].c_str(), nullptr); };
  const auto act = [&](ScriptAction::Kind kind) { actions_.push_back({kind, step.rest, 0, 0}); };
  if (step.verb == "wait") {
    Input input = held_;
    input.wait = true;
    pending_.push_back(input);
  } else if (step.verb == "frames") {
    pending_.insert(pending_.end(), static_cast<size_t>(std::clamp(number(0), 0.0f, 1e5f)), held_);
  } else if (step.verb == "click") {
    clickItem(step.rest);
  } else if (step.verb == "click-at") {
    clickAt(number(0), number(1));
  } else if (step.verb == "move") {
    Input input;
    input.x = number(0);
    input.y = number(1);
    pending_.insert(pending_.end(), 2, input);
  } else if (step.verb == "drag") {
    const int frames = step.words.size() > 4 ? static_cast<int>(std::clamp(number(4), 2.0f, 1e4f)) : 10;
    const int which = step.words.size() > 5 ? static_cast<int>(std::clamp(number(5), 0.0f, 2.0f)) : 0;
    for (int i = 0; i <= frames + 1; ++i) {
      const float t = std::clamp(static_cast<float>(i) / static_cast<float>(frames), 0.0f, 1.0f);
      Input input;
      input.x = number(0) + t * (number(2) - number(0));
      input.y = number(1) + t * (number(3) - number(1));
      input.down[which] = i > 0 && i <= frames;
      pending_.push_back(input);
    }
  } else if (step.verb == "wheel") {
    Input input = held_;
    if (step.words.size() == 3) {
      input.x = number(1);
      input.y = number(2);
    }
    input.wheel = number(0);
    pending_.push_back(input);
  } else if (step.verb == "key") {
    Input input = held_;
    for (const std::string& word : step.words) {
      input.ctrl = input.ctrl || word == "ctrl";
      input.shift = input.shift || word == "shift";
      const auto key = keyNames().find(word);
      input.key = key != keyNames().end() ? key->second : input.key;
    }
    if (input.key == 0) {
      fail("no key is called " + step.rest);
    }
    pending_.push_back(input);
    Input up = held_;
    pending_.push_back(up);
  } else if (step.verb == "type") {
    Input input = held_;
    input.text = step.rest;
    pending_.push_back(input);
  } else if (step.verb == "walk") {
    walking_ = true;
    walk_only_ = step.rest;
    walked_.clear();
  } else if (step.verb == "resize") {
    actions_.push_back({ScriptAction::Kind::resize, "", static_cast<int>(number(0)), static_cast<int>(number(1))});
  } else if (step.verb == "minimise") {
    act(ScriptAction::Kind::minimise);
  } else if (step.verb == "restore") {
    act(ScriptAction::Kind::restore);
  } else if (step.verb == "drop") {
    act(ScriptAction::Kind::drop);
  } else if (step.verb == "shot") {
    act(ScriptAction::Kind::window_picture);
  } else if (step.verb == "picture") {
    act(ScriptAction::Kind::picture);
  } else if (step.verb == "command") {
    act(ScriptAction::Kind::copy_command);
  } else if (step.verb == "lose-device") {
    act(ScriptAction::Kind::lose_device);
  }
}

// False: the item is not there yet; it is asked to scroll into view.
bool ViewScript::place(Input& input) {
  const std::vector<ui::Item>& items = ui::items();
  const auto found = std::find_if(items.begin(), items.end(), [&](const ui::Item& item) { return item.name == input.find; });
  if (found == items.end() || found->high.x <= found->low.x) {
    return false;
  }
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float x = found->low.x + std::min(0.5f * (found->high.x - found->low.x), 20.0f), y = 0.5f * (found->low.y + found->high.y);
  const bool rests = std::abs(x - seen_x_) < 0.5f && std::abs(y - seen_y_) < 0.5f;  // what is above it may just have opened
  seen_x_ = x;
  seen_y_ = y;
  const float top = found->menu ? 0.0f : 24.0f;  // below the menu bar
  if (tries_ == 0 || x < 0.0f || y < top || x >= whole.x || y >= whole.y - 24.0f) {
    ui::reveal(input.find);
    return false;
  }
  if (tries_ < 3 || !rests) {
    return false;
  }
  input.x = x;
  input.y = y;
  return true;
}

void ViewScript::drive(bool settled) {
  if (!active_) {
    return;
  }
  if (pending_.empty() && actions_.empty()) {
    if (walking_) {
      walkNext();
    } else if (at_ < steps_.size()) {
      begin(steps_[at_++]);
    }
  }
  ImGuiIO& io = ImGui::GetIO();
  Input input = held_;
  if (!pending_.empty()) {
    Input& next = pending_.front();
    if (!next.find.empty()) {
      if (place(next)) {
        const Input at = next;
        pending_.erase(pending_.begin());
        tries_ = 0;
        const std::vector<Input> after = std::move(pending_);
        pending_.clear();
        clickAt(at.x, at.y);
        pending_.insert(pending_.end(), after.begin(), after.end());
      } else if (++tries_ > (walking_ ? 10 : kMostTries)) {
        if (!walking_) {
          fail("nothing is called " + next.find);
        }
        pending_.erase(pending_.begin());
        tries_ = 0;
      }
    } else if (!next.wait || settled) {
      input = next;
      pending_.erase(pending_.begin());
    }
  }
  held_.x = input.x;
  held_.y = input.y;
  io.MousePos = input.x >= 0.0f ? ImVec2(input.x, input.y) : ImVec2(-FLT_MAX, -FLT_MAX);
  for (int i = 0; i < 3; ++i) {
    io.MouseDown[i] = input.down[i];
  }
  io.MouseWheel = input.wheel;
  if (key_down_ != 0) {
    io.KeysDown[key_down_] = false;
    key_down_ = 0;
  }
  io.KeyCtrl = input.ctrl;
  io.KeyShift = input.shift;
  io.KeyAlt = io.KeySuper = false;
  io.KeysDown[GLFW_KEY_LEFT_CONTROL] = input.ctrl;
  io.KeysDown[GLFW_KEY_LEFT_SHIFT] = input.shift;
  if (input.key != 0) {
    io.KeysDown[input.key] = true;
    key_down_ = input.key;
  }
  if (!input.text.empty()) {
    io.AddInputCharactersUTF8(input.text.c_str());
  }
}

}  // namespace forelock::samples
