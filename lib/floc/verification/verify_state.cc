#include "floc/verification/verify_state.h"

#include <utility>

#include "floc/verification/boundary_verification.h"
#include "floc/verification/scene_check.h"

namespace floc {

std::vector<Criterion> verify_state(const AnyState& any, const std::string& file) {
  return std::visit(
      [&](const auto& state) {
        std::vector<Criterion> criteria = verify_equilibrium(state);
        for (Criterion& c : check_against_scene(file, state)) criteria.push_back(std::move(c));
        criteria.push_back(verify_boundary_motion(state));
        return criteria;
      },
      any);
}

}  // namespace floc
