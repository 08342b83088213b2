// SPDX-License-Identifier: MIT
#include "report_plots.h"

#include "gnuplot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace forelock::samples {

namespace {

constexpr const char* kInk = "#333333";

std::string number(double value) {
  if (!std::isfinite(value)) return "NaN";
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

// Ends of an axis, its tics, and where a value lies between them.
struct Axis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::vector<double> tics;

  double place(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  }
  std::string range() const { return "[" + number(low) + ":" + number(high) + "]"; }
  std::string ticList() const {
    std::string list;
    for (const double tic : tics) list += (list.empty() ? "'" : ", '") + ticText(tic) + "' " + number(tic);
    return "(" + list + ")";
  }
  static std::string ticText(double tic) {
    if (tic >= 1e4) return readableCount(tic);
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", std::fabs(tic) < 1e-12 ? 0.0 : tic);
    return text;
  }
};

Axis logAxis(double least, double most, double room) {
  Axis axis;
  axis.logarithmic = true;
  axis.low = least / room;
  axis.high = most * room;
  const double decades = std::log10(axis.high / axis.low);
  std::vector<double> steps = {1};
  if (decades < 3.0) steps = {1, 2, 5};
  if (decades < 0.9) steps = {1, 1.5, 2, 3, 4, 5, 6, 8};
  for (int power = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, power) <= axis.high; ++power) {
    for (const double step : steps) {
      const double tic = step * std::pow(10.0, power);
      if (tic >= axis.low && tic <= axis.high) axis.tics.push_back(tic);
    }
  }
  return axis;
}

Axis linearAxis(double most) {
  Axis axis;
  axis.high = most > 0.0 ? 1.08 * most : 1.0;
  const double raw = axis.high / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = raw / power < 1.5 ? power : raw / power < 3.5 ? 2.0 * power : raw / power < 7.5 ? 5.0 * power : 10.0 * power;
  for (double tic = 0.0; tic <= axis.high; tic += step) axis.tics.push_back(tic);
  return axis;
}

// Logarithmic where the values would otherwise crowd at the bottom.
Axis valueAxis(const std::vector<double>& values) {
  double least = HUGE_VAL, most = 0.0;
  bool has_zero = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    has_zero = has_zero || value <= 0.0;
    if (value > 0.0) least = std::min(least, value);
    most = std::max(most, value);
  }
  return !has_zero && most > 8.0 * least ? logAxis(least, most, 1.35) : linearAxis(most);
}

struct Rect {
  double x0, y0, x1, y1;
  double overlap(const Rect& other) const {
    const double w = std::min(x1, other.x1) - std::max(x0, other.x0), h = std::min(y1, other.y1) - std::max(y0, other.y0);
    return w > 0.0 && h > 0.0 ? w * h : 0.0;
  }
};

// Puts texts beside points where they cover neither each other nor what is drawn. In pixels, y upwards.
class Labels {
 public:
  Labels(double width, double height, const Rect& inside) : width_(width), height_(height), inside_(inside) {}
  void keepClear(const Rect& rect, double weight = 1.0) { taken_.push_back({rect, weight}); }

  void place(std::ostream& script, double x, double y, const std::string& text, const std::string& color) {
    const double w = 0.56 * kLabelPx * static_cast<double>(text.size()), h = 1.1 * kLabelPx, away = 10.0;
    const struct { double dx, dy; } candidates[] = {{1, 0}, {0, 1}, {0, -1}, {-1, 0}, {0.8, 0.8}, {0.8, -0.8}, {-0.8, 0.8},
                                                    {-0.8, -0.8}, {0, 2.2}, {0, -2.2}, {2.2, 1.4}, {2.2, -1.4}, {-2.2, 1.4},
                                                    {-2.2, -1.4}};
    Rect best{};
    double least = HUGE_VAL, penalty = 0.0;
    for (const auto& candidate : candidates) {
      const double cx = x + candidate.dx * (away + 0.5 * (candidate.dx == 0.0 ? 0.0 : w) / std::max(std::fabs(candidate.dx), 1.0)),
                   cy = y + candidate.dy * (away + 0.3 * h);
      const Rect rect{cx - 0.5 * w, cy - 0.5 * h, cx + 0.5 * w, cy + 0.5 * h};
      double cost = penalty;
      penalty += 4.0;
      for (const Taken& taken : taken_) cost += taken.weight * rect.overlap(taken.rect);
      const double area = w * h;
      cost += 10.0 * (area - rect.overlap(inside_));
      if (cost < least) least = cost, best = rect;
    }
    taken_.push_back({best, 2.0});
    script << "  set label " << gnuplotText(text) << " at screen " << number((best.x0 + best.x1) / 2.0 / width_) << ","
           << number((best.y0 + best.y1) / 2.0 / height_) << " center font ',13' tc rgb '" << color << "' front\n";
  }

 private:
  static constexpr double kLabelPx = 13.0;
  struct Taken {
    Rect rect;
    double weight;
  };
  double width_, height_;
  Rect inside_;
  std::vector<Taken> taken_;
};

std::string darker(const std::string& color, double share) {
  char text[8];
  unsigned value = 0;
  std::sscanf(color.c_str(), "#%6x", &value);
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(share * ((value >> 16) & 255u)) & 255u,
                static_cast<unsigned>(share * ((value >> 8) & 255u)) & 255u, static_cast<unsigned>(share * (value & 255u)) & 255u);
  return text;
}

