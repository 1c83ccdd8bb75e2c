#include "mine_levels.hpp"

#include <fmt/core.h>

#include <chrono>
#include <utility>

namespace adit {

std::shared_ptr<const PlaceIndex> index_of(const LineMap& map, const IndexSettings& settings,
                                           const std::string& level) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto index =
      std::make_shared<const PlaceIndex>(PlaceIndex::build(map, settings.places, settings.threads));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  fmt::print(stderr, "adit: {}index of {} places, {:.2f} m apart, {:.1f} MB, built in {:.2f} s\n",
             level.empty() ? "" : "level " + level + ": ", index->size(), index->pitch_m(),
             1e-6 * static_cast<double>(index->memory()), seconds);
  return index;
}

std::vector<MineLevel> prepare_levels(const std::vector<PlanLevel>& plans,
                                      const LineMapOptions& cleaning,
                                      const IndexSettings& settings) {
  std::vector<MineLevel> levels;
  for (const PlanLevel& plan : plans) {
    MineLevel level{plan.name, LineMap::build(plan.plan.segments, cleaning), nullptr};
    level.places = index_of(level.map, settings, level.name);
    levels.push_back(std::move(level));
  }
  return levels;
}

std::string names_of(const std::vector<PlanLevel>& plans) {
  std::string text;
  for (const PlanLevel& plan : plans) text += (text.empty() ? "" : ", ") + plan.name;
  return text;
}

}  // namespace adit
