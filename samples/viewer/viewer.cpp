// SPDX-License-Identifier: MIT
#include "viewer_app.h"

#include "command_line.h"
#include "ui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace forelock::samples {

namespace {

constexpr double kProgress_s = 0.03;       // leaves the processors to who loads
constexpr double kIdle_s = 0.5;            // a person's input wakes it at once
constexpr double kAgainAfterLoss_s = 5.0;  // a device that is lost sooner again is given up

}  // namespace

bool Viewer::makeDevice(std::string& error) {
  auto device = std::make_unique<Device>();
  ViewScreen::Options wanted;
  wanted.validation = options_.validation;
  wanted.vsync = session_.settings.vsync && options_.script.empty();
  wanted.device_name = options_.device;
  wanted.ui_scale = ui_scale_ = session_.settings.ui_scale > 0.0f ? session_.settings.ui_scale : window_->contentScale();
  device->screen = ViewScreen::create(*window_, wanted, error);
  if (!device->screen) {
    return false;
  }
  device->layers = std::make_unique<ViewLayers>(device->screen->host(), device->screen->gpu());
  device->display = std::make_unique<DisplayPass>(device->screen->gpu(), device->screen->renderPass());
  device_ = std::move(device);
  session_.device = device_->screen->host().deviceName();
  if (session_.stage()) {
    device_->layers->setStage(*session_.stage());
  }
  drawn_key_.clear();
  drawn_full_ = sounding_ = false;
  compiled_keys_.clear();
  return true;
}

bool Viewer::compiling() const { return compiling_.valid() && compiling_.wait_for(std::chrono::seconds(0)) != std::future_status::ready; }

void Viewer::loseDevice(const std::string& why) {
  const auto now = Clock::now();
  compiling_ = {};  // waits for it
  if (device_) {
    const auto& messages = device_->screen->host().validationMessages();
    validation_.insert(validation_.end(), messages.begin(), messages.end());
  }
  device_.reset();
  if (lost_ != Clock::time_point{} && seconds(now - lost_) < kAgainAfterLoss_s) {
    throw std::runtime_error(why + " twice within " + std::to_string(static_cast<int>(kAgainAfterLoss_s)) + " seconds");
  }
  lost_ = now;
  std::string error;
  if (!makeDevice(error)) {
    throw std::runtime_error(why + ", and no other is usable: " + error);
  }
  session_.alert = why + ". It was made again; nothing of the scene is lost.";
}

bool Viewer::settled() const {
  return !loader_.busy() && !ready_ && !compiling_.valid() && !opening_ && !loader_.studying() && !sounding_ && (!session_.loaded() || (drawn_full_ && !again_)) &&
         !session_.approach_to && turntable_views_ == 0;
}

void Viewer::tellProgress(bool compiles) {
  session_.busy.clear();
  session_.busy_share = -1.0f;  // not known
  session_.busy_with_turntable = false;
  if (loader_.busy()) {
    session_.busy = "Opening " + loader_.label();
    session_.busy_share = loader_.share();
  } else if (ready_) {
    session_.busy = "Drawing the first picture";
  } else if (compiles) {
    session_.busy = "Compiling shaders";
  } else if (turntable_views_ > 0 && !turntable_path_.empty()) {
    session_.busy = "Drawing the turntable";
    session_.busy_share = static_cast<float>(turntable_at_) / static_cast<float>(turntable_views_);
    session_.busy_with_turntable = true;
  }
}

