#include "adit/recovery/hypotheses.hpp"

#include <algorithm>
#include <cmath>

#include "adit/relocation/fit_quality.hpp"

namespace adit {

bool are_one(const Pose2& a, const Pose2& b, const HypothesesOptions& options) {
  const Vector3d apart = difference(a, b);
  return apart.head<2>().norm() < options.same_place_m &&
         std::abs(apart.z()) < options.same_heading_rad;
}

void Hypotheses::add_own(const PoseTracker& tracker, const HypothesesOptions& options) {
  std::erase_if(all_, [&](const Hypothesis& known) {
    return are_one(known.tracker.estimate().pose, tracker.estimate().pose, options);
  });
  Hypothesis& own = all_.emplace_back();
  own.tracker = own.predicted = tracker;
  own.log_odds = options.own_gain;
  own.is_own = true;
  has_new_ = true;
}

bool Hypotheses::add(const PoseWithCovariance& map_from_vehicle, const HypothesesOptions& options) {
  const bool known = std::any_of(all_.begin(), all_.end(), [&](const Hypothesis& other) {
    return are_one(other.tracker.estimate().pose, map_from_vehicle.pose, options);
  });
  if (known) return false;
  Hypothesis& added = all_.emplace_back();
  added.tracker.start(map_from_vehicle);
  added.predicted = added.tracker;
  has_new_ = true;
  return true;
}

bool Hypotheses::add_late(const PoseWithCovariance& map_from_vehicle, const FitRules& rules,
                          const HypothesesOptions& options) {
  const bool others_know = !all_.empty() && memory_.size() > 0;
  const bool had_new = has_new_;
  if (!add(map_from_vehicle, options)) return false;
  if (!others_know) return true;
  has_new_ = had_new;
  if (!leading_past_) {
    leading_past_ = memory_.look_back(all_.front().tracker.estimate(), rules,
                                      options.sure_evidence_ratio, refiner_);
  }
  const Retrospect past = memory_.look_back(map_from_vehicle, rules, options.sure_evidence_ratio,
                                            refiner_, options.scans_to_refute);
  Hypothesis& added = all_.back();
  added.log_odds = all_.front().log_odds + lead_over_first(past);
  added.explained = past.explained;
  added.explained_m = past.explained_m;
  if (past.contradicted < options.scans_to_refute &&
      added.log_odds > all_.front().log_odds + std::log1p(-options.sure_weight)) {
    return true;
  }
  all_.pop_back();
  return false;
}

/// How much likelier a pose with this past is than the first (log), had it been known before.
double Hypotheses::lead_over_first(const Retrospect& past) const {
  double lead = 0.0;
  for (std::size_t i = 0; i < past.witnesses.size(); ++i) {
    const Witness& its = past.witnesses[i];
    const Witness& first = leading_past_->witnesses[i];
    const double more = its.log_likelihood - first.log_likelihood;
    lead += (more > 0.0 ? its : first).share_of_news * more;
  }
  return lead;
}

/// Keeps the scan, unless none of those that a search found explains it: it may have been taken
/// anywhere.
void Hypotheses::remember(const HypothesesTurn& turn, const HypothesesOptions& options) {
  const bool is_explained = std::any_of(all_.begin(), all_.end(), [](const Hypothesis& known) {
    return !known.is_own && known.contradicted == 0;
  });
  if (is_explained) memory_.add(turn.input, options.memory);
}

void Hypotheses::predict(const Pose2& move, const OdometryNoise& noise,
                         const TrackingOptions& options) {
  for (Hypothesis& hypothesis : all_) hypothesis.tracker.predict(move, noise, options);
  memory_.predict(move, noise, options);
}

void Hypotheses::blur(double metres, double radians) {
  for (Hypothesis& hypothesis : all_) hypothesis.tracker.blur(metres, radians);
  memory_.blur(metres, radians);
}

void Hypotheses::weigh(const HypothesesTurn& turn, const HypothesesOptions& options) {
  if (all_.empty()) return;
  leading_past_.reset();
  witnesses_.clear();
  for (Hypothesis& hypothesis : all_) witnesses_.push_back(take_in(hypothesis, turn, options));
  if (std::any_of(witnesses_.begin(), witnesses_.end(), [](const Witness& w) { return w.sees; })) {
    raise_odds(has_new_ ? 1.0 : std::min(1.0, turn.way_m / options.independent_way_m));
    has_new_ = false;
    remember(turn, options);
  }
  drop_contradicted(options);
  merge(options);
  normalise(options);
}

void Hypotheses::note_listed(std::span<const Listed> listed, double way_m,
                             const HypothesesOptions& options) {
  const double news = std::min(1.0, way_m / options.independent_way_m);
  for (Hypothesis& hypothesis : all_) {
    const auto found = std::find_if(listed.begin(), listed.end(), [&](const Listed& other) {
      return are_one(other.pose, hypothesis.tracker.estimate().pose, options);
    });
    hypothesis.unlisted_lead =
        found != listed.end() ? hypothesis.unlisted_lead + news * found->lead : 0.0;
  }
}

/// By what the scan says, if so much of it is new since the last.
void Hypotheses::raise_odds(double news) {
  const auto best = std::max_element(
      witnesses_.begin(), witnesses_.end(),
      [](const Witness& a, const Witness& b) { return a.log_likelihood < b.log_likelihood; });
  const double share = news * best->share_of_news;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    all_[i].log_odds += share * (witnesses_[i].log_likelihood - best->log_likelihood);
  }
}

