// What the host draws beside hair: meshes, their depth for hair to hide behind, their shadow on hair, hair's shadow on them.
// SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"
#include "gpu_resources.h"
#include "opaque_mesh.h"

#include <forelock/render.h>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace forelock::samples {

class HeadlessHost;

// A light as the meshes see it; entry i is light i of the frame.
struct OpaqueLight {
  uint32_t kind = FLK_LIGHT_DIRECTIONAL;
  glm::vec3 to_light{0.45f, 0.65f, 0.62f};  // directional: unit, to the light; spot: against its axis
  glm::dvec3 position{0.0};                 // (m) point, spot
  glm::vec3 color{2.2f, 2.1f, 2.0f};        // radiance leaving a white surface that faces it, times pi; at one metre of point and spot
  float range = 0.0f;                       // (m) 0: no end
  float source_radius = 0.01f;              // (m)
  float inner_angle = 0.0f, outer_angle = 0.0f;  // (rad) spot
  bool casts_shadow = true;
};

struct OpaqueLook {
  std::vector<OpaqueLight> lights;
  glm::vec3 ambient{0.16f, 0.17f, 0.19f};
  std::array<glm::vec3, 9> ambient_sh{};  // radiance over directions, added to it, in the order of FlkFrame.ambient_sh
  float fibre_spacing_m = 4e-3f, shadow_opacity = 0.35f;  // of the hair, for its shadow
  bool flat = false;                      // colours are data: an albedo of 0.10 for all
};

class OpaqueScene {
public:
  // Uploads, makes pipelines. Null with the reason in `error`. The host must outlive it.
  static std::unique_ptr<OpaqueScene> create(HeadlessHost& host, std::vector<OpaqueMesh> meshes, std::string& error);
  ~OpaqueScene();
  OpaqueScene(const OpaqueScene&) = delete;
  OpaqueScene& operator=(const OpaqueScene&) = delete;

  bool empty() const;
  // Box around all vertices (m); of an empty scene 0.
  void bounds(float low[3], float high[3]) const;

  // Readies images of this size, the frame's constants and the matrices of the lights' shadow maps. The device must be idle.
  // False: no device memory.
  bool prepare(const Camera& camera, double aspect, uint32_t width, uint32_t height, const OpaqueLook& look);
  // Draws the depth image and a depth map for each of the first eight lights that cast shadows. A point light, or a spot wider than 60
  // degrees, has one only where it shines from outside the sphere around the meshes. Outside rendering.
  void recordDepth(VkCommandBuffer cmd);
  // frame.depth, frame.host_shadow_maps, lights[i].host_shadow: for a frame recorded after recordDepth in the same command buffer.
  // Pointers live in this object until the next prepare().
  void fillFrame(FlkFrame& frame, std::vector<FlkLight>& lights) const;
  // After flkCmdRender of `view`: shades the meshes, with hair's shadow maps of the view's latest plan. `target`: RGBA16F of prepare()'s size
  // with COLOR_ATTACHMENT usage; what was in it is lost, and it is left in SHADER_READ_ONLY_OPTIMAL, visible to all that follows. Alpha
  // is 1 on meshes, 0 elsewhere. What an earlier call recorded must have completed.
  void recordColor(VkCommandBuffer cmd, FlkView view, const GpuImage& target);

  const GpuImage& depth() const;  // D32_SFLOAT, in DEPTH_READ_ONLY_OPTIMAL after recordDepth
  uint32_t shadowMapCount() const;

private:
  OpaqueScene();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forelock::samples
