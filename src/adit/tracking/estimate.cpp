#include "adit/tracking/estimate.hpp"

namespace adit {

const char* to_string(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::degraded:
      return "degraded";
    case Status::ambiguous:
      return "ambiguous";
    case Status::lost:
      return "lost";
  }
  return "lost";
}

}  // namespace adit
