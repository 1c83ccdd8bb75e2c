#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "adit/localizer/settings.hpp"
#include "adit/relocation/relocator.hpp"
#include "mine_levels.hpp"

namespace adit {

/// A pose that explains a scan, and the level that it is on.
struct LevelPose {
  RankedPose ranked;
  std::size_t level = 0;
};

/// Where in a mine a scan may have been taken: the verdict over all levels, the best poses first.
struct MineAnswer {
  Status verdict = Status::lost;
  std::vector<LevelPose> poses;
  double elapsed_s = 0.0;  ///< of the search alone
};

/// Looks for scans on every level of a mine.
///
/// The likelihood of the scan makes poses of different levels comparable. An answer on one level
/// does not stand where poses on others weigh as much as a rival on its own would have to. Levels
/// and settings must outlive it.
class MineSearch {
 public:
  MineSearch(const std::vector<MineLevel>& levels, const LocalizerSettings& settings);

  MineAnswer locate(const LaserScan& scan, const std::optional<SweepPrior>& motion);

 private:
  void weigh(double share_of_news, MineAnswer& answer);

  const std::vector<MineLevel>& levels_;
  const LocalizerSettings& settings_;
  std::deque<Relocator> relocators_;  // one a level
};

}  // namespace adit
