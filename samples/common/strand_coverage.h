// How much of what is behind them strands cover. SPDX-License-Identifier: MIT
#pragma once

#include "strand_edit.h"

#include <vector>

namespace forelock::samples {

// Points on planes square to six directions, the same for every set of strands within the same bounds, so that two sets are compared without the
// noise of the points themselves.
class CoverageMeter {
public:
  // `points` a side: points^2 a direction, a point in every cell of a grid over the bounds. `opacity` of a fibre in (0, 1].
  CoverageMeter(const EditableStrands& strands, double opacity, uint32_t points = 192);

  // Mean over points that anything within the bounds may cover of 1 - (1 - opacity)^layers, with radii times `widening`: the coverage of an orthographic
  // picture without a limit of resolution. Strands need radii.
  double measure(const EditableStrands& strands, double widening) const;

private:
  double opacity_;
  uint32_t points_;
  double low_[3], high_[3];
};

}  // namespace forelock::samples
