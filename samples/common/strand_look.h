// Widths and colours that artists give to strands. SPDX-License-Identifier: MIT
#pragma once

#include "image.h"
#include "strand_edit.h"

#include <string>
#include <vector>

namespace forelock::samples {

// Factor of the width at places along a strand, linear between them, constant before the first and after the last.
struct WidthProfile {
  struct Knot {
    double along;   // share of the strand's length from the root [0, 1]
    double factor;  // >= 0
  };
  std::vector<Knot> knots;  // rising
  double at(double along) const;
};
// "0:1,0.7:0.9,1:0.1". Throws std::invalid_argument with what is wrong.
WidthProfile parseWidthProfile(const std::string& text);

// Widths become the profile times `diameter`, or times the widths there are where `diameter` is 0. Strands without widths need a diameter.
void applyWidthProfile(EditableStrands& strands, const WidthProfile& profile, double diameter);

struct RootColorReport {
  uint32_t outside = 0;  // strands whose root UV is outside 0..1, which take the border's colour
};
// Multiplies the colours of every strand (white where there are none) by the image at its root UV, as FlkRootImage is read: between the four nearest pixels,
// v = 0 is the top row. Throws std::invalid_argument where there are no root UVs.
RootColorReport colorFromImage(EditableStrands& strands, const Image& image);

}  // namespace forelock::samples
