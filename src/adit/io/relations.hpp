#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"

namespace adit {

/// Where the vehicle stood at one stamp, seen from where it stood at another (Kümmerle et al.
/// 2009).
struct PoseRelation {
  double from_stamp = 0.0;
  double to_stamp = 0.0;
  Pose2 from_to;
};

/// Reads relations of the form `t1 t2 x y z roll pitch yaw` a line (m, rad), `#` comments; z, roll
/// and pitch are ignored. Errors name the line: a row that is not eight finite numbers, no row at
/// all.
Result<std::vector<PoseRelation>> read_relations(const std::string& path);

/// The same from text; `file` is the name in errors.
Result<std::vector<PoseRelation>> parse_relations(std::string_view text,
                                                  const std::string& file = {});

}  // namespace adit
