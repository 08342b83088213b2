// SPDX-License-Identifier: MIT
#include "opaque_scene.h"

#include "headless_host.h"
#include "opaque_maps.h"
#include "opaque_pipelines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace forelock::samples {

namespace {

constexpr size_t kMostHairLights = 8;  // whose hair shadow falls on meshes
constexpr size_t kMostFaces = 6 * kMostHairLights;

glm::mat4 clipFromWorld(const Camera& camera, double aspect) {
  double view[16];
  float projection[16];
  viewMatrix(camera, view);
  projectionMatrix(camera, aspect, projection);
  glm::dmat4 to_view, to_clip;
  for (int i = 0; i < 16; ++i) {
    to_view[i / 4][i % 4] = view[i];
    to_clip[i / 4][i % 4] = static_cast<double>(projection[i]);
  }
  return glm::mat4(to_clip * to_view);
}

}  // namespace

struct OpaqueScene::Impl {
  HeadlessHost* host = nullptr;
  const GpuResources* resources = nullptr;
  OpaquePipelines pipelines;
  std::vector<OpaqueDraw> draws;
  std::vector<GpuBuffer> meshes;
  glm::vec3 low{0.0f}, high{0.0f};

  GpuImage depth, maps, no_hair;      // no_hair: bound where there is no hair shadow map, never read
  std::vector<VkImageView> layers;    // of `maps`
  GpuBuffer constants;                // FrameConstants, then faces, then lights
  MeshMaps mesh_maps;                 // by layer of `maps`
  std::vector<FlkHostShadow> host_shadows;  // by layer
  glm::mat4 clip_from_world{1.0f};
  bool reversed_depth = false;
  bool flat = false;
  std::vector<opaque::LightConstants> lights;
  uint32_t width = 0, height = 0;

  bool upload(const OpaqueMesh& mesh);
  bool readyImages(uint32_t wanted_width, uint32_t wanted_height);
  bool readyMaps(uint32_t count);
  void readyLights(const OpaqueLook& look);
  bool readyConstants(const Camera& camera, const OpaqueLook& look);
  void destroy();

  VkDeviceSize facesAt() const { return sizeof(opaque::FrameConstants); }
  VkDeviceSize lightsAt() const { return facesAt() + kMostFaces * sizeof(opaque::FaceConstants); }
  OpaquePush push() const;
};

OpaqueScene::OpaqueScene() : impl_(std::make_unique<Impl>()) {}

OpaqueScene::~OpaqueScene() { impl_->destroy(); }

void OpaqueScene::Impl::destroy() {
  if (!resources) {
    return;
  }
  for (const VkImageView layer : layers) {
    pipelines.destroyView(layer);
  }
  for (GpuImage* image : {&depth, &maps, &no_hair}) {
    resources->destroy(*image);
  }
  for (GpuBuffer& buffer : meshes) {
    resources->destroy(buffer);
  }
  resources->destroy(constants);
  pipelines.destroy();
}

