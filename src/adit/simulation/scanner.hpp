#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/simulation/random.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner_faults.hpp"
#include "adit/simulation/timed_path.hpp"

namespace adit {

/// A scanner: its beams, its noise, what goes wrong.
struct ScannerSpec {
  int beams = 1000;
  double first_bearing = -kPi;          ///< rad, laser frame
  double bearing_step = kTwoPi / 1000;  ///< rad; below zero turns clockwise
  ScannerModel model;
  Pose2 vehicle_from_laser;
  double dropout_ratio = 0.0;
  double dust_ratio = 0.0;
  double dust_range_m = 3.0;
  ScannerFaults faults;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("beams", self.beams, "beams in a sweep");
    field("first_bearing", self.first_bearing, "bearing of the first beam (rad)");
    field("bearing_step", self.bearing_step, "from one beam to the next (rad)");
    ScannerModel::visit(self.model, field);
    field("dropout_ratio", self.dropout_ratio, "share of the beams that bring no return");
    field("dust_ratio", self.dust_ratio, "share of the beams that dust sends back early");
    field("dust_range_m", self.dust_range_m, "mean range of those, exponential (m)");
    ScannerFaults::visit(self.faults, field);
  }
};

/// The paper's scanner (section IV-B): 1000 beams over 360°, 50 m, steps of 0.1 m; its accuracy of
/// ±0.2 m is taken as two sigma.
ScannerSpec cyclone();

/// SICK-like: 1081 beams over 270°, sigma 15 mm, 80 m.
ScannerSpec sick();

/// SICK LMS 200-like, as in many public logs: 181 beams over 180°, sigma 15 mm, steps of 10 mm, 80
/// m.
ScannerSpec sick_lms();

/// Hokuyo-like: 728 beams over 240°, sigma 30 mm, 30 m.
ScannerSpec hokuyo();

/// The scanner as it really is, by its faults: upside down, turned, elsewhere (vehicle frame).
ScannerSpec as_mounted(const ScannerSpec& stated);

/// "cyclone", "sick", "sick_lms" or "hokuyo"; nothing for any other name.
std::optional<ScannerSpec> scanner_named(std::string_view name);

/// How long before a scan's stamp its first beam is taken (s).
double first_beam_lead(const ScannerSpec& spec);

/// What the scanner reports for a surface at `range` metres, or for none at infinity: noise, steps,
/// drop-outs and dust.
double reported_range(double range, const ScannerSpec& spec, Random& random);

/// A scan of a vehicle at rest. A beam without return is stored as the maximum range. `moving` are
/// outlines that are not in `fixed`, such as people at this time. The scanner's faults are in it,
/// but for repetition, which is of recordings.
LaserScan simulate_scan(const RayCaster& fixed, const Pose2& map_from_vehicle,
                        const ScannerSpec& spec, Random& random,
                        std::span<const Segment> moving = {});

/// A scan of a vehicle on the move: each beam from where the vehicle is at its own time.
LaserScan simulate_sweep(const RayCaster& fixed, const TimedPath& map_from_vehicle, double stamp,
                         const ScannerSpec& spec, Random& random,
                         std::span<const Segment> moving = {});

}  // namespace adit
