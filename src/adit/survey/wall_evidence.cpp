#include "adit/survey/wall_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

constexpr double kSameSide = 0.5;      // cosine of normals that one facet gathers
constexpr double kCellOfNoise = 0.75;  // finer cells than the noise tell nothing more
constexpr double kFewBeams = 2.0;      // a visit's vote counts half with so many beams
constexpr double kLeastCosine = 0.05;  // flatter beams do not tell before from behind
constexpr double kFarthestIn = 3.0;    // of the distance that tells, along a beam: still the wall

}  // namespace

double cell_size(const ScannerModel& scanner, const WallOptions& options) {
  return std::max(options.cell_m, kCellOfNoise * scanner.beam_sigma_m());
}

BeamEvidence::BeamEvidence(const ScannerModel& scanner, const WallOptions& options)
    : options_(options),
      scanner_(scanner),
      through_m_(std::max(options.seen_through_m, 3.0 * scanner.beam_sigma_m())),
      cells_(cell_size(scanner, options)) {}

int BeamEvidence::facet_for(const WallHit& hit) {
  Cell& cell = cells_.at(cells_.cell_at(hit.point));
  for (int f = cell.first_facet; f >= 0; f = facets_[index(f)].next) {
    const Gathering& g = gathering_[index(f)];
    const Vector2d normal = g.all.normal + g.visit.normal;
    if (normal.dot(hit.normal) > kSameSide * normal.norm()) return f;
  }
  facets_.emplace_back();
  gathering_.emplace_back();
  facets_.back().next = cell.first_facet;
  cell.first_facet = static_cast<int>(facets_.size()) - 1;
  return cell.first_facet;
}

void BeamEvidence::add(std::span<const WallHit> hits, int visit) {
  ++scan_;
  for (const WallHit& hit : hits) {
    const int f = facet_for(hit);
    Gathering& g = gathering_[index(f)];
    if (g.last_visit != visit) {
      close_visit(f);
      g.last_visit = visit;
      ++facets_[index(f)].visits;
      facets_[index(f)].visit_set |= std::uint64_t{1} << (static_cast<unsigned>(visit) % 64U);
    }
    const double weight = 1.0 / (hit.noise_variance + hit.pose_variance);
    g.visit.weight += weight;
    g.visit.point += weight * hit.point;
    g.visit.normal += weight * hit.normal;
    g.common_variance += weight * hit.pose_variance;
    facets_[index(f)].hits += 1.0;
    if (hit.range <= options_.sure_range_m) facets_[index(f)].near = true;
    if (g.last_scan != scan_) ++facets_[index(f)].scans;
    facets_[index(f)].scan_set |= std::uint64_t{1} << (static_cast<unsigned>(scan_) % 64U);
    g.last_scan = scan_;
  }
}

void BeamEvidence::close_visit(int facet) {
  Gathering& g = gathering_[index(facet)];
  if (g.visit.weight <= 0.0) return;
  const double common = g.common_variance / g.visit.weight;
  const double shrink = 1.0 / (1.0 + g.visit.weight * common);
  g.all.weight += shrink * g.visit.weight;
  g.all.point += shrink * g.visit.point;
  g.all.normal += shrink * g.visit.normal;
  g.visit = {};
  g.common_variance = 0.0;
}

void BeamEvidence::finish_adding() {
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    close_visit(static_cast<int>(i));
    const Sums& all = gathering_[i].all;
    facets_[i].weight = all.weight;
    facets_[i].point = all.point / all.weight;
    facets_[i].normal = all.normal.normalized();
    gathering_[i].last_visit = -1;
  }
}

void BeamEvidence::look_through(const PosedScan& posed, int visit) {
  const LaserScan& scan = posed.scan;
  const Pose2 map_from_laser = posed.map_from_vehicle * scan.vehicle_from_laser;
  const Vector2d origin = map_from_laser.translation();
  const ReturnLimits limits = return_limits(scan, scanner_);
  const std::size_t beams = scan.beams_of_one_turn();
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.ranges[i];
    // A beam without return went somewhere, but some surfaces swallow beams: it says nothing.
    if (!limits.is_return(range)) continue;
    const Vector2d direction = unit_vector(map_from_laser.theta + scan.bearing(i));
    const double clear = range - 2.0 * through_m_;
    double step = 0.0;
    walk_cells(origin, origin + (range + through_m_) * direction, cells_.cell_m(),
               [&](const GridCell& at) {
                 Cell* cell = cells_.find(at);
                 if (cell == nullptr) return;
                 const Vector2d middle((at.x + 0.5) * cells_.cell_m(),
                                       (at.y + 0.5) * cells_.cell_m());
                 step = (middle - origin).dot(direction);
                 if (step < clear) ++cell->passes;
                 for (int f = cell->first_facet; f >= 0; f = facets_[index(f)].next) {
                   judge(f, origin, direction, range, visit);
                 }
               });
  }
}

void BeamEvidence::judge(int facet, const Vector2d& origin, const Vector2d& direction, double range,
                         int visit) {
  Gathering& g = gathering_[index(facet)];
  if (g.last_visit != visit) {
    close_votes(facet);
    g.last_visit = visit;
  }
  const Facet& f = facets_[index(facet)];
  const double along = direction.dot(f.point - origin);
  const double cosine = std::abs(direction.dot(f.normal));
  const double behind = (range - along) * cosine;
  if (behind > through_m_) {
    if (cosine > kLeastCosine) g.through += 1.0;
  } else if (std::abs(range - along) < kFarthestIn * through_m_ && behind > -through_m_) {
    g.found += 1.0;
  }
}

void BeamEvidence::close_votes(int facet) {
  Gathering& g = gathering_[index(facet)];
  const double beams = g.found + g.through;
  if (beams > 0.0) {
    const double vote = 1.0 / (beams + kFewBeams);
    facets_[index(facet)].in_place += vote * g.found;
    facets_[index(facet)].seen_through += vote * g.through;
  }
  g.found = g.through = 0.0;
}

void BeamEvidence::finish_looking() {
  for (std::size_t i = 0; i < facets_.size(); ++i) close_votes(static_cast<int>(i));
}

int BeamEvidence::passes_at(const Vector2d& place) {
  const Cell* cell = cells_.find(cells_.cell_at(place));
  return cell == nullptr ? 0 : cell->passes;
}

}  // namespace adit
