#include "floc/structure/energy_account.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "floc/neighbors/interacting_pairs.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/neighbors/unlisted_pairs.h"
#include "floc/packing/balance.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_energy.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/law_response.h"
#include "floc/packing/locate.h"
#include "floc/packing/require_periodic.h"
#include "floc/structure/contact_changes.h"

namespace floc {
namespace {

/// Returns the energy stored in the contacts of a packing, including the energy of attraction (energy).
template <int Dim>
double elastic_energy_of(const Packing<Dim>& packing) {
  return contact_energy(packing).all();
}

template <int Dim>
double kinetic_energy_of(const Packing<Dim>& packing) {
  return mean_kinetic_energy(packing) * packing.grains.size();
}

/// Returns the sum of the tensors m v v over the grains, where m is the mass and v the velocity of a grain.
template <int Dim>
Mat<Dim> momentum_flux(const Grains<Dim>& g) {
  Mat<Dim> sum = Mat<Dim>::Zero();
  for (int i = 0; i < g.size(); ++i) sum += g.mass[i] * g.velocity[i] * g.velocity[i].transpose();
  return sum;
}

/// Relative motion of the two surfaces of a contact in a time step, evaluated at the middle of the step.
template <int Dim>
struct StepMotion {
  Vec<Dim> branch;  ///< branch vector at the end of the step (length)
  Vec<Dim> normal_before, normal, middle;
  double opening;   ///< increase of the gap in the step (length)
  Shear<Dim> slip;  ///< slip in the step, in the tangential frame at the end of the step (length)
  RotationVector<Dim> rolling;
  double twisting = 0.0;
  double twist = 0.0;  ///< mean rotation of the two grains about the normal in the step (radians)

  StepMotion(const ContactGeometry<Dim>& before, const ContactGeometry<Dim>& after,
             const RotationVector<Dim>& rotation_i, const RotationVector<Dim>& rotation_j)
      : branch(after.branch),
        normal_before(before.normal),
        normal(after.normal),
        middle((before.branch + after.branch).normalized()),
        opening(after.branch.norm() - before.branch.norm()) {
    const Vec<Dim> arm_i = 0.5 * (before.arm_i + after.arm_i), arm_j = 0.5 * (before.arm_j + after.arm_j);
    const RotationVector<Dim> against = rotation_i - rotation_j;
    const Vec<Dim> moved =
        after.branch - before.branch - cross<double>(rotation_i, arm_i) + cross<double>(rotation_j, arm_j);
    rolling = rolling_part<double>(middle, against);
    if constexpr (Dim == 2) {
      slip = to_shear<double>(middle, moved);
    } else {
      slip = to_shear<double>(normal, Vec<3>(to_shear<double>(middle, moved)));
      twisting = middle.dot(against);
      twist = 0.5 * middle.dot(rotation_i + rotation_j);
    }
  }

  /// Converts a tangential force from the frame at the beginning of the step to the frame at the end of the step.
  Shear<Dim> carried(const Shear<Dim>& force) const {
    return transport<double>(force, normal_before, normal, twist);
  }
};

/// Returns the energy that a spring dissipates in a step: the energy stored before the step, plus the work that
/// `motion` does on the spring, minus the energy stored after the step.
template <class V>
double spring_loss(const V& before, double stiffness_before, const V& after, double stiffness_after,
                   const V& motion) {
  return spring_energy(before.squaredNorm(), stiffness_before) -
         spring_energy(after.squaredNorm(), stiffness_after) + 0.5 * (before + after).dot(motion);
}

/// Adds the energy that the springs of a contact dissipate in a step.
/// @param before  the contact before the step; a new contact has no forces before the step
template <int Dim>
void add_spring_losses(const Contact<Dim>& before, const Contact<Dim>& after, const StepMotion<Dim>& motion,
                       EnergyTerms& terms) {
  const Shear<Dim> start = motion.carried(to_shear<double>(motion.normal_before, before.shear_force));
  // If the tangential stiffness falls, the tangential force falls in proportion. If the stiffness grows, the force does
  // not change.
  const double ratio = before.kt > after.kt ? after.kt / before.kt : 1.0;
  const Shear<Dim> scaled = ratio * start, none = Shear<Dim>::Zero();
  terms.scaling += spring_loss<Shear<Dim>>(start, before.kt, scaled, after.kt, none) +
                   0.5 * (start - scaled).dot(motion.slip);
  terms.sliding += spring_loss<Shear<Dim>>(scaled, after.kt, to_shear<double>(motion.normal, after.shear_force),
                                           after.kt, motion.slip);
  // The contact stores the moments on grain i. A positive rotation of grain i relative to grain j causes positive
  // moments on grain j, and therefore negative moments on grain i. Hence the minus signs.
  terms.sliding += spring_loss<RotationVector<Dim>>(motion.carried(-before.rolling_moment), before.kr,
                                                    -after.rolling_moment, after.kr, motion.rolling);
  terms.sliding += spring_loss<Vec<1>>(Vec<1>(-before.twisting_moment), before.ktw,
                                       Vec<1>(-after.twisting_moment), after.ktw, Vec<1>(motion.twisting));
}

/// Returns the force of the dashpot of a contact in the middle of a step (force).
template <int Dim>
double viscous_force(const AnyContactLaw& any, const Grains<Dim>& grains, const Contact<Dim>& c,
                     double gap_rate) {
  return std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (Law::kHasDamping) {
          const double coefficient =
              law.damping_coefficient(CollisionMass::between(grains.mass[c.i], grains.mass[c.j]));
          const PairGeometry<> pair = pair_geometry(grains, c);
          const auto history = packed_history<Law, Dim>(c.history);
          return law.damping.force(coefficient, law.template normal_of<Dim>(pair, history), gap_rate);
        }
        return 0.0;
      },
      any);
}

