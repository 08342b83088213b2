// Widgets of the viewer's panels: each has words that teach on hover, and a name by which a script finds it. SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace forelock::samples::ui {

struct Item {
  std::string name;   // "Section/Label", "Section/Label/Option" of an open list
  ImVec2 low, high;   // where it is in the window
  bool open = false;  // of a section, a list or a menu
  bool menu = false;  // of the menu bar
};

// Starts a frame. Items are noted for scripts only.
void begin(bool note);
const std::vector<Item>& items();
// The next frame scrolls this item into view.
void reveal(const std::string& name);
void noteItem(const std::string& label, bool open = false, bool menu = false);  // the last widget of Dear ImGui

class Section {  // a heading that opens and closes
public:
  Section(const char* label, bool open_at_first, const char* tip);
  ~Section();
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  explicit operator bool() const { return open_; }

private:
  bool open_;
};

class Scope {  // names below it begin with this
public:
  explicit Scope(const std::string& name);
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
};

// Each true when the person changed it.
bool button(const char* label, const char* tip, bool enabled = true);
bool smallButton(const char* label, const char* tip);
bool checkbox(const char* label, bool& value, const char* tip);
bool choose(const char* label, uint32_t& index, const std::vector<std::string>& names, const char* tip,
            const std::vector<const char*>& tips = {});  // of the list, of its lines
bool slide(const char* label, double& value, double low, double high, const char* tip, const char* format = "%.3g", bool logarithmic = false);
bool slide(const char* label, float& value, double low, double high, const char* tip, const char* format = "%.3g", bool logarithmic = false);
bool slide(const char* label, uint32_t& value, uint32_t low, uint32_t high, const char* tip);
bool color(const char* label, float linear[3], const char* tip);  // shown and picked in sRGB
bool selectable(const std::string& label, bool selected);
bool menuItem(const char* label, const char* keys, bool enabled = true);
bool menuCheck(const char* label, const char* keys, bool& value);
bool nameInput(const char* label, std::string& text, const char* tip);  // true on Enter
void tip(const char* text);      // of the last widget
void text(const std::string& words);         // wrapped
void faintText(const std::string& words);    // wrapped, in grey
void fact(const char* name, const std::string& value);  // a line of two columns

}  // namespace forelock::samples::ui
