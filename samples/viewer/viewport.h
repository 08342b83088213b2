// The part of the window that shows the picture: what the mouse does there, and what is drawn over it. SPDX-License-Identifier: MIT
#pragma once

#include "view_session.h"

namespace forelock::samples {

struct ViewportRect {
  float x = 0.0f, y = 0.0f, width = 1.0f, height = 1.0f;
};

class Viewport {
public:
  // `rect` in the window's coordinates.
  void draw(ViewSession& session, ViewLayers& layers, const ViewportRect& rect);
  // In pixels of the picture.
  void size(uint32_t& width, uint32_t& height) const;
  ViewportRect pixels() const;
  bool dragging() const { return drag_ != Drag::none; }

private:
  enum class Drag { none, turn, pan, divider };
  void mouse(ViewSession& session, ViewLayers& layers);
  void pick(ViewSession& session, ViewLayers& layers, bool go);
  void drawSelection(const ViewSession& session) const;
  void welcome(ViewSession& session) const;
  void drawCaptions(ViewSession& session) const;
  void drawLegend(const Legend& legend) const;
  void drawCount(const ViewSession& session, ViewLayers& layers);

  ViewportRect rect_;
  float scale_ = 1.0f;  // pixels a unit of the window
  Drag drag_ = Drag::none;
  float moved_ = 0.0f;  // since the button went down
  int counted_x_ = -1, counted_y_ = -1;  // the pixel under the mouse, and how many layers it has once that is known
  std::optional<uint64_t> counted_;
  std::string counted_key_;
  Clock::time_point hover_since_{};
};

}  // namespace forelock::samples
