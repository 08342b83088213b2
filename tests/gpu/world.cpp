#include "world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::test {
namespace {

reference::Material twinOf(const FlkMaterial& m) {
  reference::Material twin;
  for (int i = 0; i < 3; ++i) twin.color[i] = m.color[i], twin.tip_color[i] = m.tip_color[i];
  twin.opacity_root = m.opacity_root, twin.opacity_tip = m.opacity_tip, twin.width_scale = m.width_scale;
  twin.kd = m.diffuse, twin.kr = m.specular_r, twin.exponent_r = m.exponent_r;
  twin.kt = m.specular_trt, twin.exponent_trt = m.exponent_trt, twin.cuticle_tilt = m.cuticle_tilt;
  twin.shadow_opacity = m.shadow_opacity, twin.fibre_spacing = m.fibre_spacing;
  twin.tip_blend = m.tip_blend;
  return twin;
}

reference::Vec3 unit(const float v[3]) {
  const double l = std::sqrt(double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2]);
  return {v[0] / l, v[1] / l, v[2] / l};
}

reference::Strands strandsOf(const HairSpec& spec, const std::vector<float>& positions) {
  reference::Strands strands;
  for (uint32_t s = 0; s < spec.strands.strands(); ++s) {
    std::vector<reference::Vec3> points;
    std::vector<double> radii;
    for (uint32_t v = spec.strands.first_vertex[s]; v < spec.strands.first_vertex[s + 1]; ++v) {
      points.push_back({positions[v * 3], positions[v * 3 + 1], positions[v * 3 + 2]});
      radii.push_back(spec.strands.radii[v]);
    }
    reference::addStrand(strands, points, radii);
  }
  for (std::size_t i = 0; i + 2 < spec.colors.size(); i += 3)
    strands.colors.push_back({spec.colors[i], spec.colors[i + 1], spec.colors[i + 2]});
  return strands;
}

}  // namespace

World::World(const ViewSpec& spec, uint64_t pool_budget)
    : view_spec(spec),
      camera(reference::makeCamera(spec.eye, spec.target, spec.up, spec.projection, spec.width, spec.height)) {
  FlkViewDesc desc{};
  desc.type = FLK_TYPE_VIEW;
  desc.pool_budget = pool_budget;
  EXPECT_EQ(flkViewCreate(host().context(), &desc, &view), FLK_SUCCESS);
}

World::~World() {
  flkViewDestroy(view);
  for (FlkHair hair : hairs) flkHairDestroy(hair);
  host().freeUploads();
}

