#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/map/line_map.hpp"
#include "adit/places/place_index.hpp"
#include "adit/simulation/drive_map.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/world.hpp"
#include "cell.hpp"

namespace adit {

/// A plan as it is drawn, shared by all drives in it.
struct Ground {
  World world;                ///< plan, walls (as planned, or rough by themselves), its own path
  std::vector<Segment> bare;  ///< of a panel with a mark: its walls without it
  std::vector<std::vector<Pose2>> drives;  ///< past the mark
  std::vector<Pose2> places;               ///< in the openings; drives begin there
  RayCaster caster;                        ///< of the walls
  DriveMap ways;                           ///< empty where all drives go along given paths
  LineMap map;
  std::shared_ptr<const PlaceIndex> index;
};

/// The grounds of all mines, each made once; any thread may ask.
class Grounds {
 public:
  /// `data` is the folder of plans of real mines; an index is made on so many threads.
  Grounds(std::string data, int threads) : data_(std::move(data)), threads_(threads) {}

  /// Mines of which there are several (panels, drifts) follow the drive's number. Error: its plan
  /// cannot be read.
  Result<std::shared_ptr<const Ground>> of(Mine mine, std::int64_t drive);

 private:
  struct Slot {
    std::mutex making;
    std::shared_ptr<const Ground> ground;
  };

  std::string data_;
  int threads_ = 1;
  std::mutex mutex_;
  std::map<std::pair<Mine, std::int64_t>, Slot> slots_;
};

/// The plan of a mine without map and index.
Result<Ground> make_ground(Mine mine, std::int64_t variant, const std::string& data);

}  // namespace adit
