#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/relocation/scan_likelihood.hpp"
#include "locate_scene.hpp"

namespace adit {

/// What brute force says of one scan.
struct OracleAnswer {
  bool one_answer = false;   ///< no other pose explains the scan within noise
  double gap = 0.0;          ///< how much less likely the best other pose is (log)
  Pose2 rival;               ///< map_from_vehicle
  bool found_truth = false;  ///< the grid's best poses led to the true one: a check of the oracle
};

/// Whether a scan could have been taken elsewhere in a plan, by brute force: every pose of a grid
/// over the openings (0.25 m, 1 degree) is rated by the scan's ranges, the best thousand are
/// fitted. It shares the fit and the likelihood with the relocation (but for walls that are gone,
/// and with a given error of the plan), neither its index nor its search.
class PoseOracle {
 public:
  /// `inside` are positions in the openings; what is connected with them is one of them.
  PoseOracle(const LineMap& map, const ScannerModel& scanner, std::span<const Vector2d> inside,
             int threads);

  std::size_t size() const { return places_.size(); }

  /// Rates every pose of the grid by the ranges of a scan.
  void rate(const LaserScan& scan);

  /// Fits the best of them to the scan that was rated. `plan_error` is what walls may lie off their
  /// lines: with none, poses differ by the scanner's noise alone.
  OracleAnswer judge(const LaserScan& scan, const Pose2& truth, const MapError& plan_error) const;

 private:
  static constexpr std::size_t kBearings = 360;  // a degree
  using Profile = std::array<std::uint8_t, kBearings>;

  /// A direction of the scan, and its range as a code.
  struct Ray {
    std::size_t bearing = 0;
    std::uint8_t code = 0;
  };
  struct Rated {
    std::uint16_t cost = 0;
    std::uint16_t heading = 0;  // degrees, from -pi
    std::uint32_t place = 0;
  };
  struct Fitted {
    Pose2 pose;
    double log_likelihood = 0.0;
  };

  void flood(std::span<const Vector2d> inside);
  void look_around();
  void choose_rays(const LaserScan& scan);
  void rate_all();
  void rate_block(std::size_t block, std::vector<Rated>& out) const;
  void keep_apart();
  std::vector<Fitted> fit_best(const LaserScan& scan, const MapError& plan_error) const;

  const LineMap& map_;
  ScannerModel scanner_;
  int threads_ = 1;
  std::vector<Vector2d> places_;
  std::vector<Profile> profiles_;
  std::vector<Ray> rays_;
  std::vector<Rated> rated_;
};

}  // namespace adit
