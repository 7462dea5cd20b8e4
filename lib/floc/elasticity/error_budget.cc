#include "floc/elasticity/error_budget.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace floc {

const char* ErrorBudget::limit() const {
  const double undecided = equilibrium.value_or(0.0);
  if (sampling > std::max(solver, undecided)) return "sampling";
  if (solver >= undecided) return "solver";
  return floor.force > residual ? "rounding" : "residual";
}

template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step) {
  ErrorBudget budget;
  budget.solver = moduli.B_error;
  budget.floor = rounding_floor(state.packing, state.target_stress);
  budget.residual = residuals(state.packing, state.target_stress).force;
  const Eigen::VectorXd diagonal = moduli.C.diagonal().head(Dim);
  budget.sampling = (diagonal.maxCoeff() - diagonal.minCoeff()) / (Dim * Dim);

  const double undecided =
      std::max(budget.residual, budget.floor.force) * force_scale(state.packing, state.target_stress).force;
  double held = 0.0;
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    const Contact<Dim>& contact = state.packing.contacts[static_cast<std::size_t>(network.contacts[c].source)];
    if (contact.distant || contact.bonded || contact.elastic_force > undecided) continue;
    ++budget.n_undecided;
    if (step != nullptr) held += std::abs(step->energy[c]);
  }
  if (step == nullptr) return budget;
  const double all = std::accumulate(step->energy.begin(), step->energy.end(), 0.0);
  if (all > 0.0) budget.equilibrium = held / all * std::abs(moduli.B);
  return budget;
}

template ErrorBudget error_budget(const State<2>&, const ContactNetwork<2>&, const Moduli&,
                                  const StepResponse<2>*);
template ErrorBudget error_budget(const State<3>&, const ContactNetwork<3>&, const Moduli&,
                                  const StepResponse<3>*);

}  // namespace floc