void World::add(const HairSpec& spec) {
  FlkStrands arrays{};
  arrays.type = FLK_TYPE_STRANDS;
  arrays.strand_count = spec.strands.strands();
  arrays.vertex_count = uint32_t(spec.strands.radii.size());
  arrays.first_vertex = spec.strands.first_vertex.data();
  arrays.positions = spec.strands.positions.data();
  arrays.radii = spec.strands.radii.data();
  arrays.colors = spec.colors.empty() ? nullptr : spec.colors.data();
  arrays.root_uvs = spec.root_uvs.empty() ? nullptr : spec.root_uvs.data();
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&arrays, nullptr, &asset), FLK_SUCCESS);
  FlkHairDesc desc{};
  desc.type = FLK_TYPE_HAIR;
  desc.asset = asset;
  desc.material = &spec.material;
  desc.flags = spec.flags | (spec.moved.empty() ? 0u : uint32_t(FLK_HAIR_HOST_POSITIONS));
  desc.shuffle_seed = spec.seed;
  desc.follow = spec.follow;
  desc.root_image = spec.root_image;
  FlkHair hair = nullptr;
  ASSERT_EQ(host().createHair(desc, &hair), FLK_SUCCESS);
  flkAssetDestroy(asset);
  hairs.push_back(hair);
  const double s = spec.scale;
  const double matrix[16] = {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, spec.offset[0], spec.offset[1], spec.offset[2], 1};
  ASSERT_EQ(flkHairSetTransform(hair, matrix), FLK_SUCCESS);

  reference::Hair twin_hair;
  const reference::Strands rest = strandsOf(spec, spec.strands.positions);
  twin_hair.strands = spec.moved.empty() ? rest : strandsOf(spec, spec.moved);
  if (spec.follow.count)
    twin_hair.strands = reference::followStrands(rest, twin_hair.strands, spec.follow.count, double(spec.follow.radius),
                                                 double(spec.follow.spread_tip), spec.follow.seed);
  twin_hair.strands.fraction = spec.follow.count || spec.moved.empty() ? twin_hair.strands.fraction : rest.fraction;
  if (spec.root_image) {
    reference::ColorImage image{int(spec.root_image->width), int(spec.root_image->height), {}};
    for (uint32_t i = 0; i < spec.root_image->width * spec.root_image->height; ++i)
      image.texels.push_back({spec.root_image->rgb[i * 3], spec.root_image->rgb[i * 3 + 1], spec.root_image->rgb[i * 3 + 2]});
    std::vector<std::array<double, 2>> uvs;
    for (std::size_t i = 0; i + 1 < spec.root_uvs.size(); i += 2) uvs.push_back({spec.root_uvs[i], spec.root_uvs[i + 1]});
    reference::applyRootColors(twin_hair.strands, image, uvs);
  }
  for (reference::Vec3& p : twin_hair.strands.positions)
    p = {p.x * s + spec.offset[0], p.y * s + spec.offset[1], p.z * s + spec.offset[2]};
  for (double& r : twin_hair.strands.radii) r *= s;
  twin_hair.material = twinOf(spec.material);
  twin_hair.slot = uint32_t(twin.hairs.size());
  twin.hairs.push_back(std::move(twin_hair));

  if (spec.moved.empty()) return;
  FlkHairPositions moved{};
  moved.stride = 20;  // as in a vertex buffer of something else
  std::vector<float> buffer(spec.strands.radii.size() * 5, -1);
  for (int axis = 0; axis < 3; ++axis) moved.min_bounds[axis] = 1e6f, moved.max_bounds[axis] = -1e6f;
  for (std::size_t v = 0; v < spec.strands.radii.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float value = buffer[v * 5 + axis] = spec.moved[v * 3 + axis];
      moved.min_bounds[axis] = std::min(moved.min_bounds[axis], value);
      moved.max_bounds[axis] = std::max(moved.max_bounds[axis], value);
    }
  const double reach = double(spec.follow.radius) * std::max(1.0, double(spec.follow.spread_tip)) * (spec.follow.count ? 1 : 0);
  double square = 0, thickest = 0;
  reference::Sphere bounds;
  for (int axis = 0; axis < 3; ++axis) square += std::pow(moved.max_bounds[axis] - moved.min_bounds[axis] + 2 * reach, 2);
  for (const float r : spec.strands.radii) thickest = std::max(thickest, double(r) * double(spec.material.width_scale));
  bounds.center = {(moved.min_bounds[0] + moved.max_bounds[0]) / 2.0 * s + spec.offset[0],
                   (moved.min_bounds[1] + moved.max_bounds[1]) / 2.0 * s + spec.offset[1],
                   (moved.min_bounds[2] + moved.max_bounds[2]) / 2.0 * s + spec.offset[2]};
  bounds.radius = (std::sqrt(square) / 2 + thickest) * s * 1.001;
  moved_sphere_ = bounds;  // of a world of one hair
  moved.address = host().uploadBuffer(std::as_bytes(std::span(buffer)));
  moved.entry_stages = VK_PIPELINE_STAGE_2_HOST_BIT, moved.entry_access = VK_ACCESS_2_HOST_WRITE_BIT;
  ASSERT_EQ(flkHairSetPositions(hair, &moved), FLK_SUCCESS);
}

