// One scene twice: drawn by the SDK on the device, and described to the float64 reference.
#pragma once

#include "condition.h"
#include "headless_host.h"
#include "reference.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace forelock::test {

// The device that all GPU tests share, validation on. "No device" fails the test.
samples::HeadlessHost& host();

// Strands as plain arrays.
struct StrandArrays {
  std::vector<uint32_t> first_vertex{0};
  std::vector<float> positions, radii;
  uint32_t strands() const { return uint32_t(first_vertex.size()) - 1; }
  void add(const std::vector<std::array<float, 3>>& points, float radius);
};

// `groom:NAME` or a file; every `stride`-th strand. Fails the test when it cannot be opened.
StrandArrays loadStrands(const std::string& source, uint32_t stride = 1);
std::string hairdata(const std::string& file);

// The grooms and files that every bound is checked on; `stride` thins the densest at 256x256, where it would be
// over a hundred layers deep everywhere.
struct AssetCase {
  const char* name;
  const char* source;
  uint32_t stride;
};
inline constexpr AssetCase kAssetCases[] = {
    {"paper-load", "groom:paper-load", 1}, {"long-wavy", "groom:long-wavy", 12}, {"mohawk", "hairdata:Ratboy_mohawk.tfx", 1}};
// Loaded once a process. Empty where the file is absent: the caller skips, visibly.
const StrandArrays& caseStrands(const AssetCase& asset, bool thinned = true);

struct ViewSpec {
  int width = 256, height = 256;
  reference::Vec3 eye{0, 0, 1}, target{0, 0, 0}, up{0, 1, 0};
  reference::Projection projection;
};
// A view of all strands from the front right.
ViewSpec frameStrands(const StrandArrays& strands, int width, int height);
// A camera that the groom paper-load stores.
ViewSpec storedView(const char* name);

// Owns a hair and a view on the device, and the same as a reference scene.
class Scene {
public:
  Scene(const StrandArrays& strands, const FlkMaterial& material, const ViewSpec& view, uint32_t flags = FLK_HAIR_KEEP_ORDER, uint32_t seed = 0);
  ~Scene();
  Scene(const Scene&) = delete;

  // A light in view space directions; `shadow_size` 0: casts no shadow.
  void setLight(const double to_light_vs[3], double radiance, uint32_t shadow_size, uint32_t shadow_cover = FLK_SHADOW_COVER_TEXEL);
  void noLight();
  void setWidthScale(float scale);
  // The width scale that makes the thickest strand `width_px` wide at the view's target.
  float widthScaleFor(double width_px) const;
  // Scales the light until the mean of R_exact over hair pixels is `mean`. Needs a light; `lists` as gather() gives them.
  void expose(double mean, const reference::FragmentLists& lists);

  const FlkLight& light() const { return light_; }
  // `frame` with this scene's camera, hair and light; valid as long as the scene.
  FlkFrame frame(FlkFrame frame);
  // Renders with the frame's method etc.; returns linear RGBA. Fails the test on any error or lost fragment.
  std::vector<float> render(FlkFrame frame = {});
  reference::Image toImage(const std::vector<float>& rgba) const;  // for compare(): a fragment where alpha > 0
  reference::ShadowMap readShadowMap();

  reference::FragmentLists gather(std::span<const double> host_depth = {}) const;
  reference::Image referenceImage(const reference::ResolveOptions& options,
                                  const std::vector<reference::ShadowMap>& maps) const;

  reference::Scene reference_scene;
  reference::Camera camera;
  ViewSpec view_spec;
  FlkHair hair = nullptr;
  FlkView view = nullptr;
  FlkPlan plan = nullptr;  // of the last render
  FlkStatistics statistics{};
  FlkMaterial material;
  float thickest = 0;

private:
  FlkLight light_{};
  bool lit_ = false;
};

// Share in percent of the texels that either map covers and that differ by more than `tolerance` (metre).
double mapDifference(const reference::ShadowMap& a, const reference::ShadowMap& b, double tolerance);

// Both images and their difference beside each other, for a failing test.
void writeFailure(const std::string& name, const reference::Image& actual, const reference::Image& expected);

}  // namespace forelock::test
