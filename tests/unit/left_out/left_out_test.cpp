// What each feature costs a frame: passes, pipelines and bytes with the feature off and on, and of a library built without it. Writes
// the page docs/left-out.md:  ./test_left_out --write ../docs/left-out.md
#include "gpu/shader_code.h"
#include "gpu/view.h"

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace forelock {
namespace {

std::string page_path;

// ---- The C API of one build of the library ----

#define FLK_USED(X)                                                                                                       \
  X(flkContextCreate) X(flkContextDestroy) X(flkAssetCreate) X(flkAssetDestroy) X(flkHairCreate) X(flkHairDestroy)        \
  X(flkHairSetPositions) X(flkHairGetInfo) X(flkViewCreate) X(flkViewDestroy) X(flkPlanFrame) X(flkPlanGetInfo)           \
  X(flkPlanGetPass) X(flkPlanGetResource) X(flkMaterialDefault)

struct Library {
#define FLK_MEMBER(name) decltype(&::name) name = nullptr;
  FLK_USED(FLK_MEMBER)
#undef FLK_MEMBER
  std::string path;
  uintmax_t bytes = 0;

  explicit Library(const std::string& file) : path(file) {
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(handle, nullptr) << dlerror();
    if (!handle) return;
    bytes = std::filesystem::file_size(file);
#define FLK_LOAD(name) name = reinterpret_cast<decltype(name)>(dlsym(handle, #name));
    FLK_USED(FLK_LOAD)
#undef FLK_LOAD
  }
  // The one this program is linked with, whose plans it may look into.
  static Library own() {
    Library library;
#define FLK_OWN(name) library.name = &::name;
    FLK_USED(FLK_OWN)
#undef FLK_OWN
    return library;
  }

private:
  Library() = default;
};

// ---- Scenes ----

struct Scene {
  FlkFrame frame{};
  FlkHairDesc hair{};
  FlkMaterial material{};
  std::vector<FlkLight> lights;
  std::vector<FlkOpacityModifier> modifiers;
  bool host_positions = false;
  float sh[27] = {};
  FlkHostShadow host_shadow{};
};

struct Feature {
  const char* name;
  const char* option;  // of the build that does without it; null: no part of its own
  std::function<void(Scene&)> on;
};

FlkLight someLight(uint32_t kind) {
  FlkLight light{};
  light.direction[0] = 0.3f, light.direction[1] = 1, light.direction[2] = 0.5f;
  for (float& r : light.radiance) r = 2;
  light.kind = kind;
  light.position[1] = 1;
  light.inner_angle = 0.2f, light.outer_angle = 0.4f;
  return light;
}

template <class T> T handle(uintptr_t number) { return reinterpret_cast<T>(number); }

// Off: one sun without shadow, core_tail, raster, nothing else.
const std::vector<Feature>& features() {
  static const std::vector<Feature> list = {
      {"light", nullptr, [](Scene& s) { s.lights.push_back(someLight(FLK_LIGHT_DIRECTIONAL)); }},
      {"hair shadows of the light", nullptr, [](Scene& s) { s.lights[0].casts_shadow = 1; }},
      {"hair shadows covered by width (off: by texel)", nullptr, [](Scene& s) { s.lights[0].casts_shadow = 1, s.lights[0].shadow_cover = FLK_SHADOW_COVER_WIDTH; }},
      {"a second light", nullptr, [](Scene& s) { s.lights.push_back(someLight(FLK_LIGHT_DIRECTIONAL)); }},
      {"a third light, a point light", nullptr, [](Scene& s) { s.lights.insert(s.lights.end(), 2, someLight(FLK_LIGHT_POINT)); }},
      {"a spot with hair shadows", nullptr, [](Scene& s) { s.lights.push_back(someLight(FLK_LIGHT_SPOT)), s.lights.back().casts_shadow = 1; }},
      {"light tile masks", nullptr, [](Scene& s) { s.frame.light_tiles = {1024, 16, 30, 30, 0, 0}; }},
      {"host shadow map", "HOST_LIGHT", [](Scene& s) { s.lights[0].host_shadow = &s.host_shadow, s.frame.host_shadow_maps.view = handle<VkImageView>(1); }},
      {"host visibility", "HOST_LIGHT", [](Scene& s) { s.lights[0].visibility = 1, s.frame.host_visibility.view = handle<VkImageView>(1); }},
      {"ambient harmonics", nullptr, [](Scene& s) { s.frame.ambient_sh = s.sh; }},
      {"host depth", nullptr, [](Scene& s) { s.frame.depth.view = handle<VkImageView>(1), s.frame.depth.format = VK_FORMAT_D32_SFLOAT,
                                             s.frame.depth.samples = VK_SAMPLE_COUNT_1_BIT,
                                             s.frame.depth.layout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"tail without colour (core_only)", nullptr, [](Scene& s) { s.frame.method = FLK_METHOD_CORE_ONLY; }},
      {"tail in list order", nullptr, [](Scene& s) { s.frame.tail = FLK_TAIL_LIST; }},
      {"full shading of the core (off: all_low)", nullptr, nullptr},
      {"every fragment sorted (exact)", nullptr, [](Scene& s) { s.frame.method = FLK_METHOD_EXACT; }},
      {"shading at capture (forward)", nullptr, [](Scene& s) { s.frame.method = FLK_METHOD_FORWARD; }},
      {"no transparency (hard)", "HARD", [](Scene& s) { s.frame.method = FLK_METHOD_HARD; }},
      {"capture by compute", "COMPUTE", [](Scene& s) { s.frame.capture = FLK_CAPTURE_COMPUTE; }},
      {"overflow dropped (off: aggregates)", nullptr, [](Scene& s) { s.frame.overflow = FLK_OVERFLOW_DROP; }},
      {"count only", nullptr, [](Scene& s) { s.frame.count_only = 1; }},
      {"work counted", nullptr, [](Scene& s) { s.frame.count_work = 1; }},
      {"timestamps", nullptr, [](Scene& s) { s.frame.timestamps = 1; }},
      {"follow strands, one a guide", nullptr, [](Scene& s) { s.hair.follow = {1, 0.001f, 1, 0}; }},
      {"vertex colours", nullptr, [](Scene& s) { s.hair.flags = 0; }},
      {"tip colour", nullptr, [](Scene& s) { s.material.tip_blend = 1; }},
      {"positions from the host", "HOST_POSITIONS", [](Scene& s) { s.host_positions = true; }},
      {"near fade", nullptr, [](Scene& s) { s.modifiers.push_back({FLK_OPACITY_NEAR_FADE, 0.1f, 0.2f, {0, 0}, 0, 0, 0}); }},
      {"lens", nullptr, [](Scene& s) { s.modifiers.push_back({FLK_OPACITY_LENS, 0, 0, {9, 9}, 9, 9, 0}); }},
      {"front depth", "OUTPUTS", [](Scene& s) { s.frame.outputs[FLK_OUTPUT_FRONT_DEPTH].view = handle<VkImageView>(1); }},
      {"transmittance", "OUTPUTS", [](Scene& s) { s.frame.outputs[FLK_OUTPUT_TRANSMITTANCE].view = handle<VkImageView>(1); }},
      {"velocity", "OUTPUTS", [](Scene& s) { s.frame.outputs[FLK_OUTPUT_VELOCITY].view = handle<VkImageView>(1); }},
      {"depth range (proxy)", "OUTPUTS", [](Scene& s) { s.frame.outputs[FLK_OUTPUT_DEPTH_RANGE].view = handle<VkImageView>(1); }},
      {"display of strands", "DISPLAYS", [](Scene& s) { s.frame.display = FLK_DISPLAY_STRAND; }},
      {"display of layers", "DISPLAYS", [](Scene& s) { s.frame.display = FLK_DISPLAY_LAYERS; }},
  };
  return list;
}

// ---- Plans ----

struct Cost {
  FlkResult result = FLK_SUCCESS;
  std::vector<std::string> passes;
  std::vector<uint64_t> hashes;            // of SPIR-V and constants, as the API gives them
  std::vector<std::string> folded;         // of the folded SPIR-V; own library only
  std::vector<std::string> resources;      // name and bytes
  uint64_t transient = 0, persistent = 0;

  bool operator==(const Cost& other) const {
    return result == other.result && passes == other.passes && hashes == other.hashes && resources == other.resources &&
           transient == other.transient && persistent == other.persistent;
  }
};

// SPIR-V with its specialisation constants folded in and what they switch off removed.
std::string foldedHash(ShaderId id, uint8_t images, const uint32_t* constants) {
  static std::map<std::string, std::string> known;
  const auto words = shaderCode(id, images);
  std::string values;
  constexpr uint32_t kDecorate = 71, kSpecId = 1;
  for (std::size_t at = 5; at < words.size(); at += std::max(words[at] >> 16, 1u))
    if ((words[at] & 0xFFFF) == kDecorate && words[at + 2] == kSpecId) {
      const uint32_t spec = words[at + 3];
      // A boolean wants a word.
      const bool boolean = spec == FLK_SPEC_ONE_HAIR || spec == FLK_SPEC_AGGREGATE || spec == FLK_SPEC_AMBIENT || spec == FLK_SPEC_COLOR ||
                           spec == FLK_SPEC_COUNT_WORK || spec == FLK_SPEC_COLORS_LISTED || spec == FLK_SPEC_LONG_FIRST || spec == FLK_SPEC_SHARES || spec == FLK_SPEC_LOCKSTEP;
      values += std::to_string(spec) + ":" + (boolean ? (constants[spec] ? "true" : "false") : std::to_string(constants[spec])) + " ";
    }
  std::string command = FORELOCK_SPIRV_OPT;
  if (!values.empty()) command += " --set-spec-const-default-value '" + values + "'";
  command += " --freeze-spec-const --fold-spec-const-op-composite --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions --ccp "
             "--eliminate-dead-branches --merge-blocks --ssa-rewrite --ccp --eliminate-dead-branches --merge-blocks "
             "--eliminate-dead-code-aggressive --eliminate-dead-variables --eliminate-dead-const --strip-debug --compact-ids ";
  const std::string key = std::to_string(int(id)) + "/" + std::to_string(images) + command;
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const std::string in = std::string(FORELOCK_LEFT_OUT_FOLDER) + "/fold.spv", out = std::string(FORELOCK_LEFT_OUT_FOLDER) + "/folded.spv";
  std::ofstream(in, std::ios::binary).write(reinterpret_cast<const char*>(words.data()), std::streamsize(words.size_bytes()));
  const int status = std::system((command + in + " -o " + out + " 2>/dev/null").c_str());
  EXPECT_EQ(status, 0) << command;
  std::ifstream file(out, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  uint64_t hash = 0xCBF29CE484222325u;
  for (const char c : bytes.str()) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  char text[32];
  std::snprintf(text, sizeof text, "%08x", uint32_t(hash ^ hash >> 32));
  return known[key] = text;
}

std::string foldedHash(const Recipe& recipe) {
  std::string text;
  if (recipe.vertex != ShaderId::none) text = foldedHash(recipe.vertex, 0, recipe.constants) + "+";
  return text + foldedHash(recipe.main, recipe.images, recipe.constants);
}

Cost costOf(const Library& flk, const std::function<void(Scene&)>& edit, bool fold) {
  Scene scene;
  flk.flkMaterialDefault(&scene.material);
  scene.hair.flags = FLK_HAIR_IGNORE_COLORS;
  FlkFrame& frame = scene.frame;
  frame.type = FLK_TYPE_FRAME;
  frame.frame_number = 1;
  for (int i = 0; i < 4; ++i) frame.view_from_world[5 * i] = 1;
  frame.view_from_world[14] = -1;
  const float clip[16] = {2, 0, 0, 0, 0, -2, 0, 0, 0, 0, -1.001f, -1, 0, 0, -0.1001f, 0};
  std::copy(clip, clip + 16, frame.clip_from_view);
  frame.target.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  frame.target.samples = VK_SAMPLE_COUNT_1_BIT;
  frame.target.width = frame.target.height = 400;
  frame.capture = FLK_CAPTURE_RASTER;
  scene.host_shadow.rect[2] = scene.host_shadow.rect[3] = 64;
  if (edit) edit(scene);
  frame.lights = scene.lights.data(), frame.light_count = uint32_t(scene.lights.size());
  frame.opacity_modifiers = scene.modifiers.data(), frame.opacity_modifier_count = uint32_t(scene.modifiers.size());

  std::vector<float> positions, radii, colors;
  std::vector<uint32_t> first{0};
  for (int s = 0; s < 100; ++s) {
    for (int v = 0; v < 8; ++v) {
      positions.insert(positions.end(), {0.002f * float(s) - 0.1f, 0.02f * float(v), 0.001f * float(s % 7)});
      radii.push_back(1e-4f);
      colors.insert(colors.end(), {0.5f, 0.4f, 0.3f});
    }
    first.push_back(uint32_t(radii.size()));
  }
  FlkStrands strands{};
  strands.type = FLK_TYPE_STRANDS;
  strands.strand_count = 100, strands.vertex_count = 800;
  strands.first_vertex = first.data(), strands.positions = positions.data(), strands.radii = radii.data(), strands.colors = colors.data();
  FlkAsset asset = nullptr;
  FlkContext context = nullptr;
  FlkHair hair = nullptr;
  FlkView view = nullptr;
  FlkPlan plan = nullptr;
  EXPECT_EQ(flk.flkAssetCreate(&strands, nullptr, &asset), FLK_SUCCESS);
  FlkContextDesc context_desc{};
  context_desc.type = FLK_TYPE_CONTEXT;
  EXPECT_EQ(flk.flkContextCreate(&context_desc, &context), FLK_SUCCESS);
  scene.hair.type = FLK_TYPE_HAIR;
  scene.hair.asset = asset, scene.hair.material = &scene.material;
  if (scene.host_positions) scene.hair.flags |= FLK_HAIR_HOST_POSITIONS;
  EXPECT_EQ(flk.flkHairCreate(context, &scene.hair, &hair), FLK_SUCCESS);
  if (scene.host_positions) {
    FlkHairPositions moved{};
    moved.address = 64;
    for (int i = 0; i < 3; ++i) moved.min_bounds[i] = -0.1f, moved.max_bounds[i] = 0.14f;
    EXPECT_EQ(flk.flkHairSetPositions(hair, &moved), FLK_SUCCESS);
  }
  FlkViewDesc view_desc{};
  view_desc.type = FLK_TYPE_VIEW;
  EXPECT_EQ(flk.flkViewCreate(context, &view_desc, &view), FLK_SUCCESS);
  frame.hairs = &hair, frame.hair_count = 1;

  Cost cost;
  cost.result = flk.flkPlanFrame(view, &frame, &plan);
  if (cost.result == FLK_SUCCESS) {
    FlkPlanInfo info{};
    flk.flkPlanGetInfo(plan, &info);
    cost.transient = info.bytes_transient, cost.persistent = info.bytes_persistent;
    for (uint32_t i = 0; i < info.pass_count; ++i) {
      FlkPassInfo pass{};
      flk.flkPlanGetPass(plan, i, &pass);
      cost.passes.push_back(pass.name);
      cost.hashes.push_back(pass.hash);
      if (!fold) continue;
      const FramePlan& inside = reinterpret_cast<const Frame*>(plan)->plan;
      const Recipe recipe = recipeOf(inside, inside.passes.items[i]);
      cost.folded.push_back(recipe.main == ShaderId::none ? std::string() : foldedHash(recipe));
    }
    for (uint32_t i = 0; i < info.resource_count; ++i) {
      FlkResourceInfo resource{};
      flk.flkPlanGetResource(plan, i, &resource);
      cost.resources.push_back(std::string(resource.name) + " " + std::to_string(resource.bytes));
    }
  }
  flk.flkViewDestroy(view);
  flk.flkHairDestroy(hair);
  flk.flkAssetDestroy(asset);
  flk.flkContextDestroy(context);
  return cost;
}

// The scene with the feature off, and with it on.
std::pair<std::function<void(Scene&)>, std::function<void(Scene&)>> scenesOf(std::size_t index) {
  const Feature& feature = features()[index];
  const std::string name = feature.name;
  if (name == "light") return {nullptr, feature.on};
  const auto lit = features()[0].on;
  if (name == "full shading of the core (off: all_low)")
    return {[lit](Scene& s) { lit(s), s.frame.method = FLK_METHOD_ALL_LOW; }, lit};
  if (name == "hair shadows covered by width (off: by texel)")
    return {[lit](Scene& s) { lit(s), s.lights[0].casts_shadow = 1; }, [lit, on = feature.on](Scene& s) { lit(s), on(s); }};
  if (name == "a third light, a point light") {
    const auto two = features()[3].on;
    return {[=](Scene& s) { lit(s), two(s); }, [=](Scene& s) { lit(s), two(s), s.lights.push_back(someLight(FLK_LIGHT_POINT)); }};
  }
  return {lit, [lit, on = feature.on](Scene& s) { lit(s), on(s); }};
}

std::string passesText(const Cost& cost) {
  std::string text;
  for (std::size_t i = 0; i < cost.passes.size(); ++i)
    text += (i ? ", " : "") + cost.passes[i] + (cost.folded[i].empty() ? "" : " `" + cost.folded[i] + "`");
  return text.empty() ? "none" : text;
}

TEST(LeftOut, EveryFeature) {
  const Library own = Library::own();
  const Library whole(FORELOCK_WHOLE_LIBRARY);
  std::map<std::string, Library> without;
  for (const char* option : {"RASTER", "COMPUTE", "HOST_LIGHT", "HARD", "DISPLAYS", "OUTPUTS", "HOST_POSITIONS"})
    without.emplace(option, Library(std::string(FORELOCK_LEFT_OUT_FOLDER) + "/libforelock_without_" + option + ".so"));

  std::ostringstream page;
  page << "# What a frame does without\n\n"
          "Written by a test, from plans without a device (100 strands, 400 x 400 pixels, one hair): the passes of a frame with a feature off\n"
          "and on, each with a hash of its SPIR-V after the specialisation constants were folded in (vertex + fragment, or compute), and the\n"
          "bytes that the view and the hair hold for it. Equal hashes are equal pipelines. The test fails where a frame with the feature off\n"
          "differs in any pass, pipeline or byte from that of a library built without it. To make it again, from the build folder:\n\n"
          "    ./test_left_out --write ../docs/left-out.md\n\n"
          "| feature | off: passes, pipelines | on: passes, pipelines | bytes of the view, off and on | of the hair, off and on |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < features().size(); ++i) {
    const Feature& feature = features()[i];
    const auto [off_scene, on_scene] = scenesOf(i);
    const Cost off = costOf(own, off_scene, true), on = costOf(own, on_scene, true);
    ASSERT_EQ(off.result, FLK_SUCCESS) << feature.name;
    ASSERT_EQ(on.result, FLK_SUCCESS) << feature.name;
    EXPECT_FALSE(off == on && std::string(feature.name) != "timestamps") << feature.name << " changes nothing";
    EXPECT_EQ(off, costOf(whole, off_scene, false)) << feature.name << ": the shared library plans differently";
    if (feature.option) {
      const Library& library = without.at(feature.option);
      EXPECT_EQ(off, costOf(library, off_scene, false)) << feature.name << ": off is not what a build without it does";
      EXPECT_EQ(costOf(library, on_scene, false).result, FLK_ERROR_NOT_BUILT) << feature.name;
    }
    page << "| " << feature.name << " | " << passesText(off) << " | " << (off.folded == on.folded && off.passes == on.passes ? "the same" : passesText(on))
         << " | " << off.transient << ", " << on.transient << " | " << off.persistent << ", " << on.persistent << " |\n";
  }
  // A frame without hair has nothing at all, and rasterising is an option too.
  const auto lit = features()[0].on;
  const auto computed = [lit](Scene& s) { lit(s), s.frame.capture = FLK_CAPTURE_COMPUTE; };
  EXPECT_EQ(costOf(own, computed, false), costOf(without.at("RASTER"), computed, false));
  EXPECT_EQ(costOf(without.at("RASTER"), lit, false).result, FLK_ERROR_NOT_BUILT);

  page << "\n## Size of the library\n\nRelease, shared, x86-64, GCC 12; a frame that asks for a missing part is refused with "
          "`FLK_ERROR_NOT_BUILT`.\n\n| build | bytes | less than the whole |\n|---|---|---|\n| whole | " << whole.bytes << " | |\n";
  for (const auto& [option, library] : without) {
    EXPECT_LT(library.bytes, whole.bytes) << option;
    page << "| `-DFORELOCK_" << option << "=OFF` | " << library.bytes << " | " << whole.bytes - library.bytes << " |\n";
  }
  if (!page_path.empty()) std::ofstream(page_path) << page.str();

  // The committed page names every feature.
  std::ifstream committed(std::string(FORELOCK_SOURCE_DIR) + "/docs/left-out.md");
  std::stringstream text;
  text << committed.rdbuf();
  for (const Feature& feature : features())
    EXPECT_NE(text.str().find(std::string("| ") + feature.name + " |"), std::string::npos) << feature.name << " is missing in docs/left-out.md: write it again";
}

}  // namespace
}  // namespace forelock

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc == 3 && std::string(argv[1]) == "--write") forelock::page_path = argv[2];
  return RUN_ALL_TESTS();
}
