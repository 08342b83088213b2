// Panels of what is shown: assets and how hair looks. SPDX-License-Identifier: MIT
#include "commands.h"
#include "ui.h"
#include "view_session.h"

#include <algorithm>
#include <filesystem>

namespace forelock::samples {

namespace {

std::string shortName(const std::string& source) {
  return source.rfind("groom:", 0) == 0 ? source : std::filesystem::path(source).filename().string();
}

void materialWidgets(SceneAsset& wanted, const StagedAsset& asset) {
  FlkMaterial& m = wanted.material;
  if (ui::color("Colour", m.color, "Of the fibre: what share of red, green and blue light it gives back. Times the asset's own colours.")) {
    wanted.color_given = true;
  }
  ui::color("Tip colour", m.tip_color, "What the colour turns into towards the tip, as far as Tip blend says");
  ui::slide("Tip blend", m.tip_blend, 0.0, 1.0, "How much of the tip colour there is at the tip: what the colour turns into. Above 0 each fragment takes four bytes more.");
  if (asset.info.has_colors) {
    ui::checkbox("Leave out the asset's colours", wanted.ignore_colors, "Its vertex colours, and the memory that they take");
  }
  double width = asset.width_mm;
  if (ui::slide("Width (mm)", width, 5e-3, 10.0, "Diameter of the widest vertex. A hair of the head has 0.05 to 0.1; grooms with few strands need more.",
                "%.4g", true)) {
    wanted.width_mm = width;
  }
  if (wanted.width_mm > 0.0) {
    ImGui::SameLine();
    if (ui::smallButton("Reset##width", "As wide as the asset says")) {
      wanted.width_mm = 0.0;
    }
  }
  ui::slide("Opacity, root", m.opacity_root, 0.0, 1.0, "Of a pixel that a strand covers wholly, at its root");
  ui::slide("Opacity, tip", m.opacity_tip, 0.0, 1.0, "The same at its tip");
  ui::slide("Diffuse", m.diffuse, 0.0, 1.0, "Weight of the part of light that leaves the fibre in all directions (Kajiya and Kay)");
  ui::slide("Highlight R", m.specular_r, 0.0, 0.5, "Weight of the first, colourless highlight: light that the surface throws back", "%.3g", true);
  ui::slide("R exponent", m.exponent_r, 1.0, 300.0, "Exponent of the first highlight: larger is narrower", "%.3g", true);
  ui::slide("Highlight TRT", m.specular_trt, 0.0, 1.0, "Weight of the second highlight, in the hair's colour: light that went through the fibre twice",
            "%.3g", true);
  ui::slide("TRT exponent", m.exponent_trt, 1.0, 300.0, "Exponent of the second highlight: larger is narrower", "%.3g", true);
  double tilt = static_cast<double>(m.cuticle_tilt) * (180.0 / 3.14159265358979323846);
  if (ui::slide("Cuticle tilt (deg)", tilt, -20.0, 20.0, "How far the fibre's scales stand off: moves the highlights to root and tip", "%.1f")) {
    m.cuticle_tilt = static_cast<float>(tilt * (3.14159265358979323846 / 180.0));
  }
  ui::slide("Shadow opacity", m.shadow_opacity, 0.0, 1.0, "Share of light that one fibre takes away from what lies behind it");
  double spacing = 1e3 * static_cast<double>(m.fibre_spacing);
  if (ui::slide("Fibre spacing (mm)", spacing, 0.05, 50.0, "Mean way of light from fibre to fibre: smaller is darker in the depth of the hair", "%.3g", true)) {
    m.fibre_spacing = static_cast<float>(spacing * 1e-3);
  }
}

void followWidgets(SceneAsset& wanted) {
  ui::slide("Follow strands", wanted.follow.count, 0, 64, "Strands beside each strand of the asset: thickens grooms of few guides");
  if (wanted.follow.count > 0) {
    ui::slide("Follow radius (mm)", wanted.follow.radius_mm, 0.01, 50.0, "Radius around each guide's root in which they start", "%.3g", true);
    ui::slide("Tip spread", wanted.follow.spread_tip, 0.0, 10.0, "Radius at the tip, as a multiple of that at the root");
  }
}

template <class Placed>  // an asset or a mesh
void placeWidgets(Placed& wanted) {
  ui::slide("Turn (deg)", wanted.turn_deg, -180.0, 180.0, "About the axis that is up", "%.0f");
  ui::slide("Scale (m/unit)", wanted.scale, 1e-3, 1e3, "Metres a unit of the file: 0.01 for one in centimetres", "%.4g", true);
  for (int i = 0; i < 3; ++i) {
    const char* names[] = {"x (m)", "y (m)", "z (m)"};
    ui::slide(names[i], wanted.position[i], -2.0, 2.0, "Where the file's origin is", "%.3f");
  }
}

void meshSection(ViewSession& session) {
  const ui::Section section("Head, meshes", true, "Opaque surfaces beside the hair: they hide it, shadow it and take its shadow");
  if (!section) {
    return;
  }
  bool head = session.plain && session.plain->scene.head.value_or(false);
  if (ui::checkbox("Head", head, "A bust under the hair. The grooms of the project lie on it.")) {
    session.scene.head = head;
  }
  for (size_t i = 0; session.plain && i < std::min(session.scene.meshes.size(), session.plain->meshes.size()); ++i) {
    const ui::Scope scope("Mesh " + std::to_string(i + 1));
    SceneMesh& wanted = session.scene.meshes[i];
    const OpaqueMesh& read = *session.plain->meshes[i].read;
    const bool open = ImGui::TreeNode("##mesh", "%s", shortName(wanted.source).c_str());
    ui::tip(wanted.source.c_str());
    ui::noteItem("Mesh", open);
    if (!open) {
      continue;
    }
    ui::faintText(groupedDigits(read.vertices()) + " vertices, " + groupedDigits(read.indices.size() / 3) + " triangles");
    float rgb[3];
    const glm::vec3 color = wanted.color ? glm::vec3(*wanted.color) : read.albedo;
    std::copy(&color[0], &color[0] + 3, rgb);
    if (ui::color("Colour", rgb, "Of its surface: what share of light it gives back")) {
      wanted.color = glm::dvec3(rgb[0], rgb[1], rgb[2]);
    }
    placeWidgets(wanted);
    if (ui::button("Remove", "Out of the scene; the file stays as it is")) {
      Scene without = session.currentScene();
      without.meshes.erase(without.meshes.begin() + static_cast<std::ptrdiff_t>(i));
      session.requests.arrange = without;
    }
    ImGui::TreePop();
  }
  if (ui::button("Add a mesh...", "A glTF or GLB file of triangles. It can also be dragged into the window.", session.loaded())) {
    session.requests.add_mesh = true;
  }
}

}  // namespace

void hairPanel(ViewSession& session) {
  {
    const ui::Section section("Show", true, "What the picture's colours mean");
    if (section) {
      const std::vector<std::string>& names = displayNames();
      uint32_t index = static_cast<uint32_t>(std::find(names.begin(), names.end(), shownName(session.scene)) - names.begin());
      if (ui::choose("Colours", index, names,
                     "shaded: hair. Of the drawing: width in pixels, depth, layers (fragments a pixel). Of the strands: one colour each, root to tip, "
                     "curvature, length, segments, thickness, groups, guides, and bad: what is wrong with them, in red.")) {
        setShown(session.scene, index);
      }
      if (session.stage() && !session.stage()->legend.title.empty()) {
        ui::faintText(legendText(session.stage()->legend));
      }
    }
  }
  {
    const ui::Section section("Assets", true, "The strand files that are open");
    if (section) {
      for (size_t i = 0; session.plain && i < session.scene.assets.size(); ++i) {
        const ui::Scope scope("Asset " + std::to_string(i + 1));
        const StagedAsset& asset = session.plain->assets[i];
        ImGui::TextUnformatted(shortName(session.scene.assets[i].source).c_str());
        ui::tip(session.scene.assets[i].source.c_str());
        ui::faintText(groupedDigits(asset.info.strand_count) + " strands, " + groupedDigits(asset.info.vertex_count) + " vertices, " +
                      asset.opened->format);
        if (session.scene.assets.size() > 1 && ui::smallButton("Remove", "Out of the scene; the file stays as it is")) {
          Scene without = session.currentScene();
          if (asset.opened->recipe && asset.opened->recipe->drape_on_bust) {
            without.head.reset();  // there for this groom; others may still lie on it
          }
          without.assets.erase(without.assets.begin() + static_cast<std::ptrdiff_t>(i));
          session.requests.arrange = without;
        }
      }
      if (ui::button("Open...", "A strand file instead of what is open (Ctrl O). Files can also be dragged into the window.")) {
        session.requests.open_file = true;
      }
      ImGui::SameLine();
      if (ui::button("Add...", "Another strand file into the scene, at its own coordinates", session.loaded())) {
        session.requests.add_file = true;
      }
      for (const std::string& note : session.notes) {
        ui::faintText(note);
      }
    }
  }
  meshSection(session);
  for (size_t i = 0; session.plain && i < std::min(session.scene.assets.size(), session.plain->assets.size()); ++i) {
    const bool one = session.scene.assets.size() == 1;
    const std::string title = one ? "Material" : "Material " + std::to_string(i + 1);
    const ui::Section section(title.c_str(), i == 0, "How this asset's hair looks");
    if (section) {
      SceneAsset& wanted = session.scene.assets[i];
      materialWidgets(wanted, session.plain->assets[i]);
      followWidgets(wanted);
      placeWidgets(wanted);
      if (ui::button("Reset material", "The material that grooms start with")) {
        wanted.material = pictureMaterial();
        wanted.color_given = false;
        wanted.width_mm = 0.0;
      }
    }
  }
}

}  // namespace forelock::samples
