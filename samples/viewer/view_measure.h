// Small measures of scenes and pictures that the viewer takes every frame. SPDX-License-Identifier: MIT
#pragma once

#include "view_session.h"

#include <string>
#include <vector>

namespace forelock::samples {

// Text that differs where a picture would.
std::string pictureKey(const ViewSession& session, const Camera& camera);
// Text that differs where the exposure that is chosen may.
std::string lightsKey(const Scene& scene);
// Of one asset of a scene.
std::string writeAsset(const SceneAsset& asset);

// Root mean square of the difference over pixels with hair in either (RGBA, linear), of 255: docs/methods.md section 8. Not a number where
// sizes differ or no pixel has hair.
double rmseOf(const std::vector<float>& a, const std::vector<float>& b);

// Through a file beside it. Throws AssetError.
void writeWholeText(const std::string& path, const std::string& text);

}  // namespace forelock::samples
