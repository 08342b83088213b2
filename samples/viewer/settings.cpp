// SPDX-License-Identifier: MIT
#include "settings.h"

#include "asset_source.h"
#include "whole_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr uint64_t kLargest = 1 << 20;  // bytes

struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

bool isUtf8(const std::string& text) {
  try {
    return !Json(text).dump().empty();
  } catch (const Json::exception&) {
    return false;
  }
}

// Takes keys out of an object; what is left is not known here.
class Taker {
 public:
  Taker(Json& json, std::vector<std::string>& wrong) : json_(json), wrong_(wrong) {}

  void flag(const char* key, bool& value) {
    take(key, "true or false", [&](const Json& found) {
      return found.is_boolean() && (value = found.get<bool>(), true);
    });
  }

  template <typename Number>
  void number(const char* key, Number& value, double low, double high, bool zero_too = false) {
    take(key, "a number in its range", [&](const Json& found) {
      const double number = found.is_number() ? found.get<double>() : -1.0;
      const bool fits = (number >= low && number <= high) || (zero_too && number == 0.0);
      return fits && (value = static_cast<Number>(number), true);
    });
  }

  void text(const char* key, std::string& value) {
    take(key, "text", [&](const Json& found) { return found.is_string() && (value = found.get<std::string>(), true); });
  }

  void texts(const char* key, std::vector<std::string>& values, size_t most) {
    take(key, "a list of texts", [&](const Json& found) {
      if (!found.is_array() || !std::all_of(found.begin(), found.end(), [](const Json& v) { return v.is_string(); })) {
        return false;
      }
      for (size_t i = 0; i < std::min(found.size(), most); ++i) {
        values.push_back(found[i].get<std::string>());
      }
      return true;
    });
  }

 private:
  template <typename Read>
  void take(const char* key, const char* wanted, const Read& read) {
    const auto found = json_.find(key);
    if (found == json_.end()) {
      return;
    }
    if (!read(*found)) {
      wrong_.push_back(std::string(key) + " is " + found->dump().substr(0, 40) + ", must be " + wanted);
    }
    json_.erase(found);
  }

  Json& json_;
  std::vector<std::string>& wrong_;
};

// For reading and writing alike.
template <typename Keys>
void eachKey(Keys& keys, ViewSettings& s) {
  keys.texts("recent", s.recent, kMostRecent);
  keys.number("window_width", s.window_width, 160, 16384);
  keys.number("window_height", s.window_height, 160, 16384);
  keys.flag("show_left", s.show_left);
  keys.flag("show_right", s.show_right);
  keys.number("ui_scale", s.ui_scale, 0.25, 8.0, true);
  keys.flag("vsync", s.vsync);
  keys.number("moving_budget_ms", s.moving_budget_ms, 1.0, 1000.0);
  keys.flag("adapt", s.adapt);
  keys.text("last_folder", s.last_folder);
  keys.text("last_scene", s.last_scene);
}

// Names that are not UTF-8 cannot be in JSON: they are not remembered.
struct Putter {
  Json& json;
  void flag(const char* key, bool& value) { json[key] = value; }
  template <typename Number>
  void number(const char* key, Number& value, double, double, bool = false) {
    json[key] = value;
  }
  void text(const char* key, std::string& value) { json[key] = isUtf8(value) ? value : std::string(); }
  void texts(const char* key, std::vector<std::string>& values, size_t) {
    json[key] = Json::array();
    for (const std::string& value : values) {
      if (isUtf8(value)) {
        json[key].push_back(value);
      }
    }
  }
};

// Gives where it is kept now, empty where it could not be.
std::string keepDamaged(const std::string& path) {
  for (int number = 1; number < 1000; ++number) {
    const std::string kept = path + (number == 1 ? ".damaged" : ".damaged-") + (number == 1 ? "" : std::to_string(number));
    std::error_code error;
    if (fs::exists(fs::symlink_status(kept, error))) {
      continue;
    }
    fs::copy_file(path, kept, error);
    return error ? std::string() : kept;
  }
  return {};
}

void noteDamage(const std::string& path, const std::string& what, ViewSettings& settings, std::vector<std::string>& notes) {
  const std::string kept = keepDamaged(path);
  settings.leave_file = kept.empty();
  notes.push_back(path + ": " + what + (kept.empty() ? "" : "; it is kept as " + kept));
}

Json readObject(const std::string& path) {
  const std::vector<unsigned char> bytes = readWholeFile(path, kLargest);
  Json json;
  try {
    json = Json::parse(bytes.begin(), bytes.end());
  } catch (const Json::exception&) {
    throw Wrong("is not valid JSON, so that nothing of it is used");
  }
  if (!json.is_object()) {
    throw Wrong("is no object { ... }, so that nothing of it is used");
  }
  return json;
}

}  // namespace

std::string settingsPath() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config && config[0] == '/') {  // others are to be ignored: XDG Base Directory Specification
    return std::string(config) + "/forelock/view.json";
  }
  const char* home = std::getenv("HOME");
  return home && home[0] == '/' ? std::string(home) + "/.config/forelock/view.json" : std::string();
}

ViewSettings loadSettings(const std::string& path, std::vector<std::string>& notes) {
  ViewSettings settings;
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) {
    return settings;
  }
  try {
    Json json = readObject(path);
    const Json version = json.value("version", Json(kVersion));
    if (version.is_number() && version.get<double>() > kVersion) {
      notes.push_back(path + ": is of a newer forelock, so that it is neither used nor written over");
      settings.leave_file = true;
      return settings;
    }
    json.erase("version");
    std::vector<std::string> wrong;
    Taker keys(json, wrong);
    eachKey(keys, settings);
    settings.unknown = json.empty() ? std::string() : json.dump();
    if (!wrong.empty()) {
      noteDamage(path, wrong[0] + (wrong.size() > 1 ? ", and " + std::to_string(wrong.size() - 1) + " more are wrong" : "") +
                           ": the default is used instead", settings, notes);
    }
  } catch (const Wrong& damage) {
    noteDamage(path, damage.what(), settings, notes);
  } catch (const AssetError& refused) {  // begins with the path
    notes.push_back(refused.what());
    settings.leave_file = true;
  }
  return settings;
}

void saveSettings(const std::string& path, const ViewSettings& settings) {
  if (path.empty() || settings.leave_file) {
    return;
  }
  Json json;
  json["version"] = kVersion;
  ViewSettings copy = settings;
  Putter keys{json};
  eachKey(keys, copy);
  if (!settings.unknown.empty()) {
    json.update(Json::parse(settings.unknown));
  }
  std::error_code error;
  fs::create_directories(fs::path(path).parent_path(), error);  // where it fails, so does the file, which says why
  const std::string text = json.dump(2) + "\n";
  writeWholeFiles({{path, {reinterpret_cast<const unsigned char*>(text.data()), text.size()}}});
}

void noteRecent(ViewSettings& settings, const std::string& source) {
  std::string name = source;
  if (name.rfind("groom:", 0) != 0) {
    std::error_code error;
    name = fs::absolute(source, error).lexically_normal().string();
  }
  std::vector<std::string>& recent = settings.recent;
  std::erase(recent, name);
  recent.insert(recent.begin(), name);
  recent.resize(std::min(recent.size(), kMostRecent));
}

}  // namespace forelock::samples
