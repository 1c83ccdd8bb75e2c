#include "one_scan.hpp"

#include <algorithm>
#include <chrono>

#include "adit/refinement/map_error.hpp"
#include "adit/relocation/relocator.hpp"
#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kNoise = 41;  // stream of the seed

constexpr std::size_t kScans = 20;

bool is_right(const Pose2& pose, const Pose2& truth) {
  constexpr double kMetres = 1.0;
  constexpr double kRadians = radians(5.0);
  const Vector3d off = difference(truth, pose);
  return off.head<2>().norm() <= kMetres && std::abs(off.z()) <= kRadians;
}

/// Where scans of a cell that are of no place of the plan are taken.
Mine other_than(Mine mine) { return mine == Mine::niosh ? Mine::edgar : Mine::niosh; }

struct SingleScan {
  LaserScan scan;
  Pose2 truth;
};

/// A scan at a place, with clutter that only this one meets.
SingleScan take_scan(const Cell& cell, std::uint64_t seed, const Pose2& place,
                     const RayCaster& caster, const Scene& mine) {
  Scene here;
  here.world.walls = mine.world.walls;
  here.path = {place};
  add_things(cell, seed, here);
  Random noise(seed, kNoise);
  return {simulate_scan(caster, place, mine.scanner, noise, here.world.clutter), place};
}

void count(const RelocationResult& found, const Pose2* truth, double seconds, DriveCounts& counts) {
  const auto right = [&](const RankedPose& pose) { return truth && is_right(pose.pose, *truth); };
  const bool is_first = !found.poses.empty() && right(found.poses.front());
  ++counts.scans;
  counts.seconds.add(seconds);
  counts.first += is_first ? 1 : 0;
  counts.listed += std::any_of(found.poses.begin(), found.poses.end(), right) ? 1 : 0;
  counts.ok += found.verdict == Status::ok ? 1 : 0;
  counts.degraded += found.verdict == Status::degraded ? 1 : 0;
  counts.ambiguous += found.verdict == Status::ambiguous ? 1 : 0;
  counts.lost += found.verdict == Status::lost ? 1 : 0;
  const bool is_answer = found.verdict == Status::ok || found.verdict == Status::degraded;
  counts.wrong += is_answer && !is_first ? 1 : 0;
}

}  // namespace

Result<DriveCounts> run_single_scans(const Cell& cell, Grounds& grounds, std::uint64_t base_seed,
                                     std::int64_t drive) {
  using Clock = std::chrono::steady_clock;
  const bool is_outside = cell.task == Task::outside;
  const auto sought_in = grounds.of(cell.mine, drive);
  if (!sought_in) return tl::unexpected(sought_in.error());
  const auto taken_in = is_outside ? grounds.of(other_than(cell.mine), drive) : sought_in;
  if (!taken_in) return tl::unexpected(taken_in.error());
  const std::uint64_t seed = seed_of(cell, base_seed, drive);
  Scene mine;
  mine.ground = *taken_in;
  mine.world = (*taken_in)->world;
  mine.scanner = scanner_named(cell.scanner).value_or(sick());
  if (!apply_plan_error(cell, seed, mine)) return fail("the plan's error finds no place");
  const RayCaster caster(mine.world.walls);
  MapErrorOptions stated;
  stated.sigma_m = cell.stated_m;
  const MapError map_error = MapErrorEstimator(stated).error();
  Relocator relocator((*sought_in)->map, *(*sought_in)->index);
  DriveCounts counts;
  counts.drive = drive;
  const std::vector<Pose2>& places = (*taken_in)->places;
  for (std::size_t i = 0; i < kScans; ++i) {
    const Pose2& place = places[(static_cast<std::size_t>(drive) * kScans + i) % places.size()];
    const SingleScan one = take_scan(cell, seed + i, place, caster, mine);
    const auto start = Clock::now();
    const RelocationResult& found =
        relocator.locate({one.scan, mine.scanner.model, map_error, {}, {}});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    count(found, is_outside ? nullptr : &one.truth, seconds, counts);
  }
  return counts;
}

}  // namespace adit
