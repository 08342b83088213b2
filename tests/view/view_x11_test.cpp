// The viewer as a desktop sees it: real X events to a real window, with nothing of --script.
// view_x11_test FORELOCK FOLDER, which has "two stränds.json", a groom, and small.hair, and takes logs. SPDX-License-Identifier: MIT
#include "x11_desktop.h"

#include <X11/keysym.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace forelock::view_test {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kStill_s = 0.6;          // the full picture is begun 0.2 s after the last change
constexpr double kMostIdleShare = 0.2;    // of a core, of a window that nothing happens in
constexpr int kWidth = 1100, kHeight = 700;
constexpr Area kMiddle{335, 25, 430, 645};  // between the panels of a window of that size
constexpr Area kMethod{770, 60, 330, 160}, kStatus{0, 680, 500, 20};

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

void check(bool good, const std::string& what) {
  if (!good) {
    throw Failure(what);
  }
}

// A viewer on a desktop.
class View {
public:
  View(Desktop& desktop, const std::vector<std::string>& words, const std::string& name)
      : desktop_(desktop), process_(words, "x11-" + name + ".log"), name_(name) {
    until("a window", [&] { return (window = desktop_.windowOf(process_.pid())) != None; });
  }

  Process& process() { return process_; }
  std::string title() { return desktop_.titleOf(window); }

  void until(const std::string& what, const std::function<bool()>& done, double limit_s = 40.0) {
    desktop_.until(what, [&] {
      check(!process_.ended(), "the viewer ended (" + process_.ending() + ") before: " + what + "\n" + process_.said());
      return done();
    }, limit_s);
  }

  // A picture that stays as it is while the viewer rests, once `good` of it.
  Pixels settled(const std::string& what, const std::function<bool(const Pixels&)>& good) {
    Pixels last;
    auto begin = Clock::now();
    double cpu_s = process_.cpu_s();
    try {
      until(what, [&] {
        Pixels now = desktop_.look(window);
        const bool still = !now.rgb.empty() && differing(now, last, kMiddle) == 0 && good(now);
        last = std::move(now);
        const double time_s = since(begin);
        if (still && time_s < kStill_s) {
          return false;
        }
        const bool rests = process_.cpu_s() - cpu_s < kMostIdleShare * time_s;
        begin = Clock::now();
        cpu_s = process_.cpu_s();
        return still && rests;
      });
    } catch (const Failure&) {
      last.write("x11-failed.ppm");
      throw;
    }
    if (std::getenv("FORELOCK_X11_PICTURES")) {
      last.write("x11-" + name_ + "-" + std::to_string(++pictures_) + ".ppm");
    }
    return last;
  }

  // Share of a core that it takes over two seconds.
  double share() {
    const double before = process_.cpu_s();
    const auto begin = Clock::now();
    desktop_.pause(2.0);
    return (process_.cpu_s() - before) / since(begin);
  }

  void drag(int x0, int y0, int x1, int y1, unsigned int which) {
    desktop_.moveTo(window, x0, y0);
    desktop_.button(which, true);
    constexpr int kSteps = 10;
    for (int i = 1; i <= kSteps; ++i) {
      desktop_.pause(0.015);
      desktop_.moveTo(window, x0 + (x1 - x0) * i / kSteps, y0 + (y1 - y0) * i / kSteps);
    }
    desktop_.button(which, false);
  }

  // Ends by itself, by no signal, with a word. Tells how.
  std::string ending(const std::string& what) {
    desktop_.until(what + ": the viewer ends", [&] { return process_.ended(); });
    check(!process_.bySignal(), what + ": " + process_.ending() + "\n" + process_.said());
    return process_.ending();
  }

  Window window = None;

private:
  Desktop& desktop_;
  Process process_;
  std::string name_;
  int pictures_ = 0;
};

// The colour of a selected strand.
bool selected(uint32_t color) { return (color >> 16) > 220 && (color >> 8 & 0xff) > 140 && (color & 0xff) < 110; }

// Where there is hair before a grey ground.
std::pair<int, int> brownest(const Pixels& pixels, const Area& area) {
  std::pair<int, int> place{area.x, area.y};
  int most = -256;
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      const uint32_t color = pixels.at(x, y);
      const int brown = static_cast<int>(color >> 16) - static_cast<int>(color & 0xff);
      if (brown > most) {
        most = brown;
        place = {x, y};
      }
    }
  }
  return place;
}

std::string percentCoded(const std::string& path) {
  std::string coded;
  for (const char c : path) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", static_cast<unsigned char>(c));
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_';
    coded += plain ? std::string(1, c) : text;
  }
  return coded;
}

class Test {
public:
  Test(std::string forelock, const fs::path& folder)
      : forelock_(std::move(forelock)), groom_((folder / "two stränds.json").string()), hair_((folder / "small.hair").string()) {}

