// SPDX-License-Identifier: MIT
#include "options.h"

#include "methods.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace forelock::study {
namespace {

constexpr const char* kExamples =
    "DIR gets study.csv (a row a measurement), device.json, a scene file a view, images as .pfm and cached references.\n"
    "`forelock report DIR` draws plots and a page from it.\n\n"
    "What is measured, most important first: every method at k 8 in the main view (198k); k from 0 to 16; the other views;\n"
    "shadow map reads of the core; the paper's payload; sizes of the shadow map. Time runs out before the next row, never\n"
    "within one, and --resume measures what is left: a study can be stopped at any moment.\n\n"
    "Views: groom:paper-load stores 35k, 78k, 198k and 365k. Any other asset is framed from azimuth 32, elevation 8, and\n"
    "its field of view is sought so that hair covers that many thousand pixels of 1920x1200. With a --scene that places\n"
    "its camera, the only view is `scene`. --quick is a crop of 480x300 pixels of the 198k view at its own scale, called\n"
    "`quick`; its scene file draws the whole view.\n\n"
    "Light: one material a colour, lights scaled until the mean of the exact image over hair is 64/255 (dark) or 128/255\n"
    "(light), see samples/common/condition.h. With --scene materials and lights are the scene's and all light is scaled.\n\n"
    "Times are of whole frames, on a GPU with the stages timed in other frames. ms_dense, beside forward: the same fragments\n"
    "shaded by a kernel that has them all in memory, which is what shading costs at least.\n\n"
    "Errors are against float64 references that are made once a view with shadow maps of the default size (1024): rows of\n"
    "other sizes are compared with these too, which is what the sweep is about.\n\n"
    "Examples:\n"
    "  forelock-study --asset groom:paper-load --out study\n"
    "  forelock-study --asset groom:paper-load --out study --resume --minutes 60     an hour more\n"
    "  forelock-study --asset pony.tfx --up z --out pony --quick                     a look, in about a minute\n"
    "  forelock-study --asset groom:long-wavy --out wavy --views 198k --methods core_tail,exact --k 2,4,8\n"
    "  forelock-study --asset groom:paper-load --out gpu --device NVIDIA --capture compute --full\n"
    "  forelock-study --scene scene.json --out scene                                 your own lights and materials\n\n"
    "Exit status: 0 done; 1 the asset or a check failed; 2 wrong usage; 3 no usable device.\n";

std::vector<std::string> split(const std::string& option, const std::string& text) {
  std::vector<std::string> items;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    if (item.empty()) throw UsageError(option + " " + text + ": an entry is empty, write a list like 1,2,3");
    if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
  }
  if (items.empty()) throw UsageError(option + ": the list is empty");
  return items;
}

std::vector<std::string> choices(const std::string& option, const std::string& text,
                                 const std::vector<std::string>& known) {
  const std::vector<std::string> items = split(option, text);
  for (const std::string& item : items) {
    if (std::find(known.begin(), known.end(), item) != known.end()) continue;
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    throw UsageError(option + " " + item + ": unknown, there are " + all);
  }
  return items;
}

std::vector<uint32_t> numbers(const std::string& option, const std::string& text, uint32_t low, uint32_t high) {
  std::vector<uint32_t> values;
  for (const std::string& item : split(option, text)) {
    const bool digits = item.size() <= 6 && std::all_of(item.begin(), item.end(), [](char c) { return c >= '0' && c <= '9'; });
    const unsigned long value = digits ? std::stoul(item) : high + 1ul;
    if (value < low || value > high)
      throw UsageError(option + " " + item + ": must be a whole number in [" + std::to_string(low) + ", " +
                       std::to_string(high) + "]");
    values.push_back(uint32_t(value));
  }
  return values;
}

}  // namespace

const Method* findMethod(const std::string& name) {
  for (const Method& method : kMethods)
    if (name == method.name) return &method;
  return nullptr;
}

const char* colorName(samples::HairColor color) { return color == samples::HairColor::dark ? "dark" : "light"; }

bool pixelsOfView(const std::string& name, double& pixels) {
  if (name.size() < 2 || name.size() > 6 || name.back() != 'k') return false;
  for (std::size_t i = 0; i + 1 < name.size(); ++i)
    if (name[i] < '0' || name[i] > '9') return false;
  pixels = 1e3 * std::stod(name);
  return pixels > 0;
}

