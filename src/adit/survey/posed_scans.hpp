#pragma once

#include <functional>
#include <span>

#include "adit/geometry/result.hpp"
#include "adit/survey/posed_scan.hpp"

namespace adit {

/// Scans with known poses that can be gone through again and again, in the order in which they were
/// taken: from memory, or from a log that is too long to be kept.
class PosedScans {
 public:
  virtual ~PosedScans() = default;
  virtual std::size_t size() const = 0;
  /// Hands over each scan; it is gone afterwards. An Error where it cannot be read any more.
  virtual Result<void> visit(const std::function<void(const PosedScan&)>& take) const = 0;
};

/// Those in memory. The scans must outlive it.
class PosedScanList : public PosedScans {
 public:
  explicit PosedScanList(std::span<const PosedScan> scans) : scans_(scans) {}
  std::size_t size() const override { return scans_.size(); }
  Result<void> visit(const std::function<void(const PosedScan&)>& take) const override {
    for (const PosedScan& scan : scans_) take(scan);
    return {};
  }

 private:
  std::span<const PosedScan> scans_;
};

}  // namespace adit
