#include "adit/io/text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "adit/io/atomic_file.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

TEST(Text, NumbersAreTheNearestDoubles) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> digits(0, 18);
  std::uniform_int_distribution<int> digit('0', '9');
  for (int i = 0; i < 100000; ++i) {
    std::string text = i % 3 == 0 ? "-" : "";
    for (int n = digits(random); n >= 0; --n) text += static_cast<char>(digit(random));
    if (i % 5 != 0) text += '.';
    if (i % 5 > 1)
      for (int n = digits(random); n >= 0; --n) text += static_cast<char>(digit(random));
    if (i % 7 == 0) text += "e-" + std::to_string(digits(random));
    const auto value = to_number(text);
    ASSERT_TRUE(value) << text;
    ASSERT_EQ(*value, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Text, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "-", "+", ".", "-.", "1.2.3", "1e", "1x", "x", "--1", "+-1", "1 2", "0x1", "1,2", "e5"})
    EXPECT_FALSE(to_number(text)) << text;
  EXPECT_EQ(to_number("+1.5"), 1.5);
  EXPECT_EQ(to_number("1."), 1.0);
  EXPECT_EQ(to_number("-.5"), -0.5);
  EXPECT_EQ(to_number("1e400"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(to_number("-1e400"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(to_number("1e-400"), 0.0);
  EXPECT_TRUE(std::isnan(to_number("nan").value_or(0.0)));
}

TEST(Text, LinesOfBothEnds) {
  Lines lines(
      "\xef\xbb\xbf"
      "a\r\n\nb\rc\n\r\nlast");
  std::vector<std::string> read;
  for (std::string_view line; lines.next(line);) read.emplace_back(line);
  EXPECT_EQ(read, (std::vector<std::string>{"a", "", "b\rc", "", "last"}));
  EXPECT_EQ(lines.number(), 5);
}

TEST(Text, FieldsBetweenBlanksAndCommas) {
  Fields fields("  a b,c ,, d;\te,  ");
  std::vector<std::string> read;
  for (std::string_view field; fields.next(field);) read.emplace_back(field);
  EXPECT_EQ(read, (std::vector<std::string>{"a", "b", "c", "", "d", "e"}));
}

TEST(AtomicFile, ReplacesWholeFilesAndLeavesNothingBeside) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("out.txt", "old and longer");
  std::filesystem::permissions(path, std::filesystem::perms(0640));
  ASSERT_TRUE(write_file(path, "new"));
  EXPECT_EQ(test::contents_of(path), "new");
  EXPECT_EQ(folder.files(), 1);
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
}

TEST(AtomicFile, KeepsSymbolicLinks) {
  const test::ScratchFolder folder;
  const std::string target = folder.write("target.txt", "old");
  std::filesystem::create_symlink(target, folder.path("link.txt"));
  ASSERT_TRUE(write_file(folder.path("link.txt"), "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.txt")));
  EXPECT_EQ(test::contents_of(target), "new");
}

TEST(AtomicFile, WritesToDevicesWithoutReplacingThem) {
  ASSERT_TRUE(write_file("/dev/null", "text"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  const test::ScratchFolder folder;
  const auto nowhere = write_file(folder.path("no/such/folder.txt"), "text");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(to_string(nowhere.error()),
            folder.path("no/such/folder.txt") + ": cannot write: No such file or directory");
  const auto directory = write_file(folder.path("."), "text");
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().message, "cannot write: Is a directory");
  EXPECT_EQ(folder.files(), 0);
}

TEST(AtomicFile, AFullDiskLeavesTheOldFileAlone) {
  const auto full = write_file("/dev/full", "text");
  ASSERT_FALSE(full);
  EXPECT_EQ(to_string(full.error()), "/dev/full: cannot write: No space left on device");
}

}  // namespace
}  // namespace adit
