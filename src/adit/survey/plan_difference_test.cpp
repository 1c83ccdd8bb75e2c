#include "adit/survey/plan_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

/// A corridor of 20 x 4 m with a niche from x = 8 to 12 behind its upper wall.
std::vector<Segment> corridor(bool niche) {
  if (!niche) {
    return outline(std::vector<Vector2d>{{0.0, 0.0}, {20.0, 0.0}, {20.0, 4.0}, {0.0, 4.0}});
  }
  return outline(std::vector<Vector2d>{{0.0, 0.0},
                                       {20.0, 0.0},
                                       {20.0, 4.0},
                                       {12.0, 4.0},
                                       {12.0, 7.0},
                                       {8.0, 7.0},
                                       {8.0, 4.0},
                                       {0.0, 4.0}});
}

std::vector<PosedScan> drive(const std::vector<Segment>& walls) {
  Random random(2);
  const RayCaster caster(walls);
  std::vector<PosedScan> scans;
  for (int i = 0; i < 60; ++i) {
    const Pose2 pose{2.0 + 0.27 * i, 2.0, 0.3 * i};
    scans.push_back({simulate_scan(caster, pose, sick(), random), pose, Matrix3d::Zero()});
  }
  return scans;
}

PlanDifference difference(const std::vector<Segment>& plan, const std::vector<Segment>& truth) {
  const auto scans = drive(truth);
  const WallMap walls = survey_walls(scans, sick().model);
  return compare_with_plan(plan, walls, PosedScanList(scans), sick().model).value();
}

int count(const PlanDifference& d, PlanChange change) {
  return static_cast<int>(std::count_if(d.items.begin(), d.items.end(),
                                        [&](const auto& item) { return item.change == change; }));
}

TEST(CompareWithPlan, FindsNothingWhereNothingChanged) {
  const auto d = difference(corridor(false), corridor(false));
  EXPECT_TRUE(d.items.empty());
  EXPECT_GT(d.confirmed_m, 40.0);
}

TEST(CompareWithPlan, TakesRoughWallsAndWornCornersForThoseOfThePlan) {
  // Bumps of a quarter of a metre, and corners cut by half a metre.
  std::vector<Vector2d> rough{{0.5, 0.0}};
  for (int i = 1; i < 20; ++i) rough.emplace_back(i, 0.25 * std::sin(1.3 * i));
  for (const Vector2d& p :
       {Vector2d(19.5, 0.0), Vector2d(20.0, 0.5), Vector2d(20.0, 3.5), Vector2d(19.5, 4.0)}) {
    rough.push_back(p);
  }
  for (int i = 19; i > 0; --i) rough.emplace_back(i, 4.0 + 0.25 * std::sin(1.7 * i));
  for (const Vector2d& p : {Vector2d(0.5, 4.0), Vector2d(0.0, 3.5), Vector2d(0.0, 0.5)}) {
    rough.push_back(p);
  }
  const auto d = difference(corridor(false), outline(rough));
  EXPECT_TRUE(d.items.empty());
  EXPECT_GT(d.confirmed_m, 40.0);
}

TEST(CompareWithPlan, FindsWhatWasRemovedMovedAndAddedTogether) {
  auto truth = corridor(false);
  truth.push_back({{4.0, 4.0}, {4.0, 2.6}});  // a new stopping half way across
  auto plan = corridor(false);
  plan.push_back({{15.0, 0.0}, {15.0, 1.6}});  // one that was taken down
  plan[0] = {{0.0, 0.6}, {20.0, 0.6}};         // a rib cut back
  const auto d = difference(plan, truth);
  ASSERT_EQ(count(d, PlanChange::moved), 1);
  EXPECT_EQ(count(d, PlanChange::gone), 1);
  EXPECT_EQ(count(d, PlanChange::obstacle), 2);  // both of its faces
  // Made in the plan, all of them leave nothing to find.
  const auto made = apply_changes(plan, d.items);
  EXPECT_TRUE(difference(made, truth).items.empty());
}

TEST(CompareWithPlan, FindsANewCut) {
  const auto d = difference(corridor(false), corridor(true));
  ASSERT_EQ(count(d, PlanChange::gone), 1);
  EXPECT_GE(count(d, PlanChange::cut), 1);
  EXPECT_EQ(count(d, PlanChange::obstacle), 0);
  for (const PlanChangeItem& item : d.items) {
    if (item.change != PlanChange::gone) continue;
    EXPECT_NEAR(item.length_m, 4.0, 0.6);
    EXPECT_NEAR(item.removed.front().a.y(), 4.0, 1e-9);
    EXPECT_GT(item.seen_through, 0.7);
  }
}

TEST(CompareWithPlan, FindsAFallInTheOpenSpace) {
  auto truth = corridor(false);
  const auto heap =
      outline(std::vector<Vector2d>{{9.0, 2.9}, {10.5, 2.9}, {10.5, 3.6}, {9.0, 3.6}});
  truth.insert(truth.end(), heap.begin(), heap.end());
  const auto d = difference(corridor(false), truth);
  EXPECT_GE(count(d, PlanChange::obstacle), 1);
  EXPECT_EQ(count(d, PlanChange::cut), 0);
  EXPECT_EQ(count(d, PlanChange::gone), 0);
}

