// SPDX-License-Identifier: MIT
#include "report_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace forelock::samples {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1d1d1d; --faint: #666; --line: #d9d9d9; --paper: #fff; --wash: #f5f5f3; --link: #0b57a4; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e4e2; --faint: #a2a2a0; --line: #3c3c3b; --paper: #171717; --wash: #202020; --link: #8ab8ee; }
}
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 64rem; margin: 0 auto; padding: 2rem 1rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 0.3rem; font-weight: 650; }
h2 { font-size: 1.2rem; margin: 2.8rem 0 0.6rem; padding-top: 0.6rem; border-top: 1px solid var(--line); font-weight: 650; }
h3 { font-size: 1rem; margin: 1.8rem 0 0.4rem; font-weight: 650; }
p, ul, dl { max-width: 44rem; margin: 0.5rem 0; }
a { color: var(--link); }
nav { font-size: 0.9rem; margin: 0.8rem 0 0; }
nav a { margin-right: 1rem; white-space: nowrap; }
code { font-family: ui-monospace, "DejaVu Sans Mono", Consolas, monospace; font-size: 0.9em; overflow-wrap: anywhere; }
figure { margin: 1.2rem 0 1.8rem; }
figure img { max-width: 100%; height: auto; display: block; }
img.plot { background: #fff; border: 1px solid var(--line); box-sizing: border-box; width: 100%; }
img.pixels { image-rendering: pixelated; }
figcaption { font-size: 0.9rem; color: var(--ink); max-width: 48rem; margin-top: 0.5rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 20rem), 1fr)); gap: 0.6rem; align-items: start; }
.pair span { display: block; font-size: 0.8rem; color: var(--faint); }
.views { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 14rem), 1fr)); gap: 1rem; align-items: end; }
.views figure { margin: 0; }
.views img { max-height: 24rem; width: auto; }
.faint { color: var(--faint); }
.scroll { overflow: auto; max-width: 100%; }
.rows { max-height: 85vh; border: 1px solid var(--line); }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25rem 0.7rem 0.25rem 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { font-weight: 600; vertical-align: bottom; }
td.n, th.n { text-align: right; }
.rows table { font-size: 0.78rem; border-collapse: separate; border-spacing: 0; }
.rows th, .rows td { padding: 0.2rem 0.45rem; }
.rows th { position: sticky; top: 0; background: var(--wash); }
.rows td { white-space: nowrap; }
tr.doubtful td { color: var(--faint); font-style: italic; }
.big { font-size: 1.05rem; font-weight: 650; white-space: nowrap; }
summary { cursor: pointer; margin: 0.6rem 0; }
svg.legend { max-width: 100%; height: auto; display: block; color: var(--ink); margin-top: 0.6rem; }
@page rows { size: landscape; margin: 8mm; }
@media print {
  :root { --ink: #000; --faint: #444; --line: #bbb; --paper: #fff; --wash: #f2f2f2; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  nav, summary { display: none; }
  figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  .scroll { overflow: visible; max-height: none; }
  .rows { page: rows; border: 0; }
  .rows table { font-size: 5pt; }
  .rows th { position: static; }
  .rows th, .rows td { padding: 0.1rem 0.15rem; white-space: normal; }
}
)";

std::string cell(const std::string& text, bool is_number = false, const char* tag = "td") {
  return std::string("<") + tag + (is_number ? " class=\"n\">" : ">") + text + "</" + tag + ">";
}

std::string escaped(const std::string& text, size_t most = 300) {
  return escapeHtml(text.size() > most ? text.substr(0, most) + "..." : text);
}

std::string known(double value, int digits = 3) { return std::isfinite(value) ? readableNumber(value, digits) : "-"; }