class Drawing {
 public:
  Drawing(const StudyFacts& study, const std::string& folder, const std::function<void(uint64_t, uint64_t)>& progress)
      : facts(study), folder_(std::filesystem::path(folder) / "report"), progress_(progress) {}

  const StudyFacts& facts;
  Plots plots;
  uint64_t expected = 1;

  // `body` draws; sizes are in pixels. `target` is where pictures go, from the folder of scripts.
  void draw(const std::string& stem, const std::string& target, double width, double height, const std::string& body,
            const std::string& data, Plot plot) {
    std::ostringstream script;
    script << "# gnuplot " << stem << ".gp      draws " << target << stem << ".svg and .png again, in this folder\n"
           << "do for [kind in 'svg png'] {\n"
           << "  if (kind eq 'svg') {\n    set terminal svg noenhanced size " << width << "," << height
           << " font 'DejaVu Sans,Verdana,sans-serif,15' background rgb 'white'\n    dot = 0.8\n  } else {\n"
           // Font sizes are pixels to the one and points of 96 to 72 pixels to the other.
           << "    set terminal pngcairo noenhanced size " << 2 * width << "," << 2 * height
           << " font 'DejaVu Sans,15' fontscale 1.5 linewidth 2 pointscale 2 background rgb 'white'\n    dot = 1.15\n  }\n"
           << "  set output '" << target << stem << ".'.kind\n"
           << "  set encoding utf8\n  set border 3 lc rgb '#777777'\n  set tics nomirror out scale 0.6 textcolor rgb '" << kInk
           << "'\n  set grid back lc rgb '#e4e4e4' lw 1 lt 1\n  set errorbars small\n  set style fill solid 1.0 noborder\n"
           << body << "  unset output\n}\n";
    write(stem + ".dat", data);
    write(stem + ".gp", script.str());
    if (!plots.no_gnuplot) {
      std::string complaint;
      switch (runGnuplot(folder_.string(), stem + ".gp", complaint)) {
        case GnuplotResult::done:
          plot.path = target.empty() ? "report/" + stem + ".svg" : stem + ".svg";
          plots.drawn.push_back(std::move(plot));
          break;
        case GnuplotResult::not_found: plots.no_gnuplot = true; break;
        case GnuplotResult::failed: plots.problems.push_back("gnuplot could not draw " + stem + ".gp: " + complaint); break;
      }
    }
    ++drawn_;
    progress_(drawn_, std::max(expected, drawn_));
  }

  std::string stem(const std::string& name) { return fileStem(name, stems_); }

 private:
  void write(const std::string& name, const std::string& text) {
    std::ofstream file(folder_ / name, std::ios::binary);
    file << text;
    if (!file.flush()) throw StudyError((folder_ / name).string() + ": cannot be written (disk full?)");
  }

  std::filesystem::path folder_;
  std::function<void(uint64_t, uint64_t)> progress_;
  std::set<std::string> stems_;
  uint64_t drawn_ = 0;
};

std::string errorLabel(const StudyColumn& column) {
  const std::string name = column.name;
  if (name == "rmse_exact") return "error against exact order, RMSE (0 to 442)";
  if (name == "rmse_forward") return "error against the paper's forward image, RMSE (0 to 442)";
  if (name == "rmse_exact_channel") return "error of the worst channel, RMSE (0 to 255)";
  if (name == "rmse_cover") return "error of coverage, RMSE (0 to 255)";
  if (name == "p999_exact") return "99.9th percentile of the error (0 to 442)";
  if (name == "perceptual") return "mean FLIP error (0 to 1)";
  if (name == "temporal_drift") return "error of change between frames (0 to 255)";
  return name;
}

// Error against time --------------------------------------------------------------------------------------------------------

std::string pointMark(const Series& series, const StudyRow& row) {
  return series.dial ? series.dial->mark + cellText(row, *findStudyColumn(series.dial->column)) : series.method;
}

std::string frontText(const StudyFacts& facts, const std::vector<std::pair<const Series*, const StudyRow*>>& front) {
  if (front.empty()) return "";
  std::string text = "No point that counts is both faster and closer than ";
  for (size_t i = 0; i < front.size(); ++i) {
    const auto& [series, row] = front[i];
    if (i > 0) text += i + 1 == front.size() ? " and " : ", ";
    text += series->method + (series->dial ? " at " + pointMark(*series, *row) : "") + " (" + readableNumber(facts.timeOf(*row)) +
            " ms, " + readableNumber(facts.errorOf(*row)) + ")";
    if (i == 5 && front.size() > 7) {
      text += " and " + std::to_string(front.size() - 6) + " more";
      break;
    }
  }
  return text + ". ";
}

// The sentence that the figure is there for.
std::string coreTailText(const StudyFacts& facts, const Setting& setting) {
  const StudyRow *core_tail = facts.baseRow(setting, "core_tail"), *forward = facts.baseRow(setting, "forward");
  if (!core_tail || !forward || !facts.isPlotted(*core_tail) || !facts.isPlotted(*forward)) return "";
  return "core_tail" + (std::isnan(core_tail->k) ? "" : " at k " + cellText(*core_tail, *findStudyColumn("k"))) + " takes " +
         readableNumber(1.0 / facts.forwardRatio(setting).value, 2) + " of forward's time at an error of " +
         readableNumber(facts.errorOf(*core_tail)) + "; forward's own is " + readableNumber(facts.errorOf(*forward)) + ". ";
}