/// Fits the scan near where dead reckoning has the hypothesis.
Witness Hypotheses::take_in(Hypothesis& hypothesis, const HypothesesTurn& turn,
                            const HypothesesOptions& options) {
  if (hypothesis.is_own) hypothesis.tracker = turn.own;
  hypothesis.predicted = hypothesis.tracker;
  const PoseWithCovariance start = loosened(hypothesis.tracker.estimate());
  const ScanFit& fit =
      hypothesis.is_own ? turn.own_fit : refiner_.refine(turn.input, start, start, turn.refinement);
  const Testimony says = testimony_of(fit, turn.status, options.sure_evidence_ratio);
  if (says == Testimony::blind) return {};
  if (says == Testimony::contradicts) {
    const bool may_hold = hypothesis.is_own && holds_but_for_a_wall(turn, start);
    hypothesis.explained = 0;
    hypothesis.contradicted = may_hold ? 0 : hypothesis.contradicted + 1;
  } else {
    judge(says, turn, hypothesis);
    hypothesis.tracker.update(observation_of(fit), turn.tracking);
  }
  return witness_of(fit);
}

/// Where one wall of the plan is wrong, a place that looks alike but for it explains scans better.
/// That alone does not refute the way here. The wall has drawn the fit to itself: without it the
/// scan is fitted anew. What is left must be some of the scan: where one wall gave nearly all of
/// it, any place fits the rest.
bool Hypotheses::holds_but_for_a_wall(const HypothesesTurn& turn, const PoseWithCovariance& start) {
  constexpr double kLeastLeft = 0.4;  // of the returns
  const double least =
      std::max(turn.status.fewest_returns, kLeastLeft * turn.own_fit.counts.returns());
  RefinementInput input = turn.input;
  return std::any_of(turn.own_worst_walls.begin(), turn.own_worst_walls.end(), [&](int wall) {
    input.missing_wall = wall;
    const FitQuality quality = quality_of(refiner_.refine(input, start, start, turn.refinement));
    return quality.returns >= least && explains(quality, turn.status);
  });
}

/// Counts the scans in a row that confirm a hypothesis. A scan that leaves a direction open does so
/// for all places in a drift: it neither counts nor ends the row.
void Hypotheses::judge(Testimony says, const HypothesesTurn& turn, Hypothesis& hypothesis) {
  hypothesis.contradicted = 0;
  const bool is_sure = says == Testimony::sure || hypothesis.is_own;
  if (!is_sure && says == Testimony::open) return;
  const bool goes_on = is_sure && hypothesis.explained > 0;
  hypothesis.explained_m = goes_on ? hypothesis.explained_m + turn.way_m : 0.0;
  hypothesis.explained = is_sure ? hypothesis.explained + 1 : 0;
}

void Hypotheses::drop_contradicted(const HypothesesOptions& options) {
  std::erase_if(all_, [&](const Hypothesis& hypothesis) {
    return !hypothesis.is_own && hypothesis.contradicted >= options.scans_to_refute;
  });
}

/// Of those that have met, the more plausible is kept.
void Hypotheses::merge(const HypothesesOptions& options) {
  std::stable_sort(all_.begin(), all_.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.log_odds > b.log_odds;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const auto end = all_.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto better = std::find_if(all_.begin(), end, [&](const Hypothesis& other) {
      return are_one(other.tracker.estimate().pose, all_[i].tracker.estimate().pose, options);
    });
    if (better != end) {
      better->is_own = better->is_own || all_[i].is_own;
      continue;
    }
    if (kept != i) all_[kept] = all_[i];
    ++kept;
  }
  all_.resize(kept);
}

void Hypotheses::normalise(const HypothesesOptions& options) {
  if (all_.empty()) return;
  const double most = all_.front().log_odds;
  double sum = 0.0;
  for (Hypothesis& hypothesis : all_) {
    hypothesis.log_odds -= most;
    hypothesis.weight = std::exp(hypothesis.log_odds);
    sum += hypothesis.weight;
  }
  for (Hypothesis& hypothesis : all_) hypothesis.weight /= sum;
  int rank = 0;
  std::erase_if(all_, [&](const Hypothesis& hypothesis) {
    return !hypothesis.is_own &&
           (++rank > options.most_carried || hypothesis.weight < options.least_weight);
  });
}

const Hypotheses::Hypothesis* Hypotheses::own() const {
  const auto own = std::find_if(all_.begin(), all_.end(),
                                [](const Hypothesis& hypothesis) { return hypothesis.is_own; });
  return own != all_.end() ? &*own : nullptr;
}

const Hypotheses::Hypothesis& Hypotheses::leader() const {
  const Hypothesis* mine = own();
  return mine != nullptr ? *mine : all_.front();
}

Matrix3d Hypotheses::covariance_about(const Pose2& pose) const {
  Matrix3d sum = Matrix3d::Zero();
  for (const Hypothesis& hypothesis : all_) {
    const PoseWithCovariance& at = hypothesis.tracker.estimate();
    const Vector3d apart = difference(pose, at.pose);
    sum += hypothesis.weight * (at.covariance + apart * apart.transpose());
  }
  return sum;
}

bool Hypotheses::is_decided(const HypothesesOptions& options) const {
  if (all_.empty() || all_.front().weight < options.sure_weight) return false;
  const Hypothesis& best = all_.front();
  if (best.explained < options.scans_to_confirm) return false;
  if (best.is_own) return true;
  // Where the plan is wrong another place may explain the scans better; not as long as the way
  // here.
  const Hypothesis* mine = own();
  const bool own_holds = mine != nullptr && mine->contradicted < options.scans_to_refute;
  return !own_holds && best.explained_m >= options.way_to_confirm_m;
}

}  // namespace adit
