#include "adit/evaluation/sample.hpp"

namespace adit {

std::vector<EstimateSample> samples_of(std::span<const StampedPose> trajectory) {
  std::vector<EstimateSample> samples;
  samples.reserve(trajectory.size());
  for (const StampedPose& row : trajectory) {
    EstimateSample& sample = samples.emplace_back();
    sample.stamp = row.stamp;
    sample.pose = row.pose;
  }
  return samples;
}

std::vector<EstimateSample> samples_of(std::span<const Estimate> estimates) {
  std::vector<EstimateSample> samples;
  samples.reserve(estimates.size());
  for (const Estimate& row : estimates) {
    samples.push_back({row.stamp, row.pose, row.covariance, row.status, row.protection_m});
  }
  return samples;
}

}  // namespace adit
