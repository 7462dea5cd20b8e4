#include "floc/rigid/static_forces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "floc/base/error.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

/// Largest relative duality gap with which forces are accepted if rounding errors ended the search for them.
constexpr double kNearlyClosest = 1e-7;
/// Largest error of the balance, divided by the mean normal force, at which polish() is tried: if it finds the faces of
/// the cones on which the forces lie, the error falls to rounding. Searches with 20 000 polyhedra ended at 1.0e-6 and
/// 1.2e-6.
constexpr double kWorthPolishing = 1e-4;
/// If there are no balanced forces, the message names the grains with the largest motion or error: those with at least
/// this share of the largest, but at most kMostNames of them.
constexpr double kNamed = 0.1;
constexpr std::size_t kMostNames = 10;

/// Returns the blocks (P, T/mu) of the present forces, divided by ForceBalance::unit. The tangential part is zero for
/// contacts without friction.
template <int Dim>
std::vector<Vec<Dim>> present_blocks(const ForceBalance<Dim>& balance) {
  std::vector<Vec<Dim>> out;
  for (const UnknownForce<Dim>& u : balance.unknowns) {
    Vec<Dim> x = u.present / balance.unit;
    x.template tail<Dim - 1>() *= u.friction > 0.0 ? 1.0 / u.friction : 0.0;
    out.push_back(x);
  }
  return out;
}

}  // namespace

template <int Dim>
StaticForces<Dim>::StaticForces(const std::string& place, const Packing<Dim>& packing,
                                const ForceBalanceOptions<Dim>& options)
    : packing_(packing),
      balance_(force_balance(place, packing, options)),
      program_(balance_.program),
      method_(program_),
      accepted_error_(options.accepted_error) {}

template <int Dim>
BalancedForces<Dim> StaticForces<Dim>::closest(double costly_gap) {
  return solved(present_blocks(balance_), costly_gap);
}

template <int Dim>
BalancedForces<Dim> StaticForces<Dim>::canonical() {
  return solved(std::vector<Vec<Dim>>(balance_.unknowns.size(), Vec<Dim>::Zero()));
}

template <int Dim>
BalancedForces<Dim> StaticForces<Dim>::present() const {
  return forces(present_blocks(balance_), 0);
}

template <int Dim>
BalancedForces<Dim> StaticForces<Dim>::solved(const std::vector<Vec<Dim>>& preferred, double costly_gap) {
  // The unit of the energy is chosen so that the mean normal compliance is one.
  double mean = 0.0;
  for (const UnknownForce<Dim>& u : balance_.unknowns) mean += 1.0 / u.kn;
  mean /= static_cast<double>(balance_.unknowns.size());
  for (int k = 0; k < program_.n_blocks(); ++k) {
    const UnknownForce<Dim>& u = balance_.unknowns[k];
    program_.compliance[k].setConstant(u.friction * u.friction / (u.kt * mean));
    program_.compliance[k][0] = 1.0 / (u.kn * mean);
    program_.linear[k] = -program_.compliance[k].cwiseProduct(preferred[k]);
    if (costly_gap > 0.0) {
      const Contact<Dim>& c = packing_.contacts[u.contact];
      program_.linear[k][0] += std::max(0.0, c.gap) / (2.0 * smaller_radius(packing_, c) * costly_gap);
    }
  }
  ConeSolution<Dim> solution = method_.solve(program_);
  if (!solution.is_solved(kWorthPolishing, kNearlyClosest)) fail(solution);
  method_.polish(program_, solution);
  if (solution.status == ConeStatus::kFailed && !(solution.residual < accepted_error_)) fail(solution);
  return forces(solution.x, solution.n_factorizations);
}