  void run() {
    Desktop desktop(1400, 900);
    person(desktop);
    bigLetters(desktop);
    ends("a window that another client destroys", desktop, "destroy", [&](View& view) { desktop.destroy(view.window); });
    ends("a client that is killed", desktop, "kill", [&](View& view) { desktop.killOwner(view.window); });
    ends("a server that is gone", desktop, "server", [&](View&) { desktop.killServer(); });
    step("done");
  }

private:
  void step(const std::string& what) {
    std::printf("%6.1f s  %s\n", since(begin_), what.c_str());
    std::fflush(stdout);
  }

  // What `happens` to a viewer that draws all the time ends it with a word, and not by a signal.
  void ends(const std::string& what, Desktop& desktop, const std::string& name, const std::function<void(View&)>& happens) {
    step(what);
    View view(desktop, words(true), name);
    opened(view, "small.hair - ");
    desktop.type(XK_t);
    int pictures = 0;
    Pixels last;
    view.until("it turns by itself", [&] {
      Pixels now = desktop.look(view.window);
      pictures += differing(now, last, kMiddle) > 0 ? 1 : 0;
      last = std::move(now);
      return pictures >= 8;
    });
    happens(view);
    const std::string ending = view.ending(what), said = view.process().said();
    check(!said.empty(), "it ended without a word");
    std::printf("          %s: %s", ending.c_str(), said.c_str());
  }

  std::vector<std::string> words(bool with_hair, const std::string& size = "1100x700") const {
    std::vector<std::string> all{forelock_, "view", "--forget", "--validation", "--window", size};
    if (with_hair) {
      all.push_back(hair_);
    }
    return all;
  }

  static void opened(View& view, const std::string& part) {
    view.until(part + " in the title", [&] { return view.title().find(part) != std::string::npos; });
  }

  void person(Desktop& desktop);
  void bigLetters(Desktop& desktop);
  // Rows with letters in the menu bar, of a window with letters of `scale`.
  static int letterRows(const Pixels& pixels, int scale);

  std::string forelock_, groom_, hair_;
  Clock::time_point begin_ = Clock::now();
  int letter_rows_ = 0;
};

int Test::letterRows(const Pixels& pixels, int scale) {
  int rows = 0;
  for (int y = 0; y < 19 * scale; ++y) {
    rows += countPixels(pixels, {0, y, 40 * scale, 1}, [](uint32_t p) { return (p & 0xff) > 150; }) > 0 ? 1 : 0;
  }
  return rows;
}

