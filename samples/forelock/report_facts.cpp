// SPDX-License-Identifier: MIT
#include "report_facts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace forelock::samples {

namespace {

constexpr Dial kDials[] = {
    {"k", "8", "fragments of a pixel shaded in full, k", "k "},
    {"core_taps", "25", "shadow map taps of a full shade", "taps "},
    {"tau", "", "transmittance at which full shading ends, tau", "tau "},
    {"k_sort", "8", "fragments of a pixel sorted, k_sort", "sort "},
    {"tail_taps", "1", "shadow map taps in the tail", "tail taps "},
    {"shadow_size", "1024", "side of the hair shadow map (texels)", "map "},
    {"payload", "default", "coding of a node", ""},
    {"lights", "1", "lights", "lights "},
};

// In the order of the paper, then ours.
constexpr const char* kMethods[] = {"forward", "core_tail", "core_tail_list", "core_only", "all_low", "exact", "hard"};

std::string valueOf(const StudyRow& row, const Dial& dial) { return cellText(row, *findStudyColumn(dial.column)); }

size_t rankOf(const std::string& method) {
  return static_cast<size_t>(std::find(std::begin(kMethods), std::end(kMethods), method) - std::begin(kMethods));
}

std::string mostCommon(const std::map<std::string, size_t>& counts) {
  std::string best;
  size_t most = 0;
  for (const auto& [value, count] : counts) {
    if (count > most) best = value, most = count;
  }
  return best;
}

void addOnce(std::vector<std::string>& list, const std::string& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

// Numbers by size, words in the order they have.
void sortByDial(std::vector<const StudyRow*>& rows, const Dial& dial) {
  const StudyColumn& column = *findStudyColumn(dial.column);
  std::stable_sort(rows.begin(), rows.end(), [&](const StudyRow* a, const StudyRow* b) {
    return column.number ? a->*column.number < b->*column.number : a->*column.text < b->*column.text;
  });
}

}  // namespace

std::span<const Dial> dials() { return kDials; }

std::string Setting::text() const {
  std::string text;
  for (const std::string& part : {view, capture, hair_colour.empty() ? hair_colour : hair_colour + " hair"}) {
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  }
  return text.empty() ? "all rows" : text;
}

std::vector<size_t> paretoFront(std::span<const PlanePoint> points) {
  std::vector<size_t> order;
  for (size_t i = 0; i < points.size(); ++i) {
    if (std::isfinite(points[i].x) && std::isfinite(points[i].y)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return points[a].x < points[b].x || (points[a].x == points[b].x && points[a].y < points[b].y);
  });
  std::vector<size_t> front;
  for (const size_t i : order) {
    const bool better = front.empty() || points[i].y < points[front.back()].y;
    const bool equal = !front.empty() && points[i].x == points[front.back()].x && points[i].y == points[front.back()].y;
    if (better || equal) front.push_back(i);
  }
  return front;
}

std::string whyDoubtful(const StudyRow& row) {
  std::string why;
  const auto add = [&why](const std::string& text) { why += (why.empty() ? "" : "; ") + text; };
  if (row.status != "ok") add(row.status);
  if (row.deterministic == 0.0) add("not the same bits over repeated frames and permuted orders");
  if (row.pair_spread > 0.2) add("its time ratio moves by " + readableNumber(100.0 * row.pair_spread, 2) + " % between batches");
  return why;
}

std::string methodOf(const StudyRow& row) {
  const bool usual = row.store.empty() || row.store == "linked_list" || row.store == "none";
  return usual ? row.method : row.method + " (" + row.store + ")";
}

std::string readableCount(double value) {
  if (!std::isfinite(value)) return "-";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.0f", value);
  std::string grouped;
  const size_t count = std::char_traits<char>::length(digits);
  for (size_t i = 0; i < count; ++i) {
    if (i > 0 && digits[i - 1] != '-' && (count - i) % 3 == 0) grouped += ',';
    grouped += digits[i];
  }
  return grouped;
}

std::string readableNumber(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::fabs(value))));
  const int decimals = digits - 1 - magnitude;
  if (decimals <= 0 && std::fabs(value) >= 1000.0) return readableCount(value);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::clamp(decimals, 0, 8), value);
  return text;
}