void Viewer::frame() {
  const auto begin = Clock::now();
  const double dt = seconds(begin - last_frame_);
  last_frame_ = begin;
  if (!first_picture_ && (opening_ || session_.loaded())) {
    held_ms_ = std::max(held_ms_, 1e3 * dt);
  }
  const bool busy = compiling();  // asked once: it may end at any time
  const bool just_compiled = !busy && takeCompiled();
  if (!busy) {
    if (ready_) {
      adopt(std::exchange(ready_, nullptr));
    } else {
      ready_ = loader_.take();  // told by this frame: what follows takes a while
    }
    if (std::unique_ptr<LoadedExtras> extras = loader_.takeExtras()) {
      adoptExtras(std::move(extras));
    }
    takeDropped();
  }
  tellProgress(busy);
  session_.compiling = busy || just_compiled;
  session_.reduced = sounding_ || (session_.loaded() && !drawn_full_);
  const float scale = session_.settings.ui_scale > 0.0f ? session_.settings.ui_scale : window_->contentScale();
  if (scale != ui_scale_) {
    ui_scale_ = scale;
    device_->screen->setUiScale(scale);
  }
  device_->screen->setVsync(session_.settings.vsync && options_.script.empty());
  device_->screen->beginUi();
  script_.drive(settled());
  ui::begin(script_.active());
  ImGui::NewFrame();
  drawUi();
  ImGui::Render();
  bool planned = false;
  if (!busy) {
    takeScript();
    takeRequests();
    stepTurntable();
    moveCamera(dt);
    applyEdits();
    planPicture(planned);
  }
  const ViewportRect rect = viewport_.pixels();
  const bool has_picture = device_->layers->drawn(kLayerFirst) || planned;
  const bool drawn = !minimised_ && device_->screen->draw(
      [&](VkCommandBuffer cmd) {
        if (planned) {
          device_->layers->record(cmd);
        }
      },
      [&](VkCommandBuffer cmd) {
        if (!has_picture || rect.width < 1.0f || rect.height < 1.0f) {
          return;
        }
        DisplayPush push{};
        const float values[4] = {rect.x, rect.y, rect.width, rect.height};
        std::copy(values, values + 4, push.rect);
        if (session_.scene.background) {
          const glm::vec3 ground(*session_.scene.background);
          std::copy(&ground[0], &ground[0] + 3, push.ground);
          push.ground[3] = 1.0f;
        }
        push.mode = session_.shaded() ? static_cast<uint32_t>(session_.compare) : 0;
        push.divider = session_.divider;
        push.gain = session_.gain;
        push.has_opaque = device_->layers->opaqueView() && !sounding_ ? 1 : 0;
        push.scale = sounding_ ? static_cast<float>(session_.scene.exposure) : 1.0f;
        device_->display->record(cmd, push);
      });
  if (!drawn && planned) {  // the window cannot be drawn to now: the picture is drawn all the same
    if (!device_->screen->host().submit([&](VkCommandBuffer cmd) { device_->layers->record(cmd); })) {
      throw DeviceLost("drawing: the device was lost");
    }
  }
  if (planned) {
    const double ms = 1e3 * seconds(Clock::now() - begin);
    if (!drawn_full_) {
      moving_ms_.push_back(ms);
    }
    afterPicture(ms);
  }
  if (!first_picture_ && !opening_ && (planned || sounding_)) {
    first_picture_ = true;
    held_ms_ = std::max(held_ms_, 1e3 * seconds(Clock::now() - begin));
    char text[64];
    std::snprintf(text, sizeof text, ", first picture after %.2f s", seconds(Clock::now() - opened_));
    opened_text_ += text;
    session_.say(opened_text_);
  }
  picture_is_new_ = planned || sounding_;
  ++frames_;
  if (settled() && session_.loaded()) {
    ++settled_frames_;
  }
}

