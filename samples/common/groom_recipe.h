// Groom recipes: the JSON files of hairassets/ as checked numbers. docs/grooms.md explains every key.
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::samples {

// What is wrong with a recipe, as one sentence that names the key, the value and the range.
struct RecipeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct HairlinePoint {
  double azimuth_deg;    // [0, 180] from the face; both sides of the head are alike
  double elevation_deg;  // [-90, 90] of the lowest direction that carries hair
};

struct ClumpLevel {
  uint32_t count;    // of clumps; each gathers the strands whose roots are nearest to its own
  double tightness;  // [0, 1] share of the way to the clump's centre line that a strand is pulled
  double start;      // [0, 1] of the strand: no pull before
  double full;       // [0, 1] of the strand: full pull from here
  double spread;     // [0, 1] share of the pull that is lost again at the tip
};

struct Wave {
  double amplitude;   // (m)
  double wavelength;  // (m)
  double depth;       // [0, 1]: 0 a flat S-wave, 1 a helix
  double coherence;   // [0, 1]: 0 every clump has its own phase, 1 neighbours swing together
  double variation;   // [0, 1] of amplitude and wavelength from clump to clump
  double start;       // (m) from the root to full amplitude
};

struct RecipeCamera {
  std::string name;
  glm::dvec3 eye, target, up;
  double vertical_fov_deg;
  double near_m, far_m;
  uint32_t width, height;  // pixels the camera was framed for
};

struct Recipe {
  std::string name;
  std::string description;
  uint64_t seed = 1;
  uint32_t strands = 10000;
  uint32_t vertices = 24;  // of every strand

  struct {
    glm::dvec3 centre{0.0, 0.022, -0.014};
    glm::dvec3 radii{0.076, 0.088, 0.096};
    std::vector<HairlinePoint> hairline;
    double feather_deg = 6.0;
  } scalp;

  bool drape_on_bust = true;  // otherwise on the scalp's ellipsoid alone

  struct {
    double mean = 0.3;        // (m)
    double variation = 0.1;   // share, from strand to strand
    double clump_variation = 0.1;
    double layers = 0.0;      // share by which the uppermost roots' hair is shorter; negative: longer
    double front = 0.0;       // share by which hair around the face is shorter; negative: longer
    double hem = -10.0;       // (m) height below which hair is cut
    double hem_variation = 0.0;
  } length;

  struct {
    double offset = 0.0;    // (m) to the wearer's left
    double strength = 1.0;  // how strongly hair is combed away from it
  } parting;

  struct {
    double lift = 0.4;         // [0, 1]: 0 hair leaves the scalp flat, 1 upright
    double bend = 0.03;        // (m) over which gravity turns the hair
    double gravity = 1.0;      // [0, 1]: 0 hair keeps the direction that it was combed in
    double comb = 0.05;        // (m) over which the combed direction is kept
    double back = 0.5;         // share of combing to the back over combing sideways
    double whorl = 1.0;        // how strongly hair at the back is combed away from the whorl
    double ruffle = 0.0;       // share of a random direction in the combing, alike for neighbours
    double ruffle_size = 0.02; // (m) over which that direction changes
    double face_gap = 0.0;     // (m) half width of the part of the face that is kept free
    double gather = 0.0;    // how strongly hair is drawn off the shoulders to chest and back
    double clearance_low = 0.002;   // (m) over the skin, for the lowest roots
    double clearance_high = 0.014;  // (m) for the highest roots
    double clearance_spread = 0.5;  // share of random variation
  } flow;

  std::vector<ClumpLevel> clumps;  // coarse to fine
  Wave wave{0.0, 0.1, 0.3, 0.7, 0.2, 0.05};
  Wave curl{0.0, 0.02, 1.0, 0.0, 0.2, 0.05};

  struct {
    double amplitude = 0.0;  // (m) at the tip
    double wavelength = 0.05;
  } frizz;

  struct {
    double fraction = 0.0;   // of the strands
    double amplitude = 0.01; // (m) at the tip
    double loose = 0.8;      // share of the clumps' pull that they ignore
  } flyaways;

  struct {
    double fraction = 0.0;  // of the strands, the rest is guard hair
    double length = 0.5;    // share of the length that guard hair would have there
    double crimp = 0.002;   // (m) of each strand's own noise
    double wavelength = 0.008;
  } undercoat;

  struct {
    double root = 8e-5, tip = 5e-5;  // (m), diameters
    double taper = 0.7;              // [0, 1) of the strand where the taper begins
  } width;

  std::vector<RecipeCamera> cameras;
};

// Throws RecipeError. `text` is JSON; `name` is used where the recipe gives none.
Recipe parseRecipe(const std::string& text, const std::string& name);

// The text of a recipe or scene, which `what` is: a regular file of 16 MiB at most. Throws RecipeError.
std::string readSmallText(const std::string& path, const char* what);

// Throws RecipeError, also when the file cannot be read.
Recipe loadRecipe(const std::string& path);

}  // namespace forelock::samples