void drawErrorAgainstTime(Drawing& drawing, const Setting& setting, bool is_main) {
  const StudyFacts& facts = drawing.facts;
  const std::vector<Series> all = facts.errorSeries(setting);
  const auto scaled = [&](const StudyRow& row, double ms) { return ms * facts.timeOf(row) / row.ms_total; };
  std::vector<PlanePoint> points;
  std::vector<std::pair<const Series*, const StudyRow*>> of_point;
  double least_ms = HUGE_VAL, most_ms = 0.0;
  std::vector<double> errors;
  size_t hollow = 0;
  std::set<const StudyRow*> known;
  for (const Series& series : all) {
    for (const StudyRow* row : series.rows) {
      for (const double ms : {facts.timeOf(*row), scaled(*row, row->ms_p5), scaled(*row, row->ms_p95)}) {
        if (ms > 0.0) least_ms = std::min(least_ms, ms), most_ms = std::max(most_ms, ms);
      }
      errors.push_back(facts.errorOf(*row));
      const bool first = known.insert(row).second;
      if (!whyDoubtful(*row).empty()) {
        hollow += first ? 1 : 0;
      } else if (first) {
        points.push_back({facts.timeOf(*row), facts.errorOf(*row)});
        of_point.emplace_back(&series, row);
      }
    }
  }
  if (errors.empty()) return;
  constexpr double width = 1000.0, height = 640.0;
  const Rect area{0.085 * width, 0.115 * height, 0.77 * width, 0.975 * height};  // beside it the longest name of a method
  const Axis x = logAxis(least_ms, most_ms, 1.22), y = valueAxis(errors);
  const auto toX = [&](double ms) { return area.x0 + x.place(ms) * (area.x1 - area.x0); };
  const auto toY = [&](double error) { return area.y0 + y.place(error) * (area.y1 - area.y0); };

  std::ostringstream body, data;
  data << "# " << errorLabel(*facts.error) << ", " << facts.error->name << ", against time: one block a line of the plot, the front last\n";
  body << "  set lmargin at screen " << number(area.x0 / width) << "\n  set rmargin at screen " << number(area.x1 / width)
       << "\n  set bmargin at screen " << number(area.y0 / height) << "\n  set tmargin at screen " << number(area.y1 / height)
       << "\n  set logscale x\n" << (y.logarithmic ? "  set logscale y\n" : "") << "  set xrange " << x.range() << "\n  set yrange "
       << y.range() << "\n  set xtics " << x.ticList() << "\n  set ytics " << y.ticList()
       << "\n  set xlabel 'time of a frame (ms): ratio to core_tail in pairs, bars from the 5th to the 95th percentile'\n  set ylabel "
       << gnuplotText(errorLabel(*facts.error)) << " offset 1,0\n"
       << "  set key at screen 0.785,0.965 left top Left reverse samplen 2.2 spacing 1.35 textcolor rgb '" << kInk << "'\n"
       << "  unset label\n";

  Labels labels(width, height, area);
  for (const Series& series : all) {
    for (size_t i = 0; i < series.rows.size(); ++i) {
      const double px = toX(facts.timeOf(*series.rows[i])), py = toY(facts.errorOf(*series.rows[i]));
      labels.keepClear({px - 7, py - 7, px + 7, py + 7}, 2.0);
      if (series.rows[i]->ms_p95 > 0.0 && series.rows[i]->ms_p5 > 0.0) {
        labels.keepClear({toX(scaled(*series.rows[i], series.rows[i]->ms_p5)), py - 2, toX(scaled(*series.rows[i], series.rows[i]->ms_p95)), py + 2});
      }
      if (i == 0) continue;
      const double qx = toX(facts.timeOf(*series.rows[i - 1])), qy = toY(facts.errorOf(*series.rows[i - 1]));
      const int steps = static_cast<int>(std::hypot(px - qx, py - qy) / 6.0);
      for (int s = 1; s < steps; ++s) {
        const double t = static_cast<double>(s) / steps, sx = qx + t * (px - qx), sy = qy + t * (py - qy);
        labels.keepClear({sx - 3, sy - 3, sx + 3, sy + 3});
      }
    }
  }
  known.clear();
  size_t marks = 0;
  for (const Series& series : all) {
    const std::string color = darker(methodStyle(facts, series.method).color, 0.8);
    for (const StudyRow* row : series.rows) {
      if (!known.insert(row).second || ++marks > 400) continue;
      labels.place(body, toX(facts.timeOf(*row)), toY(facts.errorOf(*row)), pointMark(series, *row), color);
    }
  }

  const std::string file = is_main ? "error-vs-time" : drawing.stem("error-vs-time-" + setting.view + "-" + setting.capture +
                                                                    "-" + setting.hair_colour);
  const std::string path = gnuplotText(file + ".dat");
  const std::vector<size_t> front = paretoFront(points);
  std::vector<std::string> parts;
  const auto block = [&](const std::vector<const StudyRow*>& rows, const std::string& title, const Dial* dial) {
    data << "# " << gnuplotText(title) << ": ms, error, ms p5, ms p95, trusted, dial\n";
    for (const StudyRow* row : rows) {
      const std::string value = dial ? cellText(*row, *findStudyColumn(dial->column)) : "-";
      data << number(facts.timeOf(*row)) << '\t' << number(facts.errorOf(*row)) << '\t'
           << number(scaled(*row, row->ms_p5 > 0.0 ? row->ms_p5 : row->ms_total)) << '\t'
           << number(scaled(*row, row->ms_p95 > 0.0 ? row->ms_p95 : row->ms_total)) << '\t' << (whyDoubtful(*row).empty() ? 1 : 0) << '\t'
           << gnuplotText(value) << '\n';
    }
    data << "\n\n";
  };
  std::set<std::string> titled;
  std::vector<const StudyRow*> front_rows;
  std::vector<std::pair<const Series*, const StudyRow*>> on_front;
  for (const size_t i : front) front_rows.push_back(of_point[i].second), on_front.push_back(of_point[i]);
  const std::string front_index = std::to_string(all.size());
  if (!front_rows.empty()) {
    parts.push_back(path + " index " + front_index + " using 1:2 with steps lc rgb '#d2d2d2' lw 5 notitle");
    parts.push_back(path + " index " + front_index + " using 1:2 with points pt 6 ps 2.3*dot lw 1.5 lc rgb '#8c8c8c' notitle");
  }
  for (size_t i = 0; i < all.size(); ++i) {
    const Series& series = all[i];
    const MethodStyle style = methodStyle(facts, series.method);
    block(series.rows, series.method, series.dial);
    const std::string at = path + " index " + std::to_string(i), color = " lc rgb '" + style.color + "'";
    const bool dashed = series.dial && std::string_view(series.dial->column) != "k";
    if (series.rows.size() > 1) {
      parts.push_back(at + " using 1:2 with lines lw 2" + (dashed ? " dt 2" : "") + color + " notitle");
    }
    parts.push_back(at + " using ($5==1?$1:NaN):2:3:4 with xerrorbars lw 1.4 ps 1.1*dot pt " + std::to_string(style.point) + color + " notitle");
    parts.push_back(at + " using ($5==0?$1:NaN):2:3:4 with xerrorbars lw 1.4 ps 1.1*dot pt " + std::to_string(style.point - 1) + color + " notitle");
    if (titled.insert(series.method).second) {
      parts.push_back("keyentry with linespoints lw 2 ps 1.1*dot pt " + std::to_string(style.point) + color + " title " + gnuplotText(series.method));
    }
  }
  block(front_rows, "front", nullptr);
  if (!front_rows.empty()) {
    parts.push_back("keyentry with linespoints lw 5 pt 6 ps 2.3*dot lc rgb '#c2c2c2' title 'Pareto front'");
  }
  if (hollow > 0) {
    parts.push_back("keyentry with points pt 6 ps 1.1*dot lw 1.4 lc rgb '#555555' title 'hollow: doubtful'");
  }
  body << "  plot ";
  for (size_t i = 0; i < parts.size(); ++i) body << (i == 0 ? "" : ", \\\n    ") << parts[i];
  body << '\n';

  Plot plot;
  plot.section = "error";
  plot.title = "Error against time: " + setting.text();
  plot.caption = coreTailText(facts, setting) + frontText(facts, on_front) + "Lower left is better.";
  if (hollow > 0) {
    plot.caption += " " + std::to_string(hollow) + (hollow == 1 ? " point is" : " points are") +
                    " hollow and off the front, for reasons listed under doubtful rows.";
  }
  drawing.draw(file, is_main ? "../" : "", width, height, body.str(), data.str(), std::move(plot));
}

