#include "results.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace adit {
namespace {

CellResults three_drives() {
  CellResults results;
  results.header = {"niosh-bent-sick", 42, "0123456789abcdef", kDefinitionsVersion};
  for (const std::int64_t drive : {0, 1, 5}) {
    DriveCounts counts;
    counts.drive = drive;
    counts.scans = 300 + drive;
    counts.metres = 60.25;
    counts.levels.add(0.5, 299);
    counts.silences.add(3.0);
    results.drives.push_back(counts);
  }
  return results;
}

TEST(Results, ComeBackFromTheirText) {
  const CellResults results = three_drives();
  const auto read = parse_results(format_results(results));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->header, results.header);
  EXPECT_EQ(read->drives, results.drives);
}

// Wherever a file is cut off, each row that is read is one that was written whole.
TEST(Results, KeepWholeRowsOfAFileThatIsCutOff) {
  const CellResults results = three_drives();
  const std::string text = format_results(results);
  const std::size_t last_row = text.rfind("\n5 ") + 1;
  for (std::size_t length = last_row; length <= text.size(); ++length) {
    const auto read = parse_results(std::string_view(text).substr(0, length));
    ASSERT_TRUE(read);
    const std::size_t whole = length + 1 >= text.size() ? 3 : 2;  // the full stop counts
    ASSERT_EQ(read->drives.size(), whole) << text.substr(last_row, length - last_row);
    for (std::size_t i = 0; i < whole; ++i) EXPECT_EQ(read->drives[i], results.drives[i]);
  }
}

TEST(Results, LeaveSpoiltRowsOut) {
  std::string text = format_results(three_drives());
  text.replace(text.find("\n1 ") + 1, 1, "x");
  const auto read = parse_results(text);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->drives.size(), 2u);
  EXPECT_EQ(read->drives[1].drive, 5);
}

TEST(Results, NeedAHeader) {
  EXPECT_FALSE(parse_results(""));
  const std::string text = format_results(three_drives());
  EXPECT_FALSE(parse_results(text.substr(text.find('\n') + 1)));
  std::string other = text;
  other.replace(other.find(" scans "), 7, " turns ");
  EXPECT_FALSE(parse_results(other));
}

TEST(Results, AreReadFromTheirFile) {
  const std::string folder = testing::TempDir();
  const CellResults results = three_drives();
  ASSERT_TRUE(write_results(results, folder));
  const auto read = read_results(folder, "niosh-bent-sick");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->drives, results.drives);
  std::filesystem::remove(results_path(folder, "niosh-bent-sick"));
  EXPECT_FALSE(read_results(folder, "niosh-bent-sick"));
}

}  // namespace
}  // namespace adit
