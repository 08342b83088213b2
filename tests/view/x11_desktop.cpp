// SPDX-License-Identifier: MIT
#include "x11_desktop.h"

#include <X11/Xatom.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace forelock::view_test {

namespace {

using Clock = std::chrono::steady_clock;

// Windows of others may go at any time: a request that came too late is no failure of the test.
int ignoreError(Display*, XErrorEvent*) { return 0; }

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

void Pixels::write(const std::string& path) const {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << width << ' ' << height << "\n255\n";
  for (const uint32_t p : rgb) {
    const char bytes[3] = {static_cast<char>(p >> 16), static_cast<char>(p >> 8), static_cast<char>(p)};
    file.write(bytes, 3);
  }
}

size_t countPixels(const Pixels& pixels, const Area& area, const std::function<bool(uint32_t)>& wanted) {
  size_t count = 0;
  for (int y = std::max(area.y, 0); y < std::min(area.y + area.height, pixels.height); ++y) {
    for (int x = std::max(area.x, 0); x < std::min(area.x + area.width, pixels.width); ++x) {
      count += wanted(pixels.at(x, y)) ? 1 : 0;
    }
  }
  return count;
}

size_t differing(const Pixels& a, const Pixels& b, const Area& area) {
  if (a.width != b.width || a.height != b.height) {
    return static_cast<size_t>(area.width) * static_cast<size_t>(area.height);
  }
  size_t count = 0;
  for (int y = std::max(area.y, 0); y < std::min(area.y + area.height, a.height); ++y) {
    for (int x = std::max(area.x, 0); x < std::min(area.x + area.width, a.width); ++x) {
      count += a.at(x, y) != b.at(x, y) ? 1 : 0;
    }
  }
  return count;
}

// ---- The server and the window manager ----

Desktop::Desktop(int width, int height) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw Failure("no pipe");
  }
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  // It chooses a display that is free, and tells which when it is ready.
  server_ = std::make_unique<Process>(std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", screen, "-nolisten",
                                                               "tcp", "-noreset"}, "x11-xvfb.log", ends[1]);
  close(ends[1]);
  std::string number;
  for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) {
    number += c;
  }
  close(ends[0]);
  if (number.empty()) {
    throw Failure("Xvfb did not start; is package xvfb installed? " + server_->said());
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
  unsetenv("WAYLAND_DISPLAY");
  unsetenv("XAUTHORITY");
  display_ = XOpenDisplay(nullptr);
  if (!display_) {
    throw Failure("display :" + number + " cannot be opened");
  }
  XSetErrorHandler(ignoreError);
  root_ = DefaultRootWindow(display_);
  own_ = XCreateSimpleWindow(display_, root_, -10, -10, 1, 1, 0, 0, 0);
  XSelectInput(display_, root_, SubstructureRedirectMask | SubstructureNotifyMask);
  XFlush(display_);
}

Desktop::~Desktop() {
  if (display_) {
    XCloseDisplay(display_);
  }
}

void Desktop::killServer() {
  XCloseDisplay(display_);  // ours first: its loss would end the test too
  display_ = nullptr;
  server_->kill();
}

void Desktop::until(const std::string& what, const std::function<bool()>& done, double limit_s) {
  const auto begin = Clock::now();
  while (true) {
    while (display_ && XPending(display_) > 0) {
      XEvent event;
      XNextEvent(display_, &event);
      handle(event);
    }
    if (done()) {
      return;
    }
    if (since(begin) > limit_s) {
      throw Failure("not within " + std::to_string(static_cast<int>(limit_s)) + " s: " + what);
    }
    pollfd wait{display_ ? ConnectionNumber(display_) : -1, POLLIN, 0};
    poll(&wait, 1, 20);
  }
}

void Desktop::pause(double time_s) {
  const auto begin = Clock::now();
  until("time goes by", [&] { return since(begin) >= time_s; }, time_s + 60.0);
}

void Desktop::setState(Window window, long state) {
  const long data[2] = {state, None};
  XChangeProperty(display_, window, atom("WM_STATE"), atom("WM_STATE"), 32, PropModeReplace, reinterpret_cast<const unsigned char*>(data), 2);
}