constexpr const char* kApart =
    "The number beside a bar is the frame's time; its passes are timed in other frames, and may overlap where nothing times them.";

// Time of the passes --------------------------------------------------------------------------------------------------------

struct PassColumn {
  const char* name;
  double StudyRow::*ms;
  const char* color;
};
// Greys and violets, which no method has; from light to dark also without colour.
constexpr PassColumn kPasses[] = {{"prepare", &StudyRow::ms_prepare, "#cfcfcf"},
                                  {"shadow", &StudyRow::ms_shadow, "#8a8a8a"},
                                  {"shade", &StudyRow::ms_shade, "#dadaeb"},
                                  {"capture", &StudyRow::ms_capture, "#9e9ac8"},
                                  {"resolve", &StudyRow::ms_resolve, "#54278f"}};

struct PassBar {
  std::string group, name, note;
  const StudyRow* row;
};

void drawBars(Drawing& drawing, const std::string& stem, const std::vector<PassBar>& bars, Plot plot) {
  constexpr double width = 1000.0, bar_px = 26.0, gap_px = 16.0;
  double most = 0.0, at = 0.0;
  std::vector<double> places;
  for (size_t i = 0; i < bars.size(); ++i) {
    if (i > 0 && bars[i].group != bars[i - 1].group) at += gap_px;
    places.push_back(at + 0.5 * bar_px);
    at += bar_px;
    double sum = 0.0;
    for (const PassColumn& pass : kPasses) sum += std::isnan(bars[i].row->*pass.ms) ? 0.0 : bars[i].row->*pass.ms;
    most = std::max({most, sum, std::isnan(bars[i].row->ms_total) ? 0.0 : bars[i].row->ms_total});
  }
  const double height = at + 110.0;
  std::ostringstream body, data;
  Axis x = linearAxis(most);
  size_t longest = 0;
  for (const PassBar& bar : bars) longest = std::max(longest, bar.note.size());
  x.high = (longest > 12 ? 1.38 : 1.12) * most;  // room for what is said at the ends
  const double left = plot.section == "passes" && !bars.front().group.empty() ? 225.0 : 170.0;
  body << "  set lmargin at screen " << number(left / width) << "\n  set rmargin at screen 0.985\n  set bmargin at screen "
       << number(58.0 / height) << "\n  set tmargin at screen " << number(1.0 - 42.0 / height) << "\n  set xrange " << x.range()
       << "\n  set yrange [" << number(at + 4.0) << ":-4]\n  unset ytics\n  set border 1\n  set grid noy\n  set xtics " << x.ticList()
       << "\n  set xlabel 'GPU time (ms), medians of the passes'\n  set key at screen " << number(left / width) << "," << number(1.0 - 8.0 / height)
       << " left top horizontal Left reverse samplen 1.2 width 1 textcolor rgb '" << kInk << "'\n  unset label\n";
  std::map<std::string, std::pair<double, double>> groups;
  for (size_t i = 0; i < bars.size(); ++i) {
    const double screen = (58.0 + (at + 4.0 - places[i]) / (at + 8.0) * (height - 100.0)) / height;
    body << "  set label " << gnuplotText(bars[i].name) << " at screen " << number((left - 10.0) / width) << "," << number(screen)
         << " right font ',14' tc rgb '" << darker(methodStyle(drawing.facts, bars[i].name).color, 0.8) << "'\n";
    double sum = 0.0;
    for (const PassColumn& pass : kPasses) sum += std::isnan(bars[i].row->*pass.ms) ? 0.0 : bars[i].row->*pass.ms;
    body << "  set label " << gnuplotText(bars[i].note) << " at first " << number(sum + 0.012 * x.high) << "," << number(places[i])
         << " left font ',13' tc rgb '" << kInk << "'\n";
    auto& span = groups.try_emplace(bars[i].group, screen, screen).first->second;
    span = {std::min(span.first, screen), std::max(span.second, screen)};
  }
  for (const auto& [group, span] : groups) {
    if (group.empty()) continue;
    body << "  set label " << gnuplotText(group) << " at screen 0.012," << number((span.first + span.second) / 2.0)
         << " left font ',16' tc rgb '" << kInk << "'\n";
  }
  data << "# a block a pass: middle (ms), place, left, right, lower, upper\n";
  std::vector<std::string> parts;
  std::vector<double> sums(bars.size(), 0.0);
  for (const PassColumn& pass : kPasses) {
    std::ostringstream block;
    bool any = false;
    for (size_t i = 0; i < bars.size(); ++i) {
      const double ms = bars[i].row->*pass.ms;
      if (!(ms > 0.0)) continue;
      block << number(sums[i] + 0.5 * ms) << '\t' << number(places[i]) << '\t' << number(sums[i]) << '\t' << number(sums[i] + ms) << '\t'
            << number(places[i] - 10.0) << '\t' << number(places[i] + 10.0) << '\n';
      sums[i] += ms;
      any = true;
    }
    if (!any) continue;
    data << "# " << pass.name << '\n' << block.str() << "\n\n";
    parts.push_back("'" + stem + ".dat' index " + std::to_string(parts.size()) + " using 1:2:3:4:5:6 with boxxyerror fc rgb '" +
                    pass.color + "' title '" + pass.name + "'");
  }
  if (parts.empty()) return;
  body << "  plot ";
  for (size_t i = 0; i < parts.size(); ++i) body << (i == 0 ? "" : ", \\\n    ") << parts[i];
  body << '\n';
  drawing.draw(stem, "", width, height, body.str(), data.str(), std::move(plot));
}

