#pragma once

#include <cstddef>

#include "adit/relocation/options.hpp"
#include "adit/relocation/relocation_result.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// What is left of the stated error of a plan where this much suits a scan best; none where none is
/// stated.
double error_ratio(const MapError& error, const MapError& stated);

/// The share of all bearings in which something came back.
double turn_in_sight(const LaserScan& scan, const ScannerModel& scanner);

/// Says of found poses, weighed and the best one examined, whether one of them is the place.
///
/// Of all places of a mine one will resemble any scan: it is a little better than the next, sees
/// through walls here and there, needs a plan that errs and explains part of the scan. Together
/// these say how long a lead over the next one is asked. The lead that chance makes falls off
/// exponentially, the slower the less of a turn the scan sees (measured with scans of other mines,
/// of 180 to 360 degrees). `places` is how many were compared.
Status judge_place(const RelocationResult& found, const RelocationQuery& query, std::size_t places,
                   const RelocationOptions& options, const StatusOptions& status);

}  // namespace adit