void Test::person(Desktop& desktop) {
  step("an empty window");
  View view(desktop, words(false), "person");
  const Window window = view.window;
  const auto look = [&](const std::string& what, const std::function<bool(const Pixels&)>& good) { return view.settled(what, good); };
  const auto changedFrom = [](const Pixels& before, size_t pixels) {
    return [&before, pixels](const Pixels& now) { return differing(before, now, kMiddle) >= pixels; };
  };
  const auto sameAs = [](const Pixels& before) { return [&before](const Pixels& now) { return differing(before, now, kMiddle) == 0; }; };
  const auto copies = [&](const std::string& what, const std::string& part) {
    desktop.key(XK_Control_L, true);
    desktop.type(XK_c);
    desktop.key(XK_Control_L, false);
    std::string copied;
    view.until(what + " in the clipboard", [&] {
      copied = desktop.clipboard();
      return copied.rfind("forelock ", 0) == 0 && copied.find(part) != std::string::npos;
    });
  };
  const Pixels empty = look("an empty window is drawn", [](const Pixels& p) {
    return p.width == kWidth && p.height == kHeight && countPixels(p, kMiddle, [](uint32_t c) { return c != 0; }) > 100;
  });
  letter_rows_ = letterRows(empty, 1);

  step("a file is dropped");
  desktop.drop(window, 550, 350, "file://" + percentCoded(groom_) + "\r\n");
  opened(view, "two stränds.json - ");
  Pixels seen = look("the groom is drawn", changedFrom(empty, 20000));

  step("another file is dropped");
  desktop.drop(window, 550, 350, "file://" + percentCoded(hair_) + "\r\n");
  opened(view, "small.hair - ");
  Pixels now = look("its hair is drawn", changedFrom(seen, 20000));
  seen = now;

  step("a drag turns");
  view.drag(500, 400, 600, 380, 1);
  now = look("a turned picture", changedFrom(seen, 3000));
  seen = now;

  step("the wheel goes nearer");
  desktop.moveTo(window, 550, 350);
  for (int i = 0; i < 3; ++i) {
    desktop.click(4);
  }
  now = look("a nearer picture", changedFrom(seen, 3000));
  seen = now;

  step("keys");
  desktop.type(XK_F1);
  look("help", changedFrom(seen, 20000));
  desktop.type(XK_Escape);
  look("help is closed", sameAs(seen));
  copies("the first method", "\"core_tail\"");
  desktop.type(XK_2);
  copies("another method", "\"exact\"");
  copies("the file", "small.hair");
  now = look("its panel", [&](const Pixels& p) { return differing(seen, p, kMethod) > 1000; });
  seen = now;

  step("a click picks a strand");
  const auto [hair_x, hair_y] = brownest(seen, kMiddle);
  desktop.moveTo(window, hair_x, hair_y);
  desktop.click(1);
  now = look("a strand is marked", [&](const Pixels& p) { return countPixels(p, kMiddle, selected) > 20; });
  check(differing(seen, now, kStatus) > 100, "no word about the strand that was picked");
  seen = now;

  step("a drag and keys quicker than a frame");
  const auto dragAtOnce = [&](int from_x, int to_x) {
    view.process().freeze(true);
    desktop.moveTo(window, from_x, 400);
    desktop.button(1, true);
    desktop.moveTo(window, to_x, 400);
    desktop.button(1, false);
    view.process().freeze(false);
  };
  dragAtOnce(500, 560);
  look("a turned picture", changedFrom(seen, 3000));
  dragAtOnce(560, 500);
  // But for rounding; and no click, which would have changed what is selected.
  look("turned back as far", [&](const Pixels& p) { return differing(seen, p, kMiddle) < 300 && countPixels(p, kMiddle, selected) > 20; });
  view.process().freeze(true);
  desktop.type(XK_F1);
  desktop.type(XK_Escape);
  desktop.type(XK_1);
  view.process().freeze(false);
  copies("the method of a quick key", "\"core_tail\"");
  seen = look("nothing is selected", [&](const Pixels& p) { return countPixels(p, kMiddle, selected) == 0; });

  step("many sizes quickly");
  for (int i = 0; i < 20; ++i) {
    desktop.resize(window, i % 5 == 4 ? 1 : 300 + 47 * i, i % 5 == 4 ? 1 : 860 - 31 * i);
    desktop.pause(0.04);
  }
  desktop.resize(window, 1, 1);
  desktop.pause(1.0);
  check(desktop.areaOf(window).width == 1, "the window is not as small as can be");
  desktop.resize(window, kWidth, kHeight);
  look("the picture as before", sameAs(seen));

  step("nothing happens");
  const double idle = view.share();
  desktop.askToIconify(window);
  view.until("the window is minimised", [&] { return desktop.iconic(window); });
  desktop.pause(0.6);  // what it was doing
  const double minimised = view.share();
  std::printf("          %.1f %% of a core idle, %.1f %% minimised\n", 1e2 * idle, 1e2 * minimised);
  check(idle < kMostIdleShare && minimised < kMostIdleShare, "it works though nothing happens");
  desktop.restore(window);
  look("a restored window", sameAs(seen));

  step("covered, and not any more");
  const Window cover = desktop.cover(desktop.areaOf(window), 0xff00ff);
  view.until("a cover", [&] { return countPixels(desktop.look(window), kMiddle, [](uint32_t c) { return c == 0xff00ff; }) > 200000; });
  desktop.destroy(cover);
  look("an uncovered window", sameAs(seen));

  step("unmapped, and mapped again");
  desktop.unmap(window);
  desktop.pause(1.0);
  desktop.map(window);
  look("a window that is mapped again", sameAs(seen));

  step("a file is dropped beside, from a window that has the keyboard");
  desktop.focus(None);
  desktop.key(XK_Shift_L, true);
  desktop.drop(window, 550, 350, "file://" + percentCoded(groom_) + "\r\n");
  desktop.key(XK_Shift_L, false);
  desktop.focus(window);
  opened(view, "small.hair, two stränds.json - ");

  step("closed");
  desktop.askToClose(window);
  check(view.ending("asked to close") == "exit status 0", view.process().ending() + "\n" + view.process().said());
}

void Test::bigLetters(Desktop& desktop) {
  step("letters of twice the size");
  desktop.setDpi(192);
  View view(desktop, words(false, "600x400"), "letters");
  const Pixels pixels = view.settled("a window of twice the size", [](const Pixels& p) {
    return p.width == 1200 && p.height == 800 && countPixels(p, {0, 0, 1200, 40}, [](uint32_t c) { return (c & 0xff) > 150; }) > 100;
  });
  desktop.setDpi(0);
  const int rows = letterRows(pixels, 2);
  std::printf("          rows of letters: %d at 96 dpi, %d at 192 dpi\n", letter_rows_, rows);
  check(letter_rows_ >= 8 && std::abs(rows - 2 * letter_rows_) <= 2, "the letters are not twice as large");
  desktop.askToClose(view.window);
  check(view.ending("asked to close") == "exit status 0", view.process().ending() + "\n" + view.process().said());
}

}  // namespace

}  // namespace forelock::view_test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: view_x11_test FORELOCK FOLDER\n");
    return 2;
  }
  try {
    std::filesystem::current_path(argv[2]);
    forelock::view_test::Test(argv[1], argv[2]).run();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "view_x11_test: %s\n", failure.what());
    return 1;
  }
  return 0;
}
