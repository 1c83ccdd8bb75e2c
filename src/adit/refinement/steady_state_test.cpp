// The fit must not allocate once its buffers have grown.
#include <gtest/gtest.h>

#include <vector>

#include "adit/refinement/map_error.hpp"
#include "adit/refinement/pose_search.hpp"
#include "adit/refinement/refinement.hpp"
#include "support/allocations.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

/// Pillars in rows, with walls that are drawn twice.
LineMap pillars() {
  std::vector<Segment> segments;
  for (int x = 0; x < 60; x += 8) {
    for (int y = 0; y < 60; y += 8) {
      const Vector2d corners[] = {{x, y}, {x + 4, y}, {x + 4, y + 4}, {x, y + 4}};
      for (std::size_t k = 0; k < 4; ++k) segments.push_back({corners[k], corners[(k + 1) % 4]});
      segments.push_back({Vector2d(x, y - 0.1), Vector2d(x + 4, y - 0.1)});
    }
  }
  return LineMap::build(segments);
}

/// Fits from place to place, standing and on the move, and all that goes with a fit.
class Drive {
 public:
  Drive() {
    scan_.first_bearing = -kPi;
    scan_.bearing_step = kTwoPi / 720.0;
    scan_.max_range = 30.0;
    for (int i = 0; i < 720; ++i) scan_.ranges.push_back(3.0 + 0.01 * i);
    scanner_.max_range_m = 30.0;
    moving_ = scanner_;
    moving_.sweep_s = 0.2;
    motion_.path = steady_path({3.0, 0.0, 0.4}, sweep_timing(moving_, 720), 720);
    motion_.covariance = 0.01 * Matrix3d::Identity();
  }

  void run() {
    for (double x = 6.0; x < 50.0; x += 1.7 * test::kFewer) {
      fit(x, scanner_, {});
      fit(x, moving_, motion_);
    }
  }

 private:
  void fit(double x, const ScannerModel& scanner, const std::optional<SweepPrior>& motion) {
    const PoseWithCovariance prior{{x, 30.0, 0.1 * x}, 0.04 * Matrix3d::Identity()};
    const RefinementInput input{map_, scan_, scanner, stated_, motion};
    const PoseLattice lattice(prior, {});
    const PoseWithCovariance start{
        refiner_.most_likely(input, prior, lattice.poses(), lattice.spread(), {}),
        lattice.spread()};
    refiner_.refine(input, prior, start, {});
    refiner_.worst_walls(3);
    error_.add(refiner_.beams(), refiner_.on_wall(), scanner, prior.covariance);
  }

  LineMap map_ = pillars();
  LaserScan scan_;
  ScannerModel scanner_;
  ScannerModel moving_;
  SweepPrior motion_;
  Refiner refiner_;
  MapError stated_{0.05, 1.5, 0.01};  // the same in every run, so that all else is the same
  MapErrorEstimator error_;
};

TEST(SteadyState, RefinementAllocatesNothing) {
  Drive drive;
  drive.run();
  const long before = test::allocations();
  ASSERT_GT(before, 0);
  drive.run();
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace adit
