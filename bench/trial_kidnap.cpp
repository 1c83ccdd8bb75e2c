#include "trial_kidnap.hpp"

#include <algorithm>

#include "adit/simulation/carried_off.hpp"
#include "trial_fault.hpp"

namespace adit {
namespace {

// Streams of the seed, and what is added to it for the second recording.
constexpr std::uint64_t kKidnap = 26;
constexpr std::uint64_t kWrongStart = 27;
constexpr std::uint64_t kSecondRecording = 1000000007;

constexpr int kTries = 500;
constexpr int kPosesBefore = 8;
constexpr int kPosesAfter = 24;
constexpr double kElsewhere = 3.0;  // m

/// A part of the path: the poses [first, last).
struct Section {
  int first = 0;
  int last = 0;
};

std::span<const Pose2> poses_of(const World& world, const Section& section) {
  return std::span(world.path)
      .subspan(static_cast<std::size_t>(section.first),
               static_cast<std::size_t>(section.last - section.first));
}

/// What the vehicle drives before and after it is carried off.
struct Kidnapping {
  Section before;
  Section after;
};

std::optional<Kidnapping> draw_kidnapping(const TrialScene& scene, const LineMap& map,
                                          Random& random) {
  constexpr int kFewest = 4;  // poses after
  RangeComparison ranges(fan_of(scene.scanner), scene.scanner.model.max_range_m);
  const int poses = static_cast<int>(scene.world.path.size());
  for (int i = 0; i < kTries && poses > kFewest; ++i) {
    const int from = 3 + random.below(poses - 3);  // at least two poses before, none the first
    const int to = random.below(poses - kFewest + 1);
    const Pose2& believed = scene.world.path[static_cast<std::size_t>(from - 1)];
    const Pose2& truth = scene.world.path[static_cast<std::size_t>(to)];
    const double hop = (truth.translation() - believed.translation()).norm();
    if (hop < kElsewhere || !contradicts(ranges, map, truth, believed)) continue;
    return Kidnapping{{std::max(1, from - kPosesBefore), from},
                      {to, std::min(poses, to + kPosesAfter)}};
  }
  return std::nullopt;
}

}  // namespace

std::optional<TrialRun> kidnapped_run(TrialScene scene, std::uint64_t seed) {
  Random random(seed, kKidnap);
  TrialRun run;
  run.map = LineMap::build(scene.world.plan);
  const auto kidnapping = draw_kidnapping(scene, run.map, random);
  if (!kidnapping) return std::nullopt;
  Recording before = record(scene, poses_of(scene.world, kidnapping->before), seed);
  if (before.scans.size() < 2) return std::nullopt;
  const Recording after =
      record(scene, poses_of(scene.world, kidnapping->after), seed + kSecondRecording);
  run.start = before.first_guess;
  run.affected.assign(before.scans.size(), false);
  const Pose2 driven_on = last_move(before);
  run.recording = carried_off(std::move(before), after, driven_on);
  run.affected.resize(run.recording.scans.size(), true);
  run.scene = std::move(scene);
  return run;
}

std::optional<TrialRun> wrongly_started_run(TrialScene scene, std::uint64_t seed) {
  Random random(seed, kWrongStart);
  TrialRun run;
  run.map = LineMap::build(scene.world.plan);
  const int poses = static_cast<int>(scene.world.path.size());
  const int first = random.below(poses);
  const auto start =
      draw_wrong_start(scene, run.map, scene.world.path[static_cast<std::size_t>(first)], random);
  if (!start) return std::nullopt;
  const Section section{first, std::min(poses, first + kPosesAfter)};
  run.recording = record(scene, poses_of(scene.world, section), seed);
  run.start = *start;
  run.affected.assign(run.recording.scans.size(), true);
  run.scene = std::move(scene);
  return run;
}

std::optional<PoseWithCovariance> draw_wrong_start(const TrialScene& scene, const LineMap& map,
                                                   const Pose2& truth, Random& random) {
  RangeComparison ranges(fan_of(scene.scanner), scene.scanner.model.max_range_m);
  const double metres = scene.drive.first_guess_sigma_m;
  const double turn = scene.drive.first_guess_sigma_rad;
  for (int i = 0; i < kTries; ++i) {
    const Vector2d direction = unit_vector(random.uniform(-kPi, kPi));
    const Vector2d place = truth.translation() + random.uniform(kElsewhere, 8.0) * direction;
    const Pose2 start{place.x(), place.y(), random.uniform(-kPi, kPi)};
    if (!is_open(scene.world.plan, place) || !contradicts(ranges, map, truth, start)) continue;
    return PoseWithCovariance{start,
                              Vector3d(metres * metres, metres * metres, turn * turn).asDiagonal()};
  }
  return std::nullopt;
}

}  // namespace adit
