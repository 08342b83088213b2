// SPDX-License-Identifier: MIT
#include "groom.h"

#include "parallel.h"
#include "portable_math.h"
#include "strand_growth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace forelock::samples {

namespace {

// Independent streams of random numbers: what a number is for, as the hash's second argument.
enum Stream : uint64_t {
  kJitterU, kJitterV, kFeather, kLength, kClumpLength, kHem, kClearance, kFlyaway, kWave, kCurl = kWave + 8,
  kFrizz = kCurl + 8, kFly = kFrizz + 4, kPull = kFly + 4, kThickness, kParting,
  kUndercoat, kCrimp = kUndercoat + 1
};

double interpolateHairline(const std::vector<HairlinePoint>& line, double azimuth_deg) {
  for (size_t i = 1; i < line.size(); ++i) {
    if (azimuth_deg < line[i].azimuth_deg) {
      const double span = line[i].azimuth_deg - line[i - 1].azimuth_deg;
      const double t = clamp01((azimuth_deg - line[i - 1].azimuth_deg) / span);
      return line[i - 1].elevation_deg + t * (line[i].elevation_deg - line[i - 1].elevation_deg);
    }
  }
  return line.back().elevation_deg;
}

// Roots by the R2 sequence, whose every prefix is spread evenly, so that a prefix of the strands is a level of detail
// and the first roots serve as the clumps' centres.
std::vector<Root> plantRoots(const Recipe& recipe, const Body& body) {
  std::vector<Root> roots;
  roots.reserve(recipe.strands);
  const uint64_t most = 1000ull * recipe.strands + 100000ull;
  const double jitter = 0.5 / std::sqrt(static_cast<double>(recipe.strands));
  for (uint64_t k = 0; k < most && roots.size() < recipe.strands; ++k) {
    const double n = static_cast<double>(k);
    double u = 0.5 + n * 0.7548776662466927;
    double v = 0.5 + n * 0.5698402909980532;
    u = std::fabs(u - std::floor(u) + jitter * hashSigned(recipe.seed, kJitterU, k));
    u = u > 1.0 ? 2.0 - u : u;  // reflected, because clamping would pile roots up at the poles
    v = v + jitter * hashSigned(recipe.seed, kJitterV, k);
    const double y = 1.0 - 2.0 * u;
    const double flat = std::sqrt(1.0 - y * y);
    const glm::dvec3 direction(flat * sinTurns(v), y, flat * cosTurns(v));

    Root root;
    root.azimuth_turns = atan2Turns(direction.x, direction.z);
    root.elevation_turns = atan2Turns(direction.y, flat);
    const double azimuth_deg = std::fabs(root.azimuth_turns) * 360.0;
    const double above = root.elevation_turns * 360.0 - interpolateHairline(recipe.scalp.hairline, azimuth_deg);
    if (above < recipe.scalp.feather_deg * hashSigned(recipe.seed, kFeather, k)) {
      continue;
    }
    root.position = recipe.scalp.centre + direction * recipe.scalp.radii;
    const double depth = body.distance(root.position);
    if (depth < -0.004) {
      continue;  // under an ear, not on the scalp
    }
    const glm::dvec3 slope = direction / recipe.scalp.radii;
    root.normal = slope / std::sqrt(glm::dot(slope, slope));
    for (int i = 0; i < 4; ++i) {  // the scalp's ellipsoid is close to the skin, not on it
      root.position -= root.normal * body.distance(root.position);
    }
    root.height = smoothStep(-0.5, 0.95, direction.y);
    root.frontness = smoothStep(-0.1, 0.8, direction.z);
    const double parting = recipe.parting.offset + 0.0025 * noise1(recipe.seed, kParting, root.position.z * 60.0);
    root.side = root.position.x >= parting ? 1.0 : -1.0;
    roots.push_back(root);
  }
  if (roots.size() < recipe.strands) {
    throw RecipeError("scalp.hairline leaves too little scalp for " + std::to_string(recipe.strands) + " strands");
  }
  return roots;
}

// The clump centre nearest to a root; hair does not gather across the parting on top of the head.
uint32_t nearestClump(const std::vector<Root>& roots, uint32_t count, const Root& root) {
  uint32_t best = 0;
  double best_distance = 1e30;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 d = roots[i].position - root.position;
    double distance = glm::dot(d, d);
    if (roots[i].side != root.side) {
      distance += 0.0025 * root.height;
    }
    if (distance < best_distance) {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}

double pullAt(const ClumpLevel& level, double t) {
  return level.tightness * smoothStep(level.start, level.full, t) * (1.0 - level.spread * smoothStep(0.7, 1.0, t));
}

struct Clumps {
  std::vector<uint32_t> parent;  // of guide i: its clump one level up
  std::vector<GrownPath> paths;  // of the guides, gathered
};

class Grower {
 public:
  explicit Grower(const Recipe& recipe)
      : recipe_(recipe), body_(recipe), roots_(plantRoots(recipe, body_)) {
    const double longest = recipe.length.mean * (1.0 + recipe.length.variation) *
                           (1.0 + recipe.length.clump_variation) * std::max(1.0, 1.0 - recipe.length.layers) *
                           std::max(1.0, 1.0 - recipe.length.front);
    step_ = std::min(0.005, recipe.length.mean / 8.0);
    steps_ = static_cast<size_t>(longest / step_) + 2;
    gatherGuides();
  }

  void growStrand(uint32_t index, Groom& groom) const;

 private:
  GrownPath growRaw(uint32_t index, size_t steps, double* fly) const;
  void gatherGuides();
  void gather(GrownPath& path, const GrownPath& guide, const ClumpLevel& level, double share) const;
  double lengthOf(uint32_t index, uint32_t clump, const GrownPath& path) const;
  glm::dvec3 swing(const Wave& wave, uint64_t stream, uint32_t coarse, uint32_t fine, uint32_t index, double s,
                   const glm::dvec3& across, const glm::dvec3& outward) const;
  void keepOutside(std::vector<glm::dvec3>& points, double clearance) const;

  const Recipe& recipe_;
  Body body_;
  std::vector<Root> roots_;
  Clumps clumps_;
  double step_;
  size_t steps_;
};

GrownPath Grower::growRaw(uint32_t index, size_t steps, double* fly) const {
  const Root& root = roots_[index];
  const bool flies = hashUnit(recipe_.seed, kFlyaway, index) < recipe_.flyaways.fraction;
  *fly = flies ? 0.3 + 0.7 * hashUnit(recipe_.seed, kFlyaway, index, 1) : 0.0;
  const double layer = recipe_.flow.clearance_low +
                       (recipe_.flow.clearance_high - recipe_.flow.clearance_low) * root.height;
  const double spread = 1.0 + recipe_.flow.clearance_spread * hashSigned(recipe_.seed, kClearance, index);
  const double lift = clamp01(recipe_.flow.lift * (1.0 + 0.6 * *fly));
  return growPath(recipe_, body_, root, layer * spread, lift, step_, steps);
}

void Grower::gather(GrownPath& path, const GrownPath& guide, const ClumpLevel& level, double share) const {
  const size_t count = std::min(path.points.size(), guide.points.size());
  double bond = 1.0;
  for (size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) * step_ / recipe_.length.mean;
    // A strand that has gone another way, say to the back where its clump went to the chest, is lost to the clump for
    // good: pulling it back would take it through the shoulder.
    const glm::dvec3 apart = guide.points[i] - path.points[i];
    bond = std::min(bond, 1.0 - smoothStep(0.025, 0.055, std::sqrt(glm::dot(apart, apart))));
    const double pull = share * bond * pullAt(level, t);
    path.points[i] += apart * pull;
    path.outward[i] += (guide.outward[i] - path.outward[i]) * pull;
  }
}

void Grower::gatherGuides() {
  if (recipe_.clumps.empty()) {
    return;
  }
  const uint32_t count = std::min(recipe_.clumps.back().count, recipe_.strands);
  clumps_.parent.resize(count);
  clumps_.paths.resize(count);
  parallelFor(count, 16, [&](size_t i) {
    double fly;
    const uint32_t index = static_cast<uint32_t>(i);
    clumps_.paths[i] = growRaw(index, steps_, &fly);
    uint32_t coarser = index;
    for (const ClumpLevel& level : recipe_.clumps) {
      if (index < level.count) {
        break;
      }
      coarser = nearestClump(roots_, level.count, roots_[i]);
    }
    clumps_.parent[i] = coarser;
  });
  // A guide of one level is gathered into the finished path of its parent in the coarser one.
  for (size_t l = 1; l < recipe_.clumps.size(); ++l) {
    const uint32_t first = std::min(recipe_.clumps[l - 1].count, count);
    const uint32_t last = std::min(recipe_.clumps[l].count, count);
    for (uint32_t i = first; i < last; ++i) {
      gather(clumps_.paths[i], clumps_.paths[clumps_.parent[i]], recipe_.clumps[l - 1], 1.0);
    }
  }
}

double Grower::lengthOf(uint32_t index, uint32_t clump, const GrownPath& path) const {
  const Root& root = roots_[index];
  const auto& length = recipe_.length;
  double wanted = length.mean * (1.0 + length.variation * hashSigned(recipe_.seed, kLength, index));
  wanted *= 1.0 + length.clump_variation * hashSigned(recipe_.seed, kClumpLength, clump);
  wanted *= (1.0 - length.layers * root.height) * (1.0 - length.front * root.frontness);
  const double hem = length.hem + length.hem_variation * (0.6 * hashSigned(recipe_.seed, kHem, clump) +
                                                          0.4 * hashSigned(recipe_.seed, kHem, index, 1));
  for (size_t i = 1; i < path.points.size(); ++i) {
    const double s = static_cast<double>(i) * step_;
    if (s >= wanted) {
      break;
    }
    if (path.points[i].y < hem) {
      wanted = s;
      break;
    }
  }
  const double most = static_cast<double>(path.points.size() - 1) * step_;
  return std::min(std::max(wanted, 0.02 * length.mean), most);
}

glm::dvec3 Grower::swing(const Wave& wave, uint64_t stream, uint32_t coarse, uint32_t fine, uint32_t index, double s,
                         const glm::dvec3& across, const glm::dvec3& outward) const {
  if (!(wave.amplitude > 0.0)) {
    return glm::dvec3(0.0);
  }
  const uint64_t seed = recipe_.seed;
  const double wavelength = wave.wavelength * (1.0 + 0.4 * wave.variation * hashSigned(seed, stream, coarse));
  const double size = 1.0 + 0.7 * wave.variation * hashSigned(seed, stream + 1, fine);
  const double shared = 1.2 * noise3(seed, stream + 2, roots_[coarse].position * 14.0);
  const double own = 0.7 * hashUnit(seed, stream + 3, coarse) + 0.3 * hashUnit(seed, stream + 6, fine);
  double phase = s / wavelength + wave.coherence * shared + (1.0 - wave.coherence) * own;
  phase += 0.04 * hashSigned(seed, stream + 4, index);
  // No head of hair repeats itself exactly: the phase wanders along the lock.
  phase += wave.variation * 0.5 * noise1(seed, hashBits(stream + 5, coarse), 0.7 * s / wavelength);
  const double amplitude = wave.amplitude * size * smoothStep(0.0, wave.start, s);
  return (across * sinTurns(phase) + outward * (wave.depth * cosTurns(phase))) * amplitude;
}

// Vertices first, then the middles of the segments, whose chords cut through what is round.
void Grower::keepOutside(std::vector<glm::dvec3>& points, double clearance) const {
  for (int pass = 0; pass < 3; ++pass) {
    for (size_t i = 1; i < points.size(); ++i) {
      const double kept = clearance * smoothStep(0.0, 3.0, static_cast<double>(i));
      const double d = body_.distance(points[i]);
      if (d < kept) {
        points[i] += body_.normal(points[i]) * (kept - d);
      }
    }
    for (size_t i = 1; i + 1 < points.size(); ++i) {
      const glm::dvec3 middle = (points[i] + points[i + 1]) * 0.5;
      const double d = body_.distance(middle);
      if (d < 0.5 * clearance) {
        const glm::dvec3 push = body_.normal(middle) * (0.5 * clearance - d);
        points[i] += push;
        points[i + 1] += push;
      }
    }
  }
}

void Grower::growStrand(uint32_t index, Groom& groom) const {
  const uint64_t seed = recipe_.seed;
  const Root& root = roots_[index];
  double fly;
  GrownPath path = growRaw(index, steps_, &fly);
  const bool under = hashUnit(seed, kUndercoat, index) < recipe_.undercoat.fraction;

  uint32_t fine = index;
  uint32_t coarse = index;
  if (!recipe_.clumps.empty()) {
    const ClumpLevel& level = recipe_.clumps.back();
    fine = nearestClump(roots_, std::min(level.count, recipe_.strands), root);
    coarse = fine;
    while (clumps_.parent[coarse] != coarse) {
      coarse = clumps_.parent[coarse];
    }
    const double loyal = 1.0 - 0.35 * hashUnit(seed, kPull, index);
    if (!under) {  // what guard hair gathers above it fills the gaps below
      gather(path, clumps_.paths[fine], level, loyal * (1.0 - fly * recipe_.flyaways.loose));
    }
  }

  const double length = lengthOf(index, fine, path) * (under ? recipe_.undercoat.length : 1.0);
  const uint32_t vertices = recipe_.vertices;
  std::vector<glm::dvec3> points(vertices);
  for (uint32_t j = 0; j < vertices; ++j) {
    const double t = static_cast<double>(j) / static_cast<double>(vertices - 1);
    const double s = t * length;
    const double at = s / step_;
    const size_t cell = std::min(static_cast<size_t>(at), path.points.size() - 2);
    const double f = at - static_cast<double>(cell);
    glm::dvec3 point = path.points[cell] + (path.points[cell + 1] - path.points[cell]) * f;

    const glm::dvec3 along = path.points[cell + 1] - path.points[cell];
    const double along_squared = glm::dot(along, along);
    const glm::dvec3 tangent = along_squared > 0.0 ? along / std::sqrt(along_squared) : glm::dvec3(0, -1, 0);
    glm::dvec3 outward = path.outward[cell] - tangent * glm::dot(path.outward[cell], tangent);
    const double outward_squared = glm::dot(outward, outward);
    outward = outward_squared > 1e-12 ? outward / std::sqrt(outward_squared) : root.normal;
    const glm::dvec3 across = glm::cross(tangent, outward);

    point += swing(recipe_.wave, kWave, coarse, fine, index, s, across, outward);
    point += swing(recipe_.curl, kCurl, coarse, fine, index, s, across, outward);
    const double from_root = smoothStep(0.0, 0.04, s);
    const double frizz = recipe_.frizz.amplitude * (0.25 + 0.75 * t) * from_root;
    const double astray = fly * recipe_.flyaways.amplitude * t * std::sqrt(t);
    for (int axis = 0; axis < 3; ++axis) {
      const uint64_t a = static_cast<uint64_t>(axis);
      point[axis] += frizz * noise1(seed, hashBits(kFrizz, index, a), s / recipe_.frizz.wavelength);
      if (under) {
        point[axis] += recipe_.undercoat.crimp * smoothStep(0.0, recipe_.undercoat.wavelength, s) *
                       noise1(seed, hashBits(kCrimp, index, a), s / recipe_.undercoat.wavelength);
      }
      if (astray > 0.0) {
        point[axis] += astray * noise1(seed, hashBits(kFly, index, a), 3.0 * t + 1.5 * hashUnit(seed, kFly, index));
      }
    }
    points[j] = point;
  }
  points[0] = root.position;
  keepOutside(points, 0.0012);

  const double thickness = 1.0 + 0.15 * hashSigned(seed, kThickness, index);
  for (uint32_t j = 0; j < vertices; ++j) {
    const size_t out = static_cast<size_t>(index) * vertices + j;
    for (int axis = 0; axis < 3; ++axis) {
      groom.positions[3 * out + static_cast<size_t>(axis)] =
          static_cast<float>(std::floor(points[j][axis] * 0x1p20 + 0.5) * 0x1p-20);
    }
    const double t = static_cast<double>(j) / static_cast<double>(vertices - 1);
    const double taper = smoothStep(recipe_.width.taper, 1.0, t);
    const double radius = 0.5 * thickness * (recipe_.width.root + (recipe_.width.tip - recipe_.width.root) * taper);
    groom.radii[out] = static_cast<float>(std::floor(radius * 0x1p30 + 0.5) * 0x1p-30);
  }
  groom.root_uvs[2 * index] = static_cast<float>(std::floor((root.azimuth_turns + 0.5) * 0x1p16 + 0.5) * 0x1p-16);
  groom.root_uvs[2 * index + 1] =
      static_cast<float>(std::floor((2.0 * root.elevation_turns + 0.5) * 0x1p16 + 0.5) * 0x1p-16);
}

void hashBytes(uint64_t& hash, const void* data, size_t size) {
  const unsigned char* bytes = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < size; ++i) {
    hash = (hash ^ bytes[i]) * 0x100000001b3ull;
  }
}

}  // namespace

