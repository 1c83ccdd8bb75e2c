#include "adit/survey/changed_walls.hpp"

#include <algorithm>
#include <numeric>

namespace adit {
namespace {

constexpr double kMeet = 0.02;  // m: ends of a plan's walls that are one vertex

struct RunEnd {
  Vector2d point;
  std::size_t run = 0;
};

/// The first of the runs that `run` belongs to, with the ways to it shortened.
std::size_t first_of(std::vector<std::size_t>& belongs_to, std::size_t run) {
  while (belongs_to[run] != run) run = belongs_to[run] = belongs_to[belongs_to[run]];
  return run;
}

std::vector<RunEnd> ends_by_x(std::span<const ChangedRun> runs) {
  std::vector<RunEnd> ends;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ends.push_back({runs[i].removed.a, i});
    ends.push_back({runs[i].removed.b, i});
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const RunEnd& a, const RunEnd& b) { return a.point.x() < b.point.x(); });
  return ends;
}

}  // namespace

std::vector<std::vector<std::size_t>> runs_of_changes(std::span<const ChangedRun> runs) {
  std::vector<std::size_t> belongs_to(runs.size());
  std::iota(belongs_to.begin(), belongs_to.end(), std::size_t{0});
  const std::vector<RunEnd> ends = ends_by_x(runs);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      if (ends[j].point.x() - ends[i].point.x() > kMeet) break;
      if (runs[ends[i].run].change != runs[ends[j].run].change) continue;
      if ((ends[i].point - ends[j].point).norm() > kMeet) continue;
      const std::size_t a = first_of(belongs_to, ends[i].run);
      const std::size_t b = first_of(belongs_to, ends[j].run);
      belongs_to[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<std::size_t>> changes(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) changes[first_of(belongs_to, i)].push_back(i);
  std::erase_if(changes, [](const auto& numbers) { return numbers.empty(); });
  return changes;
}

}  // namespace adit
