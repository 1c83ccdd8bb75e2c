#include "adit/localizer/search_beside.hpp"

#include <algorithm>

namespace adit {

void SearchBeside::reset() {
  finder_.wait_and_drop();
  schedule_ = doubts_ = SearchSchedule{};
}

void SearchBeside::begin(const RelocationQuery& query, bool is_doubt, double explained) {
  finder_.begin(query, finder_options());
  schedule_.begin(settings_.recovery);
  is_doubt_ = is_doubt;
  explained_ = explained;
  since_begun_.start({});
}

PlaceFinderOptions SearchBeside::finder_options() const {
  RelocationOptions relocation = settings_.relocation;
  for (int* most : {&relocation.listed, &relocation.refined, &relocation.fitted_again,
                    &relocation.rated_again}) {
    *most = std::max(*most, settings_.recovery.most_poses);
  }
  relocation.second_look_gap = 0.0;  // one look, which is thorough, and the way decides
  return {settings_.places, relocation, settings_.likelihood, settings_.refinement,
          settings_.status};
}

}  // namespace adit
