// SPDX-License-Identifier: MIT
#include "gltf_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>

namespace forelock::samples {
namespace {

// "0 1 2 | 5 4" with a letter for each mark behind.
std::string shown(const Chains& chains) {
  std::string text;
  for (size_t i = 0; i < chains.marks.size(); ++i) {
    text += i ? " | " : "";
    for (uint32_t v = chains.first[i]; v < chains.first[i + 1]; ++v) text.append(v > chains.first[i] ? " " : "").append(std::to_string(chains.vertices[v]));
    for (const auto& [mark, letter] : {std::pair{kChainBranch, " b"}, {kChainCycle, " c"}, {kChainRootGuessed, " g"}, {kChainLoop, " l"}})
      if (chains.marks[i] & mark) text += letter;
  }
  return text;
}

TEST(GltfChains, PairsInAnyOrderAndDirection) {
  EXPECT_EQ(shown(chainsOfPairs({0, 1, 1, 2, 3, 4})), "0 1 2 | 3 4");
  EXPECT_EQ(shown(chainsOfPairs({4, 3, 2, 1, 0, 1})), "0 1 2 | 3 4");
  EXPECT_EQ(shown(chainsOfPairs({1, 0, 1, 2, 70'000, 3, 3, 2})), "0 1 2 3 70000");
  EXPECT_EQ(shown(chainsOfPairs({})), "");
}

TEST(GltfChains, TheLowerEndIsTheRootAndAGuessIsMarked) {
  EXPECT_EQ(shown(chainsOfPairs({5, 2, 2, 9})), "5 2 9 g");
  EXPECT_EQ(shown(chainsOfPairs({9, 2, 2, 7, 0, 4})), "0 4 | 7 2 9 g");
  EXPECT_EQ(shown(chainsOfPairs({9, 2})), "2 9");
}

TEST(GltfChains, BranchesSplit) {
  EXPECT_EQ(shown(chainsOfPairs({0, 1, 1, 2, 1, 3})), "0 1 b | 1 2 b | 1 3 b");
  EXPECT_EQ(shown(chainsOfPairs({0, 1, 0, 2, 0, 3, 3, 4})), "0 1 b | 0 2 b | 0 3 4 b") << "strands that share their root";
  EXPECT_EQ(shown(chainsOfPairs({0, 1, 1, 2, 2, 3, 3, 1})), "0 1 b | 1 2 3 b c") << "a loop at a branch";
}

TEST(GltfChains, CyclesOpenAtTheirLowestVertex) {
  EXPECT_EQ(shown(chainsOfPairs({2, 3, 3, 1, 1, 2})), "1 2 3 c");
  EXPECT_EQ(shown(chainsOfPairs({2, 3, 3, 1, 1, 2, 0, 5})), "0 5 | 1 2 3 c") << "closed ones come last";
  const Chains twice = chainsOfPairs({0, 1, 1, 0});
  EXPECT_EQ(shown(twice), "0 1") << "there and back is one segment";
  EXPECT_EQ(twice.repeated_edges, 1u);
}

TEST(GltfChains, DegenerateEdgesAndOddIndices) {
  const Chains chains = chainsOfPairs({4, 4, 0, 1, 0, 1, 0, 1, 7});
  EXPECT_EQ(shown(chains), "0 1");
  EXPECT_EQ(chains.self_edges, 1u);
  EXPECT_EQ(chains.repeated_edges, 2u);
  EXPECT_EQ(chains.odd_indices, 1u);
  EXPECT_EQ(shown(chainsOfPairs({4, 4})), "");
  EXPECT_EQ(shown(chainsOfPairs({4})), "");
}

TEST(GltfChains, VerticesWithoutIndicesJoinWhereTheyAreTheSame) {
  const auto never = [](uint32_t, uint32_t) { return false; };
  EXPECT_EQ(shown(chainsOfVertices(4, never)), "0 1 | 2 3");
  EXPECT_EQ(shown(chainsOfVertices(5, never)), "0 1 | 2 3");
  EXPECT_EQ(chainsOfVertices(5, never).odd_indices, 1u);
  const Chains joined = chainsOfVertices(6, [](uint32_t a, uint32_t) { return a == 1; });
  EXPECT_EQ(shown(joined), "0 1 3 | 4 5");
  EXPECT_EQ(joined.joined, 1u);
  EXPECT_EQ(shown(chainsOfVertices(1, never)), "");
}

TEST(GltfChains, StripsSplitAtRestarts) {
  EXPECT_EQ(shown(chainsOfStrip({3, 2, 1, kRestart, 5, 6}, false)), "3 2 1 | 5 6") << "a strip says itself where it begins";
  EXPECT_EQ(shown(chainsOfStrip({kRestart, kRestart, 1, 2, kRestart}, false)), "1 2");
  EXPECT_EQ(shown(chainsOfStrip({0, 1, 2}, true)), "0 1 2 l");
  EXPECT_EQ(shown(chainsOfStrip({}, false)), "");
}

// Every segment of any graph is walked once, whatever the order; time is that of a sort.
TEST(GltfChains, NoSegmentIsLostInRandomGraphs) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const uint32_t vertices = 2 + random() % 12, edges = random() % 20;
    std::vector<uint32_t> pairs;
    std::vector<std::pair<uint32_t, uint32_t>> wanted, walked;
    for (uint32_t i = 0; i < edges; ++i) {
      const uint32_t a = random() % vertices, b = random() % vertices;
      pairs.insert(pairs.end(), {a, b});
      if (a != b) wanted.emplace_back(std::min(a, b), std::max(a, b));
    }
    const Chains chains = chainsOfPairs(pairs);
    for (size_t i = 0; i < chains.marks.size(); ++i) {
      for (uint32_t v = chains.first[i]; v + 1 < chains.first[i + 1]; ++v)
        walked.emplace_back(std::minmax(chains.vertices[v], chains.vertices[v + 1]));
      if (chains.marks[i] & kChainCycle) walked.emplace_back(std::minmax(chains.vertices[chains.first[i]], chains.vertices[chains.first[i + 1] - 1]));
      EXPECT_GE(chains.first[i + 1] - chains.first[i], 2u);
    }
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    std::sort(walked.begin(), walked.end());
    EXPECT_EQ(walked, wanted) << "round " << round << ": " << shown(chains);
  }
}

TEST(GltfChains, AStarOfManySegmentsTakesNoLongerThanASort) {
  std::vector<uint32_t> pairs;
  for (uint32_t i = 1; i <= 200'000; ++i) pairs.insert(pairs.end(), {i, 0});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(chainsOfPairs(pairs).marks.size(), 200'000u);
  // A search through all neighbours at each step would take 2e10 steps; a sort of 400,000 takes hundredths of a second.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

}  // namespace
}  // namespace forelock::samples
