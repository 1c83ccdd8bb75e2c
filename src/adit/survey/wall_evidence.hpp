#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/survey/wall_grid.hpp"
#include "adit/survey/wall_hits.hpp"

namespace adit {

/// What a small piece of surface, seen from one side, was found to be over all visits.
struct Facet {
  Vector2d point = Vector2d::Zero();   ///< weighted mean of the hits
  Vector2d normal = Vector2d::Zero();  ///< unit, towards the scanners
  double weight = 0.0;                 ///< information across the wall (1/m²)
  double hits = 0.0;
  int scans = 0;
  int visits = 0;
  std::uint64_t visit_set = 0;  ///< a bit for each visit, modulo 64
  std::uint64_t scan_set = 0;   ///< a bit for each scan, modulo 64
  bool near = false;            ///< met from no farther than WallOptions::sure_range_m
  double in_place = 0.0;        ///< votes of visits that found it
  double seen_through = 0.0;    ///< votes of visits whose beams went through
  int next = -1;                ///< of the same cell

  /// Share of the votes that found it; 1 without any.
  double occupied_share() const {
    const double votes = in_place + seen_through;
    return votes > 0.0 ? in_place / votes : 1.0;
  }
};

/// Side of the cells for this scanner (m).
double cell_size(const ScannerModel& scanner, const WallOptions& options);

/// Gathers the ends of beams in small facets, then asks for each facet which beams went through.
///
/// Scans come in the order of their visits, first all to `add`, then all again to `look_through`:
/// a visit has one vote on a facet however many scans it holds, so that a machine which stands
/// still for an hour does not outvote the rest, and the errors that scans of one visit share are
/// not averaged away (weight of a visit: 1 / (common variance + noise variance / hits)).
class BeamEvidence {
 public:
  BeamEvidence(const ScannerModel& scanner, const WallOptions& options);

  void add(std::span<const WallHit> hits, int visit);
  /// Ends the first round.
  void finish_adding();
  /// The beams of a scan: what they went through and what they found in place.
  void look_through(const PosedScan& posed, int visit);
  /// Ends the second round.
  void finish_looking();

  std::span<const Facet> facets() const { return facets_; }
  double cell_m() const { return cells_.cell_m(); }
  /// How many beams went through a place on their way to something behind it.
  int passes_at(const Vector2d& place);
  /// Calls `take(index)` for the facets whose cells lie within `reach` of a place.
  template <class Take>
  void visit_near(const Vector2d& place, double reach, const Take& take) {
    const GridCell low = cells_.cell_at(place.array() - reach);
    const GridCell high = cells_.cell_at(place.array() + reach);
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const Cell* cell = cells_.find({x, y});
        if (cell == nullptr) continue;
        for (int f = cell->first_facet; f >= 0; f = facets_[index(f)].next) take(f);
      }
    }
  }

 private:
  struct Cell {
    int first_facet = -1;
    int passes = 0;
  };
  /// The sums of a facet, first of one visit, then of all.
  struct Sums {
    double weight = 0.0;
    Vector2d point = Vector2d::Zero();
    Vector2d normal = Vector2d::Zero();
  };
  struct Gathering {
    Sums all;
    Sums visit;
    double common_variance = 0.0;  // of the visit, weighted
    int last_visit = -1;
    int last_scan = -1;
    double through = 0.0;  // beams of the visit
    double found = 0.0;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  int facet_for(const WallHit& hit);
  void close_visit(int facet);
  void close_votes(int facet);
  void judge(int facet, const Vector2d& origin, const Vector2d& direction, double range, int visit);

  WallOptions options_;
  ScannerModel scanner_;
  double through_m_;
  int scan_ = 0;
  TileGrid<Cell> cells_;
  std::vector<Facet> facets_;
  std::vector<Gathering> gathering_;
};

}  // namespace adit
