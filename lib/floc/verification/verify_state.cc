#include "floc/verification/verify_state.h"

#include <utility>

#include "floc/rigid/contact_points.h"
#include "floc/verification/boundary_verification.h"
#include "floc/verification/scene_check.h"
#include "floc/verification/verify_rigid.h"

namespace floc {
namespace {

template <int Dim>
std::vector<Criterion> criteria_of_law(const State<Dim>& state, const std::string& file) {
  if (state.packing.law.is_rigid())
    return verify_rigid(state, scene_gap_tolerance(file, state).value_or(default_gap_tolerance(state.packing)));
  return verify_equilibrium(state);
}

}  // namespace

std::vector<Criterion> verify_state(const AnyState& any, const std::string& file) {
  return std::visit(
      [&](const auto& state) {
        std::vector<Criterion> criteria = criteria_of_law(state, file);
        for (Criterion& c : check_against_scene(file, state)) criteria.push_back(std::move(c));
        if (!state.motion) criteria.push_back(verify_boundary_motion(state));
        return criteria;
      },
      any);
}

}  // namespace floc
