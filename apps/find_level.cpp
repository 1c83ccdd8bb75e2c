#include "find_level.hpp"

#include <algorithm>

#include "progress.hpp"
#include "sweep_priors.hpp"

namespace adit {

std::optional<std::size_t> find_level(const Log& log, const std::vector<MineLevel>& levels,
                                      const LocalizerSettings& settings, std::size_t most_scans) {
  const SweepPriors priors(log, settings);
  MineSearch search(levels, settings);
  const std::size_t count = std::min(most_scans, log.scans.size());
  Progress progress("finding the level", count);
  std::optional<std::size_t> found;
  bool is_contradicted = false;
  for (std::size_t i = 0; i < count; ++i) {
    const LaserScan& scan = log.scans[i].scan;
    const MineAnswer answer = search.locate(scan, priors.of(scan));
    if (answer.verdict == Status::ok) {
      const std::size_t level = answer.poses.front().level;
      if (found == level) return level;
      is_contradicted = found.has_value();
      found = level;
    }
    progress.advance();
  }
  return is_contradicted ? std::nullopt : found;
}

}  // namespace adit
