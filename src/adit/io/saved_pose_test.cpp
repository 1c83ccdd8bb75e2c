#include "adit/io/saved_pose.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/test_files.hpp"

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

SavedPose some_pose() {
  SavedPose saved;
  saved.stamp = 1234567.125;
  saved.pose = {12.1, -3.0, 0.7};
  saved.covariance << 0.04, 0.01, 0.002, 0.01, 0.09, -0.003, 0.002, -0.003, 0.001;
  saved.status = Status::degraded;
  saved.level = "upper";
  return saved;
}

TEST(SavedPose, ComesBackAsItWasWritten) {
  const test::ScratchFolder folder;
  const SavedPose saved = some_pose();
  ASSERT_TRUE(write_saved_pose(saved, folder.path("last_pose.json")));
  const auto read = read_saved_pose(folder.path("last_pose.json"));
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->stamp, saved.stamp);
  EXPECT_EQ(read->pose.vector(), saved.pose.vector());
  EXPECT_EQ(read->covariance, saved.covariance);
  EXPECT_EQ(read->status, saved.status);
  EXPECT_EQ(read->level, "upper");
  EXPECT_TRUE(read->is_known());
  EXPECT_EQ(folder.files(), 1);
}

TEST(SavedPose, OneOfWhichNothingIsKnownStaysSo) {
  const test::ScratchFolder folder;
  SavedPose saved = some_pose();
  saved.covariance = Vector3d::Constant(kInfinite).asDiagonal();
  saved.level.clear();
  ASSERT_TRUE(write_saved_pose(saved, folder.path("last_pose.json")));
  EXPECT_EQ(test::contents_of(folder.path("last_pose.json")).find("level"), std::string::npos);
  const auto read = read_saved_pose(folder.path("last_pose.json"));
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_FALSE(read->is_known());
  EXPECT_EQ(read->covariance(0, 0), kInfinite);
}

TEST(SavedPose, ALostOrAmbiguousOneIsNotKnown) {
  SavedPose saved = some_pose();
  EXPECT_TRUE(saved.is_known());
  saved.status = Status::ok;
  EXPECT_TRUE(saved.is_known());
  saved.status = Status::ambiguous;
  EXPECT_FALSE(saved.is_known());
  saved.status = Status::lost;
  EXPECT_FALSE(saved.is_known());
}

/// A text that is right but for one key.
std::string with(const std::string& key, const std::string& value) {
  std::string text = "{";
  const std::array<std::pair<std::string, std::string>, 6> members{{{"stamp", "1.5"},
                                                                    {"x", "1"},
                                                                    {"y", "2"},
                                                                    {"theta", "0.5"},
                                                                    {"cov", "[1,0,0,1,0,1]"},
                                                                    {"status", "\"ok\""}}};
  for (const auto& [name, usual] : members) {
    if (name == key && value.empty()) continue;
    if (text.size() > 1) text += ",";
    text += "\"" + name + "\":" + (name == key ? value : usual);
  }
  return text + "}";
}

TEST(SavedPose, ErrorsSayWhatWasExpected) {
  ASSERT_TRUE(parse_saved_pose(with("", "")));
  const auto expect_wrong = [](const std::string& key, const std::string& value) {
    const auto read = parse_saved_pose(with(key, value), "last.json");
    ASSERT_FALSE(read) << key << " " << value;
    EXPECT_EQ(read.error().file, "last.json");
    EXPECT_NE(read.error().message.find(key), std::string::npos) << read.error().message;
    EXPECT_NE(read.error().message.find("expected"), std::string::npos) << read.error().message;
  };
  for (const char* key : {"stamp", "x", "y", "theta", "cov", "status"}) {
    expect_wrong(key, "");
    expect_wrong(key, "true");
    expect_wrong(key, "{}");
  }
  for (const char* key : {"stamp", "x", "y", "theta"}) expect_wrong(key, "null");
  for (const char* cov : {"[1,0,0,1,0]", "[1,0,0,1,0,1,0]", "[-1,0,0,1,0,1]", "[1,2,0,1,0,1]",
                          "[1,0,0,1,0,\"1\"]", "[0,1,0,0,0,0]"}) {
    expect_wrong("cov", cov);
  }
  expect_wrong("status", "\"fine\"");
  for (const char* text : {"", "[]", "3", "{", "x: 1", "{\"x\": nan}"}) {
    EXPECT_FALSE(parse_saved_pose(text)) << text;
  }
}

}  // namespace
}  // namespace adit
