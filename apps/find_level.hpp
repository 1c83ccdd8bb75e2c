#pragma once

#include <optional>
#include <vector>

#include "adit/io/log.hpp"
#include "mine_search.hpp"

namespace adit {

/// The level on which two scans in a row lie that have one answer (`ok`), of the log's first
/// `most_scans`, or the only one that has; none where no scan has or they contradict each other.
std::optional<std::size_t> find_level(const Log& log, const std::vector<MineLevel>& levels,
                                      const LocalizerSettings& settings, std::size_t most_scans);

}  // namespace adit