void addOptions(CLI::App& program, Arguments& a) {
  Options& o = a.options;
  program.footer(kExamples);
  program.add_option("--asset", o.asset, "A strand file (.tfx, .hair, .ply, .data), a recipe (.json) or groom:NAME")->type_name("ASSET");
  program.add_option("--scene", o.scene, "A scene file: assets, materials, lights, camera (docs/scene.md)")->type_name("FILE");
  program.add_option("--out", o.out, "Folder for the results; made if need be")->required()->type_name("DIR");
  program.add_option("--views", a.views, "Thousands of hair pixels each [35k,78k,198k,365k]")->type_name("LIST");
  std::string methods;
  for (const Method& method : kMethods) methods += std::string(methods.empty() ? "" : ",") + method.name;
  program.add_option("--methods", a.methods, "Of " + methods + " [all]")->type_name("LIST");
  program.add_option("--k", a.k, "Fragments shaded fully, in [0, 32] [0,1,2,4,8,16]")->type_name("LIST");
  program.add_option("--k-sort", o.k_sort, "Fragments sorted, at least k [max(8, k)]")->check(CLI::Range(1u, 32u))->type_name("N");
  program.add_option("--capture", a.captures, "raster, compute [raster where the queue can; --full: both]")->type_name("LIST");
  program.add_option("--core-taps", a.core_taps, "Shadow map reads of a full shade: 1, 4, 9, 25 [all]")->type_name("LIST");
  program.add_option("--payload", a.payloads, "default, paper [both]")->type_name("LIST");
  program.add_option("--shadow-size", a.shadow_sizes, "Texels, even, in [64, 8192] [512,1024,2048]")->type_name("LIST");
  program.add_option("--hair-colour,--hair-color", a.colors, "dark, light [dark; --full: both]")->type_name("LIST");
  program.add_option("--lights", a.lights, "Number of lights, in [1, 3] [1; --full: 1,3]")->type_name("LIST");
  program.add_option("--frames", o.frames, "Timed frames a row at most [101 on a GPU, 5 on a processor]")
      ->check(CLI::Range(2u, 10001u))->type_name("N");
  program.add_option("--device", o.device, "Part of its name [a discrete GPU, else the best there is]")->type_name("NAME");
  CLI::Option* quick = program.add_flag("--quick", a.quick, "A crop, main methods and the sweep of k: about a minute");
  program.add_flag("--full", a.full, "Both captures, colours, numbers of lights, all views: hours on a processor")->excludes(quick);
  program.add_flag("--resume", o.resume, "Measure what DIR does not hold yet");
  program.add_option("--minutes", o.minutes, "Stop before a row that would end later [18; --full: 170]")
      ->check(CLI::Range(0.05, 1e5))->type_name("M");
  program.add_option("--images", a.images, "main: of the main rows and references; none")
      ->check(CLI::IsMember({"main", "none"}))->type_name("WHICH");
  program.add_option("--bandwidth", o.bandwidth_gb_s, "Of the device, for limit_us [measured]")
      ->check(CLI::Range(1e-3, 1e6))->type_name("GB/s");
  program.add_option("--lane-rate", o.lane_rate, "Multiply-adds a second, for limit_us [measured]")
      ->check(CLI::Range(1e6, 1e18))->type_name("RATE");
  program.add_option("--up", a.up, "The up axis of the asset, y or z")->check(CLI::IsMember({"y", "z"}))->type_name("AXIS");
  program.add_flag("--validation", o.validation, "With Vulkan's validation layers; a message is a failure");
}

Options checkOptions(const Arguments& a) {
  Options o = a.options;
  if (o.asset.empty() && o.scene.empty()) throw UsageError("neither --asset nor --scene is given, one of them says what is drawn");
  o.amount = a.quick ? Amount::quick : a.full ? Amount::full : Amount::standard;
  const bool full = a.full;
  if (a.quick && !a.views.empty()) throw UsageError("--views " + a.views + ": --quick has a view of its own, leave one of them out");
  o.views_given = !a.views.empty(), o.captures_given = !a.captures.empty();
  o.lights_given = !a.lights.empty(), o.shadow_sizes_given = !a.shadow_sizes.empty();
  if (o.lights_given && !o.scene.empty()) throw UsageError("--lights: with --scene the lights are the scene's");
  o.views = split("--views", o.views_given ? a.views : "35k,78k,198k,365k");
  for (const std::string& view : o.views) {
    double pixels = 0;
    if (!pixelsOfView(view, pixels) || pixels > 2.3e6)
      throw UsageError("--views " + view + ": must be thousands of pixels of 1920x1200, for example 198k");
  }
  if (a.quick) o.views = {"quick"};
  std::vector<std::string> methods;
  for (const Method& method : kMethods) methods.push_back(method.name);
  o.methods = a.methods.empty() ? methods : choices("--methods", a.methods, methods);
  o.captures = choices("--capture", a.captures.empty() ? full ? "raster,compute" : "raster" : a.captures, {"raster", "compute"});
  o.payloads = choices("--payload", a.payloads.empty() ? "default,paper" : a.payloads, {"default", "paper"});
  o.k = numbers("--k", a.k.empty() ? "0,1,2,4,8,16" : a.k, 0, 32);
  const std::vector<std::string> taps = choices("--core-taps", a.core_taps.empty() ? "1,4,9,25" : a.core_taps, {"1", "4", "9", "25"});
  for (const std::string& item : taps) o.core_taps.push_back(uint32_t(std::stoul(item)));
  o.shadow_sizes = numbers("--shadow-size", a.shadow_sizes.empty() ? "512,1024,2048" : a.shadow_sizes, 64, 8192);
  for (const uint32_t size : o.shadow_sizes)
    if (size % 2) throw UsageError("--shadow-size " + std::to_string(size) + ": must be even");
  for (const std::string& item : choices("--hair-colour", a.colors.empty() ? full ? "dark,light" : "dark" : a.colors, {"dark", "light"}))
    o.colors.push_back(item == "dark" ? samples::HairColor::dark : samples::HairColor::light);
  o.lights = numbers("--lights", a.lights.empty() ? full ? "1,3" : "1" : a.lights, 1, samples::kConditionLightCount);
  if (!o.scene.empty()) o.lights = {1};
  if (o.minutes <= 0) o.minutes = full ? 170 : 18;
  o.images = a.images == "main";
  o.z_up = a.up == "z";
  return o;
}

}  // namespace forelock::study
