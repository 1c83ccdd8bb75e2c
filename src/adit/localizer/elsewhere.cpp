// Where the pose is lost: the search in the whole mine, and the hypotheses that it leaves.

#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/geometry/uncertain_move.hpp"
#include "adit/localizer/localizer.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

PlaceFinderOptions Localizer::finder_options() const {
  RelocationOptions relocation = settings_.relocation;
  for (int* most : {&relocation.listed, &relocation.refined, &relocation.fitted_again,
                    &relocation.rated_again}) {
    *most = std::max(*most, settings_.recovery.most_poses);
  }
  relocation.second_look_gap = 0.0;  // one look, which is thorough, and the way decides
  return {settings_.places, relocation, settings_.likelihood, settings_.refinement,
          settings_.status};
}

RelocationQuery Localizer::query_for(const LaserScan& scan) const {
  return {scan, scanner_, map_error_.error(), motion_, std::nullopt};
}

/// Every pose that may be the true one is held against the scan; one of them is the estimate.
void Localizer::weigh_hypotheses(const LaserScan& scan) {
  if (finder_.is_searching() && schedule_.is_answer_due()) take_search();
  if (hypotheses_.empty()) return;
  const Stopwatch watch(timings_.search);
  const RefinementInput input{map_, scan, scanner_, map_error_.error(), motion_};
  const std::size_t worst_walls = hypotheses_.has_own() ? 3 : 0;
  hypotheses_.weigh({input, way_m_, settings_.refinement, settings_.tracking, settings_.status,
                     tracker_, scan_fit_, refiner_.worst_walls(worst_walls)},
                    settings_.hypotheses);
  if (hypotheses_.empty()) {
    give_up();
    return;
  }
  const Hypotheses::Hypothesis& best = hypotheses_.all().front();
  const bool is_own = best.is_own;
  const bool is_believed =
      hypotheses_.is_decided(settings_.hypotheses) && (is_own || is_confirmed_);
  is_confirmed_ = false;  // of the pose that led at this scan
  follow(is_believed ? best : hypotheses_.leader(), input);
  if (is_believed) {
    believe(is_own);
  } else if (hypotheses_.is_hopeless()) {
    give_up();
  }
}

/// One pose is left, and the scans speak for it.
void Localizer::believe(bool is_own) {
  hypotheses_.clear();
  trust_.reset();
  ambiguous_ = false;
  is_found_ = true;
  if (!is_own) trusted_m_ = 0.0;
}

/// None is left.
void Localizer::give_up() {
  hypotheses_.clear();
  is_anywhere_ = !is_found_;
  schedule_.note_failure(settings_.recovery);
}

/// Whether so little of the scan is explained that a trusted pose may be another.
bool Localizer::is_doubtful() const {
  const FitQuality quality = quality_of(scan_fit_);
  return believed_ && quality.returns >= settings_.status.fewest_returns &&
         quality.evidence_ratio < settings_.recovery.doubtful_evidence_ratio;
}

/// Whether a pose elsewhere explains much more of the scan than the trusted one did.
bool Localizer::doubts(const RelocationResult& found) const {
  if (!is_doubt_ || found.verdict == Status::lost) return false;
  const Pose2 own = tracker_.estimate().pose * inverse(since_search_.estimate().pose);
  return std::any_of(found.poses.begin(), found.poses.end(), [&](const RankedPose& pose) {
    return explains(pose.quality, settings_.status) &&
           pose.quality.evidence_ratio > doubted_ + settings_.recovery.doubt_gain &&
           !are_one(pose.pose, own, settings_.hypotheses);
  });
}