// Positions, normals and openness one after the other, then the indices.
bool OpaqueScene::Impl::upload(const OpaqueMesh& mesh) {
  const size_t vertices = mesh.vertices();
  const std::vector<float> open = mesh.openness.empty() ? std::vector<float>(vertices, 1.0f) : mesh.openness;
  OpaqueDraw draw;
  draw.normals_at = 12 * vertices;
  draw.openness_at = 24 * vertices;
  draw.indices_at = 28 * vertices;
  draw.index_count = static_cast<uint32_t>(mesh.indices.size());
  draw.albedo = mesh.albedo;
  GpuBuffer& buffer = meshes.emplace_back();
  if (!resources->createBuffer(draw.indices_at + 4 * mesh.indices.size(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT, buffer)) {
    return false;
  }
  draw.buffer = buffer.buffer;
  auto* bytes = static_cast<std::byte*>(buffer.mapped);
  std::memcpy(bytes, mesh.positions.data(), 12 * vertices);
  std::memcpy(bytes + draw.normals_at, mesh.normals.data(), 12 * vertices);
  std::memcpy(bytes + draw.openness_at, open.data(), 4 * vertices);
  std::memcpy(bytes + draw.indices_at, mesh.indices.data(), 4 * mesh.indices.size());
  draws.push_back(draw);
  return true;
}

std::unique_ptr<OpaqueScene> OpaqueScene::create(HeadlessHost& host, std::vector<OpaqueMesh> meshes, std::string& error) {
  std::unique_ptr<OpaqueScene> scene(new OpaqueScene);
  Impl& i = *scene->impl_;
  i.host = &host;
  std::erase_if(meshes, [](const OpaqueMesh& mesh) { return mesh.indices.empty(); });
  if (!meshes.empty() && !host.queueHasGraphics()) {
    error = "the device's queue has no graphics, which meshes are drawn with";
    return nullptr;
  }
  i.resources = &host.resources();
  if (meshes.empty()) {
    return scene;
  }
  if (!i.pipelines.create(host.device(), error)) {
    return nullptr;
  }
  i.low = glm::vec3(std::numeric_limits<float>::max());
  i.high = -i.low;
  for (const OpaqueMesh& mesh : meshes) {
    if (!i.upload(mesh)) {
      error = mesh.label + ": there is not enough device memory for the mesh";
      return nullptr;
    }
    for (size_t v = 0; v < mesh.vertices(); ++v) {
      const glm::vec3 p(mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]);
      i.low = glm::min(i.low, p);
      i.high = glm::max(i.high, p);
    }
  }
  const GpuImageShape nothing{1, 1, 1, VK_IMAGE_VIEW_TYPE_2D, VK_FORMAT_R32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT};
  bool ready = i.resources->createImage(nothing, i.no_hair) && i.readyMaps(0);
  ready = ready && host.submit([&](VkCommandBuffer cmd) {
    for (const GpuImage* image : {&i.no_hair, &i.maps}) {
      i.resources->transition(cmd, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
  });
  if (!ready) {
    error = "there is not enough device memory for an image";
    return nullptr;
  }
  return scene;
}

bool OpaqueScene::empty() const { return impl_->draws.empty(); }
const GpuImage& OpaqueScene::depth() const { return impl_->depth; }
uint32_t OpaqueScene::shadowMapCount() const { return static_cast<uint32_t>(impl_->mesh_maps.maps.size()); }

void OpaqueScene::bounds(float low[3], float high[3]) const {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = impl_->low[axis];
    high[axis] = impl_->high[axis];
  }
}

bool OpaqueScene::Impl::readyImages(uint32_t wanted_width, uint32_t wanted_height) {
  if (depth.view && width == wanted_width && height == wanted_height) {
    return true;
  }
  resources->destroy(depth);
  width = wanted_width;
  height = wanted_height;
  return resources->createImage({width, height, 1, VK_IMAGE_VIEW_TYPE_2D, VK_FORMAT_D32_SFLOAT,
                                 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT},
                                depth);
}

// `count` layers; 0: one texel that is bound and never read.
bool OpaqueScene::Impl::readyMaps(uint32_t count) {
  if (maps.view && layers.size() == count) {
    return true;
  }
  for (const VkImageView layer : layers) {
    pipelines.destroyView(layer);
  }
  layers.clear();
  resources->destroy(maps);
  const uint32_t size = count > 0 ? kMeshMapSize : 1;
  if (!resources->createImage({size, size, std::max(count, 1u), VK_IMAGE_VIEW_TYPE_2D_ARRAY, VK_FORMAT_D32_SFLOAT,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_DEPTH_BIT},
                              maps)) {
    return false;
  }
  for (uint32_t layer = 0; layer < count; ++layer) {
    const VkImageView view = pipelines.layerView(maps, layer);
    if (!view) {
      return false;
    }
    layers.push_back(view);
  }
  return true;
}

void OpaqueScene::Impl::readyLights(const OpaqueLook& look) {
  mesh_maps = mapsOfMeshes(look.lights, low, high);
  lights.clear();
  host_shadows.clear();
  for (size_t index = 0; index < look.lights.size(); ++index) {
    const OpaqueLight& light = look.lights[index];
    const bool placed = light.kind != FLK_LIGHT_DIRECTIONAL, spot = light.kind == FLK_LIGHT_SPOT;
    opaque::LightConstants& c = lights.emplace_back();
    c.to_light = light.kind == FLK_LIGHT_POINT ? glm::vec3(0.0f) : glm::normalize(light.to_light);
    c.placed = placed ? 1 : 0;
    c.position = glm::vec3(light.position);
    c.inverse_range = placed && light.range > 0.0f ? 1.0f / light.range : 0.0f;
    c.color = light.color;
    c.least_square = light.source_radius > 0.0f ? light.source_radius * light.source_radius : 1e-6f;
    c.cos_outer = std::cos(light.outer_angle);
    c.cone_scale = spot ? 1.0f / std::max(std::cos(light.inner_angle) - c.cos_outer, 1e-6f) : 0.0f;
    c.layer = mesh_maps.of_light[index];
    if (c.layer >= 0) {
      const MeshMap& map = mesh_maps.maps[static_cast<size_t>(c.layer)];
      c.texel = map.texel;
      c.map_from_world = glm::mat4(map.map_from_world);
    }
  }
  for (uint32_t layer = 0; layer < mesh_maps.maps.size(); ++layer) {
    FlkHostShadow& shadow = host_shadows.emplace_back();
    std::memcpy(shadow.map_from_world, &mesh_maps.maps[layer].map_from_world[0][0], sizeof shadow.map_from_world);
    shadow.layer = layer;
    shadow.rect[2] = shadow.rect[3] = static_cast<float>(kMeshMapSize);
  }
}

bool OpaqueScene::Impl::readyConstants(const Camera& camera, const OpaqueLook& look) {
  const VkDeviceSize size = lightsAt() + std::max<size_t>(lights.size(), 1) * sizeof(opaque::LightConstants);
  if (constants.size < size) {
    resources->destroy(constants);
    if (!resources->createBuffer(size, VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, constants)) {
      return false;
    }
  }
  opaque::FrameConstants frame{};
  frame.eye = glm::vec3(camera.eye);
  frame.orthographic = camera.orthographic ? 1 : 0;
  frame.back = glm::vec3(cameraBasis(camera).back);
  frame.light_count = static_cast<uint32_t>(lights.size());
  frame.ambient = look.ambient;
  frame.fibres_per_metre = 1.0f / std::max(look.fibre_spacing_m, 1e-9f);
  frame.log2_transmittance = std::log2(std::max(1.0f - look.shadow_opacity, 1e-6f));
  frame.push = kMeshMapPush;
  std::copy(look.ambient_sh.begin(), look.ambient_sh.end(), frame.ambient_sh);
  std::memcpy(constants.mapped, &frame, sizeof frame);
  return true;
}

bool OpaqueScene::prepare(const Camera& camera, double aspect, uint32_t width, uint32_t height, const OpaqueLook& look) {
  Impl& i = *impl_;
  if (empty()) {
    return true;
  }
  i.clip_from_world = clipFromWorld(camera, aspect);
  i.reversed_depth = camera.reversed_depth;
  i.flat = look.flat;
  i.readyLights(look);
  return i.readyImages(width, height) && i.readyMaps(static_cast<uint32_t>(i.mesh_maps.maps.size())) && i.readyConstants(camera, look);
}

OpaquePush OpaqueScene::Impl::push() const {
  OpaquePush push;
  push.clip_from_world = clip_from_world;
  push.frame = resources->address(constants);
  push.faces = push.frame + facesAt();
  push.lights = push.frame + lightsAt();
  return push;
}

void OpaqueScene::recordDepth(VkCommandBuffer cmd) {
  Impl& i = *impl_;
  if (empty()) {
    return;
  }
  const OpaquePipelines& draw = i.pipelines;
  draw.beforeDepth(cmd, i.depth);
  draw.recordDepth(cmd, i.depth.view, {i.width, i.height}, i.reversed_depth, i.push(), i.draws);
  draw.afterDepth(cmd, i.depth, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
  if (i.mesh_maps.maps.empty()) {
    return;
  }
  draw.beforeDepth(cmd, i.maps);
  for (size_t layer = 0; layer < i.mesh_maps.maps.size(); ++layer) {
    OpaquePush push = i.push();
    push.clip_from_world = i.mesh_maps.maps[layer].clip_from_world;
    push.light = i.mesh_maps.maps[layer].light;
    push.behind = kMeshMapPush;
    draw.recordDepth(cmd, i.layers[layer], {kMeshMapSize, kMeshMapSize}, false, push, i.draws);
  }
  draw.afterDepth(cmd, i.maps, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void OpaqueScene::fillFrame(FlkFrame& frame, std::vector<FlkLight>& lights) const {
  const Impl& i = *impl_;
  if (empty()) {
    return;
  }
  // afterDepth() has made them visible to these stages: what is left is to come after them.
  constexpr VkPipelineStageFlags2 readers = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  frame.depth = {i.depth.image, i.depth.view, i.depth.format, VK_SAMPLE_COUNT_1_BIT, i.depth.range, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
                 readers, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
  for (size_t light = 0; light < std::min(lights.size(), i.mesh_maps.of_light.size()); ++light) {
    if (i.mesh_maps.of_light[light] < 0) {
      continue;
    }
    lights[light].host_shadow = &i.host_shadows[static_cast<size_t>(i.mesh_maps.of_light[light])];
    frame.host_shadow_maps = {i.maps.image, i.maps.view, i.maps.range, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, readers,
                              VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
  }
}

void OpaqueScene::recordColor(VkCommandBuffer cmd, FlkView view, const GpuImage& target) {
  Impl& i = *impl_;
  VkImageView hair = VK_NULL_HANDLE;
  std::vector<opaque::FaceConstants> faces;
  for (size_t index = 0; index < i.lights.size(); ++index) {
    opaque::LightConstants& light = i.lights[index];
    light.first_face = static_cast<uint32_t>(faces.size());
    light.face_count = 0;
    FlkShadowMap map{};
    while (index < kMostHairLights && flkViewGetShadowMap(view, static_cast<uint32_t>(index), light.face_count, &map) == FLK_SUCCESS) {
      faces.push_back(faceOf(map));
      hair = map.view;
      if (++light.face_count >= map.face_count) {
        break;
      }
    }
  }
  if (!empty()) {
    auto* bytes = static_cast<std::byte*>(i.constants.mapped);
    std::memcpy(bytes + i.facesAt(), faces.data(), faces.size() * sizeof(opaque::FaceConstants));
    std::memcpy(bytes + i.lightsAt(), i.lights.data(), i.lights.size() * sizeof(opaque::LightConstants));
    i.pipelines.bindImages(hair ? hair : i.no_hair.view, i.maps.view);
    std::vector<OpaqueDraw> draws = i.draws;
    for (OpaqueDraw& draw : draws) {
      draw.albedo = i.flat ? glm::vec3(0.10f) : draw.albedo;
    }
    i.pipelines.recordColor(cmd, target, i.depth, i.push(), draws);
    return;
  }
  i.resources->transition(cmd, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace forelock::samples
