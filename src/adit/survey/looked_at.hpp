#pragma once

#include <optional>

#include "adit/map/box.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/survey/posed_scan.hpp"

namespace adit {

/// A part of a segment, along it from its beginning.
struct SegmentPart {
  double from_m = 0.0;
  double to_m = 0.0;

  double length_m() const { return to_m - from_m; }
};

/// Extends a box by all of a scan's beams that met something.
void extend_by_beams(const PosedScan& posed, const ScannerModel& scanner, Box& box);

/// The part of a segment that lies in a box (Liang and Barsky 1984); nothing where none does.
std::optional<SegmentPart> stretch_within(const Segment& s, const Box& box);

/// That part as a segment of its own.
Segment piece_of(const Segment& s, const SegmentPart& stretch);

}  // namespace adit
