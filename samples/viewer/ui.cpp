// SPDX-License-Identifier: MIT
#include "ui.h"

#include "image.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace forelock::samples::ui {

namespace {

constexpr float kTipAfter_s = 0.4f;

struct Notes {
  std::vector<Item> items;
  std::string prefix, wanted;
  bool note = false;
};
Notes notes;  // Dear ImGui has one context, and so has this

// The prefix without its last part.
void shorten() {
  const size_t cut = notes.prefix.size() < 2 ? std::string::npos : notes.prefix.rfind('/', notes.prefix.size() - 2);
  notes.prefix.resize(cut == std::string::npos ? 0 : cut + 1);
}

// Labels stand left of their widgets' end, so that long ones are not cut.
void labelWidth() { ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f); }

}  // namespace

void begin(bool note) {
  notes.items.clear();
  notes.prefix.clear();
  notes.note = note;
}

const std::vector<Item>& items() { return notes.items; }
void reveal(const std::string& name) { notes.wanted = name; }

void noteItem(const std::string& label, bool open, bool menu) {
  if (!notes.note) {
    return;
  }
  const std::string name = notes.prefix + label.substr(0, label.find("##"));
  notes.items.push_back({name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), open, menu});
  if (name == notes.wanted) {
    notes.wanted.clear();
    ImGui::SetScrollHereY(0.5f);
  }
}

Section::Section(const char* label, bool open_at_first, const char* words) {
  open_ = ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  tip(words);
  noteItem(label, open_);
  notes.prefix += std::string(label) + "/";
  ImGui::PushID(label);
  if (open_) {
    ImGui::Indent(4.0f);
  }
}

Section::~Section() {
  if (open_) {
    ImGui::Unindent(4.0f);
    ImGui::Spacing();
  }
  ImGui::PopID();
  shorten();
}

Scope::Scope(const std::string& name) {
  notes.prefix += name + "/";
  ImGui::PushID(name.c_str());
}

Scope::~Scope() {
  ImGui::PopID();
  shorten();
}

void tip(const char* words) {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const bool rests = context.HoveredId == 0 || context.HoveredIdTimer > kTipAfter_s;
  if (words && *words && rests && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) && !ImGui::IsItemActive()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
    ImGui::TextUnformatted(words);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

bool button(const char* label, const char* words, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label);
  ImGui::EndDisabled();
  tip(words);
  noteItem(label);
  return pressed;
}

bool smallButton(const char* label, const char* words) {
  const bool pressed = ImGui::SmallButton(label);
  tip(words);
  noteItem(label);
  return pressed;
}

bool checkbox(const char* label, bool& value, const char* words) {
  const bool changed = ImGui::Checkbox(label, &value);
  tip(words);
  noteItem(label);
  return changed;
}

bool choose(const char* label, uint32_t& index, const std::vector<std::string>& names, const char* words,
            const std::vector<const char*>& line_words) {
  labelWidth();
  const char* shown = index < names.size() ? names[index].c_str() : "?";
  const bool open = ImGui::BeginCombo(label, shown, ImGuiComboFlags_HeightLarge);
  if (!open) {
    tip(words);
  }
  noteItem(label, open);
  bool changed = false;
  if (open) {
    {
      const Scope scope(std::string(label).substr(0, std::string(label).find("##")));
      for (uint32_t i = 0; i < names.size(); ++i) {
        if (selectable(names[i], i == index)) {
          changed = i != index;
          index = i;
        }
        tip(i < line_words.size() ? line_words[i] : nullptr);
      }
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool slide(const char* label, double& value, double low, double high, const char* words, const char* format, bool logarithmic) {
  labelWidth();
  const ImGuiSliderFlags flags = logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  const bool changed = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format, flags | ImGuiSliderFlags_AlwaysClamp);
  tip(words);
  noteItem(label);
  return changed;
}

bool slide(const char* label, float& value, double low, double high, const char* words, const char* format, bool logarithmic) {
  double wide = static_cast<double>(value);
  const bool changed = slide(label, wide, low, high, words, format, logarithmic);
  if (changed) {
    value = static_cast<float>(wide);
  }
  return changed;
}

bool slide(const char* label, uint32_t& value, uint32_t low, uint32_t high, const char* words) {
  labelWidth();
  const bool changed = ImGui::SliderScalar(label, ImGuiDataType_U32, &value, &low, &high, "%u", ImGuiSliderFlags_AlwaysClamp);
  tip(words);
  noteItem(label);
  return changed;
}

bool color(const char* label, float linear[3], const char* words) {
  float coded[3] = {encodeSrgb(linear[0]), encodeSrgb(linear[1]), encodeSrgb(linear[2])};
  labelWidth();
  const bool changed = ImGui::ColorEdit3(label, coded, ImGuiColorEditFlags_DisplayHex);
  if (changed) {
    for (int i = 0; i < 3; ++i) {
      linear[i] = decodeSrgb(coded[i]);
    }
  }
  tip(words);
  noteItem(label);
  return changed;
}

bool selectable(const std::string& label, bool selected) {
  const bool pressed = ImGui::Selectable(label.c_str(), selected);
  if (selected) {
    ImGui::SetItemDefaultFocus();
  }
  noteItem(label);
  return pressed;
}

bool menuItem(const char* label, const char* keys, bool enabled) {
  const bool pressed = ImGui::MenuItem(label, keys, false, enabled);
  noteItem(label);
  return pressed;
}

bool menuCheck(const char* label, const char* keys, bool& value) {
  const bool pressed = ImGui::MenuItem(label, keys, &value);
  noteItem(label);
  return pressed;
}

bool nameInput(const char* label, std::string& value, const char* words) {
  const bool entered = ImGui::InputText(label, &value, ImGuiInputTextFlags_EnterReturnsTrue);
  tip(words);
  noteItem(label);
  return entered;
}

void text(const std::string& words) { ImGui::TextWrapped("%s", words.c_str()); }

void faintText(const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", words.c_str());
  ImGui::PopStyleColor();
}

void fact(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(ImGui::GetFontSize() * 8.5f);
  ImGui::TextWrapped("%s", value.c_str());
}

}  // namespace forelock::samples::ui
