#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/io/plan_levels.hpp"
#include "adit/map/line_map.hpp"
#include "adit/places/place_index.hpp"

namespace adit {

/// A level of a mine, ready to be searched.
struct MineLevel {
  std::string name;  ///< empty where the plan has no levels
  LineMap map;
  std::shared_ptr<const PlaceIndex> places;
};

/// How the index of a level is made.
struct IndexSettings {
  PlaceIndexOptions places;
  int threads = 1;
  std::string file;  ///< where it is kept from run to run; empty: nowhere
};

/// The index of a plan: read from its file where that holds one of this plan, else built, and
/// written there. Says on stderr what it holds and how long it took. The file of a level bears the
/// level's name behind a dot. Error: the file is something else, is damaged or cannot be written.
Result<std::shared_ptr<const PlaceIndex>> index_of(const LineMap& map,
                                                   const IndexSettings& settings,
                                                   const std::string& level);

/// Cleans each level and makes its index.
Result<std::vector<MineLevel>> prepare_levels(const std::vector<PlanLevel>& plans,
                                              const LineMapOptions& cleaning,
                                              const IndexSettings& settings);

/// The names of the levels, with commas between.
std::string names_of(const std::vector<PlanLevel>& plans);

}  // namespace adit
