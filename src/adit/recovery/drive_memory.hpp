#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/recovery/testimony.hpp"

namespace adit {

/// Which scans of the way are kept.
struct DriveMemoryOptions {
  double spacing_m = 2.0;
  int most_scans = 8;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("remembered_spacing_m", self.spacing_m,
          "while several poses may be the true one, a scan is kept after so much way (m): a pose "
          "that a later search finds must explain these as well");
    field("remembered_scans", self.most_scans, "so many of them are kept, the newest");
  }
};

/// What scans of the past say of a pose, the newest first.
struct Retrospect {
  std::vector<Witness> witnesses;
  int explained = 0;         ///< scans in a row that are sure of it, the newest first ...
  double explained_m = 0.0;  ///< ... and the way over them to the present
  int contradicted = 0;      ///< most in a row
};

/// Scans of the way and dead reckoning between them: what a pose of the present would have had to
/// explain, had it been known before.
class DriveMemory {
 public:
  void clear() { *this = DriveMemory{}; }
  std::size_t size() const { return scans_.size(); }

  void predict(const Pose2& move, const OdometryNoise& noise, const TrackingOptions& options);
  /// Time without dead reckoning: the vehicle may have moved by this.
  void blur(double metres, double radians);

  /// Keeps the scan where the last that is kept is far enough.
  void add(const RefinementInput& input, const DriveMemoryOptions& options);

  /// Carries a pose of the present back from scan to scan, until so many in a row refute it.
  Retrospect look_back(const PoseWithCovariance& map_from_vehicle, const FitRules& rules,
                       double sure_evidence_ratio, Refiner& refiner,
                       int scans_to_refute = std::numeric_limits<int>::max()) const;

 private:
  /// The way between two scans: the later one's pose in the earlier's frame.
  struct Way {
    PoseTracker tracker;
    double metres = 0.0;
  };
  struct Kept {
    LaserScan scan;
    ScannerModel scanner;
    MapError map_error;
    std::optional<SweepPrior> motion;
    Way since;  // until the next, or the present
  };

  std::deque<Kept> scans_;  // the oldest first
};

}  // namespace adit
