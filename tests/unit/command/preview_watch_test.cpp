// `forelock preview --watch` as a process of its own.
#include "command_run.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

using forelock::test::readAll;
using forelock::test::scratchFolder;
using forelock::test::smallRecipe;
using forelock::test::writeScratch;

namespace fs = std::filesystem;

namespace {

class Watcher {
 public:
  explicit Watcher(const std::vector<std::string>& arguments) {
    writeScratch("watch-out", ""), writeScratch("watch-err", "");
    child_ = fork();
    if (child_ == 0) {
      dup2(open(out_.c_str(), O_WRONLY | O_APPEND), STDOUT_FILENO);
      dup2(open(err_.c_str(), O_WRONLY | O_APPEND), STDERR_FILENO);
      std::vector<char*> words;
      std::string program = FORELOCK_PROGRAM;
      words.push_back(program.data());
      std::vector<std::string> copies = arguments;
      for (std::string& word : copies) words.push_back(word.data());
      words.push_back(nullptr);
      execv(program.c_str(), words.data());
      _exit(127);
    }
  }
  ~Watcher() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  // What it exits with after Ctrl-C; -1: not by itself.
  int interrupt() {
    kill(child_, SIGINT);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string out() const { return readAll(out_); }
  std::string err() const { return readAll(err_); }

 private:
  fs::path out_ = scratchFolder() / "watch-out", err_ = scratchFolder() / "watch-err";
  pid_t child_ = -1;
};

// A slow machine gets its time, a quick one does not wait.
bool comesTrue(const std::function<bool()>& condition) {
  for (int i = 0; i < 600; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

size_t countOf(const std::string& text, const std::string& words) {
  size_t count = 0;
  for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

}  // namespace

TEST(PreviewWatch, DrawsChangesKeepsThePictureOfBrokenFilesAndEndsWell) {
  const std::string good = readAll(smallRecipe());
  const std::string asset = writeScratch("watched.json", good);
  const fs::path picture = scratchFolder() / "watched.png";
  Watcher watcher({"preview", asset, "-o", picture.string(), "--size", "32x32", "--watch", "--validation", "--no-head"});
  ASSERT_TRUE(comesTrue([&] { return watcher.out().find("watching") != std::string::npos; })) << watcher.err();
  const std::string first = readAll(picture);
  EXPECT_EQ(first.substr(1, 3), "PNG");

  std::string changed = good;
  changed.replace(changed.find("300"), 3, "90");
  writeScratch("watched.json", changed);
  ASSERT_TRUE(comesTrue([&] { return countOf(watcher.out(), "after the change") == 1; })) << watcher.out() << watcher.err();
  const std::string second = readAll(picture);
  EXPECT_NE(second, first);

  writeScratch("watched.json", good.substr(0, 30));
  ASSERT_TRUE(comesTrue([&] { return watcher.err().find("watched.json: ") != std::string::npos; })) << watcher.out();
  ASSERT_TRUE(comesTrue([&] { return watcher.out().find("stays as it was") != std::string::npos; })) << watcher.out();
  EXPECT_EQ(readAll(picture), second) << "the last picture stays";

  writeScratch("watched.json", good);
  ASSERT_TRUE(comesTrue([&] { return countOf(watcher.out(), "after the change") == 2; })) << watcher.out() << watcher.err();
  EXPECT_EQ(readAll(picture), first);

  EXPECT_EQ(watcher.interrupt(), 0) << watcher.err();
  EXPECT_EQ(watcher.err().find("validation"), std::string::npos) << watcher.err();
  for (const auto& entry : fs::directory_iterator(scratchFolder()))
    EXPECT_NE(entry.path().filename().string().rfind(".watched", 0), 0u) << "a temporary file is left";
}

TEST(PreviewWatch, WaitsForAFileThatIsNotThereYet) {
  const fs::path picture = scratchFolder() / "later.png";
  const std::string good = readAll(smallRecipe());
  Watcher watcher({"preview", (scratchFolder() / "later.json").string(), "-o", picture.string(), "--size", "32x32", "--watch"});
  ASSERT_TRUE(comesTrue([&] { return watcher.out().find("nothing drawn yet") != std::string::npos; })) << watcher.err();
  writeScratch("later.json", good);
  ASSERT_TRUE(comesTrue([&] { return fs::exists(picture); })) << watcher.err();
  EXPECT_EQ(watcher.interrupt(), 0);
}
