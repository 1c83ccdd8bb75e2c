#include "adit/survey/plan_difference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adit/map/line_map.hpp"
#include "adit/survey/looked_at.hpp"
#include "adit/survey/wall_evidence.hpp"

namespace adit {
namespace {

constexpr std::size_t kObservers = 5;   // scans asked from where a wall was seen
constexpr double kMostlyThrough = 0.7;  // share of votes above which a wall is gone ...
constexpr double kPartlyThrough = 0.4;  // ... and beside such a place: beams end at the cut's edge
constexpr std::size_t kMostObservers = 2000;

enum class PlaceState { unseen, confirmed, doubtful, gone, moved };

/// A place on a wall of the plan.
struct PlanPlace {
  Vector2d point;
  PlaceState state = PlaceState::unseen;
  double offset = 0.0;
  double share_through = 0.0;
};

struct NearWall {
  int wall = -1;
  double distance = 0.0;
};

/// Finds walls of like direction.
class LikeWalls {
 public:
  LikeWalls(std::span<const Segment> segments, double parallel_rad)
      : segments_(segments.begin(), segments.end()),
        index_(segments_),
        cosine_(std::cos(parallel_rad)),
        sine_(std::sin(parallel_rad)) {}

  /// The nearest within `reach`, and no farther than `beside` along the direction: a wall that
  /// goes on where another ends does not stand in its place.
  std::optional<NearWall> nearest(const Vector2d& p, const Vector2d& direction, double reach,
                                  double beside) const {
    std::optional<NearWall> best;
    index_.visit([&](const Box& box) { return box.squared_distance(p) <= reach * reach; },
                 [&](const SegmentIndex::Entry& entry) {
                   const Segment& s = segments_[static_cast<std::size_t>(entry.segment)];
                   const double length = s.length();
                   if (length <= 0.0) return;
                   if (std::abs((s.b - s.a).dot(direction)) < cosine_ * length) return;
                   const Vector2d way = nearest_point(s, p) - p;
                   const double d = way.norm();
                   if (d > reach || (best && d >= best->distance)) return;
                   // The way to a wall that is not quite parallel leans by as much.
                   if (std::abs(way.dot(direction)) > std::max(beside, sine_ * d)) return;
                   best = {{entry.segment, d}};
                 });
    return best;
  }

  /// Whether any wall, of whatever direction, is so near.
  bool any_within(const Vector2d& p, double reach) const {
    bool found = false;
    index_.visit([&](const Box& box) { return box.squared_distance(p) <= reach * reach; },
                 [&](const SegmentIndex::Entry& entry) {
                   const Segment& s = segments_[static_cast<std::size_t>(entry.segment)];
                   found = found || distance(s, p) <= reach;
                 });
    return found;
  }

  /// How many walls the way from one point to another crosses.
  int crossings(const Vector2d& from, const Vector2d& to) const {
    int count = 0;
    const Box way = box_of({from, to});
    std::vector<int> seen;
    index_.visit([&](const Box& box) { return box.overlaps(way); },
                 [&](const SegmentIndex::Entry& entry) { seen.push_back(entry.segment); });
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const int i : seen) {
      const Segment& s = segments_[static_cast<std::size_t>(i)];
      const double a = cross(to - from, s.a - from);
      const double b = cross(to - from, s.b - from);
      const double c = cross(s.b - s.a, from - s.a);
      const double d = cross(s.b - s.a, to - s.a);
      if (a * b < 0.0 && c * d < 0.0) ++count;
    }
    return count;
  }

 private:
  std::vector<Segment> segments_;
  SegmentIndex index_;
  double cosine_;
  double sine_;
};

std::vector<Vector2d> places_along(const Segment& s, double step) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(s.length() / step)));
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    places.emplace_back(s.a + share * (s.b - s.a));
  }
  return places;
}

class Comparison {
 public:
  Comparison(std::span<const Segment> plan, const WallMap& walls, std::span<const PosedScan> scans,
             const ScannerModel& scanner, const PlanDifferenceOptions& options,
             const WallOptions& wall_options, std::span<const int> visits)
      : plan_(plan),
        looked_at_(box_of_beams(scans, scanner).padded(options.moved_m)),
        walls_(walls),
        surveyed_(walls.segments()),
        options_(options),
        near_surveyed_(surveyed_, options.parallel_rad),
        near_plan_(plan, options.parallel_rad),
        evidence_(scanner, wall_options) {
    std::vector<int> by_way;
    if (visits.size() != scans.size()) {
      by_way = visits_by_way(scans, wall_options.visit_m);
      visits = by_way;
    }
    look(scans, visits);
    const std::size_t step = scans.size() / kMostObservers + 1;
    for (std::size_t i = 0; i < scans.size(); i += step) {
      observers_.push_back(scans[i].map_from_vehicle.translation());
    }
  }

  PlanDifference run() {
    replaced_.assign(surveyed_.size(), 0);
    for (std::size_t i = 0; i < plan_.size(); ++i) compare_segment(i);
    add_new_walls();
    return std::move(difference_);
  }

