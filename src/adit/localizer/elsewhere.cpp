// Where the pose is lost: the search in the whole mine, and the hypotheses that it leaves.

#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/geometry/uncertain_move.hpp"
#include "adit/localizer/belief.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

/// Every pose that may be the true one is held against the scan; one of them is the estimate.
bool Belief::weigh(const RefinementInput& input, const Fits& fits, std::span<const int> worst_walls,
                   const Motion& motion) {
  hypotheses_.weigh({input, motion.way_m(), settings_.refinement, settings_.tracking,
                     settings_.status, tracker_, fits.best, worst_walls},
                    settings_.hypotheses);
  if (hypotheses_.empty()) {
    give_up();
    return false;
  }
  const Hypotheses::Hypothesis& best = hypotheses_.all().front();
  const bool is_own = best.is_own;
  const bool is_believed =
      hypotheses_.is_decided(settings_.hypotheses) && (is_own || is_confirmed_);
  is_confirmed_ = false;  // of the pose that led at this scan
  const bool is_elsewhere = follow(is_believed ? best : hypotheses_.leader());
  if (is_believed) {
    believe(is_own);
  } else if (hypotheses_.is_hopeless()) {
    give_up();
  }
  return is_elsewhere;
}

/// One pose is left, and the scans speak for it.
void Belief::believe(bool is_own) {
  hypotheses_.clear();
  trust_.reset();
  is_ambiguous_ = false;
  is_found_ = true;
  if (!is_own) trusted_m_ = 0.0;
}

/// None is left.
void Belief::give_up() {
  hypotheses_.clear();
  is_anywhere_ = !is_found_;
  search_.schedule().note_failure(settings_.recovery);
}

/// The estimate becomes this hypothesis, as it was before this scan; it is that already where dead
/// reckoning leads.
bool Belief::follow(const Hypotheses::Hypothesis& hypothesis) {
  is_ambiguous_ = true;
  trust_.doubt();
  if (hypothesis.is_own) return false;
  is_anywhere_ = false;
  rival_.reset();
  tracker_ = hypothesis.predicted;
  predicted_ = tracker_.estimate();
  return true;
}

/// Takes what the search found, carried on to this scan by dead reckoning, and beside it the pose
/// that dead reckoning alone has kept.
void Belief::admit_found() {
  if (!search_.is_answer_due()) return;
  const RelocationResult found = search_.take();
  if (hypotheses_.empty() && !is_lost()) {
    if (!doubts(found)) {
      if (search_.is_doubt()) search_.doubts().note_failure(settings_.recovery);
      return;  // if it was lost, the scans have found it meanwhile
    }
    trust_.doubt();
  }
  const bool is_first = hypotheses_.empty();
  const bool is_news = admit(found);
  // A search fits so many poses and no more: in a mine that repeats itself the true one may be
  // missing. Only another search, elsewhere, that finds few and no new one says that none is; or
  // several that find many, the pose always before all that are left out.
  const RelocationOptions searched = search_.finder_options().relocation;
  const int most = std::min(searched.refined, searched.listed);
  const bool is_few = static_cast<int>(found.poses.size()) <= most / 2;
  is_confirmed_ =
      !is_first && !is_news && (is_few || hypotheses_.leads_unlisted(settings_.hypotheses));
  if (hypotheses_.empty()) {
    search_.schedule().note_failure(settings_.recovery);
  } else if (is_first && !is_anywhere_) {
    add_tracked();
  }
}

/// True where the search found nothing, or a pose that is not held already.
bool Belief::admit(const RelocationResult& found) {
  const FitRules rules{map_, settings_.refinement, settings_.tracking, settings_.status};
  const double cut_off = search_.finder_options().relocation.least_weight;
  bool is_news = found.verdict == Status::lost;
  std::vector<Hypotheses::Listed> listed;
  for (const RankedPose& pose : found.poses) {
    const PoseWithCovariance here = moved_by({pose.pose, pose.covariance}, search_.since_begun());
    const double least = found.is_cut_off ? found.poses.back().weight : cut_off;
    listed.push_back({here.pose, std::log(pose.weight / std::max(least, 1e-12))});
    if (found.verdict == Status::lost || !explains(pose.quality, settings_.status)) continue;
    if (hypotheses_.add_late(here, rules, settings_.hypotheses)) is_news = true;
  }
  hypotheses_.note_listed(listed, search_.schedule().way_before_m(), settings_.hypotheses);
  return is_news;
}

/// Whether a pose elsewhere explains much more of the scan than the trusted one did.
bool Belief::doubts(const RelocationResult& found) const {
  if (!search_.is_doubt() || found.verdict == Status::lost) return false;
  const Pose2 own = tracker_.estimate().pose * inverse(search_.since_begun().pose);
  return std::any_of(found.poses.begin(), found.poses.end(), [&](const RankedPose& pose) {
    return explains(pose.quality, settings_.status) &&
           pose.quality.evidence_ratio > search_.explained() + settings_.recovery.doubt_gain &&
           !are_one(pose.pose, own, settings_.hypotheses);
  });
}

/// The pose that dead reckoning alone has kept, which counts for more where it was trusted for
/// long.
void Belief::add_tracked() {
  if (trusted_m_ > settings_.hypotheses.own_way_m) {
    hypotheses_.add_own(tracker_, settings_.hypotheses);
  } else {
    hypotheses_.add(tracker_.estimate(), settings_.hypotheses);
  }
}

/// A search is due for a scan that contradicts the pose, for one of which a trusted pose explains
/// little, and for one at which a pose is about to be believed.
bool Belief::is_search_due(const Fits& fits) {
  const bool is_on_way = search_.schedule().is_elsewhere(settings_.recovery);
  if (!hypotheses_.empty()) return is_on_way || hypotheses_.is_decided(settings_.hypotheses);
  if (is_lost()) return search_.schedule().is_search_due() || is_on_way;
  const FitQuality quality = quality_of(fits.best);
  const bool is_doubtful = is_trusted_ && quality.returns >= settings_.status.fewest_returns &&
                           quality.evidence_ratio < settings_.recovery.doubtful_evidence_ratio;
  return is_doubtful && search_.doubts().is_search_due();
}

void Belief::seek(const RefinementInput& input, const Fits& fits, const Motion& motion) {
  search_.schedule().drive(motion.way_m());
  if (!uses_points() || !settings_.recovery.searches || search_.is_searching()) return;
  if (!is_search_due(fits)) return;
  if (fits.best.counts.returns() < settings_.status.fewest_returns && !is_anywhere_) return;
  is_confirmed_ = false;
  search_.begin({input.scan, input.scanner, input.map_error, input.motion, std::nullopt},
                hypotheses_.empty() && !is_lost(), quality_of(fits.best).evidence_ratio);
}

}  // namespace adit
