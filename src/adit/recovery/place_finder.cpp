#include "adit/recovery/place_finder.hpp"

namespace adit {

void PlaceFinder::begin(const RelocationQuery& query, const PlaceFinderOptions& options) {
  const auto search = [this, scan = query.scan, scanner = query.scanner,
                       map_error = query.map_error, motion = query.motion, within = query.within,
                       options] {
    if (!index_) {
      index_ = std::make_shared<const PlaceIndex>(PlaceIndex::build(map_, options.places));
    }
    Relocator relocator(map_, *index_);
    return relocator.locate({scan, scanner, map_error, motion, within}, options.relocation,
                            options.likelihood, options.refinement, options.status);
  };
  // Where the system has no thread left, the search runs when its answer is taken.
  result_ = std::async(std::launch::async | std::launch::deferred, search);
}

void PlaceFinder::wait_and_drop() {
  if (result_.valid()) result_.get();
}

}  // namespace adit
