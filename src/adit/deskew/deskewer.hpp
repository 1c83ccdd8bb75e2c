#pragma once

#include <vector>

#include "adit/motion/twist.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/returns.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/scan/sweep_timing.hpp"

namespace adit {

/// Which returns of a sweep are out of sight from where the scanner is at the stamp.
struct DeskewOptions {
  double hidden_depth_m = 0.5;
  double hidden_sigmas = 5.0;
  int surface_beams = 3;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("hidden_depth_m", self.hidden_depth_m,
          "a return at least so far behind a surface is hidden by it (m), beside the noise");
    field("hidden_sigmas", self.hidden_sigmas,
          "the noise that is allowed for, in sigmas of a range");
    field("surface_beams", self.surface_beams,
          "returns at most so many beams apart are one surface, that hides what is behind it");
  }
};

/// A scan that was taken on the move, as the scanner would have taken it at rest at the scan's
/// stamp.
///
/// Each return is carried from where the laser was at its own time into the laser's frame at the
/// stamp, with the lever arm of the mounting. Keeps its buffers, and the beams' directions: scans
/// of the same fan allocate nothing.
class Deskewer {
 public:
  /// `out` (not `scan` itself) gets the beams of `scan` in their order, each with its own bearing
  /// (see `LaserScan`); the turn may spread them over more than a circle or less. `twist` is the
  /// vehicle's. Without a sweep or a motion, or with one that is not finite, `out` is the scan.
  ///
  /// Returns that another surface hides from the stamp's place become "no return", and so do those
  /// that end up out of range: nothing that is said of a scan from there, such as what the map
  /// shows, has them. All others stay as they are, even where they step back in bearing: dust and
  /// the noise of near returns hide nothing, and to drop or shift one of two would bias the wall.
  /// What had no return keeps its range, and has the bearing of something very far away.
  void deskew(const LaserScan& scan, const ScannerModel& scanner, const Twist2& twist,
              const DeskewOptions& options, LaserScan& out);

 private:
  void prepare_directions(const LaserScan& scan);
  void carry_beams(const LaserScan& scan, const SweepTiming& timing, const Twist2& laser_twist,
                   LaserScan& out) const;
  void lay_slots(const LaserScan& scan, double turn);
  void find_surfaces(const LaserScan& scan, int widest);
  void drop_hidden(double depth, LaserScan& scan) const;
  /// The place of a bearing in the depth buffer, in beams from its first.
  double slot(double bearing) const { return (bearing - first_slot_) * slots_per_radian_; }

  ReturnLimits limits_;
  bool evenly_spaced_ = false;  // the fan whose directions are kept
  double first_bearing_ = 0.0;
  double bearing_step_ = 0.0;
  std::vector<Vector2d> directions_;  // of evenly spaced beams, in the laser's frame of their time
  double first_slot_ = 0.0;           // its bearing (rad)
  double slots_per_radian_ = 0.0;
  std::vector<double> nearest_;  // depth buffer: the farther end of the nearest surface (m)
};

}  // namespace adit
