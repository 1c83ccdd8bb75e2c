#include "counting.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "adit/geometry/angle.hpp"

namespace adit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An estimate that is so far off in x and in its heading, a metre on from the last.
JudgedAnswer off_by(double metres, Status status = Status::ok, double level = 0.5,
                    double heading = 0.0) {
  Estimate estimate;
  estimate.pose = {10.0 + metres, 5.0, 1.0 + heading};
  estimate.covariance = Vector3d(0.01, 0.04, 0.0001).asDiagonal();
  estimate.status = status;
  estimate.protection_m = level;
  return judged(estimate, {10.0, 5.0, 1.0}, 1.0, 2e-4);
}

TEST(JudgedAnswer, IsBeyondItsLevelAndWrongBeyondAMetre) {
  EXPECT_FALSE(off_by(0.4).is_beyond());
  EXPECT_TRUE(off_by(0.6).is_beyond());
  EXPECT_FALSE(off_by(0.6).is_wrong());
  EXPECT_TRUE(off_by(1.1).is_wrong());
  EXPECT_FALSE(off_by(1.1, Status::degraded, 2.0).is_wrong());
  EXPECT_FALSE(off_by(1.1, Status::degraded, 2.0).is_beyond());
  EXPECT_TRUE(off_by(0.0, Status::ok, 0.5, radians(6.0)).is_wrong());
  EXPECT_FALSE(off_by(0.0, Status::ok, 0.5, radians(6.0)).is_beyond());
  EXPECT_FALSE(off_by(0.0, Status::ok, 0.5, radians(4.0)).is_wrong());
}

TEST(JudgedAnswer, HoldsTheHeadingAgainstItsLevelOnceThereIsOne) {
  JudgedAnswer answer = off_by(0.0, Status::ok, 0.5, radians(3.0));
  answer.level_rad = radians(2.0);
  EXPECT_TRUE(answer.is_beyond());
  EXPECT_FALSE(answer.is_wrong());
  answer = off_by(0.0, Status::ok, 0.5, radians(6.0));
  answer.level_rad = radians(7.0);
  EXPECT_FALSE(answer.is_wrong());
}

TEST(JudgedAnswer, IsNeitherWhereItIsSilent) {
  for (const Status status : {Status::lost, Status::ambiguous}) {
    EXPECT_FALSE(off_by(50.0, status).is_beyond());
    EXPECT_FALSE(off_by(50.0, status).is_wrong());
    EXPECT_EQ(off_by(50.0, status).kind, AnswerKind::silent);
  }
}

TEST(Counting, CountsADriveByHand) {
  Counting counting(7);
  counting.add(off_by(0.1));                           // answered
  counting.add(off_by(0.3, Status::degraded, 3.0));    // an answer whose level is too large
  counting.add(off_by(0.7, Status::ok, 0.5));          // beyond
  counting.add(off_by(40.0, Status::ok, 0.5));         // beyond and wrong
  counting.add(off_by(0.0, Status::lost, kInfinity));  // two metres of silence
  counting.add(off_by(0.0, Status::ambiguous, kInfinity));
  counting.add(off_by(0.2, Status::ok, kInfinity));    // an answer without level
  counting.add(off_by(0.0, Status::lost, kInfinity));  // and a metre at the end
  const DriveCounts counts = counting.finished();
  EXPECT_EQ(counts.drive, 7);
  EXPECT_EQ(counts.scans, 8);
  EXPECT_EQ(counts.ok, 4);
  EXPECT_EQ(counts.degraded, 1);
  EXPECT_EQ(counts.ambiguous, 1);
  EXPECT_EQ(counts.lost, 2);
  EXPECT_EQ(counts.answers(), 5);
  EXPECT_EQ(counts.answered, 3);
  EXPECT_EQ(counts.beyond, 2);
  EXPECT_EQ(counts.wrong, 1);
  EXPECT_TRUE(counts.is_hit());
  EXPECT_DOUBLE_EQ(counts.metres, 8.0);
  EXPECT_EQ(counts.silences.count(), 2);
  EXPECT_NEAR(counts.silences.largest(), 2.0, 0.05);
  EXPECT_EQ(counts.levels.count(), 5);
  EXPECT_EQ(counts.levels.largest(), kInfinity);
  EXPECT_EQ(counts.judged, 4);
  EXPECT_NEAR(counts.error_m, 0.1 + 0.3 + 0.7 + 0.2, 1e-12);
  EXPECT_NEAR(counts.nees_x, (0.01 + 0.09 + 0.49 + 0.04) / 0.01, 1e-9);
  EXPECT_NEAR(counts.nees_y, 0.0, 1e-12);
  EXPECT_NEAR(counts.worst_m, 40.0, 1e-12);
}

TEST(Counting, CountsAnUnconfirmedStartApart) {
  Counting counting(0);
  JudgedAnswer answer = off_by(30.0, Status::ambiguous);
  answer.kind = AnswerKind::unconfirmed;
  counting.add(answer);
  const DriveCounts counts = counting.finished();
  EXPECT_EQ(counts.unconfirmed, 1);
  EXPECT_EQ(counts.ambiguous, 0);
  EXPECT_EQ(counts.answers(), 0);
  EXPECT_EQ(counts.silences.count(), 0);
}

TEST(Counting, MeasuresTheWayFromWhereThePoseIsSought) {
  Counting counting(0);
  JudgedAnswer before = off_by(0.0);
  before.is_news = false;
  counting.add(before);
  counting.add(before);
  counting.add(off_by(20.0, Status::lost));     // the scan from which it is sought: no way yet
  counting.add(off_by(20.0, Status::ok));       // wrong
  counting.add(off_by(0.0, Status::degraded));  // right, not ok
  EXPECT_LT(counting.finished().found_m, 0.0);
  counting.add(off_by(0.0));
  counting.add(off_by(0.0));
  EXPECT_DOUBLE_EQ(counting.finished().found_m, 3.0);
}

TEST(Counting, AddsDrivesUp) {
  Counting counting(1);
  counting.add(off_by(0.7));
  DriveCounts sum;
  add_counts(counting.finished(), sum);
  add_counts(counting.finished(), sum);
  EXPECT_EQ(sum.scans, 2);
  EXPECT_EQ(sum.beyond, 2);
  EXPECT_EQ(sum.levels.count(), 2);
  EXPECT_DOUBLE_EQ(sum.metres, 2.0);
  EXPECT_NEAR(sum.worst_m, 0.7, 1e-12);
}

}  // namespace
}  // namespace adit
