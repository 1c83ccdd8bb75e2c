#pragma once

#include <string>
#include <vector>

#include "adit/io/json.hpp"
#include "mine_search.hpp"

namespace adit {

/// What `adit locate --json` prints of a scan: status, poses, elapsed_s.
Json locate_json(const MineAnswer& answer, const std::vector<MineLevel>& levels);

/// The same as a table for the terminal.
std::string locate_table(std::size_t index, const MineAnswer& answer,
                         const std::vector<MineLevel>& levels);

}  // namespace adit
