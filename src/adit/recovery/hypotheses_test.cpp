#include "adit/recovery/hypotheses.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/recovery_scene.hpp"

namespace adit {
namespace {

/// Two rooms that are alike but for a niche in the second, forty metres farther east.
std::vector<Segment> two_rooms() {
  std::vector<Segment> plan;
  for (const double x : {0.0, 40.0}) {
    plan.push_back({{x, 0}, {x + 20, 0}});
    plan.push_back({{x + 20, 0}, {x + 20, 12}});
    plan.push_back({{x, 12}, {x, 0}});
  }
  plan.push_back({{20, 12}, {0, 12}});
  for (const Segment& side :
       {Segment{{60, 12}, {58, 12}}, Segment{{58, 12}, {58, 15}}, Segment{{58, 15}, {52, 15}},
        Segment{{52, 15}, {52, 12}}, Segment{{52, 12}, {40, 12}}}) {
    plan.push_back(side);
  }
  return plan;
}

class HypothesesTest : public RecoveryScene {
 protected:
  HypothesesTest() : RecoveryScene(two_rooms()) {}

  void drive(Hypotheses& hypotheses, const Pose2& truth, double way_m) {
    hypotheses.predict({way_m, 0.0, 0.0}, OdometryNoise{}, tracking);
    const LaserScan scan = scan_from(truth);
    const RefinementInput input{map, scan, scanner, error, std::nullopt};
    own.predict({way_m, 0.0, 0.0}, OdometryNoise{}, tracking);
    Refiner refiner;
    const ScanFit fit = refiner.refine(input, own.estimate(), own.estimate(), refinement);
    own_says = testimony_of(fit, status, options.sure_evidence_ratio);
    hypotheses.weigh(
        {input, way_m, refinement, tracking, status, own, fit, refiner.worst_walls(excuses)},
        options);
  }

