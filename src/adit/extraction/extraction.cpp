#include "adit/extraction/extraction.hpp"

#include <algorithm>
#include <cmath>

#include "adit/extraction/join.hpp"
#include "adit/extraction/segmentation.hpp"
#include "adit/extraction/wall_line.hpp"

namespace adit {
namespace {

/// Two points are always straight: a line needs a third.
int least_points(const ExtractionOptions& options) { return std::max(3, options.min_line_points); }

}  // namespace

const FeatureList& Extractor::extract(const LaserScan& scan, const ScannerModel& scanner,
                                      const ExtractionOptions& options) {
  features_.clear();
  points_.build(scan, scanner, options.roughness_m, options.grazing_rad);
  set_operator_sizes(options);
  cut_into_stretches(options);
  if (points_.closed() && stretches_.size() > 1) {
    // The seam of a closed contour moves to a corner that was found with both its arms.
    points_.restart_at(stretches_[1].begin);
    cut_into_stretches(options);
  }
  fit_lines(options);
  join_lines(options);
  sort_counter_clockwise(features_);
  return features_;
}

void Extractor::set_operator_sizes(const ExtractionOptions& options) {
  sizes_.clear();
  for (double size = options.max_operator_m; size > options.min_operator_m; size *= 0.5) {
    sizes_.push_back(size);
  }
  sizes_.push_back(options.min_operator_m);
}

void Extractor::cut_into_stretches(const ExtractionOptions& options) {
  const CornerDecision decision{options.corner_chi_square, options.straight_sigmas,
                                static_cast<std::size_t>(least_points(options))};
  stretches_.clear();
  piece_.clear();
  const std::vector<ScanPoints::Piece>& pieces = points_.pieces();
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const ScanStretch whole{pieces[p].begin, pieces[p].end};
    if (static_cast<int>(whole.size()) < least_points(options)) continue;
    cuts_.clear();
    if (!is_straight(points_, whole, options.straight_sigmas)) {
      operator_.find(points_, whole, sizes_, decision, cuts_);
    }
    segment_piece(points_, whole, cuts_, decision, stretches_);
    piece_.resize(stretches_.size(), p);
  }
}

void Extractor::fit_lines(const ExtractionOptions& options) {
  line_.clear();
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const CutEnds cuts{is_cut_between(s, -1), is_cut_between(s, 1)};
    const auto line = fit_wall_line(points_, stretches_[s], least_points(options), cuts);
    const bool usable = line && line->length() >= options.min_line_m && line->distance > 0.0;
    line_.push_back(usable ? static_cast<int>(features_.lines.size()) : -1);
    if (usable) features_.lines.push_back(*line);
  }
}

/// Whether the stretch ends, after (1) or before (-1) it, at a cut inside a piece and not at a gap.
bool Extractor::is_cut_between(std::size_t stretch, int step) const {
  const std::size_t n = stretches_.size();
  const bool at_seam = step > 0 ? stretch + 1 == n : stretch == 0;
  if (n < 2 || (at_seam && !points_.closed())) return false;
  return piece_[(stretch + n + static_cast<std::size_t>(step)) % n] == piece_[stretch];
}

void Extractor::join_lines(const ExtractionOptions& options) {
  begins_joined_.assign(stretches_.size(), 0);
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    if (line_[s] < 0) continue;
    const std::size_t next = next_line(s);
    if (next != s && add_corner(s, next, options)) {
      begins_joined_[next] = 1;
    } else {
      add_edge(s, 0);
    }
  }
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    if (line_[s] >= 0 && begins_joined_[s] == 0) add_edge(s, 1);
  }
}

/// The next stretch of the same piece that has a line, at most a few stray points away; the stretch
/// itself where there is none. In a closed contour the first follows the last.
std::size_t Extractor::next_line(std::size_t stretch) const {
  constexpr std::size_t kStrayPoints = 3;
  std::size_t stray = 0;
  for (std::size_t k = 1; k < stretches_.size(); ++k) {
    const std::size_t next = (stretch + k) % stretches_.size();
    if (next < stretch && !points_.closed()) return stretch;
    if (piece_[next] != piece_[stretch]) return stretch;
    if (line_[next] >= 0) return next;
    stray += stretches_[next].size();
    if (stray > kStrayPoints) return stretch;
  }
  return stretch;
}

