// `forelock plan`: what a frame will take, without a device. SPDX-License-Identifier: MIT
#include "commands.h"
#include "scene_options.h"
#include "stage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace forelock::samples {

namespace {

struct PlanArguments : SceneArguments {
  bool json = false;
};

constexpr const char* kExamples =
    "No device is needed. The lists are sized by an estimate until a first frame has counted its fragments.\n\n"
    "Examples:\n"
    "  forelock plan groom:long-wavy\n"
    "  forelock plan groom:long-wavy --no-shadow --size 1920x1080     what leaving out shadows saves\n"
    "  forelock plan pony.tfx --method hard                           no lists: what that saves\n"
    "  forelock plan pony.tfx --capture compute --json                hashes tell which passes run other code\n"
    "  forelock plan --scene scene.json\n";

constexpr const char* kStages[FLK_STAGE_COUNT] = {"clear", "shadow", "capture", "resolve", "prepare", "output"};

struct Planned {
  FlkPlanInfo info{};
  std::vector<FlkPassInfo> passes;
  std::vector<FlkResourceInfo> resources;
  std::vector<std::string> omissions;
};

// Of a pass without code of its own nothing. Text, since JSON numbers hold 53 bits.
std::string hashText(uint64_t hash) {
  char text[24] = "";
  if (hash != 0) {
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  }
  return text;
}

uint64_t segmentsOf(const StagedAsset& asset) {
  return uint64_t{asset.info.vertex_count - asset.info.strand_count} * (1 + uint64_t{asset.follow.count});
}

void printText(const Stage& stage, const Planned& planned) {
  for (const StagedAsset& asset : stage.assets) {
    const std::string follow = asset.follow.count == 0
                                   ? ""
                                   : " with " + std::to_string(asset.follow.count) + " follow strands beside each";
    std::printf("%s: %s strands%s, %s segments\n", asset.opened->label.c_str(),
                groupedDigits(asset.info.strand_count).c_str(), follow.c_str(), groupedDigits(segmentsOf(asset)).c_str());
  }
  std::printf("%u x %u, %s; hair in %u x %u pixels at (%u, %u)\n", stage.scene.width, stage.scene.height,
              methodText(stage.scene).c_str(), planned.info.rect[2], planned.info.rect[3], planned.info.rect[0],
              planned.info.rect[1]);

  size_t name_width = std::strlen("together");
  for (const FlkPassInfo& pass : planned.passes) {
    name_width = std::max(name_width, std::strlen(pass.name));
  }
  for (const FlkResourceInfo& resource : planned.resources) {
    name_width = std::max(name_width, std::strlen(resource.name));
  }
  const int names = static_cast<int>(name_width);
  std::printf("\n%-*s  %-20s  code\n", names + 2, "pass", "work");
  for (const FlkPassInfo& pass : planned.passes) {
    const std::string hash = hashText(pass.hash);
    std::printf("  %-*s  %-*s%s\n", names, pass.name, hash.empty() ? 0 : 22, passWork(pass).c_str(), hash.c_str());
  }
  std::printf("\n%-*s  %12s  %-20s  why\n", names + 2, "resource", "bytes", "held");
  const auto line = [&](const char* name, uint64_t bytes, const char* held, const char* why) {
    std::printf("  %-*s  %12s  %-20s  %s\n", names, name, readableBytes(bytes).c_str(), held, why);
  };
  line("hair", planned.info.bytes_persistent, "as long as the hair", "strands: positions, radii, colours, indices");
  for (const FlkResourceInfo& resource : planned.resources) {
    line(resource.name, resource.bytes, resource.transient ? "while a frame draws" : "as long as the view", resource.why);
  }
  std::printf("  %-*s  %12s\n", names, "together",
              readableBytes(planned.info.bytes_persistent + planned.info.bytes_transient).c_str());
  if (planned.info.node_capacity > 0) {
    std::printf("\nlists hold %s fragments\n", groupedDigits(planned.info.node_capacity).c_str());
  }
  if (planned.info.full_shade_taps + planned.info.low_shade_taps > 0) {
    std::printf("%sof shadow maps a full shade reads %u texels, a cheap one %u\n",
                planned.info.node_capacity > 0 ? "" : "\n", planned.info.full_shade_taps, planned.info.low_shade_taps);
  }
  if (!planned.omissions.empty()) {
    std::printf("\nleft out\n");
    for (const std::string& omission : planned.omissions) {
      std::printf("  %s\n", omission.c_str());
    }
  }
}

void printJson(const Stage& stage, const Planned& planned) {
  nlohmann::ordered_json json;
  json["assets"] = nlohmann::ordered_json::array();
  for (const StagedAsset& asset : stage.assets) {
    json["assets"].push_back({{"source", asset.opened->label},
                              {"strands", asset.info.strand_count},
                              {"follow", asset.follow.count},
                              {"segments", segmentsOf(asset)}});
  }
  json["size"] = {stage.scene.width, stage.scene.height};
  json["method"] = methodNames()[stage.scene.method];
  json["tail"] = tailNames()[stage.scene.tail];
  json["capture"] = captureNames()[stage.scene.capture];
  json["lights"] = stage.scene.lights.size();
  json["show"] = shownName(stage.scene);
  json["rect"] = planned.info.rect;
  json["node_capacity"] = planned.info.node_capacity;
  json["full_shade_taps"] = planned.info.full_shade_taps;
  json["low_shade_taps"] = planned.info.low_shade_taps;
  json["passes"] = nlohmann::ordered_json::array();
  for (const FlkPassInfo& pass : planned.passes) {
    json["passes"].push_back({{"name", pass.name}, {"stage", kStages[pass.stage]}, {"groups", pass.groups},
                              {"indices", pass.indices}, {"segments", pass.segments}, {"hash", hashText(pass.hash)}});
  }
  json["resources"] = nlohmann::ordered_json::array();
  for (const FlkResourceInfo& resource : planned.resources) {
    json["resources"].push_back({{"name", resource.name}, {"bytes", resource.bytes},
                                 {"transient", resource.transient != 0}, {"why", resource.why}});
  }
  json["bytes_persistent"] = planned.info.bytes_persistent;
  json["bytes_transient"] = planned.info.bytes_transient;
  json["left_out"] = planned.omissions;
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // a path need not be UTF-8
  std::printf("%s\n", json.dump(2, ' ', false, replace).c_str());
}

void keepMessage(void* user, const FlkMessage* message) { *static_cast<std::string*>(user) = message->text; }

int runPlan(const CLI::App& command, const PlanArguments& arguments) {
  const Stage stage = openStage(makeScene(command, arguments));
  std::string said;
  const auto check = [&](FlkResult result) {
    if (result != FLK_SUCCESS) {
      throw AssetError(result, stage.assets[0].opened->label + ": cannot be planned: " +
                                   (said.empty() ? flkResultName(result) : said));
    }
  };
  FlkContextDesc context_desc = contextDesc();
  context_desc.message = keepMessage;
  context_desc.message_user = &said;
  Context context;
  check(create(context_desc, context));
  const std::vector<Hair> hairs = planHairs(context, stage);
  View view;
  check(create(context, viewDesc(), view));

  const Camera camera = stageCamera(stage, 0, 1);
  StagedFrame staged(stage, camera, hairs, 1.0, stage.scene.width, stage.scene.height);
  const FlkHostShadow shadow{};
  planMeshes(stage, camera, shadow, staged.frame, staged.lights);
  FlkFrame& frame = staged.frame;
  frame.frame_number = 1;
  frame.timestamps = 0;
  frame.target.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  frame.target.samples = VK_SAMPLE_COUNT_1_BIT;
  frame.target.width = stage.scene.width;
  frame.target.height = stage.scene.height;
  FlkPlan plan = nullptr;
  check(flkPlanFrame(view, &frame, &plan));

  Planned planned;
  check(flkPlanGetInfo(plan, &planned.info));
  for (uint32_t i = 0; i < planned.info.pass_count; ++i) {
    check(flkPlanGetPass(plan, i, &planned.passes.emplace_back()));
  }
  for (uint32_t i = 0; i < planned.info.resource_count; ++i) {
    check(flkPlanGetResource(plan, i, &planned.resources.emplace_back()));
  }
  for (uint32_t i = 0; const char* omission = flkPlanGetOmission(plan, i); ++i) {
    planned.omissions.emplace_back(omission);
  }
  if (arguments.json) {
    printJson(stage, planned);
  } else {
    printText(stage, planned);
  }
  return kDone;
}

}  // namespace

void addPlanCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("plan", "Say what drawing an asset will take: passes, bytes, and why.");
  auto arguments = std::make_shared<PlanArguments>();
  addSceneOptions(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print it as JSON");
  command->footer(kExamples);
  command->callback([command, arguments, &exit_code] { exit_code = runPlan(*command, *arguments); });
}

}  // namespace forelock::samples
