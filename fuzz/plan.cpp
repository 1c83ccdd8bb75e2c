// A plan is read whole, finite and writable, or refused with a message.
#include "adit/io/plan.hpp"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto plan = adit::parse_plan({reinterpret_cast<const char*>(data), size}, "plan");
  if (!plan) {
    if (plan.error().message.empty() || plan.error().message.size() > 500) std::abort();
    return 0;
  }
  if (plan->segments.empty()) std::abort();
  for (const adit::Segment& segment : plan->segments)
    if (!segment.is_finite()) std::abort();
  return 0;
}
