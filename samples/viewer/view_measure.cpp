// SPDX-License-Identifier: MIT
#include "view_measure.h"

#include "whole_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {

std::string writeAsset(const SceneAsset& asset) {
  Scene scene;
  scene.assets = {asset};
  return writeScene(scene);
}

std::string lightsKey(const Scene& scene) {
  Scene lights;
  lights.lights = scene.lights;
  lights.ambient = scene.ambient;
  lights.sky = scene.sky;
  lights.ambient_sh = scene.ambient_sh;
  return writeScene(lights);
}

std::string pictureKey(const ViewSession& session, const Camera& camera) {
  Scene scene = session.scene;
  scene.camera.placed = camera;
  scene.background.reset();  // put behind afterwards
  std::string key = writeScene(scene);
  if (session.compare != Compare::none) {
    Scene second;
    applyMethod(session.second, second);
    key += writeScene(second);
  }
  key += session.measure_error ? "e" : "";
  key += session.count_work ? "c" : "";
  return key;
}

double rmseOf(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0, pixels = 0.0;
  for (size_t i = 0; i + 3 < a.size() && a.size() == b.size(); i += 4) {
    if (!(a[i + 3] > 0.0f) && !(b[i + 3] > 0.0f)) {
      continue;
    }
    for (size_t c = i; c < i + 3; ++c) {
      const double d = 255.0 * (std::clamp(static_cast<double>(a[c]), 0.0, 1.0) - std::clamp(static_cast<double>(b[c]), 0.0, 1.0));
      sum += d * d;
    }
    pixels += 1.0;
  }
  return pixels > 0.0 ? std::sqrt(sum / pixels) : std::numeric_limits<double>::quiet_NaN();
}

void writeWholeText(const std::string& path, const std::string& text) {
  writeWholeFiles({{path, {reinterpret_cast<const unsigned char*>(text.data()), text.size()}}});
}

}  // namespace forelock::samples