bool Extractor::add_corner(std::size_t stretch, std::size_t next,
                           const ExtractionOptions& options) {
  Line& before = features_.lines[static_cast<std::size_t>(line_[stretch])];
  Line& after = features_.lines[static_cast<std::size_t>(line_[next])];
  std::optional<Corner> corner = intersect(before, after, options.min_corner_turn_rad);
  if (!corner) return false;
  // The lines must really reach the vertex: a step in the wall is no corner of both.
  const double spacing = std::abs(points_.beam_step()) * corner->position.norm();
  const double shorter = std::min(before.length(), after.length());
  const double uncertain = std::min(3.0 * std::sqrt(corner->covariance.trace()), 0.5 * shorter);
  const double reach = uncertain + 3.0 * spacing + 2.0 * std::sqrt(points_.noise().beam_variance);
  if (!((corner->position - before.end).norm() <= reach)) return false;
  if (!((corner->position - after.begin).norm() <= reach)) return false;
  corner->arms = {line_[stretch], line_[next]};
  before.end = corner->position;
  after.begin = corner->position;
  features_.corners.push_back(*corner);
  return true;
}

/// Adds the occluding corner at one end of a stretch's line, if the view goes on behind it there.
void Extractor::add_edge(std::size_t stretch, int arm) {
  const bool at_end = arm == 0;
  const ScanStretch& points = stretches_[stretch];
  const std::size_t n = points_.size();
  const std::size_t last = at_end ? points.end - 1 : points.begin;
  const int step = at_end ? 1 : -1;
  const int beam = points_.beam_index(last);
  const int beyond = beam + step;
  if (!points_.full_circle() && (beyond < 0 || beyond >= points_.beam_count())) return;

  const Line& line = features_.lines[static_cast<std::size_t>(line_[stretch])];
  // Where the wall would pass out of range, its end is the scanner's and not the wall's.
  const int next_beam = (beyond + points_.beam_count()) % points_.beam_count();
  const Vector2d onward = meet(line, points_.direction(next_beam), points_.point(last));
  if (onward.norm() > points_.no_return_from()) return;
  // A few missing beams, such as filtered mixed pixels, do not open the view.
  const std::size_t neighbour = at_end ? (last + 1) % n : (last + n - 1) % n;
  const int apart =
      at_end ? points_.beams_between(last, neighbour) : points_.beams_between(neighbour, last);
  if (apart <= ScanPoints::kMostBeamsApart) {
    const Vector2d expected = meet(line, points_.beam(neighbour), points_.point(last));
    const double margin =
        0.1 + 4.0 * std::sqrt(points_.noise().beam_variance + points_.noise().roughness_variance);
    if (points_.range(neighbour) < expected.norm() + margin) return;
  }
  const bool is_cut = is_cut_between(stretch, step);
  const double half_step = 0.5 * std::abs(points_.beam_step());
  const Vector2d at = points_.beam(last);
  const Vector2d edge = at * std::cos(half_step) + step * std::sin(half_step) * perpendicular(at);
  // The last beam on the wall may be lost to noise; where a cut and not a gap ends the wall, the
  // noise also decided which point is the last.
  const double in_gap = 0.8 * half_step;
  const double at_cut =
      is_cut ? 0.5 * std::sqrt(points_.noise().beam_variance) / points_.range(last) + half_step
             : 0.0;
  const double sigma = std::hypot(in_gap, at_cut);
  Corner corner = occluding_corner(line, arm, edge, sigma);
  corner.arms[static_cast<std::size_t>(arm)] = line_[stretch];
  features_.corners.push_back(corner);
}

}  // namespace adit