 private:
  /// Asks all beams about the places of the plan, as if these were surfaces that had been hit.
  void look(std::span<const PosedScan> scans, std::span<const int> visits) {
    std::vector<WallHit> hits;
    for (const Segment& s : plan_) {
      const Vector2d normal = perpendicular(s.b - s.a).normalized();
      const auto stretch = stretch_within(s, looked_at_);
      if (!stretch) continue;
      for (const Vector2d& p : places_along(piece_of(s, *stretch), options_.step_m)) {
        hits.push_back({p, normal, 1.0, 0.0});
      }
    }
    evidence_.add(hits, 0);
    evidence_.finish_adding();
    for (std::size_t i = 0; i < scans.size(); ++i) evidence_.look_through(scans[i], visits[i]);
    evidence_.finish_looking();
  }

  PlanPlace judge(const Vector2d& p, const Vector2d& direction) {
    PlanPlace place{p};
    double least = options_.step_m;
    double in_place = 0.0;
    double through = 0.0;
    evidence_.visit_near(p, options_.step_m, [&](int f) {
      const Facet& facet = evidence_.facets()[static_cast<std::size_t>(f)];
      const double d = (facet.point - p).norm();
      if (d > least || std::abs(facet.normal.dot(direction)) > 0.7) return;
      least = d;
      in_place = facet.in_place;
      through = facet.seen_through;
    });
    const double votes = in_place + through;
    place.share_through = votes > 0.0 ? through / votes : 0.0;
    const auto near = near_surveyed_.nearest(p, direction, options_.moved_m, options_.step_m);
    if (near && near->distance <= options_.same_m) {
      place.state = PlaceState::confirmed;
    } else if (through >= options_.min_votes && place.share_through >= kMostlyThrough) {
      place.state = near ? PlaceState::moved : PlaceState::gone;
      place.offset = near ? near->distance : 0.0;
    } else if (!near && place.share_through >= kPartlyThrough) {
      place.state = PlaceState::doubtful;
    } else if (in_place > 0.0) {
      place.state = PlaceState::confirmed;
    }
    return place;
  }

  /// Decides on the doubtful places: gone where the places beside are.
  static void settle_doubts(std::vector<PlanPlace>& places) {
    const auto spread = [](auto begin, auto end) {
      for (auto at = begin; at != end && at + 1 != end; ++at) {
        const bool doubtful = (at + 1)->state == PlaceState::doubtful;
        if (at->state == PlaceState::gone && doubtful) (at + 1)->state = PlaceState::gone;
      }
    };
    spread(places.begin(), places.end());
    spread(places.rbegin(), places.rend());
    for (PlanPlace& place : places) {
      if (place.state == PlaceState::doubtful) place.state = PlaceState::confirmed;
    }
  }

  void compare_segment(std::size_t index) {
    const Segment& s = plan_[index];
    const double length = s.length();
    if (length <= 0.0) return;
    const auto stretch = stretch_within(s, looked_at_);
    difference_.unseen_m += stretch ? length - stretch->length_m() : length;
    if (!stretch) return;
    const Vector2d direction = (s.b - s.a) / length;
    std::vector<PlanPlace> places;
    for (const Vector2d& p : places_along(piece_of(s, *stretch), options_.step_m)) {
      places.push_back(judge(p, direction));
    }
    settle_doubts(places);
    const double step = stretch->length_m() / static_cast<double>(places.size());
    for (std::size_t begin = 0; begin < places.size();) {
      std::size_t end = begin + 1;
      while (end < places.size() && places[end].state == places[begin].state) ++end;
      const std::span<const PlanPlace> run(places.data() + begin, end - begin);
      record(index, run, stretch->from_m + static_cast<double>(begin) * step,
             stretch->from_m + static_cast<double>(end) * step);
      begin = end;
    }
  }

  void record(std::size_t index, std::span<const PlanPlace> run, double from, double to) {
    const PlaceState state = run.front().state;
    if (state == PlaceState::confirmed) difference_.confirmed_m += to - from;
    if (state == PlaceState::unseen) difference_.unseen_m += to - from;
    if (state != PlaceState::gone && state != PlaceState::moved) return;
    if (to - from < std::min(options_.min_length_m, plan_[index].length())) return;
    PlanChangeItem item;
    item.change = state == PlaceState::gone ? PlanChange::gone : PlanChange::moved;
    item.plan_segment = static_cast<int>(index);
    item.from_m = from;
    item.to_m = to;
    item.length_m = to - from;
    const Segment& s = plan_[index];
    const Vector2d along = (s.b - s.a).normalized();
    item.removed.push_back({s.a + from * along, s.a + to * along});
    for (const PlanPlace& place : run) {
      item.offset_m += place.offset / static_cast<double>(run.size());
      item.seen_through += place.share_through / static_cast<double>(run.size());
      if (state == PlaceState::moved) take_replacement(place.point, along, item);
    }
    difference_.items.push_back(std::move(item));
  }

