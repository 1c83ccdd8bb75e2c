#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "adit/geometry/result.hpp"

namespace adit {

/// One measurement of relocation, as the command line states it in words `name=value`.
struct LocateOptions {
  std::string plan = "niosh";
  std::string scanner = "cyclone";
  std::string data = "../shared/data";
  int clutter = 5;
  int first = 0;
  int count = 200;
  std::uint64_t seed = 1;
  double map_sigma = 0.1;
  double rough = 0.0;
  int threads = 1;
  int side = 20;
  int worst = 0;
  int oracle = 0;
  std::string index;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("plan", self.plan,
          "niosh, edgar; regular (a panel like itself everywhere), gap (one of its pillars is "
          "missing), entry (equal pillars, one drift through the outline), big (unequal pillars); "
          "outside (scans of edgar, sought in niosh), outside_niosh, intel (a real log)");
    field("scanner", self.scanner, "cyclone, sick, sick_lms or hokuyo");
    field("data", self.data, "folder of plans and logs");
    field("clutter", self.clutter, "pieces of it, other ones for each scan");
    field("first", self.first, "leaves out so many of a mine's poses");
    field("count", self.count, "scans");
    field("seed", self.seed, "of noise, clutter and places");
    field("map_sigma", self.map_sigma, "what is stated of the plan's error (m)");
    field("rough", self.rough,
          "in a mine, each end of a wall is so far from where the plan has it, one sigma (m)");
    field("threads", self.threads, "that build the index");
    field("side", self.side, "pillars along each side of a panel");
    field("worst", self.worst,
          "lists so many of the scans that are not ok and right; above `count`, all");
    field("oracle", self.oracle,
          "of so many of the scans brute force says whether they allow one answer: seconds a scan");
    field("index", self.index, "file to which the index is saved, and from which it is read");
  }
};

/// Reads the words of a command line; the error says which word is wrong and what was expected.
Result<LocateOptions> parse_locate(std::span<char* const> words);

/// All names, their defaults and meanings, a line each.
std::string locate_usage();

}  // namespace adit
