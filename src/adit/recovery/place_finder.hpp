#pragma once

#include <future>
#include <memory>
#include <utility>

#include "adit/relocation/relocator.hpp"

namespace adit {

/// What a search in the whole mine needs to know beside the scan.
struct PlaceFinderOptions {
  PlaceIndexOptions places;
  RelocationOptions relocation;
  LikelihoodOptions likelihood;
  RefinementOptions refinement;
  StatusOptions status;
};

/// Searches the mine for a scan beside the cycle, on a thread of its own.
///
/// The answer does not depend on how long that takes: the caller decides at which scan it is taken,
/// and waits where it is not there yet. The index is made at the first search, unless it is given.
class PlaceFinder {
 public:
  PlaceFinder(const LineMap& map, std::shared_ptr<const PlaceIndex> index)
      : map_(map), index_(std::move(index)) {}
  PlaceFinder(const PlaceFinder&) = delete;  // the search holds its address
  PlaceFinder& operator=(const PlaceFinder&) = delete;
  ~PlaceFinder() = default;  // waits for the search

  bool is_searching() const { return result_.valid(); }
  /// Begins a search; all that it needs is copied. One at a time.
  void begin(const RelocationQuery& query, const PlaceFinderOptions& options);
  /// Waits for the search that was begun.
  RelocationResult take() { return result_.get(); }
  /// Waits for the search that is under way, if one is, and forgets its answer.
  void wait_and_drop();

 private:
  const LineMap& map_;
  std::shared_ptr<const PlaceIndex> index_;  // touched by the search alone while one is under way
  std::future<RelocationResult> result_;
};

}  // namespace adit
