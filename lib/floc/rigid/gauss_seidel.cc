#include "floc/rigid/gauss_seidel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "floc/geometry/frame.h"

namespace floc {

template <int Dim>
GaussSeidel<Dim>::GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int)
    : bodies_(bodies), contacts_(contacts) {
  const auto side = [&](int body, double sign, const Vec<Dim>& arm, const Mat<Dim>& frame) {
    Side out{.body = body, .sign = sign, .turn = {}, .moment = {}};
    for (int a = 0; a < Dim; ++a) out.moment.col(a) = sign * moment<double>(arm, Vec<Dim>(frame.col(a)));
    out.turn = bodies_.inverse_inertia[body] * out.moment;
    return out;
  };
  for (int k = 0; k < static_cast<int>(contacts.size()); ++k) {
    const StepContact<Dim>& c = contacts[k];
    Block& block = blocks_.emplace_back();
    block.contact = k;
    block.on_i = side(c.i, -1.0, c.arm_i, c.frame);
    block.on_j = side(c.j, 1.0, c.arm_j, c.frame);
    block.response =
        c.frame.transpose() * (bodies_.inverse_mass[c.i] + bodies_.inverse_mass[c.j]).asDiagonal() * c.frame;
    block.strain = c.frame.transpose() * c.branch.asDiagonal();
    block.response += block.strain * bodies_.inverse_stretch_mass.asDiagonal() * block.strain.transpose();
    for (const Side* one : {&block.on_i, &block.on_j}) block.response += one->moment.transpose() * one->turn;
    block.response(0, 0) += c.normal_compliance;
    for (int a = 1; a < Dim; ++a) block.response(a, a) += c.tangential_compliance;
    apply(block, c.impulse - c.adhesion * Vec<Dim>::Unit(0));
  }
  colour();
}

template <int Dim>
void GaussSeidel<Dim>::colour() {
  // Greedy, in the order of the list: the smallest colour that no earlier contact of the two bodies has.
  std::vector<std::uint64_t> taken(bodies_.size(), 0);
  std::vector<int> colour(blocks_.size());
  int n_colours = 0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    std::uint64_t used = 0;
    for (const int body : {blocks_[k].on_i.body, blocks_[k].on_j.body})
      if (!bodies_.inverse_mass[body].isZero(0.0)) used |= taken[body];
    // Contacts beyond 64 colours share the last one, whose contacts are solved one after the other.
    int chosen = 0;
    while (chosen < 63 && (used >> chosen & 1u)) ++chosen;
    colour[k] = chosen;
    n_colours = std::max(n_colours, chosen + 1);
    for (const int body : {blocks_[k].on_i.body, blocks_[k].on_j.body})
      if (!bodies_.inverse_mass[body].isZero(0.0)) taken[body] |= std::uint64_t{1} << chosen;
  }
  std::vector<Block> ordered;
  ordered.reserve(blocks_.size());
  colour_start_.assign(1, 0);
  for (int c = 0; c < n_colours; ++c) {
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      if (colour[k] == c) ordered.push_back(blocks_[k]);
    colour_start_.push_back(static_cast<int>(ordered.size()));
  }
  blocks_ = std::move(ordered);
}

template <int Dim>
Vec<Dim> GaussSeidel<Dim>::relative_velocity(const Block& block) const {
  const Vec<Dim> translation = bodies_.velocity[block.on_j.body] - bodies_.velocity[block.on_i.body];
  Vec<Dim> out = contacts_[block.contact].frame.transpose() * translation + block.strain * bodies_.stretch;
  for (const Side* side : {&block.on_i, &block.on_j})
    out += side->moment.transpose() * bodies_.angular_velocity[side->body];
  return out;
}

template <int Dim>
void GaussSeidel<Dim>::apply(const Block& block, const Vec<Dim>& impulse) {
  const Vec<Dim> in_space = contacts_[block.contact].frame * impulse;
  bodies_.stretch += bodies_.inverse_stretch_mass.cwiseProduct(block.strain.transpose() * impulse);
  for (const Side* side : {&block.on_i, &block.on_j}) {
    bodies_.velocity[side->body] += side->sign * bodies_.inverse_mass[side->body].cwiseProduct(in_space);
    bodies_.angular_velocity[side->body] += side->turn * impulse;
  }
}

template <int Dim>
ContactProblem<Dim> GaussSeidel<Dim>::problem(const Block& block) const {
  const StepContact<Dim>& c = contacts_[block.contact];
  // The present velocity contains the present impulse with its compliance: it is taken out.
  Vec<Dim> compliance = Vec<Dim>::Constant(c.tangential_compliance);
  compliance[0] = c.normal_compliance;
  const Vec<Dim> velocity =
      relative_velocity(block) + c.bias + compliance.cwiseProduct(c.impulse) - block.response * c.impulse;
  return {block.response, velocity, c.friction};
}

template <int Dim>
SweepResult GaussSeidel<Dim>::solve(double tolerance, int max_sweeps, int check_every) {
  SweepResult out;
  while (true) {
    if (out.n_sweeps % check_every == 0 || out.n_sweeps == max_sweeps) {
      out.residual = residual();
      out.converged = out.residual < tolerance;
      if (out.converged || out.n_sweeps == max_sweeps) return out;
    }
    for (const Block& block : blocks_) {
      Vec<Dim>& impulse = contacts_[block.contact].impulse;
      const Vec<Dim> solved = contact_impulse(problem(block));
      apply(block, solved - impulse);
      impulse = solved;
    }
    ++out.n_sweeps;
  }
}

template <int Dim>
double GaussSeidel<Dim>::residual() const {
  double worst = 0.0, sum = 0.0;
  for (const Block& block : blocks_) {
    const Vec<Dim>& impulse = contacts_[block.contact].impulse;
    worst = std::max(worst, contact_error(problem(block), impulse));
    sum += impulse[0];
  }
  return sum > 0.0 ? worst * static_cast<double>(blocks_.size()) / sum : worst;
}

template class GaussSeidel<2>;
template class GaussSeidel<3>;

}  // namespace floc