void World::addLight(const FlkLight& light) {
  FlkLight given = light;
  reference::Light l;
  l.kind = reference::LightKind(light.kind);
  if (light.kind != FLK_LIGHT_POINT) {
    l.direction_to_light = unit(light.direction);
    l.axis = {-l.direction_to_light.x, -l.direction_to_light.y, -l.direction_to_light.z};
  }
  l.position = {light.position[0], light.position[1], light.position[2]};
  for (int i = 0; i < 3; ++i) l.radiance[i] = light.radiance[i];
  l.range = light.range;
  l.source_radius = light.source_radius > 0 ? double(light.source_radius) : 1e-3;
  l.inner_angle = light.inner_angle, l.outer_angle = light.outer_angle;
  l.shadow = light.casts_shadow, l.shadow_size = light.shadow_size ? int(light.shadow_size) : 1024;
  l.cover_width = light.shadow_cover == FLK_SHADOW_COVER_WIDTH;
  if (light.host_shadow) {
    kept_.push_back(std::make_unique<FlkHostShadow>(*light.host_shadow));
    given.host_shadow = kept_.back().get();
  }
  lights.push_back(given);
  twin.lights.push_back(std::move(l));
}

void World::setAmbientSh(const std::vector<float>& coefficients) {
  ambient_sh = coefficients;
  std::array<std::array<double, 3>, 9> sh{};
  for (std::size_t i = 0; i < 27; ++i) sh[i / 3][i % 3] = coefficients[i];
  twin.ambient_sh = sh;
}

void World::addModifier(const FlkOpacityModifier& m) {
  device_modifiers.push_back(m);
  if (m.kind == FLK_OPACITY_NEAR_FADE) modifiers.near_fade = reference::NearFade{m.start, m.end};
  else modifiers.lens = reference::Lens{m.center[0], m.center[1], m.radius, m.feather, m.inside};
}

void World::expose() {
  const reference::Image picture = reference::resolve(twin, camera, ownMaps(), gather(), {});
  double sum = 0, pixels = 0;
  for (const reference::Pixel& p : picture.pixels)
    if (p.fragments) sum += (p.rgb[0] + p.rgb[1] + p.rgb[2]) / 3, pixels += 1;
  const double factor = samples::conditionMean(samples::HairColor::dark) * pixels / sum;
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (int c = 0; c < 3; ++c) twin.lights[i].radiance[c] = lights[i].radiance[c] = float(lights[i].radiance[c] * factor);
  for (int c = 0; c < 3; ++c) twin.ambient[c] = ambient[c] = float(ambient[c] * factor);
  if (!ambient_sh.empty()) {
    for (float& c : ambient_sh) c = float(c * factor);
    setAmbientSh(std::vector<float>(ambient_sh));
  }
}

FlkFrame World::frame() const {
  FlkFrame frame{};
  std::copy(camera.view_from_world, camera.view_from_world + 16, frame.view_from_world);
  for (int i = 0; i < 16; ++i) frame.clip_from_view[i] = float(camera.clip_from_view[i]);
  frame.reversed_depth = view_spec.projection.reversed;
  frame.hairs = hairs.data(), frame.hair_count = uint32_t(hairs.size());
  frame.lights = lights.data(), frame.light_count = uint32_t(lights.size());
  std::copy(ambient, ambient + 3, frame.ambient);
  frame.ambient_sh = ambient_sh.empty() ? nullptr : ambient_sh.data();
  frame.opacity_modifiers = device_modifiers.data(), frame.opacity_modifier_count = uint32_t(device_modifiers.size());
  frame.light_tiles = light_tiles;
  frame.host_shadow_maps = host_shadow_maps, frame.host_visibility = host_visibility;
  return frame;
}

std::vector<float> World::render(FlkFrame asked, bool once) {
  samples::HeadlessHost& h = host();
  EXPECT_TRUE(h.resize(uint32_t(view_spec.width), uint32_t(view_spec.height)));
  for (int attempt = 0; attempt < 2; ++attempt) {  // a list that was too short has grown for the second
    const FlkResult result = h.render(view, asked, &plan);
    EXPECT_EQ(result, FLK_SUCCESS) << flkResultName(result) << " " << (h.messages().empty() ? "" : h.messages().back());
    EXPECT_EQ(h.statistics(view, statistics), FLK_SUCCESS);
    if (once || statistics.overflow_fragments == 0) break;
  }
  return h.readColor();
}

