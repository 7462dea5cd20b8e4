#include "floc/rigid/gauss_seidel.h"

#include <utility>

#include "floc/rigid/contact_colours.h"
#include "floc/rigid/team_sweeps.h"

namespace floc {
namespace {

/// A grain counts as round if the relative deviation of its geometry from that of a round grain is at most this number.
/// Rounding of positions in large cells causes small deviations.
constexpr double kRound = 1e-12;

/// Returns whether a body behaves like a round body at one of its contacts, as RoundGroup requires.
template <int Dim>
bool is_round(const BodyMotion<Dim>& bodies, int body, const Vec<Dim>& arm, const Vec<Dim>& normal) {
  const Mat<kRotations<Dim>>& inertia = bodies.inverse_inertia[body];
  if (inertia.isZero(0.0)) return bodies.angular_velocity[body].isZero(0.0);
  const double mean = inertia.trace() / kRotations<Dim>;
  return (inertia - mean * Mat<kRotations<Dim>>::Identity()).norm() <= kRound * mean &&
         (arm - arm.dot(normal) * normal).norm() <= kRound * arm.norm();
}

template <int Dim, bool Cell>
std::unique_ptr<ContactSweeps<Dim>> make_sweeps(BodyMotion<Dim>& bodies,
                                                std::vector<StepContact<Dim>>& contacts, int threads,
                                                InstructionSet instructions) {
  const std::vector<bool> moving = moving_bodies(bodies);
  std::vector<int> chosen;
  bool round = true;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const StepContact<Dim>& c = contacts[k];
    if (!moving[c.i] && !moving[c.j] && bodies.inverse_stretch_mass.cwiseProduct(c.branch).isZero(0.0))
      continue;
    chosen.push_back(static_cast<int>(k));
    const Vec<Dim> normal = c.frame.col(0);
    round = round && is_round(bodies, c.i, c.arm_i, normal) && is_round(bodies, c.j, c.arm_j, normal);
  }
  ContactColours colours = colour_contacts(moving, contacts, chosen);
  if (round)
    return std::make_unique<TeamSweeps<RoundGroup<Dim, Cell>>>(bodies, contacts, moving, std::move(colours),
                                                               threads, instructions);
  return std::make_unique<TeamSweeps<CoupledGroup<Dim, Cell>>>(bodies, contacts, moving, std::move(colours),
                                                               threads, instructions);
}

}  // namespace

template <int Dim>
GaussSeidel<Dim>::GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int threads,
                              InstructionSet instructions)
    : sweeps_(bodies.inverse_stretch_mass.isZero(0.0)
                  ? make_sweeps<Dim, false>(bodies, contacts, threads, instructions)
                  : make_sweeps<Dim, true>(bodies, contacts, threads, instructions)) {}

template <int Dim>
GaussSeidel<Dim>::~GaussSeidel() = default;

template <int Dim>
SweepResult GaussSeidel<Dim>::solve(double tolerance, int max_sweeps, int check_every) {
  return sweeps_->solve(tolerance, max_sweeps, check_every);
}

template <int Dim>
int GaussSeidel<Dim>::n_colours() const {
  return sweeps_->n_colours();
}

template <int Dim>
double GaussSeidel<Dim>::residual() const {
  return sweeps_->residual();
}

template class GaussSeidel<2>;
template class GaussSeidel<3>;

}  // namespace floc
