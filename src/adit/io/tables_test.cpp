// Trajectories, relations and estimates: the tables of numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "adit/io/estimates.hpp"
#include "adit/io/relations.hpp"
#include "adit/io/trajectory.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

std::string trajectory_error(std::string_view text) {
  const auto read = parse_trajectory(text, "t.tum");
  return read ? "no error" : to_string(read.error());
}

TEST(Trajectory, ReadsPosesAndToleratesTilt) {
  const auto read = parse_trajectory(
      "# t x y z qx qy qz qw\n1.5 1 2 3 0 0 0.7071067811865476 0.7071067811865476\n"
      "1.25,4,5,0,0.02,0.01,0.9997499687,-0.0002\n");
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), 2u);
  EXPECT_EQ((*read)[0].stamp, 1.5);
  EXPECT_EQ((*read)[0].pose.y, 2.0);
  EXPECT_NEAR((*read)[0].pose.theta, kPi / 2, 1e-12);
  EXPECT_NEAR(std::abs((*read)[1].pose.theta), kPi, 2e-3);
}

TEST(Trajectory, SaysLineAndWhatWasExpected) {
  const std::string expected = "expected t x y z qx qy qz qw, found ";
  EXPECT_EQ(trajectory_error("1 2 3 4 0 0 0 1\n1 2 3\n"), "t.tum:2: " + expected + "only 3 fields");
  EXPECT_EQ(trajectory_error("1 2 3 4 0 0 0 0\n"),
            "t.tum:1: " + expected + "a quaternion that is not of length 1");
  EXPECT_EQ(trajectory_error("1 2 3 4 0 0 0 nan\n"),
            "t.tum:1: " + expected + "a number that is not finite");
  EXPECT_EQ(trajectory_error("1 2 3 4 0 0 1e200 1e200\n"),
            "t.tum:1: " + expected + "a quaternion that is not of length 1");
  EXPECT_EQ(trajectory_error("# none\n"), "t.tum:1: no pose; expected t x y z qx qy qz qw");
}

TEST(Trajectory, WrittenPosesReadBack) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<StampedPose> poses;
  for (int i = 0; i < 200; ++i)
    poses.push_back({976053557.767368 + i * 0.1,
                     {1e6 * number(random), 1e3 * number(random), kPi * number(random)}});
  poses.push_back({0.0, {0.0, 0.0, kPi}});
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_trajectory(poses, folder.path("t.tum")));
  const auto read = read_trajectory(folder.path("t.tum"));
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR((*read)[i].stamp, poses[i].stamp, 1e-6);
    EXPECT_NEAR((*read)[i].pose.x, poses[i].pose.x, 1e-9);
    EXPECT_NEAR(angle_between((*read)[i].pose.theta, poses[i].pose.theta), 0.0, 4e-9);
  }
  poses[3].pose.x = kInf;
  EXPECT_FALSE(write_trajectory(poses, folder.path("bad.tum")));
  EXPECT_EQ(folder.files(), 1);
}

TEST(Trajectory, RealFilesAreRead) {
  for (const auto& [name, count] : {std::pair{"intel/reference.tum", 2672u},
                                    {"mines/niosh_poses.tum", 1000u},
                                    {"mines/edgar_poses.tum", 1000u},
                                    {"chilean_mine/11S.tum", 1u}}) {
    ADIT_DATA_FILE(path, name);
    const auto read = read_trajectory(path);
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->size(), count) << name;
  }
}

TEST(Relations, ReadsStampsAndYaw) {
  const auto read = parse_relations("1 2 0.5 -0.25 9 0.1 0.2 -1.5\n# end\n", "r");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 1u);
  EXPECT_EQ((*read)[0].from_stamp, 1.0);
  EXPECT_EQ((*read)[0].to_stamp, 2.0);
  EXPECT_EQ((*read)[0].from_to.y, -0.25);
  EXPECT_EQ((*read)[0].from_to.theta, -1.5);
  EXPECT_EQ(to_string(parse_relations("1 2 3\n", "r").error()),
            "r:1: expected t1 t2 x y z roll pitch yaw, found only 3 fields");
  EXPECT_FALSE(parse_relations("# none\n"));
}

TEST(Relations, RealFilesAreRead) {
  for (const auto& [name, count] :
       {std::pair{"intel/relations.txt", 2984u}, {"aces/relations.txt", 1279u}}) {
    ADIT_DATA_FILE(path, name);
    const auto read = read_relations(path);
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->size(), count) << name;
  }
}

EstimateRow some_row() {
  EstimateRow row;
  row.stamp = 976053557.767368;
  row.pose = {1.0 / 3.0, -2.5, 3.0};
  row.covariance << 0.01, 0.001, -0.002, 0.001, 0.04, 0.003, -0.002, 0.003, 1e-5;
  row.status = Status::degraded;
  row.protection_m = 0.75;
  row.chi_square = 12.5;
  row.degrees_of_freedom = 9;
  row.pairs = 6;
  row.dead_reckoned = false;
  row.open_direction = {0.6, -0.8};
  return row;
}

TEST(Estimates, TheFormIsFixed) {
  const std::vector<EstimateRow> rows = {some_row()};
  EXPECT_EQ(
      format_estimates(rows),
      "t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,status,protection_m,chi_square,"
      "degrees_of_freedom,pairs,dead_reckoned,open_x,open_y\n"
      "976053557.767368,0.3333333333333333,-2.5,3,0.01,0.001,-0.002,0.04,0.003,1e-05,degraded,"
      "0.75,12.5,9,6,0,0.6,-0.8\n");
}

