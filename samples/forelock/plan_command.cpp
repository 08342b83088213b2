// `forelock plan`: what a frame will take, without a device. SPDX-License-Identifier: MIT
#include "commands.h"
#include "scene_options.h"
#include "stage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

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
    "  forelock plan pony.tfx --method forward --json\n"
    "  forelock plan --scene scene.json\n";

constexpr const char* kStages[FLK_STAGE_COUNT] = {"clear", "shadow", "capture", "resolve", "prepare", "output"};

struct Planned {
  FlkPlanInfo info{};
  std::vector<FlkPassInfo> passes;
  std::vector<FlkResourceInfo> resources;
  std::vector<std::string> omissions;
};

std::string workOf(const FlkPassInfo& pass) {
  if (pass.indices > 0) {
    return groupedDigits(pass.indices) + " indices";
  }
  if (pass.segments > 0) {
    return groupedDigits(pass.segments) + " segments";
  }
  if (pass.groups[0] > 0) {
    return groupedDigits(uint64_t{pass.groups[0]} * pass.groups[1] * pass.groups[2]) + " workgroups";
  }
  return "fills and barriers";
}

void printText(const Stage& stage, const Planned& planned) {
  for (const StagedAsset& asset : stage.assets) {
    std::printf("%s: %s strands, %s segments\n", asset.opened.label.c_str(),
                groupedDigits(asset.info.strand_count).c_str(),
                groupedDigits(asset.info.vertex_count - asset.info.strand_count).c_str());
  }
  std::printf("%u x %u, %s; hair in %u x %u pixels at (%u, %u)\n", stage.scene.width, stage.scene.height,
              methodText(stage.scene).c_str(), planned.info.rect[2], planned.info.rect[3], planned.info.rect[0],
              planned.info.rect[1]);
  std::printf("\npass                   work\n");
  for (const FlkPassInfo& pass : planned.passes) {
    std::printf("  %-20s %s\n", pass.name, workOf(pass).c_str());
  }
  std::printf("\nresource             bytes  held                  why\n");
  std::printf("  %-11s %12s  as long as the hair   strands: positions, radii, indices\n", "hair",
              readableBytes(planned.info.bytes_persistent).c_str());
  for (const FlkResourceInfo& resource : planned.resources) {
    std::printf("  %-11s %12s  %-20s  %s\n", resource.name, readableBytes(resource.bytes).c_str(),
                resource.transient ? "while a frame draws" : "as long as the view", resource.why);
  }
  std::printf("  %-11s %12s\n", "together",
              readableBytes(planned.info.bytes_persistent + planned.info.bytes_transient).c_str());
  std::printf("\nlists hold %s fragments", groupedDigits(planned.info.node_capacity).c_str());
  if (planned.info.full_shade_taps > 0) {
    std::printf("; a full shade reads %u texels of the shadow map, a cheap one %u", planned.info.full_shade_taps,
                planned.info.low_shade_taps);
  }
  std::printf("\n");
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
    json["assets"].push_back({{"source", asset.opened.label},
                              {"strands", asset.info.strand_count},
                              {"segments", asset.info.vertex_count - asset.info.strand_count}});
  }
  json["size"] = {stage.scene.width, stage.scene.height};
  json["method"] = methodNames()[stage.scene.method];
  json["show"] = displayNames()[stage.scene.display];
  json["rect"] = planned.info.rect;
  json["node_capacity"] = planned.info.node_capacity;
  json["full_shade_taps"] = planned.info.full_shade_taps;
  json["low_shade_taps"] = planned.info.low_shade_taps;
  json["passes"] = nlohmann::ordered_json::array();
  for (const FlkPassInfo& pass : planned.passes) {
    json["passes"].push_back({{"name", pass.name}, {"stage", kStages[pass.stage]}, {"groups", pass.groups},
                              {"indices", pass.indices}, {"segments", pass.segments}});
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
      throw AssetError(result, stage.assets[0].opened.label + ": cannot be planned: " +
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

  StagedFrame staged(stage, stageCamera(stage, 0, 1), hairs, 1.0, stage.aspect());
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
