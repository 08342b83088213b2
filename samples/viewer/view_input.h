// Mouse and keys of a window for Dear ImGui, in the order in which they came. SPDX-License-Identifier: MIT
#pragma once

#include <deque>

struct GLFWwindow;

namespace forelock::samples {

// Dear ImGui before 1.87 looks at what is down once a frame: a key that went down and up while a slow picture was drawn was never seen, a
// drag was a click where it ended. Here what contradicts an earlier event, or follows a way, waits for the next frame. To be removed with Dear ImGui 1.87,
// whose own queue this follows.
class ViewInput {
public:
  // Takes the callbacks over from Dear ImGui's back end, which has installed them just now.
  void install(GLFWwindow* window);
  // A frame's share; between the back end's new frame and Dear ImGui's own.
  void feed();
  bool waiting() const { return !events_.empty(); }  // for the next frame

private:
  struct Event {
    enum class Kind { move, button, wheel, key, letter } kind;
    double x = 0.0, y = 0.0;        // of move and wheel
    int code = 0;                   // of button and key
    bool down = false;
    unsigned int letter = 0;
  };
  static ViewInput& of(GLFWwindow* window);
  void add(const Event& event);

  GLFWwindow* window_ = nullptr;
  std::deque<Event> events_;
  bool down_[3] = {};
  double x_ = 0.0, y_ = 0.0;
};

// Whether shift is held now, of whichever window has the keyboard: what is dragged comes from another one. False too where it is not X11.
bool shiftHeld();

}  // namespace forelock::samples
