// SPDX-License-Identifier: MIT
#include "file_browser.h"

#include "commands.h"
#include "ui.h"

#include <algorithm>
#include <filesystem>

namespace forelock::samples {

namespace fs = std::filesystem;

void FileBrowser::open(const std::string& title, const std::string& folder, std::function<bool(const std::string&)> offer,
                       const std::string& name, bool ask) {
  title_ = title;
  ask_ = ask;
  suffix_ = fs::path(name).extension().string();
  offer_ = std::move(offer);
  name_ = name;
  saving_ = !name.empty();
  all_ = false;
  open_ = opening_ = true;
  overwrite_.clear();
  std::error_code error;
  go(folder.empty() || !fs::is_directory(folder, error) ? fs::current_path(error).string() : folder);
}

void FileBrowser::go(const std::string& folder) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(folder, error);
  std::vector<Entry> entries;
  fs::directory_iterator it(path, fs::directory_options::skip_permission_denied, error);
  if (error) {
    problem_ = path.string() + ": " + error.message();
    return;
  }
  problem_.clear();
  for (; it != fs::directory_iterator(); it.increment(error)) {
    Entry entry;
    entry.name = it->path().filename().string();
    if (entry.name.empty() || entry.name[0] == '.') {
      continue;
    }
    std::error_code ignored;
    entry.folder = it->is_directory(ignored);
    entry.offered = !entry.folder && offer_(entry.name);
    entry.bytes = entry.folder ? 0 : it->file_size(ignored);
    entries.push_back(std::move(entry));
    if (error) {
      break;
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
  entries_ = std::move(entries);
  folder_ = path.string();
  typed_ = folder_;
}

std::optional<std::string> FileBrowser::draw() {
  std::optional<std::string> chosen;
  if (!open_) {
    return chosen;
  }
  if (opening_) {
    ImGui::OpenPopup("File##browser");
    opening_ = false;
  }
  const ImVec2 whole = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(whole.x * 0.9f, ImGui::GetFontSize() * 46.0f), std::min(whole.y * 0.85f, ImGui::GetFontSize() * 36.0f)));
  if (!ImGui::BeginPopupModal("File##browser", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoTitleBar)) {
    open_ = false;
    return chosen;
  }
  std::optional<ui::Scope> scope(std::in_place, "Files");
  const auto finish = [&](const std::string& path) {
    chosen = path;
    open_ = false;
    ImGui::CloseCurrentPopup();
  };
  ImGui::TextUnformatted(title_.c_str());
  if (ui::button("Up", "The folder above")) {
    go(fs::path(folder_).parent_path().string());
  }
  ImGui::SameLine();
  if (const char* home = std::getenv("HOME"); home && *home) {
    if (ui::button("Home", home)) {
      go(home);
    }
    ImGui::SameLine();
  }
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputText("##path", typed_.data(), typed_.capacity() + 1, ImGuiInputTextFlags_CallbackResize | ImGuiInputTextFlags_EnterReturnsTrue,
                       [](ImGuiInputTextCallbackData* data) {
                         if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
                           auto* text = static_cast<std::string*>(data->UserData);
                           text->resize(static_cast<size_t>(data->BufTextLen));
                           data->Buf = text->data();
                         }
                         return 0;
                       },
                       &typed_)) {
    std::error_code error;
    if (fs::is_directory(typed_, error)) {
      go(typed_);
    } else if (fs::exists(typed_, error) && !saving_) {
      finish(typed_);
    } else {
      problem_ = typed_ + ": there is no such file or folder";
    }
  }
  ui::noteItem("Path");
  ui::tip("A folder or a file can be written here");
  if (!problem_.empty()) {
    ImGui::TextColored(ImVec4(1.0f, 0.5f, 0.3f, 1.0f), "%s", problem_.c_str());
  }
  const float below = ImGui::GetFrameHeightWithSpacing() * (saving_ ? 3.4f : 1.4f);
  ImGui::BeginChild("##files", ImVec2(0.0f, -below), true);
  std::string enter;
  for (const Entry& entry : entries_) {
    if (!entry.folder && !entry.offered && !all_) {
      continue;
    }
    const bool pressed = ImGui::Selectable((entry.folder ? entry.name + "/" : entry.name).c_str(), !entry.folder && entry.name == name_,
                                           ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick);
    ui::noteItem(entry.folder ? entry.name + "/" : entry.name);
    if (!entry.folder) {
      const std::string size = readableBytes(entry.bytes);
      ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
      ImGui::TextUnformatted(size.c_str());
    }
    if (pressed && entry.folder) {
      enter = (fs::path(folder_) / entry.name).string();
    } else if (pressed) {
      name_ = entry.name;
      if (!saving_ && ImGui::IsMouseDoubleClicked(0) &&
          ImGui::GetTime() - entered_s_ > 0.5) {  // else its first click was on the folder that was there
        finish((fs::path(folder_) / entry.name).string());
      }
    }
  }
  if (!enter.empty()) {
    entered_s_ = ImGui::GetTime();
    go(enter);
  }
  ImGui::EndChild();
  const bool bare = saving_ && !name_.empty() && !fs::path(name_).has_extension();
  const std::string path = (fs::path(folder_) / (bare ? name_ + suffix_ : name_)).string();
  std::error_code error;
  const bool usable = !name_.empty() && !fs::is_directory(path, error);
  bool confirm = false;
  if (saving_) {
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.7f);
    if (ImGui::IsWindowAppearing()) {
      ImGui::SetKeyboardFocusHere();
    }
    const bool entered = ui::nameInput("Name", name_, "Of the file to write");
    confirm = ask_ && overwrite_ == path && fs::exists(path, error);
    if (confirm) {  // Cancel is where Save was, so that a second click does no harm
      ImGui::TextColored(ImVec4(1.0f, 0.75f, 0.35f, 1.0f), "There is a file of this name already.");
    } else if ((ui::button("Save", "", usable) || (entered && usable))) {
      if (ask_ && fs::exists(path, error)) {
        overwrite_ = path;
      } else {
        finish(path);
      }
    }
  } else {
    const bool there = usable && fs::exists(path, error);
    if (ui::button("Open", "A double click does the same", there)) {
      finish(path);
    }
  }
  if (!confirm) {
    ImGui::SameLine();
  }
  if (ui::button("Cancel", "") || (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) && !ImGui::IsAnyItemActive())) {
    open_ = false;
    ImGui::CloseCurrentPopup();
  }
  if (confirm) {
    ImGui::SameLine();
    if (ui::button("Write over it", "What is in it now is lost", usable)) {
      finish(path);
    }
  }
  if (!saving_) {
    ImGui::SameLine();
    ui::checkbox("All files", all_, "Also those whose names do not look like it: formats are recognised by content");
  }
  scope.reset();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace forelock::samples
