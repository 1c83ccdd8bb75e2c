#pragma once

#include <optional>
#include <vector>

#include "adit/io/log.hpp"
#include "mine_search.hpp"

namespace adit {

/// The level on which the first scan lies that has one answer (`ok`), among the log's first
/// `most_scans`; none where no scan has.
std::optional<std::size_t> find_level(const Log& log, const std::vector<MineLevel>& levels,
                                      const LocalizerSettings& settings, std::size_t most_scans);

}  // namespace adit
