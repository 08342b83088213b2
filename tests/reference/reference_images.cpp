// Metrics of section 8 and the writer for failing tests.
#include "reference.h"

#include <algorithm>
#include <fstream>

namespace forelock::reference {
namespace {

bool writeFloats(const std::string& path, const char* magic, int width, int height, const std::vector<float>& values) {
  std::ofstream file(path, std::ios::binary);
  file << magic << "\n" << width << " " << height << "\n-1.0\n";  // negative: little-endian, as every host we build on
  file.write(reinterpret_cast<const char*>(values.data()), std::streamsize(values.size() * sizeof(float)));
  return bool(file);
}

}  // namespace

Difference compare(const Image& a, const Image& b, double exposure) {
  Difference out;
  if (a.width != b.width || a.height != b.height) {
    out.rmse = out.p999 = std::numeric_limits<double>::infinity();
    return out;
  }
  std::vector<double> squares;
  double sum[3] = {0, 0, 0};
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (a.pixels[i].fragments == 0 && b.pixels[i].fragments == 0) continue;
    double square = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double pa = 255 * std::clamp(a.pixels[i].rgb[c] * exposure, 0.0, 1.0);
      const double pb = 255 * std::clamp(b.pixels[i].rgb[c] * exposure, 0.0, 1.0);
      sum[c] += (pa - pb) * (pa - pb);
      square += (pa - pb) * (pa - pb);
      out.mean_a += pa / 3;
      out.mean_b += pb / 3;
    }
    squares.push_back(square);
  }
  out.pixels = squares.size();
  if (squares.empty()) return out;
  const double n = double(squares.size());
  out.rmse = std::sqrt((sum[0] + sum[1] + sum[2]) / n);
  for (size_t c = 0; c < 3; ++c) out.rmse_channel[c] = std::sqrt(sum[c] / n);
  out.mean_a /= n;
  out.mean_b /= n;
  const size_t rank = std::min(squares.size() - 1, size_t(std::ceil(0.999 * n)) - 1);
  std::nth_element(squares.begin(), squares.begin() + std::ptrdiff_t(rank), squares.end());
  out.p999 = std::sqrt(squares[rank]);
  return out;
}

bool writePfm(const std::string& path, const Image& image) {
  std::vector<float> values;
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      for (const double v : image.at(x, y).rgb) values.push_back(float(v));
    }
  }
  return writeFloats(path, "PF", image.width, image.height, values);
}

bool writePfm(const std::string& path, std::span<const double> gray, int width, int height) {
  std::vector<float> values;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) values.push_back(float(gray[size_t(y) * size_t(width) + size_t(x)]));
  }
  return writeFloats(path, "Pf", width, height, values);
}

}  // namespace forelock::reference
