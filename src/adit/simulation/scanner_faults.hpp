#pragma once

#include "adit/geometry/pose2.hpp"

namespace adit {

/// What is wrong with a scanner that nobody states: its scans say what `ScannerSpec` does.
struct ScannerFaults {
  double repeat_after_s = -1.0;
  double repeat_s = 0.0;
  bool is_mirrored = false;
  double mount_yaw_rad = 0.0;
  double mount_x_m = 0.0;
  double mount_y_m = 0.0;
  double body_bearing_rad = 0.0;
  double body_width_rad = 0.0;
  double body_range_m = 0.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("repeat_after_s", self.repeat_after_s,
          "from this time on the scanner repeats its last scan (s); below zero: never");
    field("repeat_s", self.repeat_s, "for so long (s); 0: to the end");
    field("is_mirrored", self.is_mirrored, "bearings have the other sign: mounted upside down");
    field("mount_yaw_rad", self.mount_yaw_rad, "turned from where it is said to look (rad)");
    field("mount_x_m", self.mount_x_m, "ahead of where it is said to stand (m)");
    field("mount_y_m", self.mount_y_m, "to the left of where it is said to stand (m)");
    field("body_bearing_rad", self.body_bearing_rad,
          "middle of the bearings at which beams meet the machine itself (rad)");
    field("body_width_rad", self.body_width_rad, "width of these bearings (rad); 0: none");
    field("body_range_m", self.body_range_m, "range that they return (m)");
  }
};

}  // namespace adit
