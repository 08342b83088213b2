// test_gpu_numerics [--write-stability PATH]: PATH (or the variable FORELOCK_WRITE_STABILITY) receives
// docs/stability.md.
#include "stability.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (const char* path = std::getenv("FORELOCK_WRITE_STABILITY")) forelock::test::writeStabilityTo(path);
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--write-stability" && i + 1 < argc) {
      forelock::test::writeStabilityTo(argv[++i]);
    } else {
      std::fprintf(stderr, "usage: %s [--write-stability PATH]\n", argv[0]);
      return 2;
    }
  }
  const int result = RUN_ALL_TESTS();
  if (!forelock::test::finishStability()) {
    std::fprintf(stderr, "docs/stability.md was not written\n");
    return 1;
  }
  return result;
}
