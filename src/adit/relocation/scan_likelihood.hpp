#pragma once

#include <span>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/places/wall_field.hpp"
#include "adit/refinement/beam_chain.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/offset_process.hpp"
#include "adit/relocation/options.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// What becomes of a scan's beams at a pose, as shares of its returns; `missing` of the beams that
/// should have met a wall well within reach. Counted only where neither the map's error nor a pose
/// that is a little off explains it.
struct BeamShares {
  double on_wall = 0.0;
  double before = 0.0;    ///< something stands there
  double through = 0.0;   ///< from behind the map's wall: no clutter makes a beam longer
  double unmapped = 0.0;  ///< where the map has nothing in reach
  double missing = 0.0;
  double returns = 0.0;
};

/// How likely a scan is from a pose, comparable between any two poses of a map.
///
/// Each beam meets the map's wall, something else, or a wall behind one that is gone, in a chain
/// along the sweep. The wall's offset from the map, which neighbouring beams share, is tracked
/// along it: a wall that lies a hand's breadth off speaks once against a pose, not once a beam. A
/// return where the map has nothing, and none where it has a wall, speak against it as well.
class ScanLikelihood {
 public:
  /// Takes the scan, of which it looks at a hundred beams or so. `priors` as of the fits.
  void set_scan(const LaserScan& scan, const ScannerModel& scanner, const MapError& error,
                const LikelihoodOptions& options, const BeamPriors& priors = {});

  /// Where walls may be gone, those behind them are looked up here.
  void set_walls(const WallField& walls) { field_ = &walls; }

  /// Log of the probability density of the beams if the scanner is at most about `doubt_m` off.
  double at(const LineMap& map, const Pose2& map_from_laser, double doubt_m);

  /// The same, at the most likely of the map's errors that are these parts of the one stated; says
  /// which.
  struct Best {
    double log_likelihood = 0.0;
    double error_ratio = 1.0;
  };
  Best best_at(const LineMap& map, const Pose2& map_from_laser, double doubt_m,
               std::span<const double> error_ratios);

  /// The beams at a pose that is at most about `doubt_m` off.
  BeamShares shares_at(const LineMap& map, const Pose2& map_from_laser, double doubt_m);

  /// The same scan against a map that errs by so much.
  void set_map_error(const MapError& error);

  /// How much of what the beams say is news: the more, the less the plan errs of what is stated.
  double share_of_news() const;

 private:
  struct Beam {
    double bearing = 0.0;  // rad, laser axes
    double range = 0.0;    // m; the scanner's reach without return
    bool has_return = false;
  };
  /// The wall of the map that a beam should meet, and the one nearest to what it met.
  struct Sight {
    double range = 0.0;          // m; infinity where there is none in reach
    double cosine = 1.0;         // of the angle of incidence
    double same_off = 0.0;       // correlation of the wall's offset with that at the beam before
    double beyond_off = 0.0;     // along the beam, from another wall behind the first (m)
    double beyond_cosine = 0.0;  // zero where there is no such wall
  };
  /// The offset of the wall that the last beams met, away from the scanner.
  struct Offset {
    double mean = 0.0;  // m
    double variance = 0.0;
  };
  void look_around(const LineMap& map, const Pose2& map_from_laser);
  std::size_t ray_of(std::size_t beam, double heading) const;
  void look_beyond(const Beam& beam, const Vector2d& laser, const Vector2d& direction, int wall,
                   Sight& sight) const;
  double in_sight(double doubt_m) const;
  Vector3d densities(const Beam& beam, const Sight& sight, const Offset& offset,
                     double doubt_m) const;
  void follow(const Beam& beam, const Sight& sight, double on_wall, double doubt_m,
              Offset& offset) const;

  LikelihoodOptions options_;
  BeamPriors priors_;
  double stated_noise_ = 0.0;  // variance of the map's error as it was stated (m²)
  std::vector<Beam> beams_;
  bool evenly_spaced_ = true;
  double first_bearing_ = 0.0;
  double bearing_step_ = 0.0;
  double reach_ = 0.0;
  double noise_ = 0.0;                    // variance of a range (m²)
  double map_noise_ = 0.0;                // variance of a wall's place (m²)
  OffsetProcess process_;                 // the part of it that neighbours share
  Matrix3d next_ = Matrix3d::Identity();  // of the chain: to the next (row) from what one beam met
  const WallField* field_ = nullptr;
  Visibility visibility_;
  std::vector<Sight> sights_;
  std::vector<double> ranges_;
  std::vector<int> walls_;
  std::vector<double> dense_ranges_;
  std::vector<int> dense_walls_;
};

}  // namespace adit
