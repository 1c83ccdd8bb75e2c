#include "adit/recovery/search_schedule.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

RecoveryOptions every_three() {
  RecoveryOptions options;
  options.scans_for_search = 2;
  options.scans_between = 3;
  options.most_scans_between = 10;
  return options;
}

/// Scans that pass before the next search.
int scans_before(SearchSchedule& schedule) {
  int scans = 0;
  while (!schedule.is_search_due() && scans < 1000) ++scans;
  return scans;
}

TEST(SearchSchedule, TheFirstSearchBeginsAtOnce) {
  SearchSchedule schedule;
  EXPECT_EQ(scans_before(schedule), 0);
}

TEST(SearchSchedule, TheAnswerIsTakenSoManyScansLater) {
  SearchSchedule schedule;
  for (int search = 0; search < 3; ++search) {
    schedule.begin(every_three());
    EXPECT_FALSE(schedule.is_answer_due());
    EXPECT_TRUE(schedule.is_answer_due());
  }
}

TEST(SearchSchedule, EachFailureDoublesTheWait) {
  SearchSchedule schedule;
  for (const int wait : {3, 6, 10, 10}) {
    schedule.note_failure(every_three());
    EXPECT_EQ(scans_before(schedule), wait);
  }
}

TEST(SearchSchedule, SoMuchWayShowsMoreOfTheMine) {
  RecoveryOptions options = every_three();
  options.way_between_m = 2.0;
  SearchSchedule schedule;
  schedule.begin(options);
  schedule.drive(1.5);
  EXPECT_FALSE(schedule.is_elsewhere(options));
  schedule.drive(0.5);
  EXPECT_TRUE(schedule.is_elsewhere(options));
  schedule.begin(options);
  EXPECT_FALSE(schedule.is_elsewhere(options));
  EXPECT_DOUBLE_EQ(schedule.way_before_m(), 2.0);
}

TEST(SearchSchedule, SuccessForgetsTheFailures) {
  SearchSchedule schedule;
  for (int i = 0; i < 5; ++i) schedule.note_failure(every_three());
  schedule.note_success();
  EXPECT_EQ(scans_before(schedule), 0);
  schedule.note_failure(every_three());
  EXPECT_EQ(scans_before(schedule), 3);
}

TEST(SearchSchedule, AFailureDoesNotDelayTheAnswerOfASearchUnderWay) {
  SearchSchedule schedule;
  schedule.begin(every_three());
  schedule.note_failure(every_three());
  EXPECT_FALSE(schedule.is_answer_due());
  EXPECT_TRUE(schedule.is_answer_due());
}

}  // namespace
}  // namespace adit
