#pragma once

#include <optional>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"
#include "locate_options.hpp"

namespace adit {

/// A scan and where it was taken; no pose for one that was taken outside of the plan.
struct LocateCase {
  LaserScan scan;
  std::optional<Pose2> truth;
};

/// A plan and the scans that are sought in it.
struct LocateScene {
  LineMap map;
  ScannerModel scanner;
  MapError map_error;
  std::vector<LocateCase> cases;
};

/// Error: a file that cannot be read, a plan or a scanner that there is none of.
Result<LocateScene> make_locate_scene(const LocateOptions& options);

}  // namespace adit
