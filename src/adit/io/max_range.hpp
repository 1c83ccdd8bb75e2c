#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace adit {

/// Finds the value that a scanner writes for "no return" in the ranges themselves.
///
/// Such a value stands at the top of the ranges, many beams share it exactly, and the measured
/// values just below it are rare: far walls are seen seldom, and never twice at the same centimetre
/// as often. Some scanners have several such codes close together (SICK LMS: 81.83 and 81.91); the
/// lowest of them counts. Ranges over 655.36 m are taken as no return too.
class MaxRangeFinder {
 public:
  /// No range beyond this is a measurement (m): sixteen bits of centimetres.
  static constexpr double kFarthest = 655.36;

  /// Counts the ranges of a scan (m).
  void add(std::span<const double> ranges);

  /// The lowest code for "no return", if the ranges show one; `declared` is the maximum that the
  /// log states, and then only a code within 2 % below it counts.
  std::optional<double> find(std::optional<double> declared = std::nullopt) const;

  /// Largest range seen that may be a measurement (m).
  double largest() const { return largest_; }

 private:
  /// The beams within one centimetre, and the value that most of them have (majority vote).
  struct Bin {
    std::uint32_t count = 0;
    std::int32_t votes = 0;
    double value = 0.0;
  };

  bool stands_out(std::size_t bin) const;
  std::optional<std::size_t> top_code() const;

  std::vector<Bin> bins_;
  std::uint64_t total_ = 0;
  std::uint64_t beyond_ = 0;
  double largest_ = 0.0;
};

}  // namespace adit
