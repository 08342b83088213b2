// A scene of several hairs and lights twice: for the SDK on the device, and for the float64 reference.
#pragma once

#include "reference_follow.h"
#include "reference_outputs.h"
#include "scene.h"

#include <memory>
#include <optional>

namespace forelock::test {

struct HairSpec {
  StrandArrays strands;
  FlkMaterial material = samples::conditionMaterial(samples::HairColor::dark);
  std::vector<float> colors, root_uvs;  // empty: none
  FlkFollowStrands follow{};
  const FlkRootImage* root_image = nullptr;
  std::vector<float> moved;             // host positions, in the asset's order; empty: none
  std::array<double, 3> offset{};       // of world from hair
  double scale = 1;
  uint32_t flags = FLK_HAIR_KEEP_ORDER;
  uint32_t seed = 0;
};

class World {
public:
  explicit World(const ViewSpec& view, uint64_t pool_budget = uint64_t(1) << 30);
  ~World();
  World(const World&) = delete;

  void add(const HairSpec& spec);
  // Direction, axis and position are world space; twin and all.
  void addLight(const FlkLight& light);
  void setAmbientSh(const std::vector<float>& coefficients);
  void addModifier(const FlkOpacityModifier& modifier);
  // Scales all lights and ambient light until the mean of R_exact over hair pixels is the condition's for dark hair.
  void expose();

  FlkFrame frame() const;  // camera, hairs, lights and all
  // Linear RGBA. A frame whose lists were too short is drawn again, unless `once`.
  std::vector<float> render(FlkFrame frame, bool once = false);
  reference::Image image(const std::vector<float>& rgba) const;
  std::vector<reference::LightMaps> readMaps();  // as the last frame left them
  reference::FragmentLists gather(reference::Payload payload = reference::Payload::kept) const;
  // The sphere of the shadow maps: of the hairs, or of the bounds that came with host positions.
  reference::Sphere sphere() const;
  std::vector<reference::LightMaps> ownMaps() const;  // the reference's
  // `shift`: of the camera, in pixels.
  reference::Image expected(reference::Method method, reference::TailOrder tail, const std::vector<reference::LightMaps>& maps,
                            std::array<double, 2> shift_px = {0, 0}) const;

  ViewSpec view_spec;
  reference::Camera camera;
  reference::Scene twin;
  reference::OpacityModifiers modifiers;
  std::vector<FlkHair> hairs;
  std::vector<FlkLight> lights;
  std::vector<FlkOpacityModifier> device_modifiers;
  std::vector<float> ambient_sh;
  float ambient[3] = {0, 0, 0};
  FlkLightTiles light_tiles{};
  FlkSampledImage host_shadow_maps{}, host_visibility{};
  FlkView view = nullptr;
  FlkPlan plan = nullptr;
  FlkStatistics statistics{};

private:
  std::vector<std::unique_ptr<FlkHostShadow>> kept_;
  std::optional<reference::Sphere> moved_sphere_;
};

// Mean width that the thickest strand has at the view's target, as a factor of the asset's widths.
float widthScale(const StrandArrays& strands, const ViewSpec& view, double width_px);

}  // namespace forelock::test