StudyFacts::StudyFacts(const StudyTable& study, const std::string& error_column)
    : table(study), error(findStudyColumn(error_column)) {
  if (!error || !error->number) {
    throw StudyError("there is no column of numbers called " + error_column);
  }
  // A study that went on after a stop may have measured a row again: the later one counts.
  std::map<std::string, size_t> seen;
  for (const StudyRow& row : table.rows) {
    std::string key;
    for (const std::string& part : {row.asset, row.view, row.method, row.store, row.capture, row.hair_colour,
                                    cellText(row, *findStudyColumn("width")), cellText(row, *findStudyColumn("height"))}) {
      key += part + '\n';
    }
    for (const Dial& dial : kDials) key += valueOf(row, dial) + '\n';
    const auto [place, is_new] = seen.emplace(key, live_.size());
    if (is_new) {
      live_.push_back(&row);
    } else {
      live_[place->second] = &row;
      ++replaced_rows;
    }
  }

  std::map<std::pair<std::string, const Dial*>, std::map<std::string, size_t>> counts;
  std::vector<std::pair<Setting, size_t>> sizes;
  for (const StudyRow* row : live_) {
    addOnce(methods, methodOf(*row));
    addOnce(captures, row->capture);
    addOnce(hair_colours, row->hair_colour);
    for (const Dial& dial : kDials) {
      if (const std::string value = valueOf(*row, dial); !value.empty()) ++counts[{methodOf(*row), &dial}][value];
    }
    const Setting setting{row->view, row->capture, row->hair_colour};
    const auto found = std::find_if(sizes.begin(), sizes.end(), [&](const auto& size) { return size.first == setting; });
    if (found == sizes.end()) {
      sizes.emplace_back(setting, 1);
    } else {
      ++found->second;
    }
    auto view = std::find_if(views.begin(), views.end(), [&](const StudyView& known) { return known.name == row->view; });
    if (view == views.end()) {
      views.push_back({row->view});
      view = views.end() - 1;
      for (const StudyView& known : table.device.views) {
        if (known.name == row->view) *view = known;
      }
    }
    const auto fill = [](double& to, double from) { if (std::isnan(to)) to = from; };
    fill(view->width, row->width);
    fill(view->height, row->height);
    fill(view->fragments, row->fragments);
    fill(view->hair_pixels, row->hair_pixels);
    fill(view->mean_overdraw, row->mean_overdraw);
    fill(view->max_overdraw, row->max_overdraw);
  }
  for (const auto& [key, values] : counts) {
    base_[key] = values.count(key.second->base) ? key.second->base : mostCommon(values);
  }
  std::stable_sort(methods.begin(), methods.end(), [](const std::string& a, const std::string& b) {
    return rankOf(a) != rankOf(b) ? rankOf(a) < rankOf(b) : rankOf(a) == std::size(kMethods) && a < b;
  });
  std::stable_sort(views.begin(), views.end(), [](const StudyView& a, const StudyView& b) {
    return std::isnan(b.hair_pixels) ? !std::isnan(a.hair_pixels) : a.hair_pixels < b.hair_pixels;
  });
  std::stable_sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  main = sizes.front().first;
  for (const auto& [setting, size] : sizes) {
    if (size > 1) settings.push_back(setting);
  }
}

double StudyFacts::timeOf(const StudyRow& row) const {
  const StudyRow* base = baseRow({row.view, row.capture, row.hair_colour}, "core_tail");
  // The baseline of a row has its lights and its shadow map.
  const bool alike = base && base->lights == row.lights && base->shadow_size == row.shadow_size;
  return alike && &row != base && base->ms_total > 0.0 && row.pair_ratio > 0.0 ? base->ms_total / row.pair_ratio : row.ms_total;
}

bool StudyFacts::isPlotted(const StudyRow& row) const {
  return row.ms_total > 0.0 && std::isfinite(errorOf(row));
}