// Digits that say nothing are left out: "8", "0.25".
std::string compact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string compactSize(const StudyView& view) {
  if (!std::isfinite(view.width) || !std::isfinite(view.height)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.0f&#215;%.0f", view.width, view.height);
  return text;
}

std::string percent(double share) { return readableNumber(100.0 * share, share < 0.1 ? 2 : 3) + " %"; }

class Page {
 public:
  explicit Page(const PageInput& page_input) : input(page_input), facts(page_input.facts) {}

  std::string make() {
    const StudyDevice& device = facts.table.device;
    const std::string title = "Forelock study: " + escaped(device.asset.empty() ? "unnamed asset" : device.asset, 80);
    out << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
        << "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n<title>" << title << "</title>\n<style>" << kStyle
        << "</style>\n</head>\n<body>\n<main>\n<h1>" << title << "</h1>\n";
    intro();
    head("measured", "What was measured");
    measured();
    head("headlines", "Headline numbers");
    headlines();
    head("error", "Error against time");
    errorPlots();
    head("passes", "Where the time goes");
    section("passes", "No row has times of its passes.");
    head("tail", "What the tail costs");
    section("tail", "That takes core_only and forward or core_tail at two views or more.");
    head("load", "Fragments of a pixel");
    load();
    head("pictures", "What the errors look like");
    differencePictures();
    head("sweeps", "One setting at a time");
    text("Everything else stays at its base: k 8, 25 taps in the core and 1 in the tail, the default coding of nodes, one light.");
    section("sweeps", "No setting was varied.");
    if (isPaperLoad()) {
      head("paper", "Beside the paper");
      paper();
    }
    head("doubtful", "Failed and doubtful rows");
    doubtful();
    head("rows", "All rows");
    allRows();
    head("again", "Making it again");
    again();
    out << "</main>\n</body>\n</html>\n";
    std::string page = out.str();
    const std::string mark = "<nav></nav>";
    return page.replace(page.find(mark), mark.size(), "<nav>" + links + "</nav>");
  }

 private:
  void head(const std::string& id, const std::string& title) {
    out << "<h2 id=\"" << id << "\">" << title << "</h2>\n";
    links += "<a href=\"#" + id + "\">" + title + "</a> ";
  }
  // `words` are HTML.
  void text(const std::string& words) { out << "<p>" << words << "</p>\n"; }

  std::string dataUri(const std::string& path) const {
    std::ifstream file(std::filesystem::path(input.folder) / path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return std::string("data:") + (path.ends_with(".svg") ? "image/svg+xml" : "image/png") + ";base64," + base64(bytes);
  }
  std::string image(const std::string& path, const std::string& what, const char* kind = nullptr) const {
    return "<img" + (kind ? std::string(" class=\"") + kind + "\"" : "") + " alt=\"" + escaped(what) + "\" src=\"" + dataUri(path) + "\" />";
  }
  void figure(const Plot& plot) {
    out << "<figure>" << image(plot.path, plot.title, "plot") << "<figcaption><b>" << escaped(plot.title) << ".</b> "
        << escaped(plot.caption, 2000) << "</figcaption></figure>\n";
  }
  void section(const std::string& name, const char* otherwise) {
    bool any = false;
    for (const Plot& plot : input.plots.drawn) {
      if (plot.section == name) figure(plot), any = true;
    }
    if (!any) text(plotsMissing(otherwise));
  }
  std::string plotsMissing(const char* otherwise) const {
    return input.plots.no_gnuplot ? "Not drawn: gnuplot was not found. With the Debian package gnuplot-nox the report has its plots." : otherwise;
  }

  bool isPaperLoad() const { return facts.table.device.asset.find("paper-load") != std::string::npos; }

  void intro() {
    text("How fast ways of drawing hair are, and how far from the exact image. Every method here keeps all fragments of a pixel in a list, "
         "unless it says otherwise; they differ in which of them they shade in full and in which order they blend. "
         "<b>exact</b> shades all in full and in order. <b>forward</b> shades all in full while it captures and orders the nearest only, as "
         "Hillesland, Bilodeau and Thibieroz (2014) compare with. <b>core_tail</b>, their method, shades the nearest k in full (the core) "
         "and the others cheaply (the tail); <b>core_only</b> leaves the tail's colour out, <b>all_low</b> shades everything cheaply, "
         "<b>hard</b> has no transparency.");
    out << "<nav></nav>\n";
  }

  void measured() {
    const StudyDevice& device = facts.table.device;
    out << "<div class=\"scroll\"><table>\n";
    const auto line = [&](const char* name, const std::string& value) {
      if (!value.empty()) out << "<tr>" << cell(name, false, "th") << cell(escaped(value)) << "</tr>\n";
    };
    line("asset", device.asset);
    line("device", device.device + (device.type.empty() ? "" : " (" + device.type + ")"));
    line("driver", device.driver);
    if (std::isfinite(device.bandwidth_gb_s)) {
      line("bandwidth", readableNumber(device.bandwidth_gb_s) + " GB/s, " + readableNumber(device.lane_operations_per_s / 1e12) +
                            " T lane operations/s (" + (device.calibration.empty() ? "unknown whence" : device.calibration) + ")");
    }
    line("commit", device.commit);
    line("date", device.date);
    line("rows", std::to_string(facts.liveRows().size()) + (facts.replaced_rows > 0 ? " (of " + std::to_string(facts.replaced_rows) +
                                                                                       " that were measured twice the later)" : ""));
    out << "</table></div>\n<h3>Views</h3>\n<div class=\"scroll\"><table>\n<tr>" << cell("view", false, "th") << cell("pixels", true, "th")
        << cell("hair pixels", true, "th") << cell("fragments", true, "th") << cell("mean of a hair pixel", true, "th")
        << cell("most of a pixel", true, "th") << "</tr>\n";
    for (const StudyView& view : facts.views) {
      out << "<tr>" << cell(escaped(view.name, 60)) << cell(compactSize(view), true)
          << cell(readableCount(view.hair_pixels), true) << cell(readableCount(view.fragments), true) << cell(known(view.mean_overdraw), true)
          << cell(readableCount(view.max_overdraw), true) << "</tr>\n";
    }
    out << "</table></div>\n";
    text("<b>Errors</b> are root mean squares over the hair pixels in linear colour, 0 to 255 a channel, the three channels' squares summed, so "
         "that 442 is the most; against <i>R_exact</i>, all fragments shaded in full and blended in order in double precision, unless said "
         "otherwise. Lights are scaled until the mean of R_exact is 64 (dark hair) or 128 (light hair) of 255. "
         "<b>Times</b> are medians of GPU time over the frames timed, of all passes together, hair shadow maps included. "
         "Of error against time they are ratios to core_tail in alternating frames, where the study has them, times core_tail's median.");
    std::vector<std::string> notes = facts.table.warnings;
    notes.insert(notes.end(), input.plots.problems.begin(), input.plots.problems.end());
    notes.insert(notes.end(), input.pictures.problems.begin(), input.pictures.problems.end());
    if (!notes.empty()) {
      out << "<h3>Notes on the input</h3>\n<ul>\n";
      for (const std::string& note : notes) out << "<li>" << escaped(note) << "</li>\n";
      out << "</ul>\n";
    }
  }

  void headline(const std::string& value, const std::string& what) {
    out << "<tr><td class=\"n big\">" << value << "</td>" << cell(what) << "</tr>\n";
  }

  void headlines() {
    const Setting& setting = facts.main;
    text("Of " + escaped(setting.text()) + ", every method at its base setting.");
    out << "<div class=\"scroll\"><table>\n";
    const StudyFacts::Ratio ratio = facts.forwardRatio(setting);
    if (std::isfinite(ratio.value)) {
      std::string what = "is forward's time over core_tail's";
      what += ratio.paired ? ", from alternating frames" : ", of medians measured apart";
      if (std::isfinite(ratio.spread)) what += "; between batches it spreads by " + percent(ratio.spread);
      headline(readableNumber(ratio.value), what);
    }
    for (const char* method : {"core_tail", "core_only", "all_low", "forward", "exact"}) {
      const StudyRow* row = facts.baseRow(setting, method);
      if (!row || !std::isfinite(row->rmse_exact)) continue;
      std::string what = std::string("is the RMSE of ") + method + (std::isnan(row->k) || !std::string_view(method).starts_with("core_") ? "" : " at k " + compact(row->k)) +
                         " against exact order";
      if (std::isfinite(row->rmse_forward)) what += ", " + known(row->rmse_forward) + " against the paper's forward image";
      if (std::isfinite(row->p999_exact)) what += "; 99.9 % of the pixels are within " + known(row->p999_exact);
      if (std::isfinite(row->perceptual)) what += "; FLIP " + known(row->perceptual, 2);
      headline(known(row->rmse_exact), what);
    }
    std::string noise;
    double most = 0.0;
    for (const std::string& method : facts.methods) {
      const StudyRow* row = facts.baseRow(setting, method);
      if (!row || !std::isfinite(row->order_noise)) continue;
      most = std::max(most, row->order_noise);
      noise += (noise.empty() ? "" : ", ") + escaped(method, 60) + " " + known(row->order_noise, 2);
    }
    if (!noise.empty()) {
      headline(known(most, 2), "is the largest RMSE between frames whose strands were submitted in another order (" + noise + ")");
    }
    for (const char* method : {"core_tail", "forward"}) {
      const StudyRow* row = facts.baseRow(setting, method);
      if (!row || !(row->limit_us > 0.0) || !(row->ms_total > 0.0)) continue;
      headline(readableNumber(1e3 * row->ms_total / row->limit_us, 2),
               std::string("is ") + method + "'s measured time over its limit: " + readableNumber(row->ms_total) + " ms over " +
                   readableNumber(row->limit_us) + " &#181;s for the bytes and operations that it cannot do without");
    }
    out << "</table></div>\n";
  }

  void errorPlots() {
    text("To the left is faster, below is closer. A line goes over k, the number of fragments shaded in full, or dashed over another dial; "
         "the points carry its values. Grey, with rings, is the Pareto front: nothing measured beats these in both.");
    size_t others = 0;
    bool first = true, any = false;
    for (const Plot& plot : input.plots.drawn) {
      if (plot.section != "error") continue;
      any = true;
      if (first) figure(plot);
      else ++others;
      first = false;
    }
    if (!any) text(plotsMissing("No row has both a time and this error."));
    if (others == 0) return;
    out << "<details><summary>" << others << (others == 1 ? " more setting" : " more settings") << "</summary>\n";
    first = true;
    for (const Plot& plot : input.plots.drawn) {
      if (plot.section != "error") continue;
      if (!first) figure(plot);
      first = false;
    }
    out << "</details>\n";
  }

  void layersLegend() {
    constexpr int width = 480, left = 10;
    const auto place = [](double n) { return left + (width - 40) * std::log(n) / std::log(100.0); };
    out << "<svg class=\"legend\" role=\"img\" aria-label=\"colours of 1 to 100 fragments\" width=\"" << width << "\" height=\"40\" viewBox=\"0 0 "
        << width << " 40\">";
    for (int i = 0; i < width - 40; i += 4) {
      const double n = std::pow(100.0, (i + 2.0) / (width - 40));
      out << "<rect x=\"" << left + i << "\" y=\"2\" width=\"4.5\" height=\"14\" fill=\"" << layersColor(n).css() << "\" />";
    }
    for (const int n : {1, 2, 4, 8, 16, 30, 50, 100}) {
      out << "<text x=\"" << readableNumber(place(n), 4) << "\" y=\"34\" font-size=\"13\" text-anchor=\"middle\" fill=\"currentColor\">" << n
          << (n == 100 ? "+" : "") << "</text>";
    }
    out << "</svg>\n";
  }

  void differenceLegend(double scale) {
    constexpr int width = 480, left = 10;
    out << "<svg class=\"legend\" role=\"img\" aria-label=\"colours of differences\" width=\"" << width << "\" height=\"40\" viewBox=\"0 0 " << width
        << " 40\">";
    for (int i = 0; i < width - 40; i += 4) {
      out << "<rect x=\"" << left + i << "\" y=\"2\" width=\"4.5\" height=\"14\" fill=\"" << differenceColor((i + 2.0) / (width - 40)).css() << "\" />";
    }
    for (int i = 0; i <= 4; ++i) {
      out << "<text x=\"" << left + i * (width - 40) / 4 << "\" y=\"34\" font-size=\"13\" text-anchor=\"middle\" fill=\"currentColor\">"
          << compact(std::round(2550.0 / scale * i / 4) / 10.0) << (i == 4 ? "+" : "") << "</text>";
    }
    out << "</svg>\n";
  }

  void load() {
    section("load", input.with_pictures ? "No picture of fragments was there." : "Pictures were not asked for.");
    if (input.pictures.layers.empty()) return;
    out << "<figure><div class=\"views\">\n";
    std::string most;
    for (const LayersPicture& picture : input.pictures.layers) {
      out << "<figure>" << image(picture.path, "fragments of each pixel of the view " + picture.view) << "<span class=\"faint\">"
          << escaped(picture.view, 60) << ", " << picture.width << " x " << picture.height << " pixels of the frame</span></figure>\n";
      most += (most.empty() ? "" : ", ") + std::to_string(picture.most) + " at " + picture.view;
    }
    out << "</div>\n";
    layersLegend();
    out << "<figcaption><b>Fragments of each pixel.</b> Grey is 1, blue 8, green 50, red 100 and more, as in the paper's Figure 2a; where there is no "
           "hair there is no colour. The most of a pixel are " << escaped(most) << ".</figcaption></figure>\n";
  }

  std::string numbersOf(const MethodPicture& picture) const {
    const bool has_row = picture.row && std::isfinite(picture.row->rmse_exact);
    std::string words = "RMSE " + known(has_row ? picture.row->rmse_exact : picture.rmse) + ", 99.9 % of the pixels within " +
                        known(picture.row && std::isfinite(picture.row->p999_exact) ? picture.row->p999_exact : picture.p999);
    if (picture.row && std::isfinite(picture.row->perceptual)) words += ", FLIP " + known(picture.row->perceptual, 2);
    if (picture.off_scale > 0.0005) words += "; " + percent(picture.off_scale) + " of the hair pixels are off the scale";
    return words + ".";
  }

  void detail(const MethodPicture& picture) {
    out << image(picture.detail, picture.method + ", reference and difference, magnified", "pixels") << "\n";
  }

  void differencePictures() {
    if (!input.with_pictures) return text("Pictures were not asked for (--no-images).");
    if (!input.pictures.missing.empty()) {
      std::string names;
      for (size_t i = 0; i < std::min<size_t>(input.pictures.missing.size(), 60); ++i) {
        names += (i == 0 ? "<code>" : ", <code>") + escaped(input.pictures.missing[i], 140) + "</code>";
      }
      if (input.pictures.missing.size() > 60) names += " and " + std::to_string(input.pictures.missing.size() - 60) + " more";
      text("Missing, and so left out: " + names + ".");
    }
    if (input.pictures.groups.empty()) return text("There is no method's picture with its reference.");
    text("Hair over black, as the errors are measured. A difference is the root of the sum of the three channels' squared differences from R_exact; "
         "the framed square, the worst of each method, is shown below at four times its size: the method, R_exact, the difference.");
    bool first = true;
    for (const PictureGroup& group : input.pictures.groups) {
      if (!first) {
        out << "<details><summary>" << escaped(group.setting.text()) << ": the worst squares</summary>\n";
      } else {
        out << "<h3>" << escaped(group.setting.text()) << "</h3>\n";
      }
      std::vector<const MethodPicture*> methods;
      for (const MethodPicture& picture : group.methods) methods.push_back(&picture);
      std::stable_sort(methods.begin(), methods.end(), [](const MethodPicture* a, const MethodPicture* b) { return a->rmse < b->rmse; });
      out << "<figure>";
      if (first) {
        out << "<div class=\"pair\"><div><span>R_exact</span>" << image(group.exact, "the reference in exact order") << "</div>\n";
        if (!group.forward.empty()) {
          out << "<div><span>R_forward</span>" << image(group.forward, "the paper's reference") << "</div>";
        }
        out << "</div>\n";
      }
      differenceLegend(group.scale);
      out << "<figcaption>Differences times " << compact(group.scale) << ", the same for all methods: black is none, white is "
          << compact(255.0 / group.scale) << " of 255 and more.</figcaption></figure>\n";
      for (const MethodPicture* picture : methods) {
        out << "<figure>";
        if (first) {
          out << "<div class=\"pair\"><div><span>" << escaped(picture->method, 60) << "</span>" << image(picture->image, picture->method)
              << "</div>\n<div><span>difference from R_exact, times " << compact(group.scale) << "</span>"
              << image(picture->difference, "difference of " + picture->method) << "</div></div>\n<div style=\"margin-top: 0.6rem\">";
          if (!picture->detail.empty()) detail(*picture);
          out << "</div>";
        } else if (!picture->detail.empty()) {
          detail(*picture);
        }
        out << "<figcaption><b>" << escaped(picture->method, 60) << ".</b> " << numbersOf(*picture);
        if (picture->detail.empty()) {
          out << " This picture is R_exact's, bit for bit after clamping.";
        } else {
          out << " The worst square lies " << picture->detail_x << " pixels from the left and " << picture->detail_y << " from the top.";
        }
        out << "</figcaption></figure>\n";
      }
      if (!first) out << "</details>\n";
      first = false;
    }
  }

  void paper() {
    text("The asset was made to have the load of the paper (Hillesland, Bilodeau and Thibieroz 2014, Radeon HD 7970): its views, pixels and fragments, but "
         "not its model, material and opacity, which are not known. Its errors are against forward.");
    out << "<div class=\"scroll\"><table>\n<tr>" << cell("", false, "th") << cell("the paper", true, "th") << cell("here", true, "th") << "</tr>\n";
    const auto line = [&](const std::string& what, const std::string& theirs, const std::string& ours) {
      out << "<tr>" << cell(what) << cell(theirs, true) << cell(ours, true) << "</tr>\n";
    };
    constexpr struct { const char* view; const char* pixels; const char* overdraw; } views[] = {
        {"35k", "35,000", "30"}, {"78k", "78,000", "-"}, {"198k", "198,000", "about 20"}, {"365k", "365,000", "18"}};
    double most = 0.0;
    std::string most_view;
    for (const auto& [name, pixels, overdraw] : views) {
      for (const StudyView& view : facts.views) {
        if (view.name != name) continue;
        line(std::string(name) + ": hair pixels", pixels, readableCount(view.hair_pixels));
        line(std::string(name) + ": mean fragments of a hair pixel", overdraw, known(view.mean_overdraw));
        const double ratio = facts.forwardRatio({view.name, facts.main.capture, facts.main.hair_colour}).value;
        if (ratio > most) most = ratio, most_view = name;
      }
    }
    const Setting setting{"198k", facts.main.capture, facts.main.hair_colour};
    const auto row = [&](const char* method) { return facts.baseRow(setting, method); };
    const auto errorAgainstForward = [&](const char* method) { return row(method) ? known(row(method)->rmse_forward) : std::string("-"); };
    line("RMSE of core_tail at k 8 (198k)", "9", errorAgainstForward("core_tail"));
    line("RMSE of core_only at k 8 (198k)", "26", errorAgainstForward("core_only"));
    line("RMSE of all_low (198k)", "90", errorAgainstForward("all_low"));
    line("forward's time over core_tail's, the best view", "1.75", most > 0.0 ? readableNumber(most) + " (" + most_view + ")" : "-");
    const auto time = [&](double k) {
      for (const Series& series : facts.errorSeries(setting)) {
        if (series.method != "core_tail") continue;
        for (const StudyRow* at : series.rows) {
          if (at->k == k && (!series.dial || std::string_view(series.dial->column) == "k")) return known(at->ms_total) + " ms";
        }
      }
      return std::string("-");
    };
    line("core_tail at k 8 (198k)", "2.8 ms", time(8.0));
    line("core_tail at k 0 (198k)", "2.6 ms", time(0.0));
    out << "</table></div>\n";
  }

  void doubtful() {
    // One line for what happened to many rows alike.
    std::vector<std::pair<std::string, std::vector<const StudyRow*>>> groups;
    for (const StudyRow* row : facts.doubtfulRows()) {
      const std::string key = methodOf(*row) + (row->capture.empty() ? "" : ", " + row->capture) + ": " + whyDoubtful(*row);
      const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == key; });
      if (found == groups.end()) {
        groups.push_back({key, {row}});
      } else {
        found->second.push_back(row);
      }
    }
    if (groups.empty()) {
      return text("None: every row says ok, is the same bits from frame to frame in every order, as far as it was asked, and its time ratio moves by less "
                  "than 20 % between batches.");
    }
    text("These are hollow in the plots and no part of a front. A row is doubtful if it failed, if its image is not the same bits over repeated frames and "
         "permuted orders of submission, or if its time ratio spreads by more than 20 % between batches.");
    out << "<ul>\n";
    for (size_t i = 0; i < std::min<size_t>(groups.size(), 200); ++i) {
      const auto& [key, rows] = groups[i];
      out << "<li>" << escaped(key, 500) << " <span class=\"faint\">(" << (rows.size() == 1 ? "line " : std::to_string(rows.size()) + " rows: lines ");
      for (size_t j = 0; j < std::min<size_t>(rows.size(), 12); ++j) {
        out << (j == 0 ? "" : ", ") << rows[j]->line;
      }
      out << (rows.size() > 12 ? " and so on" : "") << (rows.size() == 1 ? ", " + escaped(rows[0]->view, 40) : std::string()) << ")</span></li>\n";
    }
    out << "</ul>\n";
    if (groups.size() > 200) text("And " + std::to_string(groups.size() - 200) + " more kinds.");
  }

  void allRows() {
    constexpr size_t kMaxRows = 3000;
    std::vector<const StudyColumn*> shown;
    std::string same, unknown;
    const std::vector<const StudyRow*>& rows = facts.liveRows();
    for (const StudyColumn& column : studyColumns()) {
      const std::string first = cellText(*rows.front(), column);
      const bool varies = std::any_of(rows.begin(), rows.end(), [&](const StudyRow* row) { return cellText(*row, column) != first; });
      if (varies || rows.size() == 1) {
        shown.push_back(&column);
      } else if (first.empty()) {
        unknown += (unknown.empty() ? "" : ", ") + std::string(column.name);
      } else {
        same += (same.empty() ? "" : "; ") + std::string(column.name) + " " + escaped(first, 100);
      }
    }
    if (!same.empty()) text("The same in every row: " + same + ".");
    if (!unknown.empty()) text("Unknown in every row: " + unknown + ".");
    text("Columns are those of <code>study.csv</code>, <code>line</code> is its line there; an empty cell is unknown or has no meaning for the method. "
         "Rows in grey italics are doubtful.");
    out << "<div class=\"scroll rows\"><table>\n<thead><tr>" << cell("line", true, "th");
    for (const StudyColumn* column : shown) {
      std::string name;
      for (const char* c = column->name; *c; ++c) name += *c == '_' ? std::string("_<wbr />") : std::string(1, *c);
      out << cell(name, column->number != nullptr, "th");
    }
    out << "</tr></thead>\n<tbody>\n";
    for (size_t i = 0; i < std::min(rows.size(), kMaxRows); ++i) {
      out << (whyDoubtful(*rows[i]).empty() ? "<tr>" : "<tr class=\"doubtful\">") << cell(std::to_string(rows[i]->line), true);
      for (const StudyColumn* column : shown) {
        std::string value = column->text ? escaped(cellText(*rows[i], *column), 80) : "";
        if (column->number && std::isfinite(rows[i]->*column->number)) {
          const double number = rows[i]->*column->number;
          value = number == std::floor(number) ? readableCount(number) : readableNumber(number, 4);
        }
        out << cell(value, column->number != nullptr);
      }
      out << "</tr>\n";
    }
    out << "</tbody></table></div>\n";
    if (rows.size() > kMaxRows) text("The first " + std::to_string(kMaxRows) + " of " + std::to_string(rows.size()) + " rows; the others are in study.csv.");
  }

  void again() {
    if (!facts.table.device.command.empty()) text("The study: <code>" + escaped(facts.table.device.command, 2000) + "</code>");
    text("This report: <code>" + escaped(input.command, 2000) + "</code>");
    text("Every plot has its data and its gnuplot script in the folder <code>report</code> beside this page; <code>cd report; gnuplot NAME.gp</code> draws it "
         "again. Views are drawn by <code>forelock preview --scene scene-VIEW.json</code> in the study's folder.");
  }

  const PageInput& input;
  const StudyFacts& facts;
  std::ostringstream out;
  std::string links;
};

}  // namespace

std::string escapeHtml(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      case '\'': safe += "&#39;"; break;
      default: safe += c;
    }
  }
  return safe;
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j) group = (group << 8) | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (size_t j = 0; j < 4; ++j) text += j <= bytes.size() - i ? digits[(group >> (18 - 6 * j)) & 63u] : '=';
  }
  return text;
}

std::string makePage(const PageInput& input) { return Page(input).make(); }

}  // namespace forelock::samples