/// Takes what the search found, carried on to this scan by dead reckoning, and beside it the pose
/// that dead reckoning alone has kept.
void Localizer::take_search() {
  const RelocationResult found = finder_.take();
  if (hypotheses_.empty() && !is_anywhere_ && !trust_.contradicted()) {
    if (!doubts(found)) {
      if (is_doubt_) doubts_.note_failure(settings_.recovery);
      return;  // if it was lost, the scans have found it meanwhile
    }
    trust_.doubt();
  }
  const bool is_first = hypotheses_.empty();
  const FitRules rules{map_, settings_.refinement, settings_.tracking, settings_.status};
  bool is_news = found.verdict == Status::lost;
  const RelocationOptions searched = finder_options().relocation;
  const int most = std::min(searched.refined, searched.listed);
  std::vector<Hypotheses::Listed> listed;
  for (const RankedPose& pose : found.poses) {
    const PoseWithCovariance here =
        moved_by({pose.pose, pose.covariance}, since_search_.estimate());
    const double least = found.is_cut_off ? found.poses.back().weight : searched.least_weight;
    listed.push_back({here.pose, std::log(pose.weight / std::max(least, 1e-12))});
    if (found.verdict == Status::lost || !explains(pose.quality, settings_.status)) continue;
    if (hypotheses_.add_late(here, rules, settings_.hypotheses)) is_news = true;
  }
  hypotheses_.note_listed(listed, schedule_.way_before_m(), settings_.hypotheses);
  // A search fits so many poses and no more: in a mine that repeats itself the true one may be
  // missing. Only another search, elsewhere, that finds few and no new one says that none is; or
  // several that find many, the pose always before all that are left out.
  const bool is_few = static_cast<int>(found.poses.size()) <= most / 2;
  is_confirmed_ =
      !is_first && !is_news && (is_few || hypotheses_.leads_unlisted(settings_.hypotheses));
  if (hypotheses_.empty()) {
    schedule_.note_failure(settings_.recovery);
  } else if (is_first && !is_anywhere_) {
    if (trusted_m_ > settings_.hypotheses.own_way_m) {
      hypotheses_.add_own(tracker_, settings_.hypotheses);
    } else {
      hypotheses_.add(tracker_.estimate(), settings_.hypotheses);
    }
  }
}

/// The estimate becomes this hypothesis, as it was before this scan; it is that already where dead
/// reckoning leads.
void Localizer::follow(const Hypotheses::Hypothesis& hypothesis, const RefinementInput& input) {
  ambiguous_ = true;
  trust_.doubt();
  if (hypothesis.is_own) return;
  is_anywhere_ = false;
  rival_.reset();
  protection_.reset();
  displacement_.reset();
  tracker_ = hypothesis.predicted;
  predicted_ = tracker_.estimate();
  predicted_laser_ = carry(predicted_, vehicle_from_laser_);
  uses_features_ = false;  // they were matched elsewhere
  scan_fit_ = refine_from(input, {predicted_.pose, floored(predicted_.covariance)});
}

/// Begins a search: for a scan that contradicts the pose, for one of which a trusted pose explains
/// little, or for one at which a pose is about to be believed.
void Localizer::seek_elsewhere(const LaserScan& scan) {
  schedule_.drive(way_m_);
  if (!uses_points() || !settings_.recovery.searches || finder_.is_searching()) return;
  const bool is_lost = is_anywhere_ || trust_.contradicted();
  const bool is_on_way = schedule_.is_elsewhere(settings_.recovery);
  const auto is_due = [&] {
    if (!hypotheses_.empty()) return is_on_way || hypotheses_.is_decided(settings_.hypotheses);
    if (is_lost) return schedule_.is_search_due() || is_on_way;
    return is_doubtful() && doubts_.is_search_due();
  };
  if (!is_due()) return;
  if (scan_fit_.counts.returns() < settings_.status.fewest_returns && !is_anywhere_) return;
  finder_.begin(query_for(scan), finder_options());
  schedule_.begin(settings_.recovery);
  is_confirmed_ = false;
  is_doubt_ = hypotheses_.empty() && !is_lost;
  doubted_ = quality_of(scan_fit_).evidence_ratio;
  since_search_.start({});
}

}  // namespace adit
