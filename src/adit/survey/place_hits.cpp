#include "adit/survey/wall_grid.hpp"
#include "adit/survey/wall_hits.hpp"

namespace adit {
namespace {

constexpr double kLeastPoints = 4.0;  // for a direction: three lie along a line by chance
constexpr double kSlender = 5.0;      // a surface is so much longer than wide, squared

/// What the beams from a place met.
class MetPoints {
 public:
  explicit MetPoints(double reach) : reach_(reach), cells_(reach) {}

  void add(const Vector2d& p) { cells_.at(cells_.cell_at(p)).push_back(p); }

  /// The direction of the surface around a place; nothing where none shows.
  std::optional<Vector2d> direction_at(const Vector2d& place) {
    Moments near;
    const GridCell at = cells_.cell_at(place);
    for (std::int32_t y = at.y - 1; y <= at.y + 1; ++y) {
      for (std::int32_t x = at.x - 1; x <= at.x + 1; ++x) {
        const std::vector<Vector2d>* cell = cells_.find({x, y});
        if (cell == nullptr) continue;
        for (const Vector2d& p : *cell) {
          const Vector2d d = p - place;
          if (d.squaredNorm() <= reach_ * reach_) near.add(d.x(), d.y());
        }
      }
    }
    if (near.n < kLeastPoints) return std::nullopt;
    const LineFit line = fit_line(near);
    const double all = near.xx + near.yy - near.n * line.centroid.squaredNorm();
    if (all <= kSlender * line.squared_error) return std::nullopt;
    return line.direction;
  }

 private:
  double reach_;
  TileGrid<std::vector<Vector2d>> cells_;
};

}  // namespace

const std::vector<std::vector<WallHit>>& PlaceHitFinder::find(std::span<const PosedScan> scans) {
  hits_.clear();
  lone_.clear();
  for (const PosedScan& posed : scans) {
    hits_.push_back(finder_.find(posed));
    lone_.push_back(finder_.lone());
  }
  if (scans.size() < 2) return hits_;
  MetPoints points(surface_reach(scanner_));
  for (const auto& hits : hits_) {
    for (const WallHit& hit : hits) points.add(hit.point);
  }
  for (const auto& lone : lone_) {
    for (const LoneBeam& beam : lone) points.add(beam.point);
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (const LoneBeam& beam : lone_[i]) {
      const auto direction = points.direction_at(beam.point);
      if (!direction) continue;
      if (const auto hit = finder_.hit_along(scans[i], beam, *direction)) hits_[i].push_back(*hit);
    }
  }
  return hits_;
}

}  // namespace adit
