#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kLasting = 64;  // stream of the seed

bool is_paper(Wheels wheels) { return wheels == Wheels::paper || wheels == Wheels::paper_bursts; }

}  // namespace

OdometryNoise noise_of(Wheels wheels) {
  if (is_paper(wheels)) return mockup_odometry();
  OdometryNoise noise;
  noise.translation_sigma_ratio = 0.02;
  noise.rotation_sigma_rad_per_m = radians(0.5);
  noise.rotation_sigma_ratio = 0.0;
  noise.translation_floor_m = 0.0;
  noise.rotation_floor_rad = 0.0;
  return noise;
}

OdometryFaults wheel_faults(Wheels wheels, double drive_s, std::uint64_t seed) {
  constexpr double kLastingSigma = 0.01;
  OdometryFaults faults;
  Random random(seed, kLasting);
  if (!is_paper(wheels)) {
    faults.odometry_scale = kLastingSigma * random.normal();
    faults.turn_scale = kLastingSigma * random.normal();
  }
  switch (wheels) {
    case Wheels::usual:
    case Wheels::paper:
      break;
    case Wheels::longer:
      faults.odometry_scale = 0.05;
      break;
    case Wheels::shorter:
      faults.odometry_scale = -0.05;
      break;
    case Wheels::turns_more:
      faults.turn_scale = 0.10;
      break;
    case Wheels::gap_3_s:
    case Wheels::gap_8_s:
      faults.dropouts = 2;
      faults.dropout_s = wheels == Wheels::gap_3_s ? 3.0 : 8.0;
      break;
    case Wheels::frozen:
      faults.freeze_s = drive_s / 3.0;
      break;
    case Wheels::creeping:
      faults.creep = 0.05;
      break;
    case Wheels::slip_bursts:
    case Wheels::paper_bursts:
      faults.burst_ratio = 0.3;
      break;
    case Wheels::jumping:
      faults.jumps = 2;
      faults.jump_rad = 0.2;
      break;
    case Wheels::none:
      faults.is_absent = true;
      break;
  }
  return faults;
}

}  // namespace adit
