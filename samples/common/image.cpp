// SPDX-License-Identifier: MIT
#include "image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace forelock::samples {

namespace {

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

float clamp01(float x) { return x > 0.0f ? std::min(x, 1.0f) : 0.0f; }  // NaN becomes 0

uint8_t toSrgb(float linear) { return static_cast<uint8_t>(encodeSrgb(linear) * 255.0f + 0.5f); }

void writePfm(const std::string& path, const Image& image) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) {
    throw std::runtime_error("cannot be opened for writing");
  }
  constexpr double scale = std::endian::native == std::endian::little ? -1.0 : 1.0;  // its sign tells the byte order
  bool good = std::fprintf(file, "PF\n%u %u\n%.1f\n", image.width, image.height, scale) > 0;
  std::vector<float> row(size_t{3} * image.width);
  for (uint32_t y = image.height; good && y-- > 0;) {  // PFM starts at the bottom
    for (uint32_t x = 0; x < image.width; ++x) {
      std::copy_n(image.pixel(x, y), 3, &row[size_t{3} * x]);
    }
    good = std::fwrite(row.data(), sizeof(float), row.size(), file) == row.size();
  }
  good = std::fclose(file) == 0 && good;
  if (!good) {
    throw std::runtime_error("cannot be written (disk full?)");
  }
}

void writeThroughLibrary(const std::string& path, const Image& image, bool is_png) {
  const auto output = OIIO::ImageOutput::create(path);
  if (!output) {
    throw std::runtime_error("no writer for this format: " + OIIO::geterror());
  }
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 4,
                       is_png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF);
  spec.alpha_channel = 3;
  std::vector<uint8_t> encoded;
  if (is_png) {
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);  // what is handed over is not premultiplied
    encoded.resize(image.rgba.size());
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
      const float alpha = clamp01(image.rgba[i + 3]);
      for (size_t channel = 0; channel < 3; ++channel) {
        encoded[i + channel] = alpha > 0.0f ? toSrgb(image.rgba[i + channel] / alpha) : uint8_t{0};
      }
      encoded[i + 3] = static_cast<uint8_t>(alpha * 255.0f + 0.5f);
    }
  } else {
    spec.attribute("compression", "zip");
  }
  const void* pixels = is_png ? static_cast<const void*>(encoded.data()) : image.rgba.data();
  // Into memory first: the library does not notice a disk that is full.
  OIIO::Filesystem::IOVecOutput memory;
  OIIO::Filesystem::IOProxy* proxy = &memory;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const bool good = output->open(path, spec) &&
                    output->write_image(is_png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT, pixels) &&
                    output->close();
  if (!good) {
    throw std::runtime_error(output->geterror());
  }
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) {
    throw std::runtime_error(std::string("cannot be written: ") + std::strerror(errno));
  }
  const bool whole = std::fwrite(memory.buffer().data(), 1, memory.buffer().size(), file) == memory.buffer().size();
  if (std::fclose(file) != 0 || !whole) {
    throw std::runtime_error("cannot be written (disk full?)");
  }
}

// What the library says may go on for lines.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

float encodeSrgb(float linear) {
  const float x = clamp01(linear);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb(float coded) {
  const float x = clamp01(coded);
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

Image over(const Image& image, const float background[3]) {
  Image result = image;
  for (size_t i = 0; i < result.rgba.size(); i += 4) {
    const float through = 1.0f - result.rgba[i + 3];
    for (size_t channel = 0; channel < 3; ++channel) {
      result.rgba[i + channel] += through * background[channel];
    }
    result.rgba[i + 3] = 1.0f;
  }
  return result;
}

bool isImagePath(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".png" || extension == ".exr" || extension == ".pfm";
}

Image readImage(const std::string& path) {
  const std::string extension = extensionOf(path);
  if (extension != ".png" && extension != ".exr") {
    throw std::runtime_error("no picture that can be read, use .png or .exr");
  }
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    throw std::runtime_error("cannot be read as a picture: " + firstLine(OIIO::geterror()));
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > 16384 || spec.height > 16384 || spec.nchannels < 1) {
    throw std::runtime_error("is " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                             ", sides must lie in [1, 16384]");
  }
  Image image(static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height));
  const size_t channels = static_cast<size_t>(spec.nchannels), pixels = size_t{image.width} * image.height;
  std::vector<float> values(channels * pixels);
  const bool encoded = extension == ".png" && spec.get_string_attribute("oiio:ColorSpace", "sRGB") != "Linear";
  const size_t colors = channels >= 3 ? 3 : 1;
  const bool has_alpha = channels > colors;
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    throw std::runtime_error("cannot be read as a picture: " + firstLine(input->geterror()));
  }
  for (size_t i = 0; i < pixels; ++i) {
    const float* from = &values[channels * i];
    float* to = &image.rgba[4 * i];
    to[3] = has_alpha ? from[colors] : 1.0f;
    for (size_t channel = 0; channel < 3; ++channel) {
      const float value = from[colors == 3 ? channel : 0];
      to[channel] = encoded ? decodeSrgb(value) : value;
    }
  }
  return image;
}

void writeImage(const std::string& path, const Image& image) {
  const std::string extension = extensionOf(path);
  if (extension == ".pfm") {
    writePfm(path, image);
  } else if (extension == ".png" || extension == ".exr") {
    writeThroughLibrary(path, image, extension == ".png");
  } else {
    throw std::runtime_error("unknown image extension \"" + extension + "\", use .png, .exr or .pfm");
  }
}

}  // namespace forelock::samples
