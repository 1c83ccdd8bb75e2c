#include "adit/refinement/classification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "adit/refinement/beam_chain.hpp"
#include "adit/simulation/random.hpp"

namespace adit {
namespace {

constexpr double kSigma = 0.05;
constexpr double kRange = 8.0;

BeamResidual beam(double residual, double range = kRange, bool has_return = true) {
  BeamResidual result;
  result.gradient.setZero();
  result.normal = result.direction = result.hit = Vector2d::Zero();
  result.residual = residual;
  result.range = range;
  result.measured = range + residual;
  result.has_return = has_return;
  return result;
}

struct Classified {
  explicit Classified(const std::vector<BeamResidual>& beams,
                      const std::vector<double>& variances = {}, const BeamPriors& priors = {}) {
    const std::vector<double> same(beams.size(), kSigma * kSigma);
    const std::vector<double>& each = variances.empty() ? same : variances;
    classifier.classify(beams, each, priors);
    summary = classifier.summary(beams);
  }
  double on_wall(std::size_t beam) const { return classifier.on_wall()[beam]; }

  BeamClassifier classifier;
  BeamSummary summary;
};

/// Density of a return if the beam met the wall, against something else: that stands anywhere up to
/// the wall's range before it or, less often, as far behind, and farther where the beam went
/// farther.
double ratio_of(const BeamResidual& at, double variance, const BeamPriors& priors) {
  if (!at.has_return) return 1.0;
  const double wall =
      std::exp(-0.5 * at.residual * at.residual / variance) / std::sqrt(kTwoPi * variance);
  const double share = at.residual < 0.0 ? 1.0 - priors.long_ratio : priors.long_ratio;
  const double way = std::max(at.range, at.has_return ? 0.5 * (at.range + at.residual) : 0.0);
  return wall / (share / way);
}

struct Exact {
  std::vector<double> on_wall;
  double log_evidence = 0.0;
};

/// Of a return if the beam met a wall of that class: its residual is of one of both.
double ratio_in(Eigen::Index met, const BeamResidual& at, double variance,
                const BeamPriors& priors) {
  if (met == Met::kOther || !at.has_return) return 1.0;
  return (met == Met::kBeyond) == at.is_beyond ? ratio_of(at, variance, priors) : 0.0;
}

/// Every sequence of classes, one by one; a chain in its steady state.
Exact enumerate(const std::vector<BeamResidual>& beams, const std::vector<double>& variances,
                const BeamPriors& priors) {
  const Matrix3d next = transition(priors);
  const Vector3d begin = steady_state(priors);
  const std::size_t count = beams.size();
  Exact exact{std::vector<double>(count, 0.0), 0.0};
  double total = 0.0;
  std::size_t sequences = 1;
  for (std::size_t i = 0; i < count; ++i) sequences *= 3;
  for (std::size_t sequence = 0; sequence < sequences; ++sequence) {
    std::vector<Eigen::Index> met;
    for (std::size_t left = sequence; met.size() < count; left /= 3) {
      met.push_back(static_cast<Eigen::Index>(left % 3));
    }
    double probability = begin[met[0]];
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) probability *= next(met[i - 1], met[i]);
      probability *= ratio_in(met[i], beams[i], variances[i], priors);
    }
    total += probability;
    for (std::size_t i = 0; i < count; ++i) {
      exact.on_wall[i] += met[i] == Met::kOther ? 0.0 : probability;
    }
  }
  for (double& one : exact.on_wall) one /= total;
  exact.log_evidence = std::log(total);
  return exact;
}

TEST(BeamClassifier, AgreesWithEverySequenceOfClasses) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    BeamPriors priors;
    priors.leave_ratio = random.uniform(0.005, 0.5);
    priors.back_ratio = random.uniform(0.005, 0.5);
    priors.gone_ratio = random.uniform(0.001, 0.5);
    priors.long_ratio = random.uniform(0.02, 0.6);
    std::vector<BeamResidual> beams;
    std::vector<double> variances;
    for (int i = 0; i < 1 + random.below(7); ++i) {
      const double sigma = random.uniform(0.01, 0.3);
      variances.push_back(sigma * sigma);
      const bool is_return = random.chance(0.8);
      const double range = random.uniform(0.5, 20.0);
      beams.push_back(beam(4.0 * sigma * random.normal(), range, is_return));
      beams.back().is_beyond = random.chance(0.4);
    }
    const Exact exact = enumerate(beams, variances, priors);
    const Classified found(beams, variances, priors);
    ASSERT_EQ(found.classifier.on_wall().size(), beams.size());
    EXPECT_NEAR(found.classifier.log_evidence(), exact.log_evidence, 1e-9);
    for (std::size_t i = 0; i < beams.size(); ++i) {
      EXPECT_NEAR(found.on_wall(i), beams[i].has_return ? exact.on_wall[i] : 0.0, 1e-9);
    }
  }
}

