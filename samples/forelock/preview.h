// What `forelock preview` draws: one picture, a turntable or a sheet; of one asset, of many, or again whenever a file changes.
// SPDX-License-Identifier: MIT
#pragma once

#include "picture.h"
#include "picture_file.h"
#include "scene_options.h"

#include <string>
#include <vector>

namespace forelock::samples {

struct PreviewArguments : SceneArguments {
  std::vector<std::string> assets;
  std::string out, device;
  uint32_t turntable = 0, thumbnail = 0;
  bool validation = false, json = false, sheet = false, watch = false, recursive = false, no_legend = false;
};

struct Preview {
  Stage stage;
  Picture picture;  // its image is what was written; the numbers are the last view's
};

// Draws what is asked for and writes it to `out`, each file in one piece: it is whole or as it was. Throws AssetError or UsageError.
Preview drawPreview(HeadlessHost& host, const Scene& scene, const PreviewArguments& arguments, const std::string& out);

// The scene with what --thumbnail and --sheet change of it.
Scene previewScene(const CLI::App& command, const PreviewArguments& arguments);

void printPreview(const PreviewArguments& arguments, const HeadlessHost& host, const Preview& preview);

// The picture of --sheet; fills what `preview` has beside its image.
Image drawAssetSheet(HeadlessHost& host, const Scene& scene, const std::string& out, Preview& preview);

// Each asset's picture into the folder arguments.out, and overview.png of all of them.
int runPreviewBatch(const CLI::App& command, const PreviewArguments& arguments, HeadlessHost& host);

// Draws now and whenever one of the scene's files changes, until it is interrupted.
int runPreviewWatch(const CLI::App& command, const PreviewArguments& arguments, HeadlessHost& host);

}  // namespace forelock::samples