template <class Law, int Dim>
double attraction_energy(const Law& law, const Packing<Dim>& packing, const Contact<Dim>& c) {
  return law.template attraction_energy_of<Dim>(pair_geometry(packing.grains, c),
                                                packed_history<Law, Dim>(c.history),
                                                acting_parameters(law, packing.grains, c));
}

/// Returns the change of the elastic energy in a step due to changes of the volumes of liquid bridges. The change is
/// computed with the grain positions at the end of the step. Volumes change when liquid is distributed anew, flows into
/// new bridges, or leaves bridges that are no longer in the contact list.
template <int Dim>
double energy_of_liquid(const Packing<Dim>& before, const Packing<Dim>& after,
                        const ContactChanges<Dim>& changes) {
  std::vector<Contact<Dim>> old;
  for (Contact<Dim> c : before.contacts) {
    if (bridge_volume(before, c) == 0.0) continue;
    c.image += changes.wrapped[c.i] - changes.wrapped[c.j];
    old.push_back(canonical(c));
  }
  std::sort(old.begin(), old.end(), precedes<Contact<Dim>>);
  std::vector<bool> is_kept(old.size(), false);
  return std::visit(
      [&](const auto& law) {
        double sum = 0.0;
        for (Contact<Dim> c : after.contacts) {
          const double volume = bridge_volume(after, c);
          const Contact<Dim> name = canonical(c);
          const auto place = std::lower_bound(old.begin(), old.end(), name, precedes<Contact<Dim>>);
          const bool found = place != old.end() && !precedes(name, *place);
          if (found) is_kept[static_cast<std::size_t>(place - old.begin())] = true;
          const double volume_before = found ? bridge_volume(before, *place) : 0.0;
          if (volume == volume_before) continue;
          sum += attraction_energy(law, after, c);
          set_bridge_volume(volume_before, c);
          sum -= attraction_energy(law, after, c);
        }
        for (std::size_t k = 0; k < old.size(); ++k) {
          if (is_kept[k]) continue;
          Contact<Dim> c = old[k];
          place(locate(after, c), c);
          sum -= attraction_energy(law, after, c);
        }
        return sum;
      },
      compose_law(after.law));
}

/// Energy balance of one time step of a packing.
template <int Dim>
class Step {
 public:
  Step(const Packing<Dim>& before, const Packing<Dim>& after, double time_step)
      : before_(before),
        after_(after),
        time_step_(time_step),
        changes_(contact_changes(before, after)),
        law_(compose_law(after.law)) {}

  /// Adds the work of the boundary on the packing, and the energy dissipated by all contacts that touch at the
  /// beginning or at the end of the step.
  void add_to(EnergyTerms& terms) {
    for (const KeptContact& kept : changes_.kept)
      add_contact(before_.contacts[kept.before], after_.contacts[kept.after], terms);
    for (const int k : changes_.gained) add_contact(Contact<Dim>(), after_.contacts[k], terms);
    for (const int k : changes_.lost) {
      const Contact<Dim>& c = before_.contacts[k];
      if (after_.law.keeps_overlap()) terms.hysteresis += normal_energy(before_, c);
      (after_.law.friction_follows_load() ? terms.scaling : terms.sliding) +=
          spring_energy(c.shear_force.squaredNorm(), c.kt);
      terms.sliding += spring_energy(c.rolling_moment.squaredNorm(), c.kr) +
                       spring_energy(c.twisting_moment * c.twisting_moment, c.ktw);
    }
    terms.work += work();
    if (holds_liquid(after_)) terms.liquid += energy_of_liquid(before_, after_, changes_);
  }