int Viewer::run() {
  std::vector<std::string> notes;
  if (!options_.forget) {
    session_.settings_path = settingsPath();
    session_.settings = loadSettings(session_.settings_path, notes);
  }
  if (!options_.script.empty()) {
    script_ = ViewScript(options_.script);
  }
  session_.scene = options_.scene;
  if (!options_.second_method.empty()) {
    const std::vector<std::string>& names = methodNames();
    session_.second.method = static_cast<uint32_t>(std::find(names.begin(), names.end(), options_.second_method) - names.begin());
    session_.compare = Compare::split;
  }
  const int width = options_.width > 0 ? options_.width : session_.settings.window_width;
  const int height = options_.height > 0 ? options_.height : session_.settings.window_height;
  if (!options_.scene.assets.empty()) {
    open(options_.scene);  // reads while the window and the device come up
  }
  std::string error;
  try {
    window_ = std::make_unique<ViewWindow>(width, height, "Forelock");
    if (!makeDevice(error)) {
      throw std::runtime_error(error);
    }
  } catch (const std::runtime_error& failure) {
    std::fprintf(stderr, "forelock: view: %s\n", failure.what());
    return kNoDevice;
  }
  for (const std::string& note : notes) {
    session_.alert += (session_.alert.empty() ? "" : "\n") + note;
  }
  session_.say("drag a strand file here, or choose one under File; F1 has the keys");
  while (!quit_) {
    if (window_->wantsToClose()) {
      break;
    }
    const bool busy = script_.active() || session_.turning || session_.approach_to || turntable_views_ > 0 || !settled() || options_.frames > 0 ||
                      frames_ < 3 || picture_is_new_ || viewport_.dragging() || window_->input().waiting();
    const bool others_work = (loader_.busy() || compiling()) && !viewport_.dragging();  // a progress bar is all that moves
    ViewWindow::poll(window_->hidden() && !script_.active() ? kIdle_s : others_work ? kProgress_s : busy ? 0.0 : kIdle_s);
    try {
      frame();
    } catch (const DeviceLost& lost) {
      try {
        loseDevice(lost.what());
      } catch (const std::runtime_error& failure) {
        std::fprintf(stderr, "forelock: view: %s\n", failure.what());
        exit_code_ = kNoDevice;
        break;
      }
    }
    if (script_.done() || (options_.frames > 0 && settled_frames_ >= options_.frames)) {
      break;
    }
    if (options_.frames > 0 && !session_.alert.empty()) {
      std::fprintf(stderr, "forelock: %s\n", session_.alert.c_str());
      exit_code_ = kFailed;
      break;
    }
  }
  return finish();
}

int Viewer::finish() {
  compiling_ = {};  // waits for it
  if (window_ && !options_.forget) {
    int width = 0, height = 0;
    glfwGetWindowSize(window_->handle(), &width, &height);
    if (width > 0 && height > 0) {
      session_.settings.window_width = width;
      session_.settings.window_height = height;
    }
    try {
      if (session_.loaded()) {
        session_.settings.last_scene = writeScene(withAbsolutePaths(session_.currentScene()));
      }
    } catch (const std::exception&) {  // a name that is not UTF-8
      session_.settings.last_scene.clear();
    }
    try {
      saveSettings(session_.settings_path, session_.settings);
    } catch (const AssetError& error) {
      std::fprintf(stderr, "forelock: %s\n", error.what());
    }
  }
  if (device_) {
    const auto& messages = device_->screen->host().validationMessages();
    validation_.insert(validation_.end(), messages.begin(), messages.end());
  }
  loader_.stopStudy();
  device_.reset();
  for (const std::string& message : validation_) {
    std::fprintf(stderr, "forelock: validation: %s\n", message.c_str());
  }
  for (const std::string& failure : script_.failures()) {
    std::fprintf(stderr, "forelock: %s: %s\n", options_.script.c_str(), failure.c_str());
  }
  if (script_.active() && !session_.alert.empty()) {
    std::fprintf(stderr, "forelock: %s: an alert was left open: %s\n", options_.script.c_str(), session_.alert.c_str());
  }
  if (script_.active() || options_.frames > 0) {
    std::sort(moving_ms_.begin(), moving_ms_.end());
    std::printf("frames %u, clicks %u, %s\n", frames_, script_.clicks(), session_.status.c_str());
    std::printf("while opening: at most %.0f ms from frame to frame\n", held_ms_);
    if (!moving_ms_.empty()) {
      std::printf("moving: %zu pictures, median %.1f ms, 95 %% within %.1f ms, at %.0f %% of the resolution\n", moving_ms_.size(),
                  moving_ms_[moving_ms_.size() / 2], moving_ms_[moving_ms_.size() * 95 / 100], 100.0 * cheap_share_);
    }
    if (session_.measure_error) {
      std::printf("error: %.4f of 255\n", session_.error);
    }
  }
  const bool failed = !validation_.empty() || !script_.failures().empty() || (script_.active() && !session_.alert.empty());
  return exit_code_ != kDone ? exit_code_ : failed ? kFailed : kDone;
}

int runViewer(const ViewerOptions& options) { return Viewer(options).run(); }

}  // namespace forelock::samples
