// Assets made from arrays, and checked.
#pragma once

#include "asset_kit.h"

namespace asset_test {

struct Arrays {
  std::vector<uint32_t> first_vertex{0};
  std::vector<float> positions, radii, root_uvs, inverse_masses, colors;

  Arrays& strand(std::initializer_list<float> coordinates) {
    positions.insert(positions.end(), coordinates.begin(), coordinates.end());
    first_vertex.push_back(static_cast<uint32_t>(positions.size() / 3));
    return *this;
  }
  Arrays& goodStrand(float x = 0) { return strand({x, 0, 0, x, 0.1f, 0, x, 0.2f, 0}); }
  FlkStrands view() const {
    FlkStrands strands{};
    strands.type = FLK_TYPE_STRANDS;
    strands.strand_count = static_cast<uint32_t>(first_vertex.size() - 1);
    strands.vertex_count = first_vertex.back();
    strands.first_vertex = first_vertex.data();
    strands.positions = positions.data();
    strands.radii = radii.empty() ? nullptr : radii.data();
    strands.root_uvs = root_uvs.empty() ? nullptr : root_uvs.data();
    strands.inverse_masses = inverse_masses.empty() ? nullptr : inverse_masses.data();
    strands.colors = colors.empty() ? nullptr : colors.data();
    return strands;
  }
};

inline std::unique_ptr<Loaded> create(const Arrays& arrays) {
  auto made = std::make_unique<Loaded>();
  const FlkAssetOptions options = optionsFor(made->caught, "made");
  const FlkStrands strands = arrays.view();
  FlkAsset asset = nullptr;
  made->result = flkAssetCreate(&strands, &options, &asset);
  made->asset.reset(asset);
  if (made->result == FLK_SUCCESS) {
    if (const char* broken = brokenPromise(asset)) ADD_FAILURE() << "broken promise: " << broken;
    if (const char* broken = brokenRoundTrip(asset)) ADD_FAILURE() << "broken round trip: " << broken;
  } else {
    EXPECT_EQ(asset, nullptr);
    EXPECT_NE(made->caught.text().find("made: "), std::string::npos);
  }
  return made;
}

}  // namespace asset_test