 private:
  void add_contact(const Contact<Dim>& before, const Contact<Dim>& after, EnergyTerms& terms) {
    const StepMotion<Dim> motion(locate(before_, named_as_before(after)), locate(after_, after),
                                 rotation(after.i), rotation(after.j));
    add_spring_losses(before, after, motion, terms);
    if (after_.law.keeps_overlap())
      terms.hysteresis += normal_energy(before_, before) - normal_energy(after_, after) -
                          0.5 * (force_of_normal_law(before) + force_of_normal_law(after)) * motion.opening;
    const double force = viscous_force(law_, after_.grains, after, motion.opening / time_step_);
    terms.viscous -= force * motion.opening;
    viscous_virial_ += force * motion.normal * motion.branch.transpose();
  }

  /// Returns the energy that the normal part of the contact law stores in a contact; 0 for a contact that does not
  /// exist yet or no longer exists.
  static double normal_energy(const Packing<Dim>& packing, const Contact<Dim>& c) {
    if (c.normal.isZero(0.0)) return 0.0;
    const ContactEnergy energy = contact_energy(packing, c);
    return packing.law.adheres_by_itself() ? energy.normal + energy.attraction : energy.normal;
  }
  /// Returns the normal force (force) whose work is stored as normal_energy().
  double force_of_normal_law(const Contact<Dim>& c) const {
    return after_.law.adheres_by_itself() ? c.normal_force : c.elastic_force;
  }

  /// Returns a contact at the end of the step, but with the periodic image from the beginning of the step. The image
  /// changes during the step if a grain is moved back into the cell.
  Contact<Dim> named_as_before(Contact<Dim> after) const {
    after.image += changes_.wrapped[after.j] - changes_.wrapped[after.i];
    return after;
  }

  RotationVector<Dim> rotation(int i) const {
    return 0.5 * time_step_ * (before_.grains.angular_velocity[i] + after_.grains.angular_velocity[i]);
  }

  /// Returns the work of the boundary on the packing: minus the virial times the strain increment, both at the
  /// middle of the step.
  double work() const {
    Mat<Dim> virial = viscous_virial_;
    for (const Packing<Dim>* end : {&before_, &after_})
      virial += 0.5 * (static_stress(*end) * end->cell.volume() + momentum_flux(end->grains));
    const Mat<Dim> middle = 0.5 * (before_.cell.matrix + after_.cell.matrix);
    const Mat<Dim> strain = middle.inverse() * (after_.cell.matrix - before_.cell.matrix);
    return -virial.cwiseProduct(strain.transpose()).sum();
  }

  const Packing<Dim>& before_;
  const Packing<Dim>& after_;
  double time_step_;
  ContactChanges<Dim> changes_;
  AnyContactLaw law_;
  Mat<Dim> viscous_virial_ = Mat<Dim>::Zero();
};

}  // namespace

template <int Dim>
EnergyAccount<Dim>::EnergyAccount(Packing<Dim> start) : previous_(std::move(start)) {
  require_periodic(previous_, "the energy account is kept");
  terms_.elastic = elastic_energy_of(previous_);
  terms_.kinetic = kinetic_energy_of(previous_);
  terms_.initial = terms_.elastic + terms_.kinetic;
}

template <int Dim>
void EnergyAccount<Dim>::advance(const Packing<Dim>& now, double time_step) {
  const double error_before = terms_.error(), kinetic_before = terms_.kinetic;
  Step<Dim>(previous_, now, time_step).add_to(terms_);
  terms_.elastic = elastic_energy_of(now);
  terms_.kinetic = kinetic_energy_of(now);
  // If all velocities have been set to zero in this step, the error of the energy balance changes by the energy that
  // was removed.
  if (terms_.kinetic == 0.0 && kinetic_before > 0.0) terms_.removed += terms_.error() - error_before;
  previous_ = now;
}

template <int Dim>
void EnergyAccount<Dim>::change_law(const Law& law) {
  previous_.law = law;
  // If the contact law changes, the forces of the springs remain the same. Pairs that interact only in the new law are
  // added to the contact list.
  const std::vector<Contact<Dim>> added = unlisted_pairs(previous_, interacting_pairs(previous_));
  previous_.contacts.insert(previous_.contacts.end(), added.begin(), added.end());
  std::sort(previous_.contacts.begin(), previous_.contacts.end(), precedes<Contact<Dim>>);
  refresh_contacts(previous_);
  const double with_law = elastic_energy_of(previous_);
  spread_liquid(previous_);
  const double with_liquid = elastic_energy_of(previous_);
  terms_.law += with_law - terms_.elastic;
  terms_.liquid += with_liquid - with_law;
  terms_.elastic = with_liquid;
}

template class EnergyAccount<2>;
template class EnergyAccount<3>;

}  // namespace floc