/// A door costs once, not once a beam.
TEST(BeamClassifier, AWallThatIsGoneIsGoneForARunOfBeams) {
  const auto evidence = [](std::size_t through) {
    std::vector<BeamResidual> beams(60, beam(0.0));
    for (std::size_t i = 20; i < 20 + through; ++i) beams[i].is_beyond = true;
    const Classified found(beams);
    for (std::size_t i = 0; i < 60; ++i) EXPECT_GT(found.on_wall(i), 0.9) << i;
    return found.classifier.log_evidence();
  };
  const BeamPriors priors;
  const double stays = std::log((1.0 - priors.gone_ratio) * (1.0 - priors.back_ratio));
  const double no_door = evidence(0);
  const double of_one = evidence(1);
  EXPECT_NEAR(evidence(20) - of_one, 19.0 * (stays - std::log(0.995 * 0.97)), 0.05);
  EXPECT_NEAR(of_one - no_door, std::log(priors.gone_ratio * 0.1 / (0.995 * 0.97 * 0.97)), 0.2);
}

TEST(BeamClassifier, ARunOfShortBeamsStandsBeforeTheWall) {
  std::vector<BeamResidual> beams(60, beam(0.0));
  for (std::size_t i = 20; i < 30; ++i) beams[i].residual = -1.5;
  const Classified found(beams);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (i >= 20 && i < 30) {
      EXPECT_LT(found.on_wall(i), 1e-6);
    } else {
      EXPECT_GT(found.on_wall(i), 0.98);
    }
  }
  EXPECT_NEAR(found.summary.counts.before, 10.0, 0.5);
  EXPECT_NEAR(found.summary.counts.behind, 0.0, 0.5);
  EXPECT_NEAR(found.summary.counts.wall, 50.0, 0.5);
}

TEST(BeamClassifier, NeighboursSpeakForABeam) {
  // A beam that lies 2.5 sigma short: on a wall it belongs to the wall, in a box to the box.
  std::vector<BeamResidual> wall(21, beam(0.0));
  std::vector<BeamResidual> box(21, beam(-20.0 * kSigma));
  wall[10].residual = box[10].residual = -2.5 * kSigma;
  EXPECT_GT(Classified(wall).on_wall(10), Classified(box).on_wall(10) + 0.3);
}

TEST(BeamClassifier, LoneDustIsBeforeTheWall) {
  std::vector<BeamResidual> beams(60, beam(0.0));
  for (std::size_t i = 5; i < 60; i += 11) beams[i].residual = -4.0;
  const Classified found(beams);
  for (std::size_t i = 5; i < 60; i += 11) EXPECT_LT(found.on_wall(i), 1e-6);
  EXPECT_GT(found.on_wall(6), 0.98);
  EXPECT_NEAR(found.summary.counts.before, 5.0, 0.5);
}

TEST(BeamClassifier, LongBeamsAreBehindAWallThatIsNotThere) {
  std::vector<BeamResidual> beams(60, beam(0.0));
  for (std::size_t i = 30; i < 60; ++i) beams[i].residual = 2.0;
  const Classified found(beams);
  for (std::size_t i = 30; i < 60; ++i) EXPECT_LT(found.on_wall(i), 1e-6);
  EXPECT_NEAR(found.summary.counts.behind, 30.0, 0.5);
  EXPECT_NEAR(found.summary.counts.before, 0.0, 0.5);
  EXPECT_EQ(found.summary.counts.returns(), 60.0);
}

TEST(BeamClassifier, BeamsWithoutReturnSayNothing) {
  Random random(3);
  std::vector<BeamResidual> beams;
  for (int i = 0; i < 40; ++i) beams.push_back(beam(kSigma * random.normal(), kRange, i % 3 != 0));
  std::vector<BeamResidual> others = beams;
  for (std::size_t i = 0; i < others.size(); i += 3) {
    others[i].residual = random.uniform(-3.0, 3.0);
    others[i].range = random.uniform(1.0, 30.0);
  }
  const Classified one(beams);
  const Classified other(others);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    EXPECT_EQ(one.on_wall(i), other.on_wall(i));
    if (i % 3 == 0) {
      EXPECT_EQ(one.on_wall(i), 0.0);
    }
  }
  EXPECT_EQ(one.classifier.log_evidence(), other.classifier.log_evidence());
  EXPECT_EQ(one.summary.expected_log_evidence, other.summary.expected_log_evidence);
  EXPECT_DOUBLE_EQ(one.summary.counts.no_return, 14.0);
  EXPECT_EQ(one.summary.counts.returns(), 26.0);
}

