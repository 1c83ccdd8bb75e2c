#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/survey/station_headings.hpp"
#include "adit/survey/station_tilt.hpp"
#include "adit/survey/walls.hpp"

namespace adit {

/// Which headings of the given poses are believed.
enum class GivenHeadings {
  automatic,  ///< none if all are the same, as in a list of positions alone
  none,
  all,
};

/// A survey from known positions: section IV-F of Shaffer et al. 1992.
struct KnownPositionsOptions {
  GivenHeadings headings = GivenHeadings::automatic;
  double same_station_m = 0.05;
  double turn_within_station_rad = kPi;
  int rounds = 15;
  int min_scans = 2;
  double min_hits_per_m = 5.0;
  double gap_m = 1.5;
  double least_agreement = 0.05;
  HeadingOptions search;
  TiltOptions tilt;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("headings", self.headings, "which headings of the given poses are believed");
    field("same_station_m", self.same_station_m,
          "scans from positions nearer than this are of one station (m)");
    field("turn_within_station_rad", self.turn_within_station_rad,
          "how far the scanner may turn between the scans of a station (rad)");
    field("rounds", self.rounds,
          "how often at most scans are turned and levelled against the walls and the walls made "
          "anew: "
          "until the stations stay, as those of one gallery turn together and slowly");
    field("min_scans", self.min_scans,
          "as of walls from a drive; less, as few scans come from known positions");
    field("min_hits_per_m", self.min_hits_per_m, "as of walls from a drive; less, for the same");
    field("gap_m", self.gap_m,
          "as of walls from a drive; more, as far walls are met by few beams (m)");
    field("least_agreement", self.least_agreement,
          "a station that agrees less with the others, of 1, is left out of the walls");
    HeadingOptions::visit(self.search, field);
    TiltOptions::visit(self.tilt, field);
  }
};

/// A scan taken at a known position.
struct PositionedScan {
  LaserScan scan;
  Vector2d position = Vector2d::Zero();  ///< of the vehicle, in the map
  std::optional<double> heading;         ///< rad, where it is known roughly
  bool has_own_pose = true;              ///< else that of its station
};

/// Gives each scan its position.
///
/// A scan whose stamp a pose has (within 1 ms) takes that pose. Where there are fewer poses than
/// scans, the others take the pose of their station: the last one before if the first scan has a
/// pose of its own, the next one after if only the last scan has, else the nearest in time.
/// An Error where there are no poses.
Result<std::vector<PositionedScan>> place_scans(std::span<const LaserScan> scans,
                                                std::span<const StampedPose> poses,
                                                GivenHeadings headings);

/// What was found of one scan.
struct SurveyedScan {
  std::size_t scan = 0;  ///< its number among those given
  int station = 0;
  Pose2 map_from_vehicle;
  ScanTilt tilt;
};

/// What was found of one station.
struct SurveyedStation {
  Vector2d position = Vector2d::Zero();
  StationHeading heading;  ///< of its first scan
  int scans = 0;
  bool placed = true;  ///< whether its heading was found: else its scans are in no wall
};

struct KnownPositionsSurvey {
  std::vector<SurveyedStation> stations;
  std::vector<SurveyedScan> scans;  ///< in the order given
  WallMap walls;
  std::vector<PosedScan> levelled;  ///< what the walls are made of: scans of placed stations
  std::vector<int> visits;          ///< of these, ascending: their stations
};

/// Scans from known positions to walls: headings within each station, then of the stations, then
/// each scan against the walls of all, tilts and what they sent to roof and floor, and the walls.
/// An Error where fewer than two stations hold a scan with returns, or where no two agree.
Result<KnownPositionsSurvey> survey_known_positions(std::span<const PositionedScan> scans,
                                                    const ScannerModel& scanner,
                                                    const KnownPositionsOptions& options = {},
                                                    const WallOptions& walls = {},
                                                    const SurveyProgress& progress = {});

}  // namespace adit
