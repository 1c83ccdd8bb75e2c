#include "trial_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "adit/evaluation/bound_summary.hpp"
#include "adit/evaluation/report.hpp"
#include "adit/evaluation/statistics.hpp"

namespace adit {
namespace {

/// `value(answer)` of the answers of which `counts(answer)` holds.
template <class Value, class Counts>
Statistics statistics_of(std::span<const Answer> answers, Value&& value, Counts&& counts) {
  std::vector<double> values;
  for (const Answer& answer : answers) {
    if (counts(answer)) values.push_back(value(answer));
  }
  return summarise(std::move(values));
}

template <class Counts>
std::int64_t count_of(std::span<const Answer> answers, Counts&& counts) {
  return std::count_if(answers.begin(), answers.end(), counts);
}

/// Runs with an answer that counts.
template <class Counts>
std::size_t runs_with(std::span<const Answer> answers, Counts&& counts) {
  std::set<std::uint64_t> seeds;
  for (const Answer& answer : answers) {
    if (counts(answer)) seeds.insert(answer.seed);
  }
  return seeds.size();
}

const auto kAll = [](const Answer&) { return true; };
const auto kNear = [](const Answer& a) { return a.near_intersection; };
const auto kPosition = [](const Answer& a) { return a.position_error(); };
const auto kHeadingDeg = [](const Answer& a) { return degrees(a.heading_error()); };

Vector2d error_in_vehicle(const Answer& a) {
  return RigidTransform({0.0, 0.0, -a.truth.theta})
      .direction(a.pose.translation() - a.truth.translation());
}

double along(const Answer& a) { return std::abs(error_in_vehicle(a).x()); }
double across(const Answer& a) { return std::abs(error_in_vehicle(a).y()); }

/// The claimed sigma along the vehicle (m).
double along_sigma(const Answer& a) {
  const Vector2d ahead = unit_vector(a.truth.theta);
  return std::sqrt(ahead.dot(a.covariance.topLeftCorner<2, 2>() * ahead));
}

double percent(std::int64_t part, std::int64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string row(const char* name, const Statistics& s) {
  return fmt::format(
      "{:<24} mean {:.4f}  rms {:.4f}  median {:.4f}  p95 {:.4f}  p99 {:.4f}  max {:.4f}  ({})\n",
      name, s.mean, s.rms, s.median, s.p95, s.p99, s.max, s.count);
}

std::string near_and_elsewhere(std::span<const Answer> answers) {
  if (count_of(answers, kNear) == 0) return "";
  const auto elsewhere = [](const Answer& a) { return !a.near_intersection; };
  return row("  within 4 m of crossing", statistics_of(answers, kPosition, kNear)) +
         row("  elsewhere", statistics_of(answers, kPosition, elsewhere));
}

/// Runs past the bounds of a lost run, at any scan and at the last.
std::string lost_runs(std::span<const Answer> answers) {
  const EvaluationOptions bounds;
  int any = 0, last = 0, runs = 0;
  bool lost = false;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const bool beyond = answers[i].position_error() > bounds.lost_position_m ||
                        answers[i].heading_error() > bounds.lost_heading_rad;
    lost = lost || beyond;
    if (i + 1 < answers.size() && answers[i + 1].seed == answers[i].seed) continue;
    ++runs;
    any += lost ? 1 : 0;
    last += beyond ? 1 : 0;
    lost = false;
  }
  return fmt::format("runs past 1 m or 20 deg: {} at some scan, {} at the last, of {}\n", any, last,
                     runs);
}

template <class Counts>
std::string protection_row(const char* name, std::span<const Answer> answers, Counts&& counts) {
  const auto is_trusted = [&](const Answer& a) { return counts(a) && a.is_trusted(); };
  const auto all = count_of(answers, counts);
  const auto trusted = count_of(answers, is_trusted);
  const auto exceeded = count_of(answers, [&](const Answer& a) {
    return is_trusted(a) && a.position_error() > a.protection_m;
  });
  const auto without = count_of(
      answers, [&](const Answer& a) { return is_trusted(a) && !std::isfinite(a.protection_m); });
  const auto level = [](const Answer& a) { return a.protection_m; };
  const Statistics levels = statistics_of(answers, level, is_trusted);
  return fmt::format(
      "{:<24} trusted {} of {} ({:.2f} %)  exceeded {} ({:.2f} in 1000)  level p50 {:.3f}  p95 "
      "{:.3f}  without level {}\n",
      name, trusted, all, percent(trusted, all), exceeded, 10.0 * percent(exceeded, trusted),
      levels.median, levels.p95, without);
}

}  // namespace

std::string accuracy_text(std::span<const Answer> answers) {
  const auto within =
      count_of(answers, [](const Answer& a) { return along(a) <= 3.0 * along_sigma(a); });
  return row("position (m)", statistics_of(answers, kPosition, kAll)) +
         near_and_elsewhere(answers) +
         row("  along the vehicle", statistics_of(answers, along, kAll)) +
         row("  across the vehicle", statistics_of(answers, across, kAll)) +
         row("heading (deg)", statistics_of(answers, kHeadingDeg, kAll)) +
         fmt::format("along inside its 3 sigma {:.2f} %; median sigma {:.4f} m\n",
                     percent(within, std::ssize(answers)),
                     statistics_of(answers, along_sigma, kAll).median) +
         lost_runs(answers);
}

std::string status_text(std::span<const Answer> answers) {
  StatusCounts counts;
  for (const Answer& answer : answers) ++counts[answer.status];
  const auto beyond = [](double metres) {
    return [metres](const Answer& a) { return a.is_trusted() && a.position_error() > metres; };
  };
  const auto ok_beyond = [](double metres) {
    return
        [metres](const Answer& a) { return a.status == Status::ok && a.position_error() > metres; };
  };
  return fmt::format("status                   ok {}  degraded {}  ambiguous {}  lost {}\n",
                     counts.ok, counts.degraded, counts.ambiguous, counts.lost) +
         fmt::format(
             "confidently wrong        ok beyond 0.5 m: {} (in {} runs), beyond 1 m: {}; ok or "
             "degraded beyond 1 m: {}\n",
             count_of(answers, ok_beyond(0.5)), runs_with(answers, ok_beyond(0.5)),
             count_of(answers, ok_beyond(1.0)), count_of(answers, beyond(1.0)));
}

std::string protection_text(std::span<const Answer> answers) {
  std::string text = protection_row("protection", answers, kAll);
  if (count_of(answers, kNear) > 0) {
    text += protection_row("  within 4 m of crossing", answers, kNear);
  }
  return text;
}

std::string worst_text(std::span<const Answer> answers, int count) {
  std::vector<const Answer*> trusted;
  for (const Answer& answer : answers) {
    if (answer.is_trusted()) trusted.push_back(&answer);
  }
  std::sort(trusted.begin(), trusted.end(), [](const Answer* a, const Answer* b) {
    return a->position_error() > b->position_error();
  });
  trusted.resize(std::min(trusted.size(), static_cast<std::size_t>(count)));
  std::string text;
  for (const Answer* a : trusted) {
    const Vector2d error = error_in_vehicle(*a);
    text += fmt::format(
        "  seed {} scan {} {} at {:.2f} {:.2f}, {:.1f} deg: along {:.3f} across {:.3f} m, {:.2f} "
        "deg; level {:.3f}\n",
        a->seed, a->scan, to_string(a->status), a->truth.x, a->truth.y, degrees(a->truth.theta),
        error.x(), error.y(), degrees(angle_between(a->truth.theta, a->pose.theta)),
        a->protection_m);
  }
  return text;
}

std::string time_text(std::span<const Answer> answers) {
  const auto microseconds = [](const Answer& a) { return 1e6 * a.seconds; };
  const Statistics s = statistics_of(answers, microseconds, kAll);
  return fmt::format("cycle (us)               median {:.1f}  p99 {:.1f}\n", s.median, s.p99);
}

std::string bound_text(std::span<const Answer> answers, const LineMap& map,
                       const ScannerSpec& scanner) {
  std::vector<StampedPose> poses;
  for (const Answer& answer : answers) poses.push_back({0.0, answer.truth});
  const BoundSummary bound = bound_along(map, poses, scanner.model, fan_of(scanner));
  const double position = statistics_of(answers, kPosition, kAll).rms / bound.position_rms;
  const double heading = statistics_of(answers, kHeadingDeg, kAll).rms / bound.heading_rms_deg;
  return fmt::format(
      "Cramer-Rao bound         rms {:.5f} m, {:.4f} deg; errors over it: position {:.3f}, heading "
      "{:.3f}\n",
      bound.position_rms, bound.heading_rms_deg, position, heading);
}

}  // namespace adit