bool hasPasses(const StudyRow& row) {
  return row.ms_total > 0.0 && std::any_of(std::begin(kPasses), std::end(kPasses), [&](const PassColumn& pass) { return row.*pass.ms > 0.0; });
}

void drawPasses(Drawing& drawing, const std::string& capture) {
  const StudyFacts& facts = drawing.facts;
  std::vector<PassBar> bars;
  std::string speeds;
  size_t views = 0;
  for (const StudyView& view : facts.views) {
    const Setting setting{view.name, capture, facts.main.hair_colour};
    if (views == 12) break;
    const size_t before = bars.size();
    const StudyFacts::Ratio ratio = facts.forwardRatio(setting);
    for (const char* method : {"forward", "core_tail", "core_only"}) {
      const StudyRow* row = facts.baseRow(setting, method);
      if (!row || !hasPasses(*row)) continue;
      std::string note = readableNumber(row->ms_total) + " ms";
      if (method == std::string_view("core_tail") && std::isfinite(ratio.value)) {
        note += ", forward takes " + readableNumber(ratio.value) + " times as long";
        speeds += (speeds.empty() ? "" : ", ") + readableNumber(ratio.value) + " at " + view.name;
      }
      bars.push_back({view.name, method, note, row});
    }
    if (bars.size() > before) ++views;
  }
  if (bars.empty()) return;
  Plot plot;
  plot.section = "passes";
  plot.title = "Time of the passes, view by view" + (capture.empty() ? "" : ": " + capture + " capture");
  plot.caption = (speeds.empty() ? "" : "Time of forward over time of core_tail is " + speeds + ". ") +
                 std::string("forward shades while it captures, the others while they resolve; core_only, without a tail's colour, is what "
                             "core_tail could reach at best (the paper's Figure 3). ") + kApart;
  drawBars(drawing, drawing.stem("passes-views-" + capture), bars, plot);
}

void drawMethods(Drawing& drawing, const std::string& capture) {
  const StudyFacts& facts = drawing.facts;
  const Setting setting{facts.main.view, capture, facts.main.hair_colour};
  std::vector<PassBar> bars;
  for (const std::string& method : facts.methods) {
    const StudyRow* row = facts.baseRow(setting, method);
    if (row && hasPasses(*row)) bars.push_back({"", method, readableNumber(row->ms_total) + " ms", row});
  }
  if (bars.size() < 2 || bars.size() > 40) return;
  Plot plot;
  plot.section = "passes";
  plot.title = "Time of the passes, method by method: " + setting.text();
  const auto [least, most] = std::minmax_element(bars.begin(), bars.end(), [](const PassBar& a, const PassBar& b) {
    return a.row->ms_total < b.row->ms_total;
  });
  plot.caption = least->name + " is the fastest with " + readableNumber(least->row->ms_total) + " ms, " + most->name + " takes " +
                 readableNumber(most->row->ms_total / least->row->ms_total, 2) + " times as long. " + kApart;
  drawBars(drawing, drawing.stem("passes-methods-" + capture), bars, plot);
}

