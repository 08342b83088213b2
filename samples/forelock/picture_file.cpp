// SPDX-License-Identifier: MIT
#include "picture_file.h"

#include "asset_source.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace fs = std::filesystem;

std::string numberedPath(const std::string& path, uint32_t number) {
  char suffix[16];
  std::snprintf(suffix, sizeof suffix, "-%03u", number);
  const fs::path p(path);
  return (p.parent_path() / (p.stem().string() + suffix + p.extension().string())).string();
}

void savePicture(const std::string& path, const Image& image) {
  const fs::path target(path);
  fs::path name(".");
  name += target.stem();
  name += ".";
  name += std::to_string(getpid());
  name += target.extension();
  const fs::path temporary = target.parent_path() / name;
  std::error_code error;
  try {
    writeImage(temporary.string(), image);
    fs::rename(temporary, target, error);
  } catch (const std::runtime_error& failure) {
    std::string why = failure.what();  // which may name the temporary file
    if (const size_t at = why.find(temporary.string()); at != std::string::npos) {
      why.replace(at, temporary.string().size(), path);
    }
    fs::remove(temporary, error);
    throw AssetError(FLK_ERROR_IO, path + ": " + why);
  }
  if (error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw AssetError(FLK_ERROR_IO, path + ": cannot be replaced: " + error.message());
  }
}

}  // namespace forelock::samples
