#pragma once

#include <vector>

#include "adit/extraction/corner_operator.hpp"
#include "adit/extraction/scan_points.hpp"
#include "adit/features/features.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// What counts as a feature of a scan.
struct ExtractionOptions {
  double roughness_m = 0.0;
  double min_operator_m = 0.4;
  double max_operator_m = 3.0;
  double corner_chi_square = 25.0;
  double straight_sigmas = 4.0;
  double min_corner_turn_rad = 0.26;
  double min_line_m = 0.3;
  int min_line_points = 4;
  double grazing_rad = 0.15;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("roughness_m", self.roughness_m,
          "how far the wall itself strays from straight, one sigma (m); 0 for built walls");
    field("min_operator_m", self.min_operator_m,
          "smallest arm of the corner operator (m); the paper's columns of 0.4 m");
    field("max_operator_m", self.max_operator_m,
          "largest arm of the corner operator (m); the paper's survey of a real mine");
    field("corner_chi_square", self.corner_chi_square,
          "two lines instead of one must explain this much more chi-square; 25 lets one in 270,000 "
          "straight windows through");
    field("straight_sigmas", self.straight_sigmas,
          "a stretch is straight while its chi-square is below its mean plus this many sigmas");
    field("min_corner_turn_rad", self.min_corner_turn_rad,
          "the wall turns at least this much at a corner (rad); 15 degrees");
    field("min_line_m", self.min_line_m, "shorter lines are dropped (m)");
    field("min_line_points", self.min_line_points, "lines of fewer points are dropped");
    field("grazing_rad", self.grazing_rad,
          "neighbouring points belong to one wall if it could be met at this grazing angle (rad)");
  }
};

/// Feature extraction (the paper, III-E): from a scan to its corners and lines, counter-clockwise,
/// in the laser's frame, each with its covariance from the noise of its points.
///
/// Breakpoints cut the scan into pieces; the corner operator, in sizes from `min_operator_m` to
/// `max_operator_m`, cuts pieces into straight stretches; lines are fitted to the stretches and
/// meet in corners. Keeps its buffers: scans of the same size allocate nothing.
class Extractor {
 public:
  /// The result views the extractor's buffer and holds until the next call.
  const FeatureList& extract(const LaserScan& scan, const ScannerModel& scanner,
                             const ExtractionOptions& options);

  /// The features of the last scan; none before the first.
  const FeatureList& features() const { return features_; }

  /// The points of the last scan, for pictures and tests.
  const ScanPoints& points() const { return points_; }

 private:
  void set_operator_sizes(const ExtractionOptions& options);
  void cut_into_stretches(const ExtractionOptions& options);
  void fit_lines(const ExtractionOptions& options);
  void join_lines(const ExtractionOptions& options);
  bool add_corner(std::size_t stretch, std::size_t next, const ExtractionOptions& options);
  void add_edge(std::size_t stretch, int arm);
  std::size_t next_line(std::size_t stretch) const;
  bool is_cut_between(std::size_t stretch, int step) const;

  ScanPoints points_;
  CornerOperator operator_;
  std::vector<double> sizes_;
  std::vector<std::size_t> cuts_;
  std::vector<ScanStretch> stretches_;
  std::vector<std::size_t> piece_;   // of each stretch
  std::vector<int> line_;            // of each stretch, or -1
  std::vector<char> begins_joined_;  // whether the stretch's line begins in a corner
  FeatureList features_;
};

}  // namespace adit
