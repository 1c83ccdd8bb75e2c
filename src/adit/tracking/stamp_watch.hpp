#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace adit {

/// How a scan's stamp follows the one before.
enum class StampOrder {
  first,      ///< nothing came before
  in_order,   ///< a little later
  duplicate,  ///< the same stamp, of the same scanner
  late,       ///< earlier: scans arrived out of order
  gap,        ///< later, but scans are missing in between
  jump,       ///< far away: a clock was set
};

/// When a step between stamps is a gap, and when a clock has jumped.
struct StampOptions {
  double gap_s = 3.5;
  double jump_s = 60.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("gap_s", self.gap_s, "scans farther apart than this have a gap between them (s)");
    field("jump_s", self.jump_s,
          "stamps farther apart than this, or back by this: a clock jumped (s)");
  }
};

/// What was met so far, in scans.
struct StampCounts {
  long duplicates = 0;
  long late = 0;
  long gaps = 0;
  long jumps = 0;
};

/// Watches the stamps of scans as they come.
class StampWatch {
 public:
  StampOrder next(double stamp, int scanner, const StampOptions& options);
  void reset() { *this = StampWatch{}; }

  /// Seconds from the scan before the last to the last; 0 for the first and after a jump.
  double step_s() const { return step_s_; }
  const StampCounts& counts() const { return counts_; }

 private:
  static constexpr std::size_t kScanners = 8;  // more share their places

  StampOrder classify(double step, bool repeated, const StampOptions& options);

  std::optional<double> last_;
  std::array<std::optional<double>, kScanners> last_of_;  // each scanner's own
  double step_s_ = 0.0;
  StampCounts counts_;
};

}  // namespace adit
