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
  return {simulate_scan(caster, place, mine.scanner(), noise, here.world.clutter), place};
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

/// Places of a drive: the next of the list; where the plan lacks a part, those in its middle.
std::vector<Pose2> places_of(const Cell& cell, std::int64_t drive, Scene& mine) {
  constexpr double kWithin = 8.0;  // m
  const std::vector<Pose2>& all = mine.ground->places;
  const std::size_t first = static_cast<std::size_t>(drive) * kScans;
  std::vector<Pose2> places;
  if (cell.plan != PlanError::off_plan) {
    for (std::size_t i = 0; i < kScans; ++i) places.push_back(all[(first + i) % all.size()]);
    return places;
  }
  mine.path = {all[first % all.size()]};
  const DriveMap& ways = mine.ground->ways;
  for (std::size_t i = 0; i < ways.size() && places.size() < kScans; ++i) {
    if ((ways.place(i) - mine.path.front().translation()).norm() > kWithin) continue;
    const double heading = wrap_angle(2.4 * static_cast<double>(i));
    places.push_back({ways.place(i).x(), ways.place(i).y(), heading});
  }
  return places;
}

}  // namespace

Result<DriveCounts> run_single_scans(const Cell& cell, Grounds& grounds, std::uint64_t base_seed,
                                     std::int64_t drive) {
  using Clock = std::chrono::steady_clock;
  const bool is_outside = cell.task == Task::outside;
  const auto sought_in = grounds.of(cell.mine, drive);
  if (!sought_in) return tl::unexpected(sought_in.error());
  const auto taken_in =
      cell.task == Task::outside ? grounds.of(other_than(cell.mine), drive) : sought_in;
  if (!taken_in) return tl::unexpected(taken_in.error());
  const std::uint64_t seed = seed_of(cell, base_seed, drive);
  Scene mine;
  mine.ground = *taken_in;
  mine.world = (*taken_in)->world;
  mine.scanners = faulty_scanners(cell, 0.0);
  const std::vector<Pose2> places = places_of(cell, drive, mine);
  if (!apply_plan_error(cell, seed, mine)) return fail("the plan's error finds no place");
  const RayCaster caster(mine.world.walls);
  MapErrorOptions stated;
  stated.sigma_m = cell.stated_m;
  const MapError map_error = MapErrorEstimator(stated).error();
  const LineMap& map = mine.own_map ? *mine.own_map : (*sought_in)->map;
  Relocator relocator(map, mine.own_map ? *mine.own_index : *(*sought_in)->index);
  DriveCounts counts;
  counts.drive = drive;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SingleScan one = take_scan(cell, seed + i, places[i], caster, mine);
    const auto start = Clock::now();
    const RelocationResult& found =
        relocator.locate({one.scan, mine.scanner().model, map_error, {}, {}});
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    count(found, is_outside ? nullptr : &one.truth, seconds, counts);
  }
  return counts;
}

}  // namespace adit
