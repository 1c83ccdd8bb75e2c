#pragma once

#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/relocation/options.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// How likely a scan is from a pose, comparable between any two poses of a map.
///
/// Each beam meets the map's wall or something else, in a chain along the sweep as in the
/// refinement. Unlike its evidence this one measures against the same everywhere: a return where
/// the map has nothing, and none where it has a wall, speak against a pose.
class ScanLikelihood {
 public:
  /// Takes the scan, of which it looks at a hundred beams or so.
  void set_scan(const LaserScan& scan, const ScannerModel& scanner, const MapError& error,
                const LikelihoodOptions& options);

  /// Log of the probability density of the beams if the scanner is at most about `doubt_m` off.
  double at(const LineMap& map, const Pose2& map_from_laser, double doubt_m);

  /// The same scan against a map that errs by so much.
  void set_map_error(const MapError& error);

  /// How much of what the beams say is news: neighbours see the same stretch of wall.
  double share_of_news() const { return share_of_news_; }

 private:
  struct Beam {
    double bearing = 0.0;  // rad, laser axes
    double range = 0.0;    // m; the scanner's reach without return
    bool has_return = false;
  };
  struct Densities {
    double wall = 0.0;
    double other = 0.0;
  };
  void look_around(const LineMap& map, const Pose2& map_from_laser);
  Densities densities(const LineMap& map, const Beam& beam, double heading, double range, int wall,
                      double doubt_m) const;

  LikelihoodOptions options_;
  std::vector<Beam> beams_;
  bool evenly_spaced_ = true;
  double first_bearing_ = 0.0;
  double bearing_step_ = 0.0;
  double reach_ = 0.0;
  double noise_ = 0.0;      // variance of a range (m²)
  double map_noise_ = 0.0;  // variance of a wall's place (m²)
  double leave_ = 0.0;      // of the chain, from one beam looked at to the next
  double back_ = 0.0;
  double share_of_news_ = 1.0;
  Visibility visibility_;
  std::vector<double> ranges_;
  std::vector<int> walls_;
};

}  // namespace adit
