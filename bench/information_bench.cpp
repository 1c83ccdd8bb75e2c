// The Cramér-Rao bound along the paper's run, with the paper's scanner.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "adit/evaluation/bound_summary.hpp"
#include "adit/information/bound.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

/// The information from numeric derivatives of brute-force ranges. A beam of which one of the
/// displaced casts jumps over a depth edge is taken by its slope on the other side.
Matrix3d numeric_information(const std::vector<Segment>& segments, const Pose2& pose,
                             const ScannerSpec& scanner) {
  constexpr double kStep = 1e-6;
  constexpr double kJump = 1e-3;
  const double variance = scanner.model.beam_sigma_m() * scanner.model.beam_sigma_m();
  Matrix3d information = Matrix3d::Zero();
  for (int beam = 0; beam < scanner.beams; ++beam) {
    const double bearing = scanner.first_bearing + beam * scanner.bearing_step;
    const auto range_at = [&](const Vector3d& by) {
      const Pose2 moved = Pose2::from_vector(pose.vector() + by);
      return cast_ray(segments, moved.translation(), unit_vector(moved.theta + bearing));
    };
    const double here = range_at(Vector3d::Zero());
    if (!(here < scanner.model.max_range_m)) continue;
    Vector3d g;
    for (int axis = 0; axis < 3; ++axis) {
      const double ahead = range_at(kStep * Vector3d::Unit(axis)) - here;
      const double behind = here - range_at(-kStep * Vector3d::Unit(axis));
      g(axis) = (std::abs(ahead) < kJump ? ahead : behind) / kStep;
    }
    information += g * g.transpose() / variance;
  }
  return information;
}

void bound_mockup(benchmark::State& state) {
  const World world = mockup();
  const LineMap map = LineMap::build(world.plan);
  const ScannerSpec scanner = cyclone();
  const BeamFan fan{scanner.first_bearing, scanner.bearing_step, scanner.beams, {}};
  const std::vector<Pose2> path = mockup_path();
  BoundWorkspace workspace;
  std::vector<StampedPose> poses;
  for (const Pose2& pose : path) {
    poses.push_back({static_cast<double>(poses.size()), pose});
    const Matrix3d expected = numeric_information(world.plan, pose, scanner);
    const PoseBound bound = cramer_rao(map, pose, scanner.model, fan, {}, workspace);
    if ((bound.information - expected).norm() > 1e-3 * expected.norm()) {
      state.SkipWithError("the bound differs from numeric derivatives");
      return;
    }
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        cramer_rao(map, path[next++ % path.size()], scanner.model, fan, {}, workspace).information);
  }
  const BoundSummary summary = bound_along(map, poses, scanner.model, fan);
  state.counters["position_mean_m"] = summary.position_mean;
  state.counters["heading_mean_deg"] = summary.heading_mean_deg;
}
BENCHMARK(bound_mockup)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