reference::Image World::image(const std::vector<float>& rgba) const {
  reference::Image picture;
  picture.width = view_spec.width, picture.height = view_spec.height;
  picture.pixels.resize(rgba.size() / 4);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    reference::Pixel& p = picture.pixels[i];
    for (int c = 0; c < 3; ++c) p.rgb[c] = double(rgba[i * 4 + std::size_t(c)]);
    p.transmittance = 1 - double(rgba[i * 4 + 3]);
    p.fragments = rgba[i * 4 + 3] > 0;
  }
  return picture;
}

reference::Sphere World::sphere() const { return moved_sphere_ ? *moved_sphere_ : reference::boundingSphere(twin); }

std::vector<reference::LightMaps> World::ownMaps() const {
  std::vector<reference::LightMaps> all;
  for (const reference::Light& light : twin.lights) {
    all.push_back(reference::lightFrames(light, sphere()));
    for (reference::ShadowMap& map : all.back().faces) reference::drawShadowMap(map, twin);
  }
  return all;
}

std::vector<reference::LightMaps> World::readMaps() {
  std::vector<reference::LightMaps> all;
  for (std::size_t i = 0; i < twin.lights.size(); ++i) {
    reference::LightMaps maps = reference::lightFrames(twin.lights[i], sphere());
    for (std::size_t face = 0; face < maps.faces.size(); ++face) {
      FlkShadowMap map{};
      EXPECT_EQ(flkViewGetShadowMap(view, uint32_t(i), uint32_t(face), &map), FLK_SUCCESS);
      EXPECT_EQ(map.face_count, maps.faces.size());
      EXPECT_EQ(int(map.size), maps.faces[face].size);
      const std::vector<float> values = host().readShadowMap(map);
      for (std::size_t t = 0; t < values.size(); ++t)
        maps.faces[face].depth[t] = values[t] >= 1.0f ? std::numeric_limits<float>::infinity() : values[t] * map.depth_range;
    }
    all.push_back(std::move(maps));
  }
  return all;
}

reference::FragmentLists World::gather(reference::Payload payload) const {
  reference::GatherOptions options;
  options.payload = payload;
  options.modifiers = modifiers;
  return reference::gatherFragments(twin, camera, options);
}

reference::Image World::expected(reference::Method method, reference::TailOrder tail,
                                 const std::vector<reference::LightMaps>& maps, std::array<double, 2> shift_px) const {
  reference::Camera seen = camera;
  if (shift_px[0] != 0 || shift_px[1] != 0) {  // in clip space: perspective shifts with the divisor
    const bool perspective = reference::isPerspective(camera);
    seen.clip_from_view[perspective ? 8 : 12] += (perspective ? -2 : 2) * shift_px[0] / view_spec.width;
    seen.clip_from_view[perspective ? 9 : 13] += (perspective ? -2 : 2) * shift_px[1] / view_spec.height;
  }
  reference::ResolveOptions options;
  options.method = method;
  options.tail = tail;
  if (method == reference::Method::hard) {
    reference::GatherOptions gathering;
    gathering.modifiers = modifiers;
    return reference::renderHard(twin, seen, maps, gathering);
  }
  return reference::resolve(twin, seen, maps, gather(), options);
}

float widthScale(const StrandArrays& strands, const ViewSpec& view, double width_px) {
  const float thickest = *std::max_element(strands.radii.begin(), strands.radii.end());
  const auto &e = view.eye, &t = view.target;
  const double distance = std::sqrt(std::pow(e.x - t.x, 2) + std::pow(e.y - t.y, 2) + std::pow(e.z - t.z, 2));
  const double scale = view.height / 2.0 / view.projection.tan_half_y / (view.projection.orthographic ? 1.0 : distance);
  return float(width_px / (2.0 * double(thickest) * scale));
}

}  // namespace forelock::test