void drawTailCost(Drawing& drawing, const std::string& capture) {
  const StudyFacts& facts = drawing.facts;
  struct Line {
    std::string method;
    std::vector<std::pair<const StudyView*, double>> points;
  };
  std::vector<Line> lines;
  double most = 0.0, least = 0.0, most_pixels = 0.0;
  std::set<const StudyView*> shown;
  for (const char* method : {"forward", "core_tail", "core_tail_list"}) {
    Line line{method, {}};
    for (const StudyView& view : facts.views) {
      const Setting setting{view.name, capture, facts.main.hair_colour};
      const StudyRow *row = facts.baseRow(setting, method), *bare = facts.baseRow(setting, "core_only");
      if (!row || !bare || !(row->ms_total > 0.0) || !(bare->ms_total > 0.0) || !(view.hair_pixels > 0.0)) continue;
      line.points.emplace_back(&view, row->ms_total - bare->ms_total);
      most = std::max(most, line.points.back().second);
      least = std::min(least, line.points.back().second);
      most_pixels = std::max(most_pixels, view.hair_pixels);
      shown.insert(&view);
    }
    if (line.points.size() > 1) lines.push_back(std::move(line));
  }
  if (lines.empty()) return;
  constexpr double width = 1000.0, height = 460.0;
  Axis y = linearAxis(most);
  y.low = least < 0.0 ? 1.3 * least : 0.0;
  std::ostringstream body, data;
  std::string tics;
  for (const StudyView* view : shown) {
    tics += (tics.empty() ? "" : ", ") + gnuplotText(view->name) + " " + number(view->hair_pixels / 1e3);
  }
  body << "  set lmargin at screen 0.085\n  set rmargin at screen 0.77\n  set bmargin at screen 0.15\n  set tmargin at screen 0.96\n"
       << "  set xrange [0:" << number(1.06e-3 * most_pixels) << "]\n  set yrange " << y.range() << "\n  set xtics (" << tics << ")\n"
       << "  set xlabel 'hair pixels, at the views'\n  set ylabel 'time over that of core_only (ms)'\n  set ytics auto\n"
       << "  set key at screen 0.785,0.94 left top Left reverse samplen 2.2 spacing 1.35 textcolor rgb '" << kInk << "'\n  unset label\n"
       << "  set xzeroaxis lc rgb '#999999' lt 1\n";
  data << "# a block a method: thousands of hair pixels, ms over core_only\n";
  const std::string stem = drawing.stem("tail-cost-" + capture);
  body << "  plot ";
  std::string ends;
  for (size_t i = 0; i < lines.size(); ++i) {
    const MethodStyle style = methodStyle(facts, lines[i].method);
    data << "# " << lines[i].method << '\n';
    for (const auto& [view, ms] : lines[i].points) data << number(view->hair_pixels / 1e3) << '\t' << number(ms) << '\n';
    data << "\n\n";
    body << (i == 0 ? "" : ", \\\n    ") << "'" << stem << ".dat' index " << i << " using 1:2 with linespoints lw 2 ps 1.2*dot pt " << style.point
         << " lc rgb '" << style.color << "' title " << gnuplotText(lines[i].method);
    const auto& [view, ms] = lines[i].points.back();
    ends += (ends.empty() ? "" : "; ") + lines[i].method + " " + readableNumber(ms) + " ms at " + view->name;
  }
  body << '\n';
  Plot plot;
  plot.section = "tail";
  plot.title = "What the tail costs" + (capture.empty() ? "" : ": " + capture + " capture");
  plot.caption = "Time beyond core_only's, which draws no tail: " + ends + " (the paper's Figure 4).";
  if (least < 0.0) plot.caption += " A negative cost means that the difference is below the noise of the times.";
  drawing.draw(stem, "", width, height, body.str(), data.str(), std::move(plot));
}

