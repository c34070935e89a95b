// What a case file needs beyond its tables and rules: packed cells and channels, which need every solver.
#include "apps/case_suspension.hpp"

namespace hemoflux::apps {

ContactInput read_contact(const Section& /*in*/) { return {}; }
PackingInput read_packing(const Section& /*in*/) { return {}; }
void complete_suspension(Case& /*c*/, bool /*initial_chosen*/) {}

}  // namespace hemoflux::apps
