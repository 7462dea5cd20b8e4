#include "floc/rigid/common_factor.h"

#include <algorithm>

#include "floc/geometry/frame.h"

namespace floc {
namespace {

/// Adds the impulse of a contact to the velocities of the bodies and of the cell.
template <int Dim>
void push(const StepContact<Dim>& c, BodyMotion<Dim>& bodies) {
  const Vec<Dim> p = c.frame * c.impulse;
  const auto push_body = [&](int i, const Vec<Dim>& arm, const Vec<Dim>& on_body) {
    bodies.velocity[i] += bodies.inverse_mass[i].cwiseProduct(on_body);
    bodies.angular_velocity[i] += bodies.inverse_inertia[i] * moment<double>(arm, on_body);
  };
  push_body(c.i, c.arm_i, -p);
  push_body(c.j, c.arm_j, p);
  bodies.stretch += bodies.inverse_stretch_mass.cwiseProduct(p.cwiseProduct(c.branch));
}

/// Returns the relative velocity at a contact, in the frame of the contact.
template <int Dim>
Vec<Dim> relative_velocity(const StepContact<Dim>& c, const BodyMotion<Dim>& bodies) {
  const auto of_body = [&](int i, const Vec<Dim>& arm) {
    return Vec<Dim>(bodies.velocity[i] + cross<double>(bodies.angular_velocity[i], arm));
  };
  return c.frame.transpose() *
         (of_body(c.j, c.arm_j) - of_body(c.i, c.arm_i) + bodies.stretch.cwiseProduct(c.branch));
}

}  // namespace

template <int Dim>
double best_common_factor(const BodyMotion<Dim>& bodies, const std::vector<StepContact<Dim>>& contacts) {
  BodyMotion<Dim> changed = bodies;
  std::fill(changed.velocity.begin(), changed.velocity.end(), Vec<Dim>::Zero());
  std::fill(changed.angular_velocity.begin(), changed.angular_velocity.end(), RotationVector<Dim>::Zero());
  changed.stretch.setZero();
  for (const StepContact<Dim>& c : contacts) push<Dim>(c, changed);
  double work = 0.0, twice_energy = 0.0;
  for (const StepContact<Dim>& c : contacts) {
    Vec<Dim> compliance = Vec<Dim>::Constant(c.tangential_compliance);
    compliance[0] = c.normal_compliance;
    const Vec<Dim> change = relative_velocity<Dim>(c, changed);
    // The adhesions a are a part of u_free. As W is symmetric, their part of the work is p' W a = a' W p.
    work += c.impulse.dot(relative_velocity<Dim>(c, bodies) + c.bias) - c.adhesion * change[0];
    twice_energy += c.impulse.dot(change + compliance.cwiseProduct(c.impulse));
  }
  return twice_energy > 0.0 ? std::max(0.0, -work / twice_energy) : 1.0;
}

template double best_common_factor(const BodyMotion<2>&, const std::vector<StepContact<2>>&);
template double best_common_factor(const BodyMotion<3>&, const std::vector<StepContact<3>>&);

}  // namespace floc
