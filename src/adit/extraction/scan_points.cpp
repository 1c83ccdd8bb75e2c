#include "adit/extraction/scan_points.hpp"

#include <algorithm>

namespace adit {

ScanPoints::LineError ScanPoints::line_error(std::size_t begin, std::size_t end) const {
  const Moments m = moments(begin, end);
  const double inverse_n = 1.0 / m.n;
  const double mx = m.x * inverse_n;
  const double my = m.y * inverse_n;
  const double a = m.xx - m.x * mx;
  const double b = m.xy - m.x * my;
  const double c = m.yy - m.y * my;
  const double spread = std::sqrt((a - c) * (a - c) + 4.0 * b * b);
  const double squared_error = std::max(0.0, 0.5 * (a + c - spread));
  const double range2 = mx * mx + my * my;
  // cos² of the incidence by the double angle: no trigonometry and no second square root.
  const double aligned = (a - c) * (mx * mx - my * my) + 4.0 * b * mx * my;
  const double scale = spread * range2;
  const double cos2 = scale > 0.0 ? std::clamp(0.5 * (1.0 - aligned / scale), 0.02, 1.0) : 1.0;
  return {squared_error, noise_.across(cos2, range2), cos2 * range2};
}

double ScanPoints::chi_square(std::size_t begin, std::size_t end) const {
  if (end - begin < 3) return 0.0;
  const LineError error = line_error(begin, end);
  return error.squared / error.variance;
}

bool ScanPoints::is_straight(std::size_t begin, std::size_t end, double sigmas) const {
  const double freedom = static_cast<double>(end - begin) - 2.0;
  if (freedom < 1.0) return true;
  const LineError error = line_error(begin, end);
  // Along a long wall the incidence changes, and with it the noise across it: the mean of its
  // share, and of that squared, by Simpson's rule over the points.
  const auto share_at = [&](std::size_t i) {
    const double range2 = range_[i] * range_[i];
    return noise_.across(std::clamp(error.foot2 / range2, 0.02, 1.0), range2) / error.variance;
  };
  const double first = share_at(begin);
  const double middle = share_at((begin + end) / 2);
  const double last = share_at(end - 1);
  const double mean = (first + 4.0 * middle + last) / 6.0;
  const double mean_square = (first * first + 4.0 * middle * middle + last * last) / 6.0;
  return error.squared / error.variance <=
         freedom * mean + sigmas * std::sqrt(2.0 * freedom * mean_square);
}

void ScanPoints::build(const LaserScan& scan, const ScannerModel& scanner, double roughness,
                       double grazing) {
  const double sigma = scanner.beam_sigma_m();
  noise_.beam_variance = std::max(sigma * sigma, 1e-8);
  noise_.roughness_variance = roughness * roughness;
  noise_.bearing_variance = scanner.bearing_sigma_rad * scanner.bearing_sigma_rad;
  reach_of_noise_ = 4.0 * std::sqrt(2.0 * (noise_.beam_variance + noise_.roughness_variance));
  prepare_beams(scan);
  spacing_per_metre_ = std::abs(step_) / std::sin(grazing);
  collect(scan, scanner);
  closed_ = false;
  if (full_circle_ && size() > 2) {
    std::size_t start = 0;
    while (start < size() && joined(start == 0 ? size() - 1 : start - 1, start)) ++start;
    closed_ = start == size();
    if (closed_) {
      start =
          static_cast<std::size_t>(std::max_element(range_.begin(), range_.end()) - range_.begin());
    }
    rotate(start);
  }
  cut_pieces();
  accumulate();
}

void ScanPoints::restart_at(std::size_t point) {
  rotate(point);
  accumulate();
}

void ScanPoints::prepare_beams(const LaserScan& scan) {
  const std::size_t n = scan.beams_of_one_turn();
  full_circle_ = scan.is_full_circle();
  const bool same_fan = evenly_spaced_ && scan.bearings.empty() && cos_.size() == n &&
                        first_bearing_ == scan.first_bearing && step_ == scan.bearing_step;
  if (same_fan) return;
  evenly_spaced_ = scan.bearings.empty();
  first_bearing_ = scan.first_bearing;
  step_ = scan.bearing_step;
  cos_.resize(n);
  sin_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double bearing = scan.bearing(step_ < 0.0 ? n - 1 - k : k);
    cos_[k] = std::cos(bearing);
    sin_[k] = std::sin(bearing);
  }
}

void ScanPoints::collect(const LaserScan& scan, const ScannerModel& scanner) {
  const std::size_t n = cos_.size();
  for (auto* v : {&x_, &y_, &range_}) v->resize(n);
  beam_.resize(n);
  limits_ = return_limits(scan, scanner);
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double r = scan.ranges[step_ < 0.0 ? n - 1 - k : k];
    if (!limits_.is_return(r)) continue;
    x_[count] = r * cos_[k];
    y_[count] = r * sin_[k];
    range_[count] = r;
    beam_[count] = static_cast<int>(k);
    ++count;
  }
  for (auto* v : {&x_, &y_, &range_}) v->resize(count);
  beam_.resize(count);
}

int ScanPoints::beams_between(std::size_t i, std::size_t j) const {
  const int beams = beam_[j] - beam_[i];
  return beams > 0 ? beams : beams + beam_count();
}

bool ScanPoints::joined(std::size_t i, std::size_t j) const {
  const int beams = beams_between(i, j);
  if (beams > kMostBeamsApart) return false;
  const double nearer = std::min(range_[i], range_[j]);
  const double limit = nearer * spacing_per_metre_ * beams + reach_of_noise_;
  const double dx = x_[j] - x_[i];
  const double dy = y_[j] - y_[i];
  return dx * dx + dy * dy <= limit * limit;
}

void ScanPoints::rotate(std::size_t first) {
  const auto by = [first](auto& v) {
    std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(first), v.end());
  };
  if (first == 0 || first >= size()) return;
  by(x_);
  by(y_);
  by(range_);
  by(beam_);
}

void ScanPoints::cut_pieces() {
  pieces_.clear();
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= size(); ++i) {
    if (i < size() && joined(i - 1, i)) continue;
    if (i > begin) pieces_.push_back({begin, i});
    begin = i;
  }
}

void ScanPoints::accumulate() {
  sums_.resize(size() + 1);
  sums_[0] = Moments{};
  for (std::size_t i = 0; i < size(); ++i) {
    sums_[i + 1] = sums_[i];
    sums_[i + 1].add(x_[i], y_[i]);
  }
}

}  // namespace adit
