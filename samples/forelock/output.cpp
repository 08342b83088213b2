// What subcommands print alike. SPDX-License-Identifier: MIT
#include "commands.h"

#include <cstdio>

namespace forelock::samples {

void addOpenOptions(CLI::App& command, uint32_t& points_per_strand) {
  command.add_option("--points-per-strand", points_per_strand, "Of a PLY file of bare points: how many make a strand")
      ->check(CLI::Range(2u, 65'536u))->type_name("N");
}

void printMessages(const std::vector<AssetMessage>& messages, bool with_info) {
  for (const AssetMessage& message : messages) {
    if (with_info || message.severity != FLK_SEVERITY_INFO) {
      std::fprintf(stderr, "forelock: %s\n", message.text.c_str());
    }
  }
}

std::string groupedDigits(uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string grouped;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) {
      grouped += ',';
    }
    grouped += digits[i];
  }
  return grouped;
}

std::string readableBytes(uint64_t bytes) {
  constexpr const char* units[] = {"bytes", "KiB", "MiB", "GiB"};
  double value = static_cast<double>(bytes);
  int unit = 0;
  while (value >= 1024.0 && unit < 3) {
    value /= 1024.0;
    ++unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return text;
}

const char* severityName(uint32_t severity) {
  switch (severity) {
    case FLK_SEVERITY_ERROR: return "error";
    case FLK_SEVERITY_WARNING: return "warning";
    default: return "info";
  }
}

}  // namespace forelock::samples