void drawHistogram(Drawing& drawing, const std::vector<Histogram>& histograms) {
  std::ostringstream body, data;
  double most_pixels = 1.0, most_layers = 1.0;
  std::string means;
  // Light to dark as the hair comes closer.
  constexpr const char* shades[] = {"#c7a500", "#5ab45a", "#26828e", "#3b4b9a", "#440154"};
  std::vector<std::string> parts;
  data << "# a block a view: fragments, pixels with as many\n";
  for (const Histogram& histogram : histograms) {
    uint64_t pixels = 0, fragments = 0;
    data << "# " << gnuplotText(histogram.view) << '\n';
    for (size_t n = 1; n < histogram.pixels.size(); ++n) {
      const uint64_t count = histogram.pixels[n];
      data << n << '\t' << (count > 0 ? std::to_string(count) : "NaN") << '\n';
      pixels += count;
      fragments += n * count;
      most_pixels = std::max(most_pixels, static_cast<double>(count));
      if (count > 0) most_layers = std::max(most_layers, static_cast<double>(n));
    }
    data << "\n\n";
    if (pixels == 0 || parts.size() == 12) continue;
    const double mean = static_cast<double>(fragments) / static_cast<double>(pixels);
    const size_t shade = histograms.size() < 2 ? 3 : parts.size() * 4 / (histograms.size() - 1);
    parts.push_back("index " + std::to_string(&histogram - histograms.data()) + " using 1:2 with lines lw 2 lc rgb '" +
                    shades[std::min<size_t>(shade, 4)] + "' title " + gnuplotText(histogram.view + ", mean " + readableNumber(mean)));
    means += (means.empty() ? "" : ", ") + readableNumber(mean) + " at " + histogram.view;
  }
  if (parts.empty()) return;
  const Axis y = logAxis(1.0, most_pixels, 1.3);
  const std::string stem = drawing.stem("fragments-histogram");
  body << "  set lmargin at screen 0.095\n  set rmargin at screen 0.975\n  set bmargin at screen 0.15\n  set tmargin at screen 0.96\n"
       << "  set logscale y\n  set xrange [0:" << number(1.02 * most_layers) << "]\n  set yrange " << y.range() << "\n  set ytics " << y.ticList()
       << "\n  set xtics auto\n  set xlabel 'fragments of a pixel'\n  set ylabel 'pixels with as many'\n"
       << "  set key at screen 0.97,0.95 right top Left reverse samplen 2.2 spacing 1.35 textcolor rgb '" << kInk << "'\n  unset label\n"
       << "  set arrow 1 from 8," << number(y.low) << " to 8," << number(y.high) << " nohead lc rgb '#999999' dt 3\n"
       << "  set label 'k = 8' at 8," << number(y.low * 1.6) << " offset 0.6,0 left font ',13' tc rgb '#777777'\n  plot ";
  for (size_t i = 0; i < parts.size(); ++i) body << (i == 0 ? "" : ", \\\n    ") << "'" << stem << ".dat' " << parts[i];
  body << '\n';
  Plot plot;
  plot.section = "load";
  plot.title = "Fragments of a pixel";
  plot.caption = "A hair pixel has on average " + means + " fragments; what lies right of the dotted line is tail at k 8 (the paper's Figure 2b).";
  drawing.draw(stem, "", 1000.0, 460.0, body.str(), data.str(), std::move(plot));
}

// Sweeps --------------------------------------------------------------------------------------------------------------------

std::string sweepText(const StudyFacts& facts, const Sweep& sweep) {
  const Series* chosen = &sweep.series.front();
  for (const Series& series : sweep.series) {
    if (series.method == "core_tail") chosen = &series;
  }
  const StudyRow &first = *chosen->rows.front(), &last = *chosen->rows.back();
  const StudyColumn& column = *findStudyColumn(sweep.dial->column);
  std::string text = chosen->method + " goes from ";
  const auto say = [&](const StudyRow& row) {
    return readableNumber(row.ms_total) + " ms and an error of " + readableNumber(facts.errorOf(row)) + " at " + sweep.dial->column + " " +
           cellText(row, column);
  };
  return text + say(first) + " to " + say(last) + ".";
}

void drawSweep(Drawing& drawing, const Sweep& sweep, const Setting& setting) {
  const StudyFacts& facts = drawing.facts;
  const StudyColumn& column = *findStudyColumn(sweep.dial->column);
  // Values stand at equal distances: they are chosen by doubling, and 0 has a place too.
  std::vector<const StudyRow*> all;
  for (const Series& series : sweep.series) all.insert(all.end(), series.rows.begin(), series.rows.end());
  std::stable_sort(all.begin(), all.end(), [&](const StudyRow* a, const StudyRow* b) {
    return column.number ? a->*column.number < b->*column.number : a->*column.text < b->*column.text;
  });
  std::vector<std::string> values;
  for (const StudyRow* row : all) {
    if (values.empty() || values.back() != cellText(*row, column)) values.push_back(cellText(*row, column));
  }
  std::vector<double> errors, times;
  for (const StudyRow* row : all) errors.push_back(facts.errorOf(*row)), times.push_back(row->ms_total);
  std::string tics;
  for (size_t i = 0; i < values.size(); ++i) {
    if (values.size() <= 12 || i % (values.size() / 8) == 0) tics += (tics.empty() ? "" : ", ") + gnuplotText(values[i]) + " " + std::to_string(i);
  }
  std::ostringstream body, data;
  const std::string stem = drawing.stem(std::string("sweep-") + sweep.dial->column);
  body << "  set multiplot\n  set xrange [-0.35:" << number(static_cast<double>(values.size()) - 0.65) << "]\n  set xtics (" << tics << ")\n"
       << "  set bmargin at screen 0.18\n  set tmargin at screen 0.90\n";
  struct Panel {
    const char* title;
    double left, right;
    Axis axis;
    const char* use;
  };
  const Axis time_axis = [&] {
    double most = 0.0;
    for (const double ms : times) most = std::isfinite(ms) ? std::max(most, ms) : most;
    return linearAxis(most);
  }();
  const std::string error_title = std::string("error, ") + facts.error->name;
  const Panel panels[] = {{error_title.c_str(), 0.06, 0.41, valueAxis(errors), "1:2"}, {"time (ms)", 0.475, 0.825, time_axis, "1:3"}};
  data << "# a block a method: place on the axis, error (" << facts.error->name << "), ms, value\n";
  for (const Series& series : sweep.series) {
    data << "# " << gnuplotText(series.method) << '\n';
    for (const StudyRow* row : series.rows) {
      const auto place = std::find(values.begin(), values.end(), cellText(*row, column)) - values.begin();
      data << place << '\t' << number(facts.errorOf(*row)) << '\t' << number(row->ms_total) << '\t' << gnuplotText(cellText(*row, column)) << '\n';
    }
    data << "\n\n";
  }
  for (const Panel& panel : panels) {
    const bool is_last = &panel == &panels[1];
    body << "  set lmargin at screen " << number(panel.left) << "\n  set rmargin at screen " << number(panel.right) << "\n"
         << (panel.axis.logarithmic ? "  set logscale y\n" : "  unset logscale y\n") << "  set yrange " << panel.axis.range() << "\n  set ytics "
         << panel.axis.ticList() << "\n  set label 1 " << gnuplotText(panel.title) << " at screen " << number(panel.left) << ",0.95 left tc rgb '"
         << kInk << "'\n  set label 2 " << gnuplotText(sweep.dial->label) << " at screen " << number((panel.left + panel.right) / 2.0)
         << ",0.04 center font ',14' tc rgb '" << kInk << "'\n"
         << (is_last ? "  set key at screen 0.84,0.91 left top Left reverse samplen 1.6 spacing 1.3 textcolor rgb '#333333'\n" : "  unset key\n")
         << "  plot ";
    for (size_t i = 0; i < sweep.series.size(); ++i) {
      const MethodStyle style = methodStyle(facts, sweep.series[i].method);
      body << (i == 0 ? "" : ", \\\n    ") << "'" << stem << ".dat' index " << i << " using " << panel.use << " with linespoints lw 2 ps 1.1*dot pt "
           << style.point << " lc rgb '" << style.color << "' title " << gnuplotText(sweep.series[i].method);
    }
    body << '\n';
  }
  body << "  unset multiplot\n";
  Plot plot;
  plot.section = "sweeps";
  plot.title = "Sweep of " + std::string(sweep.dial->column) + ": " + setting.text();
  plot.caption = sweepText(facts, sweep);
  drawing.draw(stem, "", 1000.0, 380.0, body.str(), data.str(), std::move(plot));
}

}  // namespace

