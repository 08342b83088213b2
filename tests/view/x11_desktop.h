// An X server without a screen, and on it what a desktop does for a program: windows are managed, mouse and keys moved, files dropped,
// the clipboard read, pixels looked at. SPDX-License-Identifier: MIT
#pragma once

#include "x11_process.h"

#include <X11/Xlib.h>

#include <cstdint>
#include <functional>
#include <memory>

namespace forelock::view_test {

struct Area {
  int x = 0, y = 0, width = 0, height = 0;
};

struct Pixels {
  int width = 0, height = 0;
  std::vector<uint32_t> rgb;  // 0xRRGGBB, rows from above
  uint32_t at(int x, int y) const { return rgb[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]; }
  void write(const std::string& path) const;  // PPM
};
// Pixels of `area` that are for `wanted`; outside of the picture there are none.
size_t countPixels(const Pixels& pixels, const Area& area, const std::function<bool(uint32_t)>& wanted);
// Of another colour; all, where the sizes differ.
size_t differing(const Pixels& a, const Pixels& b, const Area& area);

class Desktop {
public:
  Desktop(int width, int height);  // throws Failure; the server's log goes to the current folder
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  // Does a window manager's work until `done`. Throws Failure with `what` when it is not after limit_s.
  void until(const std::string& what, const std::function<bool()>& done, double limit_s = 40.0);
  void pause(double time_s);
  void killServer();

  void setDpi(int dpi);  // as desktops tell programs that start then; 0: not at all
  Window windowOf(pid_t pid);      // None: not there yet, or not mapped
  std::string titleOf(Window window);
  Area areaOf(Window window);      // of the screen
  Pixels look(Window window);      // what is on the screen where it is, whoever drew it

  // Mouse and keyboard of the server: they go to who is under the one and has the focus of the other. Positions are in the window.
  void moveTo(Window window, int x, int y);
  void button(unsigned int which, bool down);
  void click(unsigned int which);
  void key(KeySym key, bool down);
  void type(KeySym key);           // down and up at once
  void focus(Window window);       // None: keys go nowhere

  void resize(Window window, int width, int height);
  void askToIconify(Window window);  // as XIconifyWindow does; the manager then does it
  bool iconic(Window window) const { return window == iconic_; }
  void restore(Window window);
  void unmap(Window window);       // without a word about a state, as another desktop that is switched to
  void map(Window window);
  void askToClose(Window window);  // WM_DELETE_WINDOW
  void destroy(Window window);     // by another than its owner
  void killOwner(Window window);
  Window cover(const Area& area, unsigned long color);  // a window above all

  // Drags URIs over the window, then lets go. Throws Failure where the window does not take them.
  void drop(Window window, int x, int y, const std::string& uri_list);
  std::string clipboard();         // as text; waits for its owner

private:
  Atom atom(const char* name) { return XInternAtom(display_, name, False); }
  void handle(XEvent& event);
  void setState(Window window, long state);
  void sendMessage(Window to, const char* type, const long (&data)[5]);
  void serveDrop(const XSelectionRequestEvent& request);
  std::string property(Window window, Atom name);

  std::unique_ptr<Process> server_;
  Display* display_ = nullptr;
  Window root_ = None, own_ = None, iconic_ = None;
  std::string dropped_;
  bool accepted_ = false, fetched_ = false, finished_ = false, converted_ = false;
};

}  // namespace forelock::view_test