  /// The surveyed wall that stands in for a place of the plan; each is taken once.
  void take_replacement(const Vector2d& p, const Vector2d& along, PlanChangeItem& item) {
    const auto near = near_surveyed_.nearest(p, along, options_.moved_m, options_.step_m);
    if (!near) return;
    const auto wall = static_cast<std::size_t>(near->wall);
    if (replaced_[wall] != 0) return;
    replaced_[wall] = 1;
    item.added.push_back(surveyed_[wall]);
  }

  bool is_new(std::size_t wall) const {
    if (replaced_[wall] != 0) return false;
    std::size_t far = 0;
    const std::vector<Vector2d> places = places_along(surveyed_[wall], options_.step_m);
    for (const Vector2d& p : places) {
      // Worn corners lie across their walls' directions.
      if (!near_plan_.any_within(p, options_.same_m)) ++far;
    }
    return 2 * far > places.size();
  }

  /// New walls, neighbours of one line together.
  void add_new_walls() {
    std::size_t wall = 0;
    for (const SurveyedWallLine& line : walls_.lines) {
      PlanChangeItem item;
      int behind = 0;
      int open = 0;
      for (const SurveyedWall& piece : line.pieces) {
        if (is_new(wall)) {
          item.added.push_back(piece.segment);
          item.length_m += piece.segment.length();
          item.support.hits += piece.support.hits;
          item.support.scans = std::max(item.support.scans, piece.support.scans);
          item.support.visits = std::max(item.support.visits, piece.support.visits);
          ask_observers(piece.segment, behind, open);
        } else {
          finish_new(item, behind, open);
        }
        ++wall;
      }
      finish_new(item, behind, open);
    }
  }

  void finish_new(PlanChangeItem& item, int& behind, int& open) {
    if (item.length_m >= options_.min_length_m) {
      item.change = behind > open ? PlanChange::cut : PlanChange::obstacle;
      difference_.items.push_back(item);
    }
    item = {};
    behind = open = 0;
  }

  /// Whether a wall of the plan stood between it and the nearest places on its open side.
  void ask_observers(const Segment& s, int& behind, int& open) const {
    const Vector2d middle = 0.5 * (s.a + s.b);
    const Vector2d normal = perpendicular(s.b - s.a).normalized();
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < observers_.size(); ++i) {
      const Vector2d way = observers_[i] - middle;
      if (way.dot(normal) > 0.2 * way.norm()) order.emplace_back(way.squaredNorm(), i);
    }
    const std::size_t count = std::min(order.size(), kObservers);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                      order.end());
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d& from = observers_[order[k].second];
      near_plan_.crossings(from, middle + options_.same_m * normal) > 0 ? ++behind : ++open;
    }
  }

  std::span<const Segment> plan_;
  Box looked_at_;
  const WallMap& walls_;
  std::vector<Segment> surveyed_;
  const PlanDifferenceOptions& options_;
  LikeWalls near_surveyed_;
  LikeWalls near_plan_;
  BeamEvidence evidence_;
  std::vector<Vector2d> observers_;
  std::vector<char> replaced_;
  PlanDifference difference_;
};

}  // namespace

const char* to_string(PlanChange change) {
  switch (change) {
    case PlanChange::gone:
      return "wall gone";
    case PlanChange::moved:
      return "wall moved";
    case PlanChange::cut:
      return "new cut";
    case PlanChange::obstacle:
      break;
  }
  return "new obstacle";
}

PlanDifference compare_with_plan(std::span<const Segment> plan, const WallMap& walls,
                                 std::span<const PosedScan> scans, const ScannerModel& scanner,
                                 const PlanDifferenceOptions& options,
                                 const WallOptions& wall_options, std::span<const int> visits) {
  return Comparison(plan, walls, scans, scanner, options, wall_options, visits).run();
}

std::vector<Segment> apply_changes(std::span<const Segment> plan,
                                   std::span<const PlanChangeItem> accepted) {
  constexpr double kLeast = 1e-6;  // m: what is left of a wall
  std::vector<Segment> changed;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    std::vector<std::pair<double, double>> cuts;
    for (const PlanChangeItem& item : accepted) {
      if (item.plan_segment == static_cast<int>(i)) cuts.emplace_back(item.from_m, item.to_m);
    }
    if (cuts.empty()) {
      changed.push_back(plan[i]);
      continue;
    }
    std::sort(cuts.begin(), cuts.end());
    const Vector2d along = (plan[i].b - plan[i].a).normalized();
    double from = 0.0;
    cuts.emplace_back(plan[i].length(), plan[i].length());
    for (const auto& [cut, end] : cuts) {
      if (cut - from > kLeast) {
        changed.push_back({plan[i].a + from * along, plan[i].a + cut * along});
      }
      from = std::max(from, end);
    }
  }
  for (const PlanChangeItem& item : accepted) {
    changed.insert(changed.end(), item.added.begin(), item.added.end());
  }
  return changed;
}

}  // namespace adit