TEST(Estimates, RowsReadBackBitByBit) {
  const test::ScratchFolder folder;
  const std::vector<EstimateRow> rows = {some_row(), EstimateRow{}, some_row()};
  ASSERT_TRUE(write_estimates(rows, folder.path("e.csv")));
  const auto read = read_estimates(folder.path("e.csv"));
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*read)[i].stamp, rows[i].stamp);
    EXPECT_EQ((*read)[i].pose.vector(), rows[i].pose.vector());
    EXPECT_EQ((*read)[i].covariance, rows[i].covariance);
    EXPECT_EQ((*read)[i].status, rows[i].status);
    EXPECT_EQ((*read)[i].protection_m, rows[i].protection_m);
    EXPECT_EQ((*read)[i].chi_square, rows[i].chi_square);
    EXPECT_EQ((*read)[i].degrees_of_freedom, rows[i].degrees_of_freedom);
    EXPECT_EQ((*read)[i].pairs, rows[i].pairs);
    EXPECT_EQ((*read)[i].dead_reckoned, rows[i].dead_reckoned);
    EXPECT_EQ((*read)[i].open_direction, rows[i].open_direction);
  }
}

TEST(Estimates, UnknownVariancesAreInf) {
  EstimateRow row = some_row();
  row.covariance(1, 1) = kInf;
  row.covariance(2, 2) = std::nan("");
  row.protection_m = std::nan("");
  const auto read = parse_estimates(format_estimates(std::vector<EstimateRow>{row}));
  ASSERT_TRUE(read) << to_string(read.error());
  Matrix3d expected = Matrix3d::Zero();
  expected.diagonal() << 0.01, kInf, kInf;
  EXPECT_EQ((*read)[0].covariance, expected);
  EXPECT_EQ((*read)[0].protection_m, kInf);
}

TEST(Estimates, ColumnsAreFoundByName) {
  const auto read = parse_estimates(
      "note,status,protection_m,theta,y,x,t,cov_tt,cov_yt,cov_yy,cov_xt,cov_xy,cov_xx\n"
      "hello,ok,inf,3,2,1,0.5,6,5,4,3,2,1\n");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ((*read)[0].pose.x, 1.0);
  EXPECT_EQ((*read)[0].stamp, 0.5);
  EXPECT_EQ((*read)[0].covariance(2, 1), 5.0);
  EXPECT_EQ((*read)[0].covariance(0, 2), 3.0);
  EXPECT_EQ((*read)[0].status, Status::ok);
}

TEST(Estimates, FilesWithoutTheLaterColumnsAreRead) {
  const auto read = parse_estimates(
      "t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,status,protection_m,chi_square,"
      "degrees_of_freedom,pairs,dead_reckoned\n1,2,3,0,1,0,0,1,0,1,ok,0.5,1,1,7,0\n");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ((*read)[0].pairs, 7);
  EXPECT_EQ((*read)[0].open_direction, Vector2d(0.0, 0.0));
}

TEST(Estimates, SaysLineAndWhatWasExpected) {
  const std::string header = format_estimates({});
  const auto error = [&](const std::string& text) {
    const auto read = parse_estimates(text, "e.csv");
    return read ? "no error" : to_string(read.error());
  };
  EXPECT_EQ(error("t,x,y\n"), "e.csv:1: expected a header with the column theta");
  EXPECT_EQ(error("t,x,y,t\n"), "e.csv:1: column \"t\" stands twice");
  EXPECT_EQ(error(header + "1,2\n"), "e.csv:2: expected 18 fields, found fewer");
  EXPECT_EQ(error(header + "1,2,3,0,1,0,0,1,0,1,fine,1,1,1,1,1,0,0\n"),
            "e.csv:2: expected status, found \"fine\"");
  EXPECT_EQ(error(header + "1,2,3,0,-1,0,0,1,0,1,ok,1,1,1,1,1,0,0\n"),
            "e.csv:2: expected cov_xx, found \"-1\"");
  EXPECT_EQ(error(header + "1,2,3,0,1,0,0,1,0,1,ok,1,1,1.5,1,1,0,0\n"),
            "e.csv:2: expected degrees_of_freedom, found \"1.5\"");
  EXPECT_EQ(error(header + "1,2,3,0,1,0,0,1,0,1,ok,1,1,1,1,1,0,inf\n"),
            "e.csv:2: expected open_y, found \"inf\"");
  EXPECT_EQ(error(header + "1,2,3,0,1,0,0,1,0,1,ok,1,1,1,1,1,0,0,1\n"),
            "e.csv:2: expected 18 fields, found more");
  EXPECT_EQ(error(header), "no error");
}

TEST(Estimates, ARowIsMadeFromAnEstimate) {
  const std::vector<FeaturePair> pairs(4);
  Estimate estimate;
  estimate.stamp = 1.0;
  estimate.status = Status::ok;
  estimate.dead_reckoned = false;
  estimate.pairs = pairs;
  EXPECT_EQ(to_row(estimate).open_direction, Vector2d(0.0, 0.0));
  estimate.open_direction = Vector2d(0.0, 1.0);
  const EstimateRow row = to_row(estimate);
  EXPECT_EQ(row.open_direction, Vector2d(0.0, 1.0));
  EXPECT_EQ(row.pairs, 4);
  EXPECT_EQ(row.status, Status::ok);
  EXPECT_FALSE(row.dead_reckoned);
}

}  // namespace
}  // namespace adit
