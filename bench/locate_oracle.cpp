#include "locate_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "adit/scan/returns.hpp"
#include "adit/threads/share_out.hpp"

namespace adit {
namespace {

constexpr double kPitch = 0.25;       // of the grid (m)
constexpr double kClearance = 0.3;    // no scanner stands nearer to a wall (m)
constexpr std::size_t kRays = 60;     // of the scan, that rate the grid
constexpr std::size_t kGroup = 15;    // rays whose costs fit a byte together
constexpr int kCap = 16;              // what one ray says at most (steps of the code)
constexpr std::size_t kBlock = 1024;  // places that one thread rates at a time
constexpr std::size_t kHeadings = 3;  // that are kept of a place, on average
constexpr std::size_t kFitted = 1000;
constexpr std::size_t kFittedAgain = 60;
constexpr std::size_t kFewBeams = 120;
constexpr double kApartMetres = 1.0;
constexpr double kApartRadians = radians(5.0);

// A pose that is less likely by a factor of 50 than the true one does not explain the scan as
// noise.
constexpr double kWithinNoise = 4.0;  // log

/// Steps of 5 cm nearby, growing with the range as a grid of places and degrees asks.
std::uint8_t code_of(double range) {
  constexpr double kScale = 70.0;
  constexpr double kNear = 4.0;  // m
  constexpr double kFar = 100.0;
  return static_cast<std::uint8_t>(
      std::lround(kScale * std::log1p(std::clamp(range, 0.0, kFar) / kNear)));
}

bool is_apart(const Pose2& a, const Pose2& b) {
  return !is_near(a, b, kApartMetres, kApartRadians);
}

LaserScan every_nth(const LaserScan& scan, std::size_t beams) {
  const std::size_t stride = std::max<std::size_t>(1, scan.ranges.size() / beams);
  LaserScan out = scan;
  out.ranges.clear();
  out.bearings.clear();
  out.bearing_step = scan.bearing_step * static_cast<double>(stride);
  for (std::size_t i = 0; i < scan.ranges.size(); i += stride) {
    out.ranges.push_back(scan.ranges[i]);
    if (!scan.bearings.empty()) out.bearings.push_back(scan.bearings[i]);
  }
  return out;
}

Matrix3d spread(double metres, double radians) {
  return Vector3d(metres, metres, radians).cwiseAbs2().asDiagonal();
}

}  // namespace

PoseOracle::PoseOracle(const LineMap& map, const ScannerModel& scanner,
                       std::span<const Vector2d> inside, int threads)
    : map_(map), scanner_(scanner), threads_(threads) {
  flood(inside);
  look_around();
}

/// All grid places that can be reached from those given without coming near a wall.
void PoseOracle::flood(std::span<const Vector2d> inside) {
  const Vector2d origin = map_.bounds().min;
  const Vector2d size = map_.bounds().size();
  const auto columns = static_cast<std::int64_t>(size.x() / kPitch) + 1;
  const auto rows = static_cast<std::int64_t>(size.y() / kPitch) + 1;
  std::vector<bool> known(static_cast<std::size_t>(columns * rows), false);
  std::vector<int> near;
  std::vector<std::int64_t> open;
  const auto visit = [&](std::int64_t column, std::int64_t row) {
    if (column < 0 || row < 0 || column >= columns || row >= rows) return;
    const std::int64_t cell = row * columns + column;
    if (known[static_cast<std::size_t>(cell)]) return;
    known[static_cast<std::size_t>(cell)] = true;
    const Vector2d place =
        origin + kPitch * Vector2d(static_cast<double>(column), static_cast<double>(row));
    near.clear();
    map_.near(place, kClearance, near);
    if (!near.empty()) return;
    places_.push_back(place);
    open.push_back(cell);
  };
  for (const Vector2d& seed : inside) {
    const Vector2d cell = (seed - origin) / kPitch;
    visit(std::lround(cell.x()), std::lround(cell.y()));
  }
  while (!open.empty()) {
    const std::int64_t cell = open.back();
    open.pop_back();
    const std::int64_t column = cell % columns;
    const std::int64_t row = cell / columns;
    visit(column - 1, row);
    visit(column + 1, row);
    visit(column, row - 1);
    visit(column, row + 1);
  }
}

void PoseOracle::look_around() {
  profiles_.resize(places_.size());
  share_out((places_.size() + kBlock - 1) / kBlock, threads_, [&] {
    return [&, visibility = Visibility(),
            ranges = std::vector<double>(kBearings)](std::size_t block) mutable {
      const std::size_t end = std::min(places_.size(), (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < end; ++i) {
        visibility.sweep(map_, places_[i], scanner_.max_range_m);
        visibility.ranges(-kPi, kTwoPi / static_cast<double>(kBearings), ranges);
        for (std::size_t b = 0; b < kBearings; ++b) {
          profiles_[i][b] = code_of(std::min(ranges[b], scanner_.max_range_m));
        }
      }
    };
  });
}

/// Beams that lie nearest to evenly spread whole degrees.
void PoseOracle::choose_rays(const LaserScan& scan) {
  constexpr std::size_t kNone = ~std::size_t{0};
  std::array<std::size_t, kBearings> beam_at{};
  beam_at.fill(kNone);
  for (std::size_t i = 0; i < scan.beams_of_one_turn(); ++i) {
    const double turns = (scan.bearing(i) + kPi) / kTwoPi;
    const double degrees = (turns - std::floor(turns)) * static_cast<double>(kBearings);
    const double off = std::abs(degrees - std::round(degrees));
    if (off < 0.51) beam_at[static_cast<std::size_t>(std::lround(degrees)) % kBearings] = i;
  }
  std::vector<Ray> seen;
  const ReturnLimits limits = return_limits(scan, scanner_);
  for (std::size_t b = 0; b < kBearings; ++b) {
    if (beam_at[b] == kNone) continue;
    const double range = scan.ranges[beam_at[b]];
    const bool has_return = limits.is_return(range);
    seen.push_back({b, code_of(has_return ? range : scanner_.max_range_m)});
  }
  rays_.clear();
  const std::size_t count = std::min(kRays, seen.size());
  for (std::size_t i = 0; i < count; ++i) rays_.push_back(seen[i * seen.size() / count]);
}

/// The headings of each place that rate better than their neighbours; the best of them.
void PoseOracle::rate_block(std::size_t block, std::vector<Rated>& out) const {
  std::array<std::uint8_t, 2 * kBearings> twice{};
  std::array<std::uint8_t, kBearings> part{};
  std::array<std::uint16_t, kBearings> costs{};
  const std::size_t end = std::min(places_.size(), (block + 1) * kBlock);
  for (std::size_t i = block * kBlock; i < end; ++i) {
    std::copy(profiles_[i].begin(), profiles_[i].end(), twice.begin());
    std::copy(profiles_[i].begin(), profiles_[i].end(), twice.begin() + kBearings);
    costs.fill(0);
    for (std::size_t first = 0; first < rays_.size(); first += kGroup) {
      part.fill(0);
      for (std::size_t r = first; r < std::min(rays_.size(), first + kGroup); ++r) {
        const std::uint8_t* __restrict plan = twice.data() + rays_[r].bearing;
        const std::uint8_t code = rays_[r].code;
        for (std::size_t s = 0; s < kBearings; ++s) {
          const std::uint8_t high = plan[s] > code ? plan[s] : code;
          const std::uint8_t low = plan[s] > code ? code : plan[s];
          const auto off = static_cast<std::uint8_t>(high - low);
          part[s] = static_cast<std::uint8_t>(part[s] + (off < kCap ? off : kCap));
        }
      }
      for (std::size_t s = 0; s < kBearings; ++s) {
        costs[s] = static_cast<std::uint16_t>(costs[s] + part[s]);
      }
    }
    for (std::size_t s = 0; s < kBearings; ++s) {
      const std::uint16_t before = costs[(s + kBearings - 1) % kBearings];
      const std::uint16_t after = costs[(s + 1) % kBearings];
      if (costs[s] < before && costs[s] <= after) {
        out.push_back({costs[s], static_cast<std::uint16_t>(s), static_cast<std::uint32_t>(i)});
      }
    }
  }
}

void PoseOracle::rate_all() {
  const auto better = [](const Rated& a, const Rated& b) {
    return std::tie(a.cost, a.place, a.heading) < std::tie(b.cost, b.place, b.heading);
  };
  std::vector<std::vector<Rated>> blocks((places_.size() + kBlock - 1) / kBlock);
  share_out(blocks.size(), threads_, [&] {
    return [&](std::size_t block) {
      std::vector<Rated>& rated = blocks[block];
      rate_block(block, rated);
      const std::size_t most = std::min(rated.size(), kBlock * kHeadings);
      std::nth_element(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(most),
                       rated.end(), better);
      rated.resize(most);
    };
  });
  rated_.clear();
  for (const auto& block : blocks) rated_.insert(rated_.end(), block.begin(), block.end());
  std::sort(rated_.begin(), rated_.end(), better);
}

/// The best thousand of which no two lie in the same half metre and six degrees.
void PoseOracle::keep_apart() {
  constexpr double kCell = 0.5;  // m
  constexpr int kSector = 6;     // degrees
  std::set<std::tuple<int, int, int>> taken;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rated_.size() && kept < kFitted; ++i) {
    const Vector2d cell = (places_[rated_[i].place] - map_.bounds().min) / kCell;
    const bool is_new = taken
                            .emplace(static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                                     rated_[i].heading / kSector)
                            .second;
    if (is_new) rated_[kept++] = rated_[i];
  }
  rated_.resize(kept);
}

std::vector<PoseOracle::Fitted> PoseOracle::fit_best(const LaserScan& scan,
                                                     const MapError& plan_error) const {
  constexpr double kLoose = 0.1;  // the first fits allow for so much more error (m)
  const LaserScan thin = every_nth(scan, kFewBeams);
  const MapError loose{std::hypot(plan_error.offset_sigma_m, kLoose), plan_error.length_m,
                       plan_error.roughness_sigma_m};
  const Pose2 laser_from_vehicle = inverse(scan.vehicle_from_laser);
  std::vector<Fitted> fitted(rated_.size());
  const auto fit_all = [&](const LaserScan& beams, const MapError& error, double start_m) {
    share_out(fitted.size(), threads_, [&] {
      ScanLikelihood likelihood;
      LikelihoodOptions options;
      options.beams = static_cast<int>(scan.ranges.size());
      likelihood.set_scan(scan, scanner_, error, options);
      return [&, likelihood, refiner = Refiner()](std::size_t i) mutable {
        const PoseWithCovariance prior{fitted[i].pose, spread(1.0, 0.1)};
        const PoseWithCovariance start{fitted[i].pose, spread(start_m, 0.1 * start_m)};
        fitted[i].pose =
            refiner.refine({map_, beams, scanner_, error, std::nullopt}, prior, start, {}).pose;
        fitted[i].log_likelihood =
            likelihood.at(map_, fitted[i].pose * scan.vehicle_from_laser, 0.0);
      };
    });
    std::stable_sort(fitted.begin(), fitted.end(), [](const Fitted& a, const Fitted& b) {
      return a.log_likelihood > b.log_likelihood;
    });
  };
  for (std::size_t i = 0; i < rated_.size(); ++i) {
    const Vector2d& place = places_[rated_[i].place];
    const double heading = wrap_angle(radians(static_cast<double>(rated_[i].heading)));
    fitted[i].pose = Pose2{place.x(), place.y(), heading} * laser_from_vehicle;
  }
  fit_all(thin, loose, 0.2);
  fitted.resize(std::min(fitted.size(), kFittedAgain));
  fit_all(scan, plan_error, 0.05);
  return fitted;
}

void PoseOracle::rate(const LaserScan& scan) {
  choose_rays(scan);
  rate_all();
  keep_apart();
}

OracleAnswer PoseOracle::judge(const LaserScan& scan, const Pose2& truth,
                               const MapError& plan_error) const {
  std::vector<Fitted> fitted = fit_best(scan, plan_error);
  ScanLikelihood likelihood;
  LikelihoodOptions options;
  options.beams = static_cast<int>(scan.ranges.size());
  likelihood.set_scan(scan, scanner_, plan_error, options);
  double at_truth = likelihood.at(map_, truth * scan.vehicle_from_laser, 0.0);
  OracleAnswer answer;
  double at_rival = -1e9;
  for (const Fitted& pose : fitted) {
    if (!is_apart(truth, pose.pose)) {
      answer.found_truth = true;
      at_truth = std::max(at_truth, pose.log_likelihood);
    } else if (pose.log_likelihood > at_rival) {
      at_rival = pose.log_likelihood;
      answer.rival = pose.pose;
    }
  }
  answer.gap = at_truth - at_rival;
  answer.one_answer = answer.gap > kWithinNoise;
  return answer;
}

}  // namespace adit
