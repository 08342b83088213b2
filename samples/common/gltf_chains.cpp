// SPDX-License-Identifier: MIT
#include "gltf_chains.h"

#include <algorithm>

namespace forelock::samples {
namespace {

void endChain(Chains& chains, uint8_t marks) {
  chains.first.push_back(static_cast<uint32_t>(chains.vertices.size()));
  chains.marks.push_back(marks);
}

// What exporters write: each segment joins vertex v and v + 1, and no segment is there twice. False: it is not like that.
bool chainsOfNeighbours(const std::vector<uint32_t>& pairs, uint32_t vertices, Chains& chains) {
  if (vertices / 8 > pairs.size()) return false;  // a few segments of many vertices
  std::vector<bool> joined(size_t(vertices) + 1);  // v with v + 1
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const uint32_t low = std::min(pairs[i], pairs[i + 1]);
    if (std::max(pairs[i], pairs[i + 1]) != low + 1 || joined[low]) return false;
    joined[low] = true;
  }
  for (uint32_t v = 0; v + 1 < vertices; ++v) {
    if (!joined[v]) continue;
    if (v == 0 || !joined[v - 1]) chains.vertices.push_back(v);
    chains.vertices.push_back(v + 1);
    if (!joined[v + 1]) endChain(chains, 0);
  }
  return true;
}

// Neighbours of each vertex, without double ones, rising.
struct Graph {
  std::vector<uint32_t> names;  // of vertices that segments end at, rising; a vertex is its place here
  std::vector<size_t> begin;
  std::vector<uint32_t> neighbours;
  std::vector<bool> walked;  // along neighbours[i]

  size_t degree(uint32_t v) const { return begin[v + 1] - begin[v]; }

  // The way from `from` to `to` and back.
  void walk(uint32_t from, uint32_t to) {
    for (const auto& [a, b] : {std::pair{from, to}, std::pair{to, from}})
      walked[size_t(std::lower_bound(&neighbours[begin[a]], neighbours.data() + begin[a + 1], b) - neighbours.data())] = true;
  }
};

Graph graphOf(const std::vector<uint32_t>& pairs, Chains& chains) {
  Graph graph;
  graph.names = pairs;
  std::sort(graph.names.begin(), graph.names.end());
  graph.names.erase(std::unique(graph.names.begin(), graph.names.end()), graph.names.end());
  const auto place = [&](uint32_t name) { return uint32_t(std::lower_bound(graph.names.begin(), graph.names.end(), name) - graph.names.begin()); };
  std::vector<uint64_t> ways;  // from << 32 | to
  ways.reserve(pairs.size());
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const uint64_t a = place(pairs[i]), b = place(pairs[i + 1]);
    ways.push_back(a << 32 | b);
    ways.push_back(b << 32 | a);
  }
  std::sort(ways.begin(), ways.end());
  const auto end = std::unique(ways.begin(), ways.end());
  chains.repeated_edges = uint64_t(ways.end() - end) / 2;
  ways.erase(end, ways.end());
  graph.begin.assign(graph.names.size() + 1, 0);
  for (const uint64_t way : ways) {
    ++graph.begin[(way >> 32) + 1];
    graph.neighbours.push_back(uint32_t(way));
  }
  for (size_t v = 0; v < graph.names.size(); ++v) graph.begin[v + 1] += graph.begin[v];
  graph.walked.resize(graph.neighbours.size());
  return graph;
}

// From `from` over `to` to the next vertex that is no middle of a chain, or back to `from`.
void follow(Graph& graph, uint32_t from, uint32_t to, Chains& chains) {
  const size_t start = chains.vertices.size();
  uint8_t marks = graph.degree(from) > 2 ? kChainBranch : 0;
  bool rises = true;
  uint32_t last = from, at = to;
  chains.vertices.push_back(graph.names[from]);
  graph.walk(last, at);
  while (at != from) {
    rises = rises && at > last;
    chains.vertices.push_back(graph.names[at]);
    if (graph.degree(at) != 2) break;
    const uint32_t* both = &graph.neighbours[graph.begin[at]];
    const uint32_t next = both[0] == last ? both[1] : both[0];
    last = at, at = next;
    graph.walk(last, at);
  }
  if (at == from) {
    marks |= kChainCycle;
  } else if (graph.degree(at) > 2) {
    marks |= kChainBranch;
  }
  if (!rises && chains.vertices.size() - start > 1) marks |= kChainRootGuessed;
  endChain(chains, marks);
}

}  // namespace

Chains chainsOfPairs(std::vector<uint32_t> pairs) {
  Chains chains;
  if (pairs.size() % 2 != 0) ++chains.odd_indices, pairs.pop_back();
  size_t kept = 0;
  uint32_t largest = 0;
  for (size_t i = 0; i < pairs.size(); i += 2) {
    if (pairs[i] == pairs[i + 1]) {
      ++chains.self_edges;
      continue;
    }
    largest = std::max({largest, pairs[i], pairs[i + 1]});
    pairs[kept++] = pairs[i], pairs[kept++] = pairs[i + 1];
  }
  pairs.resize(kept);
  if (pairs.empty() || chainsOfNeighbours(pairs, largest + 1, chains)) return chains;

  Graph graph = graphOf(pairs, chains);
  const uint32_t vertices = uint32_t(graph.names.size());
  for (const bool ends : {true, false})
    for (uint32_t v = 0; v < vertices; ++v) {
      if ((graph.degree(v) != 2) != ends) continue;
      for (size_t way = graph.begin[v]; way < graph.begin[v + 1]; ++way)
        if (!graph.walked[way]) follow(graph, v, graph.neighbours[way], chains);
    }
  return chains;
}

Chains chainsOfVertices(uint32_t count, const std::function<bool(uint32_t, uint32_t)>& same) {
  Chains chains;
  chains.odd_indices = count % 2;
  for (uint32_t v = 0; v + 1 < count; v += 2) {
    if (v > 0 && same(v - 1, v)) {
      ++chains.joined;
    } else {
      if (v > 0) endChain(chains, 0);
      chains.vertices.push_back(v);
    }
    chains.vertices.push_back(v + 1);
  }
  if (!chains.vertices.empty()) endChain(chains, 0);
  return chains;
}

Chains chainsOfStrip(const std::vector<uint32_t>& indices, bool loop) {
  Chains chains;
  for (const uint32_t index : indices) {
    if (index != kRestart) {
      chains.vertices.push_back(index);
    } else if (chains.vertices.size() > chains.first.back()) {
      endChain(chains, loop ? kChainLoop : 0);
    }
  }
  if (chains.vertices.size() > chains.first.back()) endChain(chains, loop ? kChainLoop : 0);
  return chains;
}

}  // namespace forelock::samples