TEST(BeamClassifier, CountsReturnsOneByOneWhateverTheirProbabilities) {
  // Twenty returns are what the least of a scan is: a sum of their probabilities may fall short.
  Random random(11);
  for (int run = 0; run < 200; ++run) {
    std::vector<BeamResidual> beams;
    for (int i = 0; i < 20; ++i) beams.push_back(beam(3.0 * kSigma * random.normal()));
    EXPECT_EQ(Classified(beams).summary.counts.returns(), 20.0) << run;
  }
}

TEST(BeamClassifier, TheEvidenceOfAScanOfWallsIsAsExpected) {
  Random random(4);
  std::vector<BeamResidual> walls;
  std::vector<BeamResidual> clutter;
  for (int i = 0; i < 5000; ++i) {
    const double range = random.uniform(2.0, 20.0);
    walls.push_back(beam(kSigma * random.normal(), range));
    clutter.push_back(beam(random.uniform(-range, 0.0), range));
  }
  const Classified on_walls(walls);
  const double expected = on_walls.summary.expected_log_evidence;
  EXPECT_GT(expected, 10000.0);
  EXPECT_NEAR(on_walls.classifier.log_evidence(), expected, 0.05 * expected);
  EXPECT_LT(Classified(clutter).classifier.log_evidence(), 0.05 * expected);
}

TEST(BeamClassifier, LongScansKeepTheirEvidence) {
  // The evidence of so many beams alike is a sum; none may get lost in a product that overflows.
  const auto evidence = [](std::size_t beams) {
    return Classified(std::vector<BeamResidual>(beams, beam(0.0, 50.0))).classifier.log_evidence();
  };
  const double of_one = (evidence(1000) - evidence(500)) / 500.0;
  EXPECT_NEAR(evidence(20000) - evidence(1000), 19000.0 * of_one, 1e-6 * evidence(20000));
  const Classified far(std::vector<BeamResidual>(3000, beam(-1e6)));
  EXPECT_TRUE(std::isfinite(far.classifier.log_evidence()));
  EXPECT_LT(far.classifier.log_evidence(), 0.0);
  EXPECT_LT(far.on_wall(1500), 1e-6);
}

TEST(BeamClassifier, SomethingElseIsLikelierBeforeNearWalls) {
  // The same returns at 4 m: as clutter before a wall at 8 m, or before one at 40 m.
  const BeamPriors priors;
  const auto other = [&](double range) {
    return log_other(std::vector<BeamResidual>(10, beam(4.0 - range, range)), priors);
  };
  EXPECT_NEAR(other(8.0) - other(40.0), 10.0 * std::log(5.0), 1e-9);
  EXPECT_NEAR(other(8.0), 10.0 * std::log((1.0 - priors.long_ratio) * 0.5), 1e-9);
  EXPECT_EQ(log_other(std::vector<BeamResidual>(3, beam(0.0, 8.0, false)), priors), 0.0);
}

/// All that is seen from there lies far behind the wall.
TEST(LogOther, APoseCloseByAWallMakesNothingBehindItLikely) {
  const BeamPriors priors;
  const auto other = [&](double range) {
    return log_other(std::vector<BeamResidual>(10, beam(9.0 - range, range)), priors);
  };
  EXPECT_NEAR(other(0.001), other(0.1), 1e-9);
  EXPECT_LT(other(0.001), 0.0);
  EXPECT_GT(other(0.001), other(8.0) - 1e-9);
}

TEST(BeamClassifier, AScanWithoutBeamsIsNothing) {
  const Classified none({});
  EXPECT_TRUE(none.classifier.on_wall().empty());
  EXPECT_EQ(none.classifier.log_evidence(), 0.0);
  EXPECT_EQ(none.summary.counts.returns(), 0.0);
}

TEST(BeamClassifier, AShorterScanAfterALongOneHasItsOwnLength) {
  BeamClassifier classifier;
  const std::vector<BeamResidual> many(50, beam(-2.0));
  const std::vector<BeamResidual> few(7, beam(0.0));
  const std::vector<double> variances(50, kSigma * kSigma);
  classifier.classify(many, variances, {});
  classifier.classify(few, variances, {});
  const Classified fresh(few);
  ASSERT_EQ(classifier.on_wall().size(), few.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(classifier.on_wall()[i], fresh.on_wall(i));
  }
  EXPECT_EQ(classifier.log_evidence(), fresh.classifier.log_evidence());
}

}  // namespace
}  // namespace adit
