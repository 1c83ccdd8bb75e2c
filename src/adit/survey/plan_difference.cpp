#include "adit/survey/plan_difference.hpp"

#include <algorithm>
#include <cmath>

#include "adit/survey/changed_walls.hpp"
#include "adit/survey/like_walls.hpp"
#include "adit/survey/replaced_walls.hpp"
#include "adit/survey/visits.hpp"
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
  Comparison(std::span<const Segment> plan, const WallMap& walls, const ScannerModel& scanner,
             const PlanDifferenceOptions& options, const WallOptions& wall_options)
      : plan_(plan),
        scanner_(scanner),
        walls_(walls),
        surveyed_(walls.segments()),
        replaced_(surveyed_),
        options_(options),
        visit_m_(wall_options.visit_m),
        near_surveyed_(surveyed_, options.parallel_rad),
        near_plan_(plan, options.parallel_rad),
        evidence_(scanner, wall_options) {
    for (const SurveyedWallLine& line : walls.lines) {
      for (const SurveyedWall& piece : line.pieces) supports_.push_back(&piece.support);
    }
  }

  Result<PlanDifference> run(const PosedScans& scans, std::span<const int> visits) {
    if (const auto done = look_about(scans); !done) return tl::unexpected(done.error());
    if (const auto done = look(scans, visits); !done) return tl::unexpected(done.error());
    for (std::size_t i = 0; i < plan_.size(); ++i) compare_segment(i);
    for (const std::vector<std::size_t>& runs : runs_of_changes(runs_)) add_change(runs);
    add_replacements();
    add_new_walls();
    return std::move(difference_);
  }

 private:
  /// What was looked at, and from where.
  Result<void> look_about(const PosedScans& scans) {
    const std::size_t step = scans.size() / kMostObservers + 1;
    std::size_t i = 0;
    auto done = scans.visit([&](const PosedScan& scan) {
      extend_by_beams(scan, scanner_, looked_at_);
      if (i++ % step == 0) observers_.push_back(scan.map_from_vehicle.translation());
    });
    looked_at_ = looked_at_.padded(options_.moved_m);
    return done;
  }

  /// Asks all beams about the places of the plan, as if these were surfaces that had been hit.
  Result<void> look(const PosedScans& scans, std::span<const int> visits) {
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
    Visits visit(visits.size() == scans.size() ? visits : std::span<const int>{}, visit_m_);
    auto done = scans.visit([&](const PosedScan& scan) {
      evidence_.look_through(scan, visit.next(scan.map_from_vehicle));
    });
    evidence_.finish_looking();
    return done;
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
    ChangedRun changed;
    changed.change = state == PlaceState::gone ? PlanChange::gone : PlanChange::moved;
    changed.piece = {static_cast<int>(index), {from, to}};
    changed.removed = piece_of(plan_[index], changed.piece.stretch);
    for (const PlanPlace& place : run) {
      changed.places.push_back({place.point, place.offset, place.share_through});
    }
    runs_.push_back(std::move(changed));
  }

  /// Whether it is long enough, or a whole wall. Short runs count beside such a one only: round a
  /// worn corner two of them meet.
  bool is_listed_alone(const ChangedRun& run) const {
    const double whole = plan_[static_cast<std::size_t>(run.piece.segment)].length();
    return run.piece.stretch.length_m() >= std::min(options_.min_length_m, whole);
  }

  /// Lists what removes walls of the plan, unless all of it is short.
  void add_change(std::span<const std::size_t> runs) {
    PlanChangeItem item;
    item.change = runs_[runs.front()].change;
    bool is_long = false;
    double count = 0.0;
    for (const std::size_t r : runs) {
      const ChangedRun& run = runs_[r];
      item.pieces.push_back(run.piece);
      item.removed.push_back(run.removed);
      item.length_m += run.piece.stretch.length_m();
      is_long = is_long || is_listed_alone(run);
      for (const ChangedPlace& place : run.places) {
        item.offset_m += place.offset_m;
        item.seen_through += place.share_through;
        count += 1.0;
      }
    }
    if (!is_long) return;
    item.offset_m /= count;
    item.seen_through /= count;
    if (item.change == PlanChange::moved) claim_replacements(runs);
    difference_.items.push_back(std::move(item));
  }

  /// The surveyed walls that stand in for the places of these runs, for the next item.
  void claim_replacements(std::span<const std::size_t> runs) {
    for (const std::size_t r : runs) {
      const Segment& removed = runs_[r].removed;
      const Vector2d along = (removed.b - removed.a).normalized();
      for (const ChangedPlace& place : runs_[r].places) {
        const auto near =
            near_surveyed_.nearest(place.point, along, options_.moved_m, options_.step_m);
        if (!near) continue;
        replaced_.claim(difference_.items.size(), static_cast<std::size_t>(near->wall),
                        near->point);
      }
    }
  }

  void add_replacements() {
    const auto is_plans_own = [&](std::size_t wall, const Vector2d& p) {
      const Vector2d along = (surveyed_[wall].b - surveyed_[wall].a).normalized();
      return near_plan_.nearest(p, along, options_.same_m, options_.step_m).has_value();
    };
    for (const Replacement& r : replaced_.share_out(options_.step_m, is_plans_own)) {
      PlanChangeItem& item = difference_.items[r.change];
      item.added.push_back(piece_of(surveyed_[r.wall], r.stretch));
      const double share = r.stretch.length_m() / surveyed_[r.wall].length();
      add_support(*supports_[r.wall], share, item.support);
    }
  }

  /// What speaks for a share of a wall; where hits lie on it is not kept, so that they are taken
  /// for evenly spread.
  static void add_support(const WallSupport& wall, double share, WallSupport& sum) {
    sum.hits += share * wall.hits;
    sum.scans = std::max(sum.scans, wall.scans);
    sum.visits = std::max(sum.visits, wall.visits);
  }

  bool is_new(std::size_t wall) const {
    if (replaced_.is_claimed(wall)) return false;
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
          add_support(piece.support, 1.0, item.support);
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
  const ScannerModel& scanner_;
  Box looked_at_;
  const WallMap& walls_;
  std::vector<Segment> surveyed_;
  ReplacedWalls replaced_;
  const PlanDifferenceOptions& options_;
  double visit_m_;
  LikeWalls near_surveyed_;
  LikeWalls near_plan_;
  BeamEvidence evidence_;
  std::vector<Vector2d> observers_;
  std::vector<ChangedRun> runs_;
  std::vector<const WallSupport*> supports_;  // of the surveyed walls
  PlanDifference difference_;
};

}  // namespace

Result<PlanDifference> compare_with_plan(std::span<const Segment> plan, const WallMap& walls,
                                         const PosedScans& scans, const ScannerModel& scanner,
                                         const PlanDifferenceOptions& options,
                                         const WallOptions& wall_options,
                                         std::span<const int> visits) {
  return Comparison(plan, walls, scanner, options, wall_options).run(scans, visits);
}

}  // namespace adit
