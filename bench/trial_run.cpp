#include "trial_run.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr std::uint64_t kGuesses = 22;  // stream of the seed

constexpr double kNearIntersection = 4.0;  // m, docs/benchmarks.md: at and near intersections

bool is_near(const std::vector<Vector2d>& places, const Vector2d& point) {
  return std::any_of(places.begin(), places.end(), [&](const Vector2d& place) {
    return (place - point).norm() <= kNearIntersection;
  });
}

/// What is known before a scan that stands alone: a draw about the truth.
PoseWithCovariance draw_guess(const Pose2& truth, const DriveOptions& drive, Random& random) {
  const Vector3d sigma(drive.first_guess_sigma_m, drive.first_guess_sigma_m,
                       drive.first_guess_sigma_rad);
  Vector3d error;
  for (double& value : error) value = random.normal();
  return {Pose2::from_vector(truth.vector() + error.cwiseProduct(sigma)),
          Matrix3d(sigma.cwiseAbs2().asDiagonal())};
}

/// Writes answers down beside the truth.
class Recorder {
 public:
  Recorder(const TrialRun& run, std::uint64_t seed, std::vector<Answer>& answers)
      : run_(run), seed_(seed), answers_(answers) {}

  void add(std::size_t scan, const Estimate& estimate, double seconds) {
    Answer answer;
    answer.seed = seed_;
    answer.scan = scan;
    answer.truth = run_.recording.truth[scan].pose;
    answer.pose = estimate.pose;
    answer.covariance = estimate.covariance;
    answer.status = estimate.status;
    answer.protection_m = estimate.protection_m;
    answer.seconds = seconds;
    answer.near_intersection = is_near(run_.scene.intersections, answer.truth.translation());
    answers_.push_back(answer);
  }

 private:
  const TrialRun& run_;
  std::uint64_t seed_;
  std::vector<Answer>& answers_;
};

/// Feeds what the wheels said until the scan's last beam was taken.
class WheelFeed {
 public:
  explicit WheelFeed(const TrialRun& run)
      : wheels_(run.recording.wheels),
        tail_s_(run.scene.scanner.model.sweep_s - first_beam_lead(run.scene.scanner)) {}

  void feed(double scan_stamp, Localizer& localizer) {
    constexpr double kSameTime = 1e-9;  // s
    while (next_ < wheels_.size() && wheels_[next_].stamp <= scan_stamp + tail_s_ + kSameTime) {
      localizer.add_odometry(wheels_[next_++]);
    }
  }

 private:
  const std::vector<StampedPose>& wheels_;
  double tail_s_;
  std::size_t next_ = 0;
};

void track(const TrialRun& run, Recorder& recorder) {
  const Recording& recording = run.recording;
  Localizer localizer(run.map, run.scene.settings);
  localizer.start(run.start.pose, run.start.covariance);
  WheelFeed wheels(run);
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const LaserScan& scan = recording.scans[i];
    if (run.feeds_wheels) wheels.feed(scan.stamp, localizer);
    const Estimate& estimate =
        run.feeds_wheels ? localizer.update(scan) : localizer.update(scan, recording.odometry[i]);
    recorder.add(i, estimate, localizer.last_turn().timings.total());
  }
}

/// A localizer for each scan, so that nothing learnt from one serves another.
void locate_each(const TrialRun& run, std::uint64_t seed, Recorder& recorder) {
  Random random(seed, kGuesses);
  for (std::size_t i = 0; i < run.recording.scans.size(); ++i) {
    const Pose2& truth = run.recording.truth[i].pose;
    const PoseWithCovariance guess = draw_guess(truth, run.scene.drive, random);
    Localizer localizer(run.map, run.scene.settings);
    localizer.start(guess.pose, guess.covariance);
    const Estimate& estimate = localizer.update(run.recording.scans[i]);
    recorder.add(i, estimate, localizer.last_turn().timings.total());
  }
}

}  // namespace

TrialRun plain_run(TrialScene scene, std::uint64_t seed) {
  TrialRun run;
  run.map = LineMap::build(scene.world.plan);
  run.recording = record(scene, scene.world.path, seed);
  run.start = run.recording.first_guess;
  run.scene = std::move(scene);
  return run;
}

BeamFan fan_of(const ScannerSpec& scanner) {
  return {scanner.first_bearing, scanner.bearing_step, scanner.beams, scanner.vehicle_from_laser};
}

void localise(const TrialRun& run, const TrialOptions& options, std::uint64_t seed,
              std::vector<Answer>& answers) {
  Recorder recorder(run, seed, answers);
  if (options.mode == TrialMode::tracking) {
    track(run, recorder);
  } else {
    locate_each(run, seed, recorder);
  }
}

}  // namespace adit