MethodStyle methodStyle(const StudyFacts& facts, const std::string& method) {
  static const std::map<std::string, MethodStyle> known = {
      {"forward", {"#d55e00", 7}},   {"core_tail", {"#0072b2", 5}}, {"core_tail_list", {"#56b4e9", 9}}, {"core_only", {"#e69f00", 11}},
      {"all_low", {"#cc79a7", 13}},  {"exact", {"#222222", 7}},     {"hard", {"#009e73", 15}}};
  if (const auto found = known.find(method); found != known.end()) return found->second;
  static const MethodStyle further[] = {{"#8c564b", 5}, {"#7f3c8d", 9}, {"#80ba5a", 11}, {"#a5aa00", 13}, {"#4b4b8f", 7}, {"#cf1c90", 15}};
  size_t index = 0;
  for (const std::string& other : facts.methods) {
    if (other == method) break;
    index += known.count(other) == 0 ? 1 : 0;
  }
  MethodStyle style = further[index % std::size(further)];
  style.color = darker(style.color, 1.0 - 0.3 * static_cast<double>(std::min<size_t>(index / std::size(further), 2)));
  return style;
}

std::string gnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text.substr(0, 120)) {
    const unsigned char code = static_cast<unsigned char>(c);
    // Within single quotes only the quote itself means something; the others are kept out all the same.
    const bool plain = code >= 0x20 && code < 0x7f && c != '\'' && c != '`' && c != '"' && c != '\\' && c != '@' && c != '$';
    quoted += plain ? c : '_';
  }
  return quoted + "'";
}

std::string fileStem(const std::string& name, std::set<std::string>& taken) {
  std::string stem;
  for (const char c : name.substr(0, 80)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    stem += plain ? c : '_';
  }
  while (!stem.empty() && (stem.back() == '-' || stem.back() == '.')) stem.pop_back();
  while (!stem.empty() && (stem.front() == '-' || stem.front() == '.')) stem.erase(0, 1);
  if (stem.empty()) stem = "_";
  std::string unique = stem;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = stem + "-" + std::to_string(n);
  return unique;
}

Plots drawPlots(const StudyFacts& facts, const std::vector<Histogram>& histograms, const std::string& folder,
                const std::function<void(uint64_t, uint64_t)>& progress) {
  constexpr size_t kMaxSettings = 48;  // a study has about 16
  Drawing drawing(facts, folder, progress);
  const std::vector<Sweep> sweeps = facts.sweeps(facts.main);
  const size_t settings = std::min(facts.settings.size(), kMaxSettings), captures = std::min<size_t>(facts.captures.size(), 4);
  drawing.expected = settings + 3 * captures + 1 + sweeps.size();
  for (size_t i = 0; i < settings; ++i) drawErrorAgainstTime(drawing, facts.settings[i], facts.settings[i] == facts.main);
  if (settings == 0) drawErrorAgainstTime(drawing, facts.main, true);  // a single row is a plot too
  if (settings < facts.settings.size()) {
    drawing.plots.problems.push_back("error against time is drawn for " + std::to_string(settings) + " of " +
                                     std::to_string(facts.settings.size()) + " settings");
  }
  for (size_t i = 0; i < captures; ++i) {
    drawPasses(drawing, facts.captures[i]);
    drawMethods(drawing, facts.captures[i]);
    drawTailCost(drawing, facts.captures[i]);
  }
  drawHistogram(drawing, histograms);
  for (const Sweep& sweep : sweeps) drawSweep(drawing, sweep, facts.main);
  return std::move(drawing.plots);
}

}  // namespace forelock::samples