template <int Dim>
double StaticForces<Dim>::extreme(int block, double sign) {
  program_.linear.assign(program_.n_blocks(), Vec<Dim>::Zero());
  program_.linear[block][0] = -sign;
  // The repulsive part P is never below zero, so the search for the smallest force ends at P = 0. For the largest
  // force, no bound is known in advance.
  const double bound = sign < 0.0 ? 0.0 : -std::numeric_limits<double>::infinity();
  const ConeSolution<Dim> solution = method_.minimise_linear(program_, bound);
  if (solution.status == ConeStatus::kUnbounded) return std::numeric_limits<double>::infinity();
  if (solution.status != ConeStatus::kSolved) fail(solution);
  return solution.x[block][0] * balance_.unit - balance_.unknowns[block].adhesion;
}

template <int Dim>
ForceRange StaticForces<Dim>::range(int contact) {
  const auto found = std::ranges::find(balance_.unknowns, contact, &UnknownForce<Dim>::contact);
  if (found == balance_.unknowns.end()) {
    const Contact<Dim>& c = packing_.contacts[contact];
    const double known = c.distant ? c.normal_force : 0.0;
    return {known, known};
  }
  const int block = static_cast<int>(found - balance_.unknowns.begin());
  return {extreme(block, -1.0), extreme(block, 1.0)};
}

template <int Dim>
BalancedForces<Dim> StaticForces<Dim>::forces(const std::vector<Vec<Dim>>& x, int n_factorizations) const {
  BalancedForces<Dim> out;
  out.n_factorizations = n_factorizations;
  out.friction_limit.assign(packing_.contacts.size(), std::numeric_limits<double>::infinity());
  // Some contacts have no unknown force: attractions across a gap keep their present forces, and the forces of all
  // other such contacts are zero in every equilibrium (force_balance.h).
  for (const Contact<Dim>& c : packing_.contacts) {
    out.normal_force.push_back(c.distant ? c.normal_force : 0.0);
    out.shear_force.push_back(c.distant ? c.shear_force : Vec<Dim>(Vec<Dim>::Zero()));
  }
  double mean = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const UnknownForce<Dim>& u = balance_.unknowns[k];
    // The block is x = (P, T/mu) in units of ForceBalance::unit, with the repulsive part P and the friction coefficient
    // mu. The normal force is F_N = P - F_a with the adhesion F_a, and the tangential force T is mu times the
    // tangential part of x.
    out.normal_force[u.contact] = x[k][0] * balance_.unit - u.adhesion;
    Vec<Dim> shear = u.friction * balance_.unit * x[k];
    shear[0] = 0.0;
    out.shear_force[u.contact] = u.frame * shear;
    if (u.friction > 0.0) out.friction_limit[u.contact] = u.friction * x[k][0] * balance_.unit;
    mean += std::abs(x[k][0]) / static_cast<double>(x.size());
  }
  // In the program, the moments on a grain are divided by the size of the grain, so that the residuals of these rows
  // are forces, too. The residuals and `mean` have the unit ForceBalance::unit, which cancels in their ratio.
  const Eigen::VectorXd residual = program_.balance(x) - program_.load;
  for (int row = 0; row < residual.size(); ++row) {
    const double size = std::abs(residual[row]);
    if (balance_.row_grain[row] < 0)
      out.error.stress = std::max(out.error.stress, size / balance_.unit_of_boundary);
    else if (balance_.row_is_moment[row])
      out.error.moment = std::max(out.error.moment, size / mean);
    else
      out.error.force = std::max(out.error.force, size / mean);
  }
  return out;
}

template <int Dim>
void StaticForces<Dim>::fail(const ConeSolution<Dim>& solution) const {
  if (solution.status != ConeStatus::kInfeasible)
    throw NoResult(fmt::format(
        "rounding errors ended the search for static forces: the residual is {:.1e} of the mean force, and the "
        "duality gap is {:.1e}, after {} factorizations; there may be no solution. The balance has the largest "
        "errors for {}",
        solution.residual, solution.gap, solution.n_factorizations,
        largest_grains(Eigen::VectorXd(program_.balance(solution.x) - program_.load), true)));
  // If no forces balance the load, the solver returns a motion that proves this: the load does positive work in the
  // motion, and no contact resists the motion.
  const std::string grains = largest_grains(solution.motion, false);
  throw NoResult("no set of contact forces balances the load: this is not an equilibrium of rigid grains" +
                 (grains.empty() ? grains : "; the load moves most " + grains));
}

