// A study that is small enough to be made on the spot.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace forelock::test {

// Fields by column; those that are not named are empty.
using StudyFields = std::map<std::string, std::string>;

std::string studyHeader();
std::string studyLine(const StudyFields& fields);

// A good row: view 198k, compute, dark, k 8 and so on.
StudyFields goodRow(const std::string& method, double ms, double error);

// Two views, five methods, a sweep of k and of taps, a failed row; with device.json and pictures of 24 x 16 pixels.
void writeStudy(const std::filesystem::path& folder);

void writeText(const std::filesystem::path& path, const std::string& text);
void writePfm(const std::filesystem::path& path, uint32_t width, uint32_t height, uint32_t channels, const std::vector<float>& values);

}  // namespace forelock::test
