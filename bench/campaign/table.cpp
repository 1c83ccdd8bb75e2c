#include "table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "cell.hpp"

namespace adit {
namespace {

constexpr double kLongSilence = 10.0;  // m

double ratio(double part, double whole) {
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

double percent(std::int64_t part, std::int64_t whole) {
  return 100.0 * ratio(static_cast<double>(part), static_cast<double>(whole));
}

std::string bound_text(double share) {
  return 100.0 * share < 10.0 ? fmt::format("{:.2g}", 100.0 * share)
                              : fmt::format("{:.0f}", 100.0 * share);
}

/// "3 of 952 (0.07 to 0.92 %)".
std::string with_bounds(std::int64_t hits, std::int64_t trials) {
  const Share share = clopper_pearson(hits, trials);
  return fmt::format("{} of {} ({} to {} %)", hits, trials, bound_text(share.low),
                     bound_text(share.high));
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "";
  return std::isinf(value) ? "∞" : fmt::format("{:.{}f}", value, digits);
}

const Cell* cell_named(std::string_view name) {
  const auto cells = all_cells();
  const auto found =
      std::find_if(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.name == name; });
  return found == cells.end() ? nullptr : &*found;
}

bool is_single(const Cell& cell) { return cell.task == Task::locate || cell.task == Task::outside; }

/// Whether the machine's own scanner is at fault, which a monitor has to find out.
bool is_scanner_faulty(const Cell& cell) {
  return cell.fault != ScannerFault::none && cell.fault != ScannerFault::dust &&
         cell.fault != ScannerFault::dropouts;
}

/// Whether the pose is not known all along, so that there is a way until it is found.
bool is_sought(const Cell& cell) {
  return cell.start != Start::right || cell.plan == PlanError::off_plan;
}

std::string found_text(const Pooled& p, bool has_way) {
  if (!has_way) return "";
  return fmt::format("{} m; {:.0f} / {:.0f} / {:.0f} %", number(p.median_found(), 1),
                     100.0 * p.found_within(10.0), 100.0 * p.found_within(15.0),
                     100.0 * p.found_within(30.0));
}

std::string untold_text(const Pooled& p) {
  return p.sum.wrong == 0 ? "" : fmt::format("{:.0f} %", percent(p.sum.untold, p.sum.wrong));
}

std::string silence_text(const Pooled& p) {
  const Histogram& silences = p.sum.silences;
  if (silences.count() == 0) return "none";
  return fmt::format("{} in {}; {}; {} m", silences.above(kLongSilence), p.long_silence,
                     number(silences.largest(), 0), number(silences.quantile(0.5), 1));
}

std::string drive_row(std::string_view name, const Pooled& p, bool has_way) {
  const DriveCounts& s = p.sum;
  const std::int64_t confirmed = s.scans - s.unconfirmed;
  const auto judged = static_cast<double>(s.judged);
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {:.1f} | {:.1f} | {} | {} / {} | {}, {} | {} | {} {} "
      "{} | {} | {} / {} |\n",
      name, p.drives, s.answers(), with_bounds(s.beyond, s.answers()),
      with_bounds(s.wrong, s.answers()), untold_text(p), with_bounds(p.hit, p.drives),
      percent(s.answered, confirmed), percent(s.ok, confirmed), silence_text(p),
      number(s.levels.quantile(0.5), 2), number(s.levels.quantile(0.95), 2),
      number(ratio(s.error_m, judged), 3), number(s.worst_m, 2),
      number(std::sqrt(ratio(s.squares_m2, s.bound_m2)), 2), number(ratio(s.nees_x, judged), 2),
      number(ratio(s.nees_y, judged), 2), number(ratio(s.nees_heading, judged), 2),
      found_text(p, has_way), number(1e6 * s.seconds.quantile(0.5), 0),
      number(1e6 * s.seconds.quantile(0.99), 0));
}

std::string single_row(std::string_view name, const Pooled& p) {
  const DriveCounts& s = p.sum;
  return fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {} | {} / {} |\n", name,
                     s.scans, percent(s.first, s.scans), percent(s.listed, s.scans),
                     percent(s.ok, s.scans), percent(s.degraded, s.scans),
                     with_bounds(s.wrong, s.scans), number(1e3 * s.seconds.quantile(0.5), 1),
                     number(1e3 * s.seconds.quantile(0.99), 0));
}

constexpr const char* kDriveHead =
    "| cell | drives | answers | beyond (95 %) | wrong (95 %) | of them no scan can tell | drives "
    "hit (95 %) | answered, % | `ok`, % | silent: stretches over 10 m in drives; longest; median | "
    "level p50 / p95, m | mean, largest error, m | error over bound | NEES x, y, heading | found: "
    "median; "
    "within 10 / 15 / 30 m | cycle median / p99, µs |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

constexpr const char* kSingleHead =
    "| cell | scans | first, % | listed, % | `ok`, % | `degraded`, % | wrong (95 %) | search "
    "median "
    "/ p99, ms |\n|---|---|---|---|---|---|---|---|\n";

}  // namespace

void Pooled::add(const DriveCounts& counts) {
  ++drives;
  hit += counts.is_hit() ? 1 : 0;
  wrong_in += counts.wrong > 0 ? 1 : 0;
  beyond_in += counts.beyond > 0 ? 1 : 0;
  long_silence += counts.silences.above(kLongSilence) > 0 ? 1 : 0;
  if (counts.found_m >= 0.0) {
    found_m.insert(std::upper_bound(found_m.begin(), found_m.end(), counts.found_m),
                   counts.found_m);
  }
  add_counts(counts, sum);
}

double Pooled::found_within(double metres) const {
  const auto end = std::upper_bound(found_m.begin(), found_m.end(), metres);
  return ratio(static_cast<double>(end - found_m.begin()), static_cast<double>(drives));
}

double Pooled::median_found() const {
  const auto middle = static_cast<std::size_t>(drives / 2);
  return middle < found_m.size() ? found_m[middle] : std::numeric_limits<double>::infinity();
}

Pooled pooled(const CellResults& results) {
  Pooled all;
  for (const DriveCounts& counts : results.drives) all.add(counts);
  return all;
}

std::string table_text(std::span<const CellResults> results) {
  std::string drives;
  std::string singles;
  Pooled all;
  for (const CellResults& one : results) {
    const Cell* cell = cell_named(one.header.cell);
    if (cell == nullptr || one.drives.empty()) continue;
    const Pooled p = pooled(one);
    if (is_single(*cell)) {
      singles += single_row(cell->name, p);
      continue;
    }
    drives += drive_row(cell->name, p, is_sought(*cell));
    if (is_scanner_faulty(*cell)) continue;
    for (const DriveCounts& counts : one.drives) all.add(counts);
  }
  std::string text;
  if (!drives.empty()) {
    text += kDriveHead + drives + drive_row("all but faulty scanners", all, false);
    text +=
        fmt::format("\nOf all drives but those of faulty scanners, beyond in {}, wrong in {}.\n",
                    with_bounds(all.beyond_in, all.drives), with_bounds(all.wrong_in, all.drives));
  }
  if (!singles.empty()) text += (text.empty() ? "" : "\n") + (kSingleHead + singles);
  return text;
}

}  // namespace adit