TEST(CompareWithPlan, FindsAWallThatMoved) {
  auto plan = corridor(false);
  plan[2] = {{20.0, 3.5}, {0.0, 3.5}};  // the wall was cut back by half a metre since
  const auto d = difference(plan, corridor(false));
  ASSERT_EQ(count(d, PlanChange::moved), 1);
  const auto moved = std::find_if(d.items.begin(), d.items.end(), [](const auto& item) {
    return item.change == PlanChange::moved;
  });
  EXPECT_NEAR(moved->offset_m, 0.5, 0.05);
  ASSERT_FALSE(moved->added.empty());
  EXPECT_NEAR(moved->added.front().a.y(), 4.0, 0.05);
}

TEST(CompareWithPlan, ListsAWallThatIsDrawnInPiecesOnce) {
  auto plan = corridor(false);
  plan[2] = {{20.0, 3.5}, {9.0, 3.5}};  // both were cut back by half a metre since
  plan.push_back({{9.0, 3.5}, {0.0, 3.5}});
  const auto d = difference(plan, corridor(false));
  ASSERT_EQ(count(d, PlanChange::moved), 1);
  const PlanChangeItem& moved = d.items.front();
  EXPECT_EQ(moved.pieces.size(), 2U);
  EXPECT_NEAR(moved.length_m, 19.0, 1.5);
  EXPECT_GT(moved.support.hits, 100.0);
  EXPECT_GT(moved.support.scans, 5);
  EXPECT_TRUE(difference(apply_changes(plan, d.items), corridor(false)).items.empty());
}

TEST(CompareWithPlan, GivesEachOfTwoMovedWallsItsPartOfTheWallThatReplacesThem) {
  auto plan = corridor(false);
  plan[2] = {{20.0, 4.0}, {12.0, 4.0}};  // between two that are cut back one stands
  plan.push_back({{12.0, 3.4}, {7.0, 3.4}});
  plan.push_back({{6.0, 3.5}, {0.0, 3.5}});
  const auto d = difference(plan, corridor(false));
  ASSERT_EQ(count(d, PlanChange::moved), 2);
  ASSERT_EQ(d.items.size(), 2U);
  for (const PlanChangeItem& item : d.items) {
    double added = 0.0;
    for (const Segment& s : item.added) added += s.length();
    EXPECT_NEAR(added, 6.0, 1.2);
    // Alone it is made whole, and the other is still found.
    const auto made = apply_changes(plan, std::vector<PlanChangeItem>{item});
    const auto rest = difference(made, corridor(false));
    ASSERT_EQ(rest.items.size(), 1U);
    EXPECT_EQ(rest.items.front().change, PlanChange::moved);
  }
  EXPECT_TRUE(difference(apply_changes(plan, d.items), corridor(false)).items.empty());
}

TEST(CompareWithPlan, CombsNoWallThatReplacesTwoOverEachOther) {
  auto plan = corridor(false);
  plan[2] = {{20.0, 3.5}, {0.0, 3.5}};  // drawn twice, and cut back since
  plan.push_back({{19.5, 3.4}, {0.5, 3.4}});
  const auto d = difference(plan, corridor(false));
  ASSERT_EQ(count(d, PlanChange::moved), 2);
  std::size_t pieces = 0;
  for (const PlanChangeItem& item : d.items) pieces += item.added.size();
  EXPECT_LE(pieces, 4U);
  EXPECT_TRUE(difference(apply_changes(plan, d.items), corridor(false)).items.empty());
}

TEST(CompareWithPlan, LeavesWallsThatRunToTheHorizonUnseen) {
  constexpr double kFar = 1e8;  // m
  auto plan = corridor(false);
  const auto near = difference(plan, corridor(true));
  plan.push_back({{0.0, kFar}, {kFar, kFar}});
  plan.push_back({{-kFar, 30.0}, {kFar, 30.0}});
  const auto d = difference(plan, corridor(true));
  EXPECT_EQ(d.items.size(), near.items.size());
  EXPECT_NEAR(d.confirmed_m, near.confirmed_m, 0.5);
  EXPECT_NEAR(d.unseen_m - near.unseen_m, 3.0 * kFar, 0.5);
}

TEST(CompareWithPlan, FindsChangesOnTheSeenPartOfALongWall) {
  auto plan = corridor(false);
  plan.push_back({{-1e8, 2.9}, {1e8, 2.9}});  // through the corridor
  const auto d = difference(plan, corridor(false));
  ASSERT_EQ(d.items.size(), 1U);
  EXPECT_EQ(d.items.front().change, PlanChange::gone);
  EXPECT_GT(d.items.front().length_m, 15.0);
  EXPECT_LT(d.items.front().length_m, 21.0);
  const auto made = apply_changes(plan, d.items);
  EXPECT_EQ(made.size(), plan.size() + 1);  // what was not seen stays on either side
}

TEST(ApplyChanges, ChangesWhatIsAcceptedAndNothingElse) {
  const auto plan = corridor(false);
  EXPECT_EQ(apply_changes(plan, {}).size(), plan.size());
  PlanChangeItem gone;
  gone.pieces = {{2, {8.0, 12.0}}};
  PlanChangeItem cut;
  cut.change = PlanChange::cut;
  cut.added = {{{8.0, 7.0}, {12.0, 7.0}}};
  const auto changed = apply_changes(plan, std::vector<PlanChangeItem>{gone, cut});
  ASSERT_EQ(changed.size(), plan.size() + 2);
  double length = 0.0;
  for (const Segment& s : changed) length += s.length();
  EXPECT_NEAR(length, 48.0 - 4.0 + 4.0, 1e-9);
}

}  // namespace
}  // namespace adit
