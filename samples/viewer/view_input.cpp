// SPDX-License-Identifier: MIT
#include "view_input.h"

#include "view_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <dlfcn.h>

#include <algorithm>
#include <bitset>

namespace forelock::samples {

ViewInput& ViewInput::of(GLFWwindow* window) { return static_cast<ViewWindow*>(glfwGetWindowUserPointer(window))->input(); }

void ViewInput::install(GLFWwindow* window) {
  window_ = window;
  events_.clear();
  std::fill(std::begin(down_), std::end(down_), false);
  glfwGetCursorPos(window, &x_, &y_);
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).add({Event::Kind::move, x, y}); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) { of(w).add({Event::Kind::wheel, x, y}); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (button >= 0 && button < 3) {
      of(w).add({Event::Kind::button, 0.0, 0.0, button, action == GLFW_PRESS});
    }
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (key >= 0 && key <= GLFW_KEY_LAST && action != GLFW_REPEAT) {  // Dear ImGui repeats by itself
      of(w).add({Event::Kind::key, 0.0, 0.0, key, action == GLFW_PRESS});
    }
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned int letter) { of(w).add({Event::Kind::letter, 0.0, 0.0, 0, false, letter}); });
}

void ViewInput::add(const Event& event) {
  if (event.kind == Event::Kind::move && !events_.empty() && events_.back().kind == Event::Kind::move) {
    events_.back() = event;
  } else {
    events_.push_back(event);
  }
}

void ViewInput::feed() {
  ImGuiIO& io = ImGui::GetIO();
  std::bitset<GLFW_KEY_LAST + 1> keys;
  std::bitset<3> buttons;
  bool moved = false, wheeled = false, lettered = false;
  const bool any = !events_.empty();
  for (; !events_.empty(); events_.pop_front()) {
    const Event& event = events_.front();
    const size_t code = static_cast<size_t>(event.code);
    if (event.kind == Event::Kind::move) {
      if (buttons.any() || wheeled) break;
      x_ = event.x;
      y_ = event.y;
      moved = true;
    } else if (event.kind == Event::Kind::button) {
      // What the mouse has only just come to is not hovered for a tab, and a slider takes no way that ends with the button up.
      if (moved || buttons[code] || wheeled || keys.any()) break;
      buttons[code] = true;
      down_[code] = event.down;
    } else if (event.kind == Event::Kind::wheel) {
      if (moved || buttons.any()) break;
      ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
      wheeled = true;
    } else if (event.kind == Event::Kind::key) {
      if (keys[code] || lettered || buttons.any()) break;
      ImGui_ImplGlfw_KeyCallback(window_, event.code, 0, event.down ? GLFW_PRESS : GLFW_RELEASE, 0);
      keys[code] = true;
    } else {
      ImGui_ImplGlfw_CharCallback(window_, event.letter);
      lettered = true;
    }
  }
  std::copy(std::begin(down_), std::end(down_), io.MouseDown);
  // Where nothing has come in, the back end asked where the mouse is: outside of the window there are no events of it.
  if (any && io.MousePos.x > -1e30f) {
    io.MousePos = ImVec2(static_cast<float>(x_), static_cast<float>(y_));
  }
}

// GLFW has no call that asks the screen: on X11 Xlib is asked, which GLFW has loaded.
bool shiftHeld() {
  const auto find = [](const char* name) { return dlsym(RTLD_DEFAULT, name); };
  const auto display_of = reinterpret_cast<void* (*)()>(find("glfwGetX11Display"));
  const auto root_of = reinterpret_cast<unsigned long (*)(void*)>(find("XDefaultRootWindow"));
  const auto query = reinterpret_cast<int (*)(void*, unsigned long, unsigned long*, unsigned long*, int*, int*, int*, int*, unsigned int*)>(
      find("XQueryPointer"));
  void* display = display_of ? display_of() : nullptr;
  if (!display || !root_of || !query) {
    return false;
  }
  unsigned long root = 0, child = 0;
  int x = 0, y = 0, in_x = 0, in_y = 0;
  unsigned int mask = 0;
  query(display, root_of(display), &root, &child, &x, &y, &in_x, &in_y, &mask);
  constexpr unsigned int kShiftMask = 1;  // of X.h
  return (mask & kShiftMask) != 0;
}

}  // namespace forelock::samples
