#include "adit/calibration/log_settings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adit/config/fields.hpp"
#include "adit/extraction/noise_estimate.hpp"
#include "adit/io/carmen.hpp"

namespace adit {
namespace {

constexpr const char* kConfigured = "configuration";
constexpr const char* kFromFields = "the log's own fields";
constexpr const char* kEstimated = "estimated from the log";
constexpr const char* kDefault = "default";
constexpr const char* kThenLearnt = ", then learnt from the residuals";
constexpr long kScansToLearnFrom = 200;
constexpr double kBestSigma = 1e-3;  // m; no scanner of mines is better, whatever a log shows

/// The scatter of scans of one laser, spread evenly over the log.
std::optional<ScatterEstimate> scatter_of(const Log& log, const LaserSummary& laser) {
  ScatterEstimator estimator;
  const auto held = std::count_if(log.scans.begin(), log.scans.end(),
                                  [&](const LogScan& entry) { return entry.laser == laser.laser; });
  const long stride = std::max(1L, static_cast<long>(held) / kScansToLearnFrom);
  long seen = 0;
  for (const LogScan& entry : log.scans) {
    if (entry.laser == laser.laser && seen++ % stride == 0) estimator.add(entry.scan);
  }
  return estimator.estimate();
}

double longest_range(const Log& log, const LaserId& laser) {
  double longest = 0.0;
  for (const LogScan& entry : log.scans) {
    if (entry.laser == laser) longest = std::max(longest, entry.scan.max_range);
  }
  return longest;
}

/// The noise that is left of the beams' scatter without their rounding.
double noise_without_rounding(double beam_sigma_m, double quantisation_m) {
  const double rounding = quantisation_m * quantisation_m / 12.0;
  const double least = std::max(0.25 * rounding, kBestSigma * kBestSigma);
  return std::sqrt(std::max(beam_sigma_m * beam_sigma_m - rounding, least));
}

const char* words_for(RangeSource source) {
  switch (source) {
    case RangeSource::configuration:
      return kConfigured;
    case RangeSource::parameter:
      return "the log's PARAM lines";
    case RangeSource::field:
      return kFromFields;
    case RangeSource::found:
      return "found in the log's ranges";
    case RangeSource::assumed:
      break;
  }
  return "assumed: above every range of the log";
}

/// Fills in what the configuration leaves open of one laser, and says from where.
ScannerSources settle_scanner(const LoadedConfiguration& loaded, const Log& log,
                              const LaserSummary& laser,
                              const std::optional<ScatterEstimate>& scatter,
                              ScannerModel& scanner) {
  ScannerSources sources{kConfigured, kConfigured, kConfigured};
  if (!loaded.has("scanner.max_range_m")) {
    scanner.max_range_m = longest_range(log, laser.laser);
    sources.max_range_m = words_for(laser.max_range_source);
  }
  if (!loaded.has("scanner.quantisation_m")) {
    const std::optional<double> step = find_range_step(log, laser.laser);
    if (step) scanner.quantisation_m = *step;
    sources.quantisation_m = step ? kEstimated : kDefault;
  }
  if (!loaded.has("scanner.range_sigma_m")) {
    if (scatter) {
      scanner.range_sigma_m = noise_without_rounding(scatter->beam_sigma_m, scanner.quantisation_m);
    }
    sources.range_sigma_m = scatter ? kEstimated : kDefault;
  }
  return sources;
}

/// Settles every laser. Returns the scatter of the one that shows most of the walls.
std::optional<ScatterEstimate> settle_scanners(const LoadedConfiguration& loaded, const Log& log,
                                               LogSettings& settings) {
  LocalizerSettings& localizer = settings.configuration.localizer;
  std::optional<ScatterEstimate> widest;
  for (const LaserSummary& laser : log.summary.lasers) {
    const std::optional<ScatterEstimate> scatter = scatter_of(log, laser);
    ScannerModel scanner = loaded.values.localizer.scanner;
    settings.lasers.push_back(settle_scanner(loaded, log, laser, scatter, scanner));
    if (settings.lasers.size() == 1) {
      localizer.scanner = scanner;
    } else {
      localizer.more_scanners.push_back(scanner);
    }
    if (scatter && (!widest || scatter->windows > widest->windows)) widest = scatter;
  }
  return widest;
}

/// The keys whose values and sources are reported even where nothing is known of them.
bool is_reported(const ConfigField& field) {
  const std::string name = field.name();
  return field.table == "scanner" || field.table == "odometry" || name == "map.sigma_m" ||
         name == "extraction.roughness_m";
}

}  // namespace

LogSettings settle(const LoadedConfiguration& loaded, const Log& log) {
  LogSettings settings{loaded.values, {}, {}};
  LocalizerSettings& localizer = settings.configuration.localizer;
  localizer.more_scanners.clear();
  for (const std::string& key : loaded.given) settings.sources[key] = kConfigured;
  const std::optional<ScatterEstimate> scatter = settle_scanners(loaded, log, settings);
  if (!settings.lasers.empty()) {
    const ScannerSources& first = settings.lasers.front();
    settings.sources["scanner.max_range_m"] = first.max_range_m;
    settings.sources["scanner.quantisation_m"] = first.quantisation_m;
    settings.sources["scanner.range_sigma_m"] = first.range_sigma_m;
  }
  if (scatter && !loaded.has("extraction.roughness_m")) {
    localizer.extraction.roughness_m = scatter->roughness_m;
    settings.sources["extraction.roughness_m"] = kEstimated;
  }
  for (const ConfigField& field : fields_of(settings.configuration)) {
    if (is_reported(field)) settings.sources.try_emplace(field.name(), kDefault);
  }
  localizer.map.is_stated = loaded.has("map.sigma_m");
  // Features alone leave no residuals of single beams to learn the map's error from.
  if (localizer.estimator != Estimator::features) settings.sources["map.sigma_m"] += kThenLearnt;
  return settings;
}

}  // namespace adit