void Desktop::handle(XEvent& event) {
  if (event.type == MapRequest) {
    const Window window = event.xmaprequest.window;
    XMoveWindow(display_, window, 40, 30);
    setState(window, NormalState);
    XMapWindow(display_, window);
  } else if (event.type == MapNotify && !event.xmap.override_redirect) {
    XSetInputFocus(display_, event.xmap.window, RevertToPointerRoot, CurrentTime);
  } else if (event.type == ConfigureRequest) {
    const XConfigureRequestEvent& ask = event.xconfigurerequest;
    XWindowChanges changes{ask.x, ask.y, ask.width, ask.height, ask.border_width, ask.above, ask.detail};
    XConfigureWindow(display_, ask.window, static_cast<unsigned int>(ask.value_mask), &changes);
  } else if (event.type == ClientMessage) {
    const XClientMessageEvent& message = event.xclient;
    if (message.message_type == atom("WM_CHANGE_STATE") && message.data.l[0] == IconicState) {
      iconic_ = message.window;
      setState(iconic_, IconicState);
      XUnmapWindow(display_, iconic_);
    } else if (message.message_type == atom("XdndStatus")) {
      accepted_ = (message.data.l[1] & 1) != 0;
    } else if (message.message_type == atom("XdndFinished")) {
      finished_ = true;  // whether it was taken is not told by it: GLFW 3.3 puts the number of bytes where a bit should be
    }
  } else if (event.type == SelectionRequest) {
    serveDrop(event.xselectionrequest);
  } else if (event.type == SelectionNotify) {
    converted_ = true;
  }
  XFlush(display_);
}

void Desktop::setDpi(int dpi) {
  const std::string text = dpi > 0 ? "Xft.dpi:\t" + std::to_string(dpi) + "\n" : "";
  XChangeProperty(display_, root_, XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                  static_cast<int>(text.size()));
  XSync(display_, False);
}

// ---- Windows ----

std::string Desktop::property(Window window, Atom name) {
  Atom type = None;
  int format = 0;
  unsigned long count = 0, rest = 0;
  unsigned char* data = nullptr;
  if (XGetWindowProperty(display_, window, name, 0, 1 << 20, False, AnyPropertyType, &type, &format, &count, &rest, &data) != Success || !data) {
    return {};
  }
  // Values of 32 bits come as longs.
  std::string value(reinterpret_cast<const char*>(data), count * (format == 32 ? sizeof(long) : static_cast<size_t>(format) / 8));
  XFree(data);
  return value;
}

Window Desktop::windowOf(pid_t pid) {
  Window root = None, parent = None, found = None, *children = nullptr;
  unsigned int count = 0;
  if (!XQueryTree(display_, root_, &root, &parent, &children, &count)) {
    return None;
  }
  for (unsigned int i = 0; i < count; ++i) {
    const std::string owner = property(children[i], atom("_NET_WM_PID"));
    XWindowAttributes attributes{};
    if (owner.size() == sizeof(long) && *reinterpret_cast<const long*>(owner.data()) == pid &&
        XGetWindowAttributes(display_, children[i], &attributes) && attributes.map_state == IsViewable) {
      found = children[i];
    }
  }
  XFree(children);
  return found;
}

std::string Desktop::titleOf(Window window) { return property(window, atom("_NET_WM_NAME")); }

Area Desktop::areaOf(Window window) {
  XWindowAttributes attributes{};
  if (!XGetWindowAttributes(display_, window, &attributes)) {
    return {};
  }
  return {attributes.x, attributes.y, attributes.width, attributes.height};
}

Pixels Desktop::look(Window window) {
  const Area area = areaOf(window);
  const int width = std::min(area.width, DisplayWidth(display_, 0) - area.x), height = std::min(area.height, DisplayHeight(display_, 0) - area.y);
  Pixels pixels{width, height, {}};
  if (width <= 0 || height <= 0) {
    return {};
  }
  XImage* image = XGetImage(display_, root_, area.x, area.y, static_cast<unsigned int>(width), static_cast<unsigned int>(height), AllPlanes, ZPixmap);
  if (!image || image->bits_per_pixel != 32) {
    throw Failure("the screen cannot be looked at");
  }
  for (int y = 0; y < height; ++y) {
    const auto* row = reinterpret_cast<const uint32_t*>(image->data + y * image->bytes_per_line);
    std::transform(row, row + width, std::back_inserter(pixels.rgb), [](uint32_t p) { return p & 0xffffffu; });
  }
  XDestroyImage(image);
  return pixels;
}

void Desktop::resize(Window window, int width, int height) {
  XResizeWindow(display_, window, static_cast<unsigned int>(width), static_cast<unsigned int>(height));
  XFlush(display_);
}

void Desktop::askToIconify(Window window) {
  XIconifyWindow(display_, window, 0);
  XFlush(display_);
}

void Desktop::restore(Window window) {
  iconic_ = None;
  setState(window, NormalState);
  map(window);
}

void Desktop::unmap(Window window) {
  XUnmapWindow(display_, window);
  XFlush(display_);
}

void Desktop::map(Window window) {
  XMapWindow(display_, window);
  XFlush(display_);
}