/// Names the grains with the largest values in the rows of the program; empty if all values are zero.
/// @param moments  whether the rows of moments and rotations count, too
template <int Dim>
std::string StaticForces<Dim>::largest_grains(const Eigen::VectorXd& of_rows, bool moments) const {
  std::map<int, double> size;
  for (int row = 0; row < of_rows.size(); ++row)
    if (const int grain = balance_.row_grain[row]; grain >= 0 && (moments || !balance_.row_is_moment[row]))
      size[grain] = std::max(size[grain], std::abs(of_rows[row]));
  std::vector<std::pair<double, int>> grains;
  for (const auto& [grain, value] : size)
    if (value > 0.0) grains.emplace_back(-value, grain);
  if (grains.empty()) return "";
  std::ranges::sort(grains);
  const double least = kNamed * grains.front().first;
  std::erase_if(grains, [&](const auto& g) { return g.first > least; });
  std::vector<std::int64_t> names;
  for (const auto& [value, grain] : grains)
    if (names.size() < kMostNames) names.push_back(packing_.grains.name(grain));
  std::string text = (grains.size() == 1 ? "grain " : "grains ") + fmt::format("{}", fmt::join(names, ", "));
  if (grains.size() > names.size()) text += fmt::format(" and {} others", grains.size() - names.size());
  return text;
}

template <int Dim>
std::vector<std::optional<double>> forces_on_moving_walls(const Packing<Dim>& packing,
                                                          const std::vector<double>& force) {
  std::vector<std::optional<double>> out;
  for (std::size_t w = 0; w < packing.walls.size(); ++w)
    out.push_back(follows_forces(packing.walls[w]) ? std::optional(force[w]) : std::nullopt);
  return out;
}

template <int Dim>
double force_distance(const BalancedForces<Dim>& f, const BalancedForces<Dim>& g) {
  double difference = 0.0, size = 0.0;
  for (std::size_t k = 0; k < f.normal_force.size(); ++k) {
    difference += std::pow(f.normal_force[k] - g.normal_force[k], 2) +
                  (f.shear_force[k] - g.shear_force[k]).squaredNorm();
    size += f.normal_force[k] * f.normal_force[k] + f.shear_force[k].squaredNorm();
  }
  return size > 0.0 ? std::sqrt(difference / size) : 0.0;
}

template <int Dim>
std::optional<double> force_freedom(const State<Dim>& state) {
  if (state.motion) return std::nullopt;
  const Packing<Dim>& packing = state.packing;
  ForceBalanceOptions<Dim> options;
  if (packing.walls.empty()) {
    options.axis_stress = state.stress.diagonal();
    for (int a = 0; a < Dim; ++a) options.open_axis[a] = state.target_side[a] > 0.0;
  } else {
    options.wall_force = forces_on_moving_walls(packing, wall_forces(packing));
  }
  try {
    StaticForces<Dim> forces("the state", packing, options);
    return force_distance(forces.present(), forces.canonical());
  } catch (const NoResult&) {
    return std::nullopt;
  } catch (const InputError&) {  // thrown if all forces are zero, or if contacts resist rolling or twisting
    return std::nullopt;
  }
}

template class StaticForces<2>;
template class StaticForces<3>;
template std::vector<std::optional<double>> forces_on_moving_walls(const Packing<2>&,
                                                                   const std::vector<double>&);
template std::vector<std::optional<double>> forces_on_moving_walls(const Packing<3>&,
                                                                   const std::vector<double>&);
template double force_distance(const BalancedForces<2>&, const BalancedForces<2>&);
template double force_distance(const BalancedForces<3>&, const BalancedForces<3>&);
template std::optional<double> force_freedom(const State<2>&);
template std::optional<double> force_freedom(const State<3>&);

}  // namespace floc
