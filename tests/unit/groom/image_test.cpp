// SPDX-License-Identifier: MIT
#include "image.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace forelock::samples {
namespace {

std::string temporary(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SampleImage, PfmIsBottomUpFloats) {
  Image image(2, 2);
  image.pixel(0, 1)[0] = 0.25f;  // bottom left
  image.pixel(1, 0)[2] = 7.5f;   // top right
  const std::string path = temporary("forelock_image_test.pfm");
  writeImage(path, image);
  const std::string content = contentOf(path);
  const std::string header = "PF\n2 2\n-1.0\n";
  ASSERT_EQ(content.size(), header.size() + 2 * 2 * 3 * sizeof(float));
  EXPECT_EQ(content.substr(0, header.size()), header);
  float values[12];
  std::memcpy(values, content.data() + header.size(), sizeof values);
  EXPECT_EQ(values[0], 0.25f);
  EXPECT_EQ(values[11], 7.5f);
  std::remove(path.c_str());
}

TEST(SampleImage, PngAndExrAreWritten) {
  Image image(3, 2);
  for (float& value : image.rgba) {
    value = 0.5f;
  }
  for (const char* name : {"forelock_image_test.png", "forelock_image_test.exr"}) {
    const std::string path = temporary(name);
    writeImage(path, image);
    EXPECT_GT(contentOf(path).size(), 50u) << name;
    std::remove(path.c_str());
  }
}

TEST(SampleImage, ReadsBackWhatIsWritten) {
  Image image(3, 2);
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = i % 4 == 3 ? 1.0f : static_cast<float>(i) / 32.0f;
  }
  for (const char* name : {"forelock_image_test.png", "forelock_image_test.exr"}) {
    const std::string path = temporary(name);
    writeImage(path, image);
    const Image read = readImage(path);
    std::remove(path.c_str());
    ASSERT_EQ(read.width, 3u);
    ASSERT_EQ(read.height, 2u);
    for (size_t i = 0; i < image.rgba.size(); ++i) {
      EXPECT_NEAR(read.rgba[i], image.rgba[i], 0.005f) << name << " " << i;  // half a step of sRGB near 1
    }
  }
}

TEST(SampleImage, OverKeepsOpaqueAndShowsBackground) {
  Image image(2, 1);
  const float red[4] = {1.0f, 0.0f, 0.0f, 1.0f};
  std::memcpy(image.pixel(0, 0), red, sizeof red);
  const float background[3] = {0.2f, 0.3f, 0.4f};
  const Image result = over(image, background);
  EXPECT_EQ(result.pixel(0, 0)[0], 1.0f);
  EXPECT_EQ(result.pixel(1, 0)[1], 0.3f);
  EXPECT_EQ(result.pixel(1, 0)[3], 1.0f);
}

TEST(SampleImage, FailuresAreExceptions) {
  EXPECT_THROW(writeImage("/nonexistent/folder/a.png", Image(1, 1)), std::runtime_error);
  EXPECT_THROW(writeImage("/nonexistent/folder/a.pfm", Image(1, 1)), std::runtime_error);
  EXPECT_THROW(readImage("/nonexistent/a.png"), std::runtime_error);
  EXPECT_THROW(readImage("/nonexistent/a.jpg"), std::runtime_error);
  EXPECT_THROW(writeImage(temporary("a.jpg"), Image(1, 1)), std::runtime_error);
}

}  // namespace
}  // namespace forelock::samples