  HypothesesOptions options;
  PoseTracker own;  // the pose by dead reckoning
  Testimony own_says = Testimony::blind;
  std::size_t excuses = 3;  // walls that may have moved
};

TEST_F(HypothesesTest, RoomsThatLookAlikeStayUndecided) {
  const auto blind = [](double x) { return Pose2{x, 2.0, 0.0}; };
  Hypotheses hypotheses;
  // From here a scanner of seven metres sees no niche.
  scanner.max_range_m = 7.0;
  hypotheses.add(near(blind(3.0)), options);
  hypotheses.add(near(blind(43.0)), options);
  for (int i = 1; i <= 4; ++i) drive(hypotheses, blind(3.0 + 0.5 * i), 0.5);
  ASSERT_EQ(hypotheses.size(), 2u);
  EXPECT_FALSE(hypotheses.is_decided(options));
  EXPECT_GT(hypotheses.all()[1].weight, 0.01);
}

TEST_F(HypothesesTest, WhatTellsThemApartDecidesAfterSomeWay) {
  Hypotheses hypotheses;
  hypotheses.add(near({6.0, 6.0, 0.0}), options);
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  drive(hypotheses, {46.5, 6.0, 0.0}, 0.5);
  ASSERT_FALSE(hypotheses.empty());
  EXPECT_NEAR(hypotheses.all().front().tracker.estimate().pose.x, 46.5, 0.1);
  EXPECT_FALSE(hypotheses.is_decided(options));  // one scan, and no way
  for (int i = 1; i <= 6; ++i) drive(hypotheses, {46.5 + 0.5 * i, 6.0, 0.0}, 0.5);
  EXPECT_TRUE(hypotheses.is_decided(options));
  EXPECT_NEAR(hypotheses.leader().tracker.estimate().pose.x, 49.5, 0.1);
}

TEST_F(HypothesesTest, APoseThatIsFoundLateIsHeldAgainstTheWay) {
  const FitRules rules{map, refinement, tracking, status};
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  for (int i = 1; i <= 10; ++i) drive(hypotheses, {46.0 + 0.5 * i, 6.0, 0.0}, 0.5);
  // What the first room shows has never been what the scans saw.
  EXPECT_FALSE(hypotheses.add_late(near({11.0, 6.0, 0.0}), rules, options));
  EXPECT_FALSE(hypotheses.add_late(near({51.0, 6.0, kPi}), rules, options));
  EXPECT_EQ(hypotheses.size(), 1u);
}

TEST_F(HypothesesTest, ATrueOneThatIsFoundLateHasTheWayToItsCredit) {
  const FitRules rules{map, refinement, tracking, status};
  Hypotheses hypotheses;
  hypotheses.add(near({6.0, 6.0, 0.0}), options);
  status.least_evidence_ratio = 0.0;  // it is not contradicted, only unlikely
  status.evidence_per_behind = 0.0;
  status.most_behind_ratio = 1.0;
  for (int i = 1; i <= 10; ++i) drive(hypotheses, {46.0 + 0.5 * i, 6.0, 0.0}, 0.5);
  ASSERT_EQ(hypotheses.size(), 1u);
  ASSERT_TRUE(hypotheses.add_late(near({51.0, 6.0, 0.0}), rules, options));
  drive(hypotheses, {51.0, 6.0, 0.0}, 0.0);
  EXPECT_NEAR(hypotheses.all().front().tracker.estimate().pose.x, 51.0, 0.1);
  EXPECT_GT(hypotheses.all().front().weight, options.sure_weight);
  EXPECT_GE(hypotheses.all().front().explained_m, options.way_to_confirm_m);
}

TEST_F(HypothesesTest, OneThatLeadsWhatManySearchesLeftOutIsComplete) {
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  const Pose2 here = hypotheses.all().front().tracker.estimate().pose;
  const std::vector<Hypotheses::Listed> listed = {{here, 4.0}};
  hypotheses.note_listed(listed, 2.0, options);
  hypotheses.note_listed(listed, 0.0, options);  // the same walls again
  hypotheses.note_listed(listed, 2.0, options);
  EXPECT_FALSE(hypotheses.leads_unlisted(options));
  hypotheses.note_listed(listed, 1.0, options);
  EXPECT_TRUE(hypotheses.leads_unlisted(options));
  hypotheses.note_listed({}, 2.0, options);  // a search that does not find it
  EXPECT_FALSE(hypotheses.leads_unlisted(options));
}

TEST_F(HypothesesTest, StandingStillDecidesNothing) {
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  for (int i = 0; i < 20; ++i) drive(hypotheses, {46.0, 6.0, 0.0}, 0.0);
  EXPECT_FALSE(hypotheses.is_decided(options));
}

TEST_F(HypothesesTest, ThePoseByDeadReckoningLeadsUntilAnotherIsBelieved) {
  own.start(near({6.0, 6.0, 2.0}));  // no scan fits there
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  hypotheses.add_own(own, options);
  for (int i = 1; i <= 3; ++i) {
    drive(hypotheses, {46.0 + 0.5 * i, 6.0, 0.0}, 0.5);
    EXPECT_TRUE(hypotheses.leader().is_own);
    EXPECT_FALSE(hypotheses.is_decided(options));
  }
  for (int i = 4; i <= 8; ++i) drive(hypotheses, {46.0 + 0.5 * i, 6.0, 0.0}, 0.5);
  EXPECT_TRUE(hypotheses.is_decided(options));
  EXPECT_FALSE(hypotheses.all().front().is_own);
}

TEST_F(HypothesesTest, WhichIsRightIsPartOfTheCovariance) {
  scanner.max_range_m = 7.0;  // sees no niche: one is as likely as the other
  Hypotheses hypotheses;
  hypotheses.add(near({3.0, 2.0, 0.0}), options);
  hypotheses.add(near({43.0, 2.0, 0.0}), options);
  drive(hypotheses, {3.5, 2.0, 0.0}, 0.5);
  const Pose2 first = hypotheses.all().front().tracker.estimate().pose;
  const Pose2 second = hypotheses.all().back().tracker.estimate().pose;
  const double weight = hypotheses.all().back().weight;
  ASSERT_GT(weight, 0.1);
  const Matrix3d covariance = hypotheses.covariance_about(first);
  EXPECT_NEAR(covariance(0, 0), weight * std::pow(second.x - first.x, 2), 0.1);
  EXPECT_LT(covariance(1, 1), 0.01);
}

TEST_F(HypothesesTest, ABlindScanLeavesTheNewsToTheNext) {
  Hypotheses seeing, blinded;
  for (Hypotheses* hypotheses : {&seeing, &blinded}) {
    hypotheses->add(near({46.0, 6.0, 0.0}), options);
    hypotheses->add(near({6.0, 6.0, 0.0}), options);
  }
  const double range_m = scanner.max_range_m;
  scanner.max_range_m = 0.5;
  drive(blinded, {46.0, 6.0, 0.0}, 0.0);
  scanner.max_range_m = range_m;
  drive(seeing, {46.0, 6.0, 0.0}, 0.0);
  drive(blinded, {46.0, 6.0, 0.0}, 0.0);
  ASSERT_EQ(seeing.size(), blinded.size());
  EXPECT_NEAR(seeing.all().front().weight, blinded.all().front().weight, 1e-6);
  EXPECT_GT(seeing.all().front().weight, 0.9);
}

// The plan may be wrong here, and a place elsewhere look more like what is seen.
TEST_F(HypothesesTest, NoneIsBelievedWhileThePoseByDeadReckoningExplainsTheScans) {
  own.start(near({6.0, 6.0, 0.0}));
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  hypotheses.add_own(own, options);
  for (int i = 1; i <= 8; ++i) drive(hypotheses, {46.0 + 0.5 * i, 6.0, 0.0}, 0.5);
  EXPECT_GT(hypotheses.all().front().weight, options.sure_weight);
  EXPECT_FALSE(hypotheses.is_decided(options));
  EXPECT_TRUE(hypotheses.leader().is_own);
}

TEST_F(HypothesesTest, OneWallThatHasMovedDoesNotRefuteTheWayHere) {
  // The second room is the first with its far wall drawn back, and so is the world's first room.
  const auto room = [](double x0, double x1) {
    const Vector2d a(x0, 0.0), b(x1, 0.0), c(x1, 9.0), d(x0, 9.0);
    return std::vector<Segment>{{a, b}, {b, c}, {c, d}, {d, a}};
  };
  std::vector<Segment> plan = room(0.0, 8.0);
  for (const Segment& wall : room(40.0, 52.0)) plan.push_back(wall);
  map = LineMap::build(plan);
  status.most_behind_ratio = 0.25;  // as many beams as that wall takes contradict a pose
  own.start(near({4.0, 4.0, 0.2}));
  Hypotheses hypotheses;
  hypotheses.add(near({44.0, 4.0, 0.2}), options);
  hypotheses.add_own(own, options);
  Pose2 seen = Pose2{44.0, 4.0, 0.2} * Pose2{0.3, 0.0, 0.0};
  for (int i = 0; i < 12; ++i) {
    drive(hypotheses, seen, 0.3);
    seen = seen * Pose2{0.3, 0.0, 0.0};
    EXPECT_FALSE(hypotheses.is_decided(options)) << i;
  }
  EXPECT_GT(hypotheses.all().front().weight, 0.99);
  EXPECT_FALSE(hypotheses.all().front().is_own);
}

// Between a wall that is right and one that is not the fit comes to lie where it explains neither.
TEST_F(HypothesesTest, AWallThatDrawsTheFitToItselfDoesNotRefuteTheWayHereEither) {
  const auto drift = [](double x0, double width) {
    const Vector2d a(x0, 0.0), b(x0 + 30.0, 0.0), c(x0 + 30.0, width), d(x0, width);
    return std::vector<Segment>{{a, b}, {b, c}, {c, d}, {d, a}};
  };
  std::vector<Segment> plan = drift(0.0, 5.0);
  for (const Segment& wall : drift(100.0, 6.0)) plan.push_back(wall);
  map = LineMap::build(plan);
  status.least_evidence_ratio = status.most_evidence_ratio = 0.7;  // half a scan is too little
  for (const bool is_excused : {true, false}) {
    excuses = is_excused ? 3 : 0;
    own.start(near({8.0, 2.5, 0.0}));
    Hypotheses hypotheses;
    hypotheses.add(near({108.0, 3.0, 0.0}), options);
    hypotheses.add_own(own, options);
    int contradicted = 0;
    for (int i = 1; i <= 8; ++i) {
      drive(hypotheses, {108.0 + 0.5 * i, 3.0, 0.0}, 0.5);
      contradicted += own_says == Testimony::contradicts;
    }
    EXPECT_EQ(contradicted, 8);
    EXPECT_NE(hypotheses.is_decided(options), is_excused);
    EXPECT_GT(hypotheses.all().front().weight, 0.99);
    EXPECT_FALSE(hypotheses.all().front().is_own);
  }
}

TEST_F(HypothesesTest, WhatASearchFindsWhereDeadReckoningIsNeedsNoWay) {
  own.start(near({46.0, 6.0, 0.0}));
  Hypotheses hypotheses;
  hypotheses.add(near({46.2, 6.0, 0.02}), options);
  hypotheses.add_own(own, options);
  EXPECT_EQ(hypotheses.size(), 1u);
  drive(hypotheses, {46.0, 6.0, 0.0}, 0.0);
  drive(hypotheses, {46.0, 6.0, 0.0}, 0.0);
  EXPECT_TRUE(hypotheses.is_decided(options));
}

TEST_F(HypothesesTest, ContradictedPosesAreGivenUp) {
  own.start(near({4.0, 30.0, 1.0}));  // in rock
  Hypotheses hypotheses;
  hypotheses.add(near({5.0, 6.0, 0.0}), options);
  hypotheses.add(near({15.0, 4.0, 2.0}), options);
  hypotheses.add_own(own, options);
  for (int i = 0; i < 3; ++i) drive(hypotheses, {50.0, 3.0, 1.2}, 0.0);
  ASSERT_EQ(hypotheses.size(), 1u);
  EXPECT_TRUE(hypotheses.is_hopeless());
}

TEST_F(HypothesesTest, PosesThatMeetBecomeOne) {
  Hypotheses hypotheses;
  hypotheses.add(near({46.0, 6.0, 0.0}), options);
  hypotheses.add(near({46.7, 6.0, 0.0}), options);
  EXPECT_EQ(hypotheses.size(), 2u);
  drive(hypotheses, {46.3, 6.0, 0.0}, 0.0);
  EXPECT_EQ(hypotheses.size(), 1u);
  hypotheses.add(near({46.4, 6.1, 0.01}), options);
  EXPECT_EQ(hypotheses.size(), 1u);
}

}  // namespace
}  // namespace adit
