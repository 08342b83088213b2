// Rows G12 and G13: order of hair and hair, of hair and the host's depth, and positions from depth, from 0.3 to 200 m.
#include "frame_kit.h"
#include "numerics_spv/numerics_depth.h"
#include "numerics_spv/numerics_position.h"

#include <gtest/gtest.h>

#include <string>

namespace forelock::test {
namespace {

constexpr double kFibre = 70e-6;  // metre: how far apart two fibres are
constexpr int kSize = 64;
constexpr double kDistances[] = {0.3, 1, 3, 10, 30, 100, 200};
constexpr double kFar[] = {1e2, 1e4, 1e6, 1e8};

ViewSpec distantView(double distance, double far, bool reversed) {
  ViewSpec view;
  view.width = view.height = kSize;
  view.eye = {0.013, -0.007, distance}, view.target = {0.013, -0.007, 0};
  view.projection.tan_half_y = 0.25;
  view.projection.near_plane = 1e-2, view.projection.far_plane = far, view.projection.reversed = reversed;
  return view;
}

// 8 x 8 pairs of strands that cross, a fibre apart in depth: the one along x is dark under a light along x, the other bright.
TEST(DepthOrder, HairAndHair) {
  std::string counts;
  std::size_t wrong_within = 0, pairs = 0;
  for (const double distance : kDistances) {
    std::size_t wrong = 0;
    std::mt19937 random{uint32_t(distance * 10)};
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double pixel = 2 * 0.25 * distance / kSize;
    StrandArrays strands;
    std::vector<bool> dark_first;
    for (int p = 0; p < 64; ++p) {
      const double x = 0.013 + (p % 8 * 8 + 4.5 - kSize / 2) * pixel,
                   y = -0.007 - (p / 8 * 8 + 4.5 - kSize / 2) * pixel;
      // Up to half a pixel of depth, so that perspective does not move them, and fp32 rounds each elsewhere.
      const double z = 0.5 * pixel * uniform(random), step = random() % 2 ? kFibre : -kFibre;
      strands.add({{float(x - 4 * pixel), float(y), float(z + step / 2)},
                   {float(x + 4 * pixel), float(y), float(z + step / 2)}},
                  float(4 * pixel));
      strands.add({{float(x), float(y - 4 * pixel), float(z - step / 2)},
                   {float(x), float(y + 4 * pixel), float(z - step / 2)}},
                  float(4 * pixel));
      dark_first.push_back(step > 0);
    }
    for (const double far : kFar)
      for (const bool reversed : {false, true}) {
        Scene scene(strands, plainMaterial(0.9f, 0.9f), distantView(distance, far, reversed));
        const double along_x[3] = {1, 0, 0};
        scene.setLight(along_x, 1, 0);
        FlkFrame frame{};
        frame.method = FLK_METHOD_EXACT;
        const std::vector<float> image = scene.render(frame);
        for (int p = 0; p < 64; ++p) {
          const float red = image[std::size_t((p / 8 * 8 + 4) * kSize + p % 8 * 8 + 4) * 4];
          // 0.9 x 0.9 where the bright one is first, a tenth of that where it is second.
          wrong += (red < 0.4f) != dark_first[std::size_t(p)];
          ++pairs;
        }
      }
    if (distance <= 100) wrong_within += wrong;
    enlist(counts, format(distance) + " m " + std::to_string(wrong));
  }
  EXPECT_EQ(wrong_within, 0u);
  record("G12",
         "hair 70 um before hair, near 1e-2, far 1e2 to 1e8, standard and reversed, to 100 m: pairs in the wrong "
         "order, of " +
             std::to_string(pairs * 6 / 7),
         "0", std::to_string(wrong_within));
  record("G12", "the same at each distance", "reported", counts);
}

struct DepthFormat {
  const char* name;
  bool reversed, sixteen_bits;
};

// The depth a host's rasteriser writes: clip z and w in fp32, then the format.
float storedDepth(const float* clip, double depth, bool sixteen_bits) {
  const float d = float(depth), z = -clip[10] * d + clip[14];
  const float value = std::clamp(z / d, 0.0f, 1.0f);
  return sixteen_bits ? float(std::nearbyint(double(value) * 65535) / 65535) : value;
}

// A leaning strand over the whole picture, the host's surface a fibre before it or behind, by pixels.
StrandArrays leaningStrand(double distance) {
  const double s = 0.25 * distance;
  StrandArrays strands;
  strands.add({{float(0.013 - 3 * s), float(-0.007 - 0.5 * s), float(-0.11 * s)},
               {float(0.013 + 3 * s), float(-0.007 + 0.5 * s), float(0.13 * s)}},
              float(2 * s));
  return strands;
}

TEST(DepthOrder, HairAndTheHostsSurface) {
  const DepthFormat formats[] = {{"D32, reversed", true, false},
                                 {"D32, standard", false, false},
                                 {"D16, reversed", true, true},
                                 {"D16, standard", false, true}};
  for (const DepthFormat& format_of : formats) {
    std::string shares;
    std::size_t wrong_within = 0, within = 0;
    for (const double distance : kDistances) {
      std::size_t wrong = 0, pixels = 0;
      for (const double far : kFar) {
        if (distance * 1.1 > far) continue;  // beyond the far plane
        Scene scene(leaningStrand(distance), plainMaterial(1, 1), distantView(distance, far, format_of.reversed));
        const reference::FragmentLists lists = scene.gather();
        float clip[16];
        for (int i = 0; i < 16; ++i) clip[i] = float(scene.camera.clip_from_view[i]);
        std::vector<float> buffer(kSize * kSize);
        for (int y = 0; y < kSize; ++y)
          for (int x = 0; x < kSize; ++x) {
            const double side = (x + y) % 2 ? kFibre : -kFibre;
            buffer[std::size_t(y * kSize + x)] =
                storedDepth(clip, lists.at(x, y)[0].depth + side, format_of.sixteen_bits);
          }
        host().resize(kSize, kSize);
        host().setDepth(buffer);
        const std::vector<float> image = scene.render();
        host().setDepth({});
        for (std::size_t i = 0; i < buffer.size(); ++i) {
          wrong += (image[i * 4 + 3] > 0) != ((i % kSize + i / kSize) % 2 == 1);
          ++pixels;
        }
      }
      if (pixels == 0) continue;
      if (distance <= 100) wrong_within += wrong, within += pixels;
      enlist(shares, format(distance) + " m " + format(100.0 * double(wrong) / double(pixels)) + " %");
    }
    const bool held = format_of.reversed && !format_of.sixteen_bits;
    EXPECT_TRUE(!held || wrong_within == 0) << format_of.name;
    record("G12",
           std::string("host's surface 70 um before or behind hair, ") + format_of.name +
               ", far 1e2 to 1e8, to 100 m: wrong pixels, of " + std::to_string(within),
           held ? "0" : "reported", std::to_string(wrong_within));
    record("G12", std::string("the same, ") + format_of.name + ", at each distance", "reported", shares);
  }
}

// From the depth that the hair's lists hold, unprojected by the shader, against the point of the strand in float64.
TEST(PositionFromDepth, WithinAQuarterOfAFibre) {
  std::string each;
  Worst within;
  for (const double distance : {0.3, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 200.0}) {
    Worst error;
    for (const double far : {1e2, 1e8}) {
      if (distance * 1.1 > far) continue;
      Scene scene(leaningStrand(distance), plainMaterial(1, 1), distantView(distance, far, true));
      host().setOutputs(1u << FLK_OUTPUT_FRONT_DEPTH);
      scene.render();
      const std::vector<float> depth = host().readOutput(FLK_OUTPUT_FRONT_DEPTH);
      host().setOutputs(0);
      const reference::FragmentLists lists = scene.gather();
      const double* p = scene.camera.clip_from_view;
      std::vector<float> in;
      for (int i = 0; i < kSize * kSize; ++i)
        add(in,
            {i % kSize + 0.5, i / kSize + 0.5, double(depth[std::size_t(i)]), p[0], p[5], p[8], p[9], kSize, kSize});
      const std::vector<float> out = runItems(numerics_position, in, 9, 3);
      ASSERT_EQ(out.size(), std::size_t(kSize * kSize * 3));
      for (int i = 0; i < kSize * kSize; ++i) {
        const double d = lists.at(i % kSize, i / kSize)[0].depth;
        const double ndc_x = (i % kSize + 0.5) / kSize * 2 - 1, ndc_y = (i / kSize + 0.5) / kSize * 2 - 1;
        const Vec3 truth{(ndc_x + p[8]) * d / p[0], (ndc_y + p[9]) * d / p[5], -d};
        error.see(1e6 * length(sum(at(out, std::size_t(i) * 3), scaled(truth, -1))));
      }
    }
    if (distance <= 20) within.see(error.value());
    enlist(each, format(distance) + " m " + format(error.value()) + " um");
  }
  EXPECT_LT(within.value(), kFibre / 2 / 4 * 1e6);
  record("G13", "position of a fragment from its stored depth, to 20 m: largest error",
         "< 8.75 um (a quarter of a fibre's radius)", format(within.value()) + " um");
  record("G13", "the same at each distance", "reported", each);
}

// What of it a host's buffer would lose.
TEST(PositionFromDepth, FromTheHostsBuffer) {
  for (const bool reversed : {false, true}) {
    std::string each;
    for (const double distance : {2.0, 20.0, 200.0}) {
      const reference::Camera camera = reference::makeCamera({0, 0, 1}, {0, 0, 0}, {0, 1, 0},
                                                             distantView(1, 1e4, reversed).projection, kSize, kSize);
      float clip[16];
      for (int i = 0; i < 16; ++i) clip[i] = float(camera.clip_from_view[i]);
      std::vector<float> in, depths;
      for (int i = 0; i < 4000; ++i) {
        depths.push_back(float(distance * (1 + 1e-5 * i)));
        in.insert(in.end(), {storedDepth(clip, double(depths.back()), false), clip[10], clip[14], 0});
      }
      const std::vector<float> out = runItems(numerics_depth, in, 4, 1);
      ASSERT_EQ(out.size(), depths.size());
      Worst error;
      for (std::size_t i = 0; i < out.size(); ++i) error.see(1e6 * std::fabs(double(out[i]) - double(depths[i])));
      enlist(each, format(distance) + " m " + format(error.value()) + " um");
    }
    record("G13",
           std::string("depth of the host's surface from a D32 buffer, ") + (reversed ? "reversed" : "standard") +
               ", near 1e-2: largest error",
           "reported", each);
  }
}

}  // namespace
}  // namespace forelock::test