std::vector<const StudyRow*> StudyFacts::rows(const Setting& setting) const {
  std::vector<const StudyRow*> found;
  for (const StudyRow* row : live_) {
    if (Setting{row->view, row->capture, row->hair_colour} == setting) found.push_back(row);
  }
  return found;
}

std::vector<const StudyRow*> StudyFacts::doubtfulRows() const {
  std::vector<const StudyRow*> found;
  for (const StudyRow* row : live_) {
    if (!whyDoubtful(*row).empty()) found.push_back(row);
  }
  return found;
}

const std::string& StudyFacts::baseValue(const std::string& method, const Dial& dial) const {
  static const std::string none;
  const auto found = base_.find({method, &dial});
  return found == base_.end() ? none : found->second;
}

bool StudyFacts::atBase(const StudyRow& row, const Dial* left_out) const {
  const std::string method = methodOf(row);
  for (const Dial& dial : kDials) {
    if (&dial == left_out) continue;
    const std::string value = valueOf(row, dial), &base = baseValue(method, dial);
    if (value.empty() || value == base) continue;
    // As many are sorted as are shaded in full, or more.
    if (std::string_view(dial.column) == "k_sort" && row.k > 8.0 && row.k_sort == row.k) continue;
    return false;
  }
  return true;
}

const StudyRow* StudyFacts::baseRow(const Setting& setting, const std::string& method) const {
  const StudyRow* best = nullptr;
  for (const StudyRow* row : rows(setting)) {
    if (methodOf(*row) == method && atBase(*row) && (!best || (best->status != "ok" && row->status == "ok"))) best = row;
  }
  return best;
}

std::vector<Series> StudyFacts::errorSeries(const Setting& setting) const {
  std::vector<Series> all;
  const std::vector<const StudyRow*> here = rows(setting);
  for (const std::string& method : methods) {
    bool has_line = false;
    for (const Dial& dial : std::span(kDials, 3)) {  // the others change what is drawn, or hardly the error
      Series series{method, &dial, {}};
      std::set<std::string> values;
      for (const StudyRow* row : here) {
        if (methodOf(*row) == method && atBase(*row, &dial) && isPlotted(*row) && !valueOf(*row, dial).empty()) {
          series.rows.push_back(row);
          values.insert(valueOf(*row, dial));
        }
      }
      if (values.size() < 2) continue;
      sortByDial(series.rows, dial);
      all.push_back(std::move(series));
      has_line = true;
    }
    if (const StudyRow* row = baseRow(setting, method); row && !has_line && isPlotted(*row)) {
      all.push_back({method, nullptr, {row}});
    }
  }
  return all;
}

std::vector<Sweep> StudyFacts::sweeps(const Setting& setting) const {
  std::vector<Sweep> all;
  const std::vector<const StudyRow*> here = rows(setting);
  for (const Dial& dial : kDials) {
    Sweep sweep{&dial, {}};
    for (const std::string& method : methods) {
      Series series{method, &dial, {}};
      std::set<std::string> values;
      for (const StudyRow* row : here) {
        if (methodOf(*row) == method && atBase(*row, &dial) && row->status == "ok" && !valueOf(*row, dial).empty()) {
          series.rows.push_back(row);
          values.insert(valueOf(*row, dial));
        }
      }
      if (values.size() < 2) continue;
      sortByDial(series.rows, dial);
      sweep.series.push_back(std::move(series));
    }
    if (!sweep.series.empty()) all.push_back(std::move(sweep));
  }
  return all;
}

StudyFacts::Ratio StudyFacts::forwardRatio(const Setting& setting) const {
  const StudyRow *forward = baseRow(setting, "forward"), *core_tail = baseRow(setting, "core_tail");
  Ratio ratio;
  if (forward && forward->pair_ratio > 0.0) {
    ratio = {1.0 / forward->pair_ratio, forward->pair_spread, true};
  } else if (forward && core_tail && forward->ms_total > 0.0 && core_tail->ms_total > 0.0) {
    ratio.value = forward->ms_total / core_tail->ms_total;
  }
  return ratio;
}

}  // namespace forelock::samples
