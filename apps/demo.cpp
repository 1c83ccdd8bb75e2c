#include "commands.hpp"
#include "report_error.hpp"

namespace adit {
int run_demo(const DemoArguments&) { return report({"not yet", {}}); }
}  // namespace adit
