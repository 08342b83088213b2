// What the window remembers, and that nothing of it is lost.
#include "settings.h"

#include "asset_source.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;
using namespace forelock::samples;

namespace {

class Settings : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("forelock-settings-" + std::to_string(::getpid()));
    fs::remove_all(folder);
    path = (folder / "forelock" / "view.json").string();
  }
  void TearDown() override { fs::remove_all(folder); }

  void write(const std::string& text) const {
    fs::create_directories(fs::path(path).parent_path());
    std::ofstream(path) << text;
  }
  static std::string read(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(name).rdbuf();
    return text.str();
  }
  ViewSettings load() { return notes.clear(), loadSettings(path, notes); }

  fs::path folder;
  std::string path;
  std::vector<std::string> notes;
};

}  // namespace

TEST_F(Settings, MissingFileIsTheDefault) {
  const ViewSettings settings = load();
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(settings.window_width, 1280);
  EXPECT_TRUE(settings.show_left);
  EXPECT_FALSE(settings.leave_file);
}

TEST_F(Settings, ComesBackAsItWas) {
  ViewSettings settings;
  settings.recent = {"/a/b.tfx", "groom:curly", "/an \"odd\" näme.hair"};
  settings.window_width = 1900, settings.window_height = 777;
  settings.show_left = settings.vsync = settings.adapt = settings.show_right = false;
  settings.ui_scale = 1.35f;
  settings.moving_budget_ms = 33.3;
  settings.last_folder = "/tmp";
  saveSettings(path, settings);
  const ViewSettings back = load();
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(back.recent, settings.recent);
  EXPECT_EQ(back.window_width, 1900);
  EXPECT_EQ(back.window_height, 777);
  EXPECT_FALSE(back.show_left || back.show_right || back.vsync || back.adapt);
  EXPECT_EQ(back.ui_scale, 1.35f);
  EXPECT_EQ(back.moving_budget_ms, 33.3);
  EXPECT_EQ(back.last_folder, "/tmp");
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path).parent_path()), fs::directory_iterator()), 1) << "no temporary file stays";
}

TEST_F(Settings, KeysThatAreNotKnownStay) {
  write(R"({"window_width": 900, "lens": {"radius": [1, 2]}, "tone": "warm"})");
  ViewSettings settings = load();
  EXPECT_TRUE(notes.empty());
  settings.window_height = 600;
  saveSettings(path, settings);
  const std::string text = read(path);
  EXPECT_NE(text.find("\"tone\": \"warm\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"radius\""), std::string::npos) << text;
  EXPECT_EQ(load().window_width, 900);
  EXPECT_EQ(load().window_height, 600);
  saveSettings(path, load());
  EXPECT_EQ(read(path), text);
}

TEST_F(Settings, ADamagedFileIsKept) {
  for (const char* damage : {"", "{\"window_width\": 90", "[1]", "\x80\xff", "{\"a\": \"\xff\"}", "null"}) {
    SetUp();
    write(damage);
    const ViewSettings settings = load();
    EXPECT_EQ(settings.window_width, 1280) << damage;
    ASSERT_EQ(notes.size(), 1u) << damage;
    EXPECT_NE(notes[0].find(path + ".damaged"), std::string::npos) << notes[0];
    saveSettings(path, settings);
    EXPECT_EQ(read(path + ".damaged"), damage);
    EXPECT_EQ(load().window_width, 1280);
    EXPECT_TRUE(notes.empty());
  }
  write("other");
  load();
  EXPECT_EQ(read(path + ".damaged-2"), "other");
  EXPECT_EQ(read(path + ".damaged"), "null");
}

TEST_F(Settings, AWrongValueIsTheDefaultAndTheRestIsRead) {
  write(R"({"window_width": -4, "vsync": 3, "recent": ["/a", 2], "ui_scale": 0, "window_height": 500})");
  const ViewSettings settings = load();
  EXPECT_EQ(settings.window_width, 1280);
  EXPECT_EQ(settings.window_height, 500);
  EXPECT_TRUE(settings.vsync);
  EXPECT_TRUE(settings.recent.empty());
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("and 2 more are wrong"), std::string::npos) << notes[0];
  EXPECT_TRUE(fs::exists(path + ".damaged"));
}

TEST_F(Settings, ANewerFileIsNeitherUsedNorWrittenOver) {
  const std::string newer = R"({"version": 2, "window_width": 900})";
  write(newer);
  const ViewSettings settings = load();
  EXPECT_EQ(settings.window_width, 1280);
  EXPECT_EQ(notes.size(), 1u);
  saveSettings(path, settings);
  EXPECT_EQ(read(path), newer);
}

TEST_F(Settings, AnUnreadableFileIsLeft) {
  fs::create_directories(path);  // a folder of this name
  const ViewSettings settings = load();
  EXPECT_EQ(notes.size(), 1u);
  EXPECT_NO_THROW(saveSettings(path, settings));
  EXPECT_TRUE(fs::is_directory(path));
}

TEST_F(Settings, SavingSaysWhyItCannot) {
  fs::create_directories(folder);
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(saveSettings((folder / "file" / "view.json").string(), {}), AssetError);
  EXPECT_NO_THROW(saveSettings("", {}));
}

TEST_F(Settings, RecentOnesAreNewestFirstAndOnce) {
  ViewSettings settings;
  for (int i = 0; i < 20; ++i) noteRecent(settings, "/folder/./" + std::to_string(i) + ".tfx");
  ASSERT_EQ(settings.recent.size(), kMostRecent);
  EXPECT_EQ(settings.recent[0], "/folder/19.tfx");
  noteRecent(settings, "/folder/x/../15.tfx");
  noteRecent(settings, "groom:curly");
  ASSERT_EQ(settings.recent.size(), kMostRecent);
  EXPECT_EQ(settings.recent[0], "groom:curly");
  EXPECT_EQ(settings.recent[1], "/folder/15.tfx");
  EXPECT_EQ(std::count(settings.recent.begin(), settings.recent.end(), "/folder/15.tfx"), 1);
  noteRecent(settings, "here.tfx");
  EXPECT_EQ(settings.recent[0], (fs::current_path() / "here.tfx").string());
  settings.recent = {"/no\xffutf8", "/a"};
  saveSettings(path, settings);
  EXPECT_EQ(load().recent, std::vector<std::string>{"/a"});
}

TEST_F(Settings, PathFollowsTheEnvironment) {
  const char* home = std::getenv("HOME");
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const std::string old_home = home ? home : "", old_config = config ? config : "";
  setenv("XDG_CONFIG_HOME", "/c", 1);
  setenv("HOME", "/h", 1);
  EXPECT_EQ(settingsPath(), "/c/forelock/view.json");
  setenv("XDG_CONFIG_HOME", "relative", 1);
  EXPECT_EQ(settingsPath(), "/h/.config/forelock/view.json");
  unsetenv("XDG_CONFIG_HOME");
  EXPECT_EQ(settingsPath(), "/h/.config/forelock/view.json");
  unsetenv("HOME");
  EXPECT_EQ(settingsPath(), "");
  if (home) setenv("HOME", old_home.c_str(), 1);
  if (config) setenv("XDG_CONFIG_HOME", old_config.c_str(), 1);
}