Groom makeGroom(const Recipe& recipe, const std::function<void(uint64_t, uint64_t)>& progress) {
  const Grower grower(recipe);
  const size_t strands = recipe.strands;
  const size_t vertices = strands * recipe.vertices;
  Groom groom;
  groom.first_vertex.resize(strands + 1);
  for (size_t i = 0; i <= strands; ++i) {
    groom.first_vertex[i] = static_cast<uint32_t>(i * recipe.vertices);
  }
  groom.positions.resize(3 * vertices);
  groom.radii.resize(vertices);
  groom.root_uvs.resize(2 * strands);
  std::atomic<uint64_t> done{0};
  parallelFor(strands, 64, [&](size_t i) {
    grower.growStrand(static_cast<uint32_t>(i), groom);
    const uint64_t finished = ++done;
    if (progress && finished % 256 == 0) {
      progress(finished, strands);
    }
  });
  return groom;
}

FlkStrands describeGroom(const Groom& groom) {
  FlkStrands strands = {};
  strands.type = FLK_TYPE_STRANDS;
  strands.strand_count = groom.strandCount();
  strands.vertex_count = groom.vertexCount();
  strands.first_vertex = groom.first_vertex.data();
  strands.positions = groom.positions.data();
  strands.radii = groom.radii.data();
  strands.root_uvs = groom.root_uvs.data();
  return strands;
}

uint64_t hashGroom(const Groom& groom) {
  uint64_t hash = 0xcbf29ce484222325ull;
  hashBytes(hash, groom.first_vertex.data(), groom.first_vertex.size() * sizeof(uint32_t));
  hashBytes(hash, groom.positions.data(), groom.positions.size() * sizeof(float));
  hashBytes(hash, groom.radii.data(), groom.radii.size() * sizeof(float));
  hashBytes(hash, groom.root_uvs.data(), groom.root_uvs.size() * sizeof(float));
  return hash;
}

}  // namespace forelock::samples
