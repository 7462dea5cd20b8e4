#pragma once

#include <Eigen/Core>
#include <optional>

#include "floc/relaxation/static_solver.h"

namespace floc {

/// Change of a configuration in a Newton iteration.
template <class Configuration>
struct NewtonMove {
  Configuration next;
  double length;  ///< largest relative displacement of two grains in contact, in units of the largest diameter
};

/// Moves a configuration by a Newton step. The step is shortened to StaticSolverOptions::largest_step. It is then halved
/// as long as it does not reduce the residual, up to StaticSolverOptions::max_backtracking times: springs that reach their
/// caps and contacts that open or close change the tangent stiffness within a step, so that a full step can increase the
/// residual, whereas a shorter step may reduce it.
/// @param problem  equations with the functions largest_relative_displacement(now, step) and moved(now, step)
/// @param now      configuration with the member `worst`, the largest residual
/// @return the configuration after the step, whose residual may still be larger; nothing if the packing has a mechanism
/// (a motion without stiffness): such a motion has only the stiffness of the regularisation, so that a small residual
/// along it gives a huge step
template <class Problem, class Configuration>
std::optional<NewtonMove<Configuration>> newton_move(const Problem& problem, const Configuration& now,
                                                     Eigen::VectorXd step, const StaticSolverOptions& options) {
  double length = problem.largest_relative_displacement(now, step);
  if (!(length < 1e3)) return std::nullopt;
  if (length > options.largest_step) {
    step *= options.largest_step / length;
    length = options.largest_step;
  }
  Configuration next = problem.moved(now, step);
  for (int halvings = 0; next.worst >= now.worst && halvings < options.max_backtracking; ++halvings) {
    step *= 0.5;
    length *= 0.5;
    next = problem.moved(now, step);
  }
  return NewtonMove<Configuration>{std::move(next), length};
}

}  // namespace floc
