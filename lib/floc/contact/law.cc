#include "floc/contact/law.h"

#include <algorithm>

#include "floc/contact/contact_history.h"
#include "floc/contact/law_parameters.h"
#include "floc/contact/model_traits.h"

namespace floc {

Law::Law() : Law(LawParameters{}) {}

Law::Law(const LawParameters& parameters) : parameters_(std::make_shared<const LawParameters>(parameters)) {}

bool Law::operator==(const Law& other) const {
  return parameters() == other.parameters();
}

bool Law::has_adhesion() const {
  return parameters().adhesion || adheres_by_itself();
}

bool Law::has_damping() const {
  return static_cast<bool>(parameters().damping);
}

bool Law::has_friction() const {
  return static_cast<bool>(parameters().friction);
}

bool Law::has_rolling() const {
  return static_cast<bool>(parameters().rolling);
}

bool Law::has_twisting() const {
  return static_cast<bool>(parameters().twisting);
}

double Law::pull_off_force() const {
  return parameters().adhesion.visit([](const auto& model) {
    if constexpr (requires { model.pull_off_force; }) return model.pull_off_force;
    return 0.0;
  });
}

double Law::pull_off_force(double radius) const {
  if (const CapillaryAdhesion* bridges = liquid()) return bridges->strength(radius, radius);
  return pull_off_force(PairGeometry<>(0.0, reduced(radius, radius)));
}

double Law::pull_off_force(const PairGeometry<>& pair) const {
  return parameters().normal.visit([&]<class Model>(const Model& model) {
    if constexpr (kAdheresByItself<Model>) return model.pull_off_force(pair);
    return pull_off_force();
  });
}

const CapillaryAdhesion* Law::liquid() const {
  if (!parameters().adhesion.holds<CapillaryAdhesion>()) return nullptr;
  const CapillaryAdhesion& bridges = parameters().adhesion.get<CapillaryAdhesion>();
  return bridges.acts() ? &bridges : nullptr;
}

double Law::range() const {
  return parameters().adhesion.visit([](const auto& model) {
    if constexpr (requires { model.range(); }) return model.acts() ? model.range() : 0.0;
    return 0.0;
  });
}

std::string Law::fault_in_dimension(int dimension) const {
  const std::vector<LawFault> faults = parameters().faults_in_dimension(dimension);
  return faults.empty() ? "" : faults.front().words;
}

double Law::reach(double largest_radius) const {
  return std::max(range(), parameters().normal.visit([&](const auto& model) {
    if constexpr (requires { model.holding_range(largest_radius); }) return model.holding_range(largest_radius);
    return 0.0;
  }));
}

bool Law::is_rigid() const {
  return parameters().normal.holds<RigidContact>();
}

bool Law::keeps_overlap() const {
  return parameters().normal.visit([]<class Model>(const Model&) { return history_size<Model>(2) > 0; });
}

bool Law::adheres_by_itself() const {
  return parameters().normal.visit([]<class Model>(const Model&) { return kAdheresByItself<Model>; });
}

const char* Law::normal_keyword() const {
  return parameters().normal.visit([]<class Model>(const Model&) { return Model::kKeyword; });
}

double Law::contact_modulus(int dim, double diameter) const {
  return parameters().normal.visit([&](const auto& model) { return model.modulus_of_packing(dim, diameter); });
}

double Law::force_exponent() const {
  return parameters().normal.visit([]<class Model>(const Model&) { return floc::force_exponent<Model>(); });
}

bool Law::is_for_small_overlaps() const {
  return parameters().normal.visit([]<class Model>(const Model&) { return kIsForSmallOverlaps<Model>; });
}

double Law::friction_coefficient() const {
  return parameters().friction.visit([]<class Model>(const Model& model) {
    if constexpr (kIsAbsent<Model>) {
      return 0.0;
    } else {
      return model.coefficient;
    }
  });
}

bool Law::friction_follows_load() const {
  return resists_sliding() &&
         parameters().friction.visit([]<class Model>(const Model&) { return kFollowsNormalStiffness<Model>; });
}

bool Law::resists_sliding() const {
  return parameters().friction.visit([](const auto& model) {
    if constexpr (requires { model.acts(); }) return model.acts();
    return false;
  });
}

}  // namespace floc