void Desktop::askToClose(Window window) {
  sendMessage(window, "WM_PROTOCOLS", {static_cast<long>(atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0});
}

void Desktop::destroy(Window window) {
  XDestroyWindow(display_, window);
  XFlush(display_);
}

void Desktop::killOwner(Window window) {
  XKillClient(display_, window);
  XFlush(display_);
}

Window Desktop::cover(const Area& area, unsigned long color) {
  XSetWindowAttributes wanted{};
  wanted.override_redirect = True;
  wanted.background_pixel = color;
  const Window window = XCreateWindow(display_, root_, area.x, area.y, static_cast<unsigned int>(area.width), static_cast<unsigned int>(area.height), 0,
                                      CopyFromParent, InputOutput, CopyFromParent, CWOverrideRedirect | CWBackPixel, &wanted);
  XMapRaised(display_, window);
  XFlush(display_);
  return window;
}

// ---- Mouse and keyboard ----

void Desktop::moveTo(Window window, int x, int y) {
  const Area area = areaOf(window);
  XTestFakeMotionEvent(display_, 0, area.x + x, area.y + y, CurrentTime);
  XFlush(display_);
}

void Desktop::button(unsigned int which, bool down) {
  XTestFakeButtonEvent(display_, which, down ? True : False, CurrentTime);
  XFlush(display_);
}

void Desktop::click(unsigned int which) {
  button(which, true);
  button(which, false);
}

void Desktop::key(KeySym key, bool down) {
  XTestFakeKeyEvent(display_, XKeysymToKeycode(display_, key), down ? True : False, CurrentTime);
  XFlush(display_);
}

void Desktop::type(KeySym which) {
  key(which, true);
  key(which, false);
}

void Desktop::focus(Window window) {
  XSetInputFocus(display_, window, RevertToPointerRoot, CurrentTime);
  XSync(display_, False);
}

// ---- Between programs ----

void Desktop::sendMessage(Window to, const char* type, const long (&data)[5]) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = to;
  event.xclient.message_type = atom(type);
  event.xclient.format = 32;
  std::copy(data, data + 5, event.xclient.data.l);
  XSendEvent(display_, to, False, NoEventMask, &event);
  XFlush(display_);
}

// Drag and drop of version 5: freedesktop.org, "Drag-and-Drop Protocol for the X Window System".
void Desktop::drop(Window window, int x, int y, const std::string& uri_list) {
  const std::string aware = property(window, atom("XdndAware"));
  const long version = aware.size() == sizeof(long) ? std::min(*reinterpret_cast<const long*>(aware.data()), 5L) : 0;
  if (version < 3) {
    throw Failure("the window takes nothing that is dropped");
  }
  dropped_ = uri_list;
  accepted_ = fetched_ = finished_ = false;
  XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
  const long own = static_cast<long>(own_);
  sendMessage(window, "XdndEnter", {own, version << 24, static_cast<long>(atom("text/uri-list")), None, None});
  const Area area = areaOf(window);
  for (int step = 5; step >= 0; --step) {
    moveTo(window, x - 10 * step, y);
    const long at = (static_cast<long>(area.x + x - 10 * step) << 16) | (area.y + y);
    accepted_ = false;
    sendMessage(window, "XdndPosition", {own, 0, at, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
    until("what is dragged over the window is accepted", [&] { return accepted_; });
  }
  sendMessage(window, "XdndDrop", {own, 0, CurrentTime, 0, 0});
  until("what was dropped is fetched", [&] { return fetched_; });
  until("the drop is finished", [&] { return finished_; });
}

void Desktop::serveDrop(const XSelectionRequestEvent& request) {
  XEvent answer{};
  answer.xselection.type = SelectionNotify;
  answer.xselection.requestor = request.requestor;
  answer.xselection.selection = request.selection;
  answer.xselection.target = request.target;
  answer.xselection.time = request.time;
  if (request.selection == atom("XdndSelection") && request.target == atom("text/uri-list")) {
    XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(dropped_.data()), static_cast<int>(dropped_.size()));
    answer.xselection.property = request.property;
    fetched_ = true;
  }
  XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
}

std::string Desktop::clipboard() {
  converted_ = false;
  XDeleteProperty(display_, own_, atom("FORELOCK_CLIPBOARD"));
  XConvertSelection(display_, atom("CLIPBOARD"), atom("UTF8_STRING"), atom("FORELOCK_CLIPBOARD"), own_, CurrentTime);
  XFlush(display_);
  until("the clipboard's owner answers", [&] { return converted_; });
  return property(own_, atom("FORELOCK_CLIPBOARD"));
}

}  // namespace forelock::view_test
