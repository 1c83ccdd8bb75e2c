#include <array>

#include "cell.hpp"

namespace adit {
namespace {

constexpr auto kCells = std::to_array<Cell>({
    // Plan as the mine.
    {.name = "niosh-planned-sick", .group = "planned", .stated_m = 0.0, .quick = 4, .full = 40},
    {.name = "niosh-planned-sick-anywhere",
     .group = "planned",
     .stated_m = 0.0,
     .start = Start::anywhere,
     .quick = 4,
     .full = 40},
    {.name = "edgar-planned-sick",
     .group = "planned",
     .mine = Mine::edgar,
     .stated_m = 0.0,
     .quick = 2,
     .full = 40},
    {.name = "panel-planned-sick",
     .group = "planned",
     .mine = Mine::panel,
     .plan = PlanError::rough,
     .quick = 4},
    {.name = "mockup-planned-cyclone",
     .group = "planned",
     .mine = Mine::mockup,
     .stated_m = 0.0,
     .scanner = "cyclone",
     .wheels = Wheels::paper,
     .task = Task::stops,
     .quick = 10},
    {.name = "crosscuts-planned-sick",
     .group = "planned",
     .mine = Mine::crosscuts,
     .stated_m = 0.0,
     .quick = 2},
    {.name = "straight-planned-sick",
     .group = "planned",
     .mine = Mine::straight,
     .plan = PlanError::rough,
     .quick = 2},
    // One scan.
    {.name = "niosh-scan-cyclone",
     .group = "one_scan",
     .stated_m = 0.1,
     .scanner = "cyclone",
     .task = Task::locate,
     .quick = 2},
    {.name = "edgar-outside-cyclone",
     .group = "one_scan",
     .mine = Mine::niosh,
     .stated_m = 0.1,
     .scanner = "cyclone",
     .task = Task::outside,
     .quick = 1},
});

}  // namespace

std::span<const Cell> all_cells() { return kCells; }

}  // namespace adit
