#include "floc/elasticity/bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/elasticity/compliance_term.h"
#include "floc/elasticity/isotropic_moduli.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {
namespace {

/// Let P_0 = sum |F_N| r/(Dim V) be the pressure that the normal forces F_N would give if all were compressive
/// (distance r between centres, volume V). If the pressure is below this share of P_0, B_reuss is set to zero: in an
/// equilibrium computed to a tolerance of 1e-8, a smaller pressure cannot be distinguished from zero.
constexpr double kNoPressure = 1e-8;
/// The contact forces count as balanced if two ratios are at most this number: the net force on each grain divided by
/// the largest contact force, and the net force on each pair of walls divided by the sum of the forces on both walls.
/// The number is a hundred times the tolerance of an equilibrium. Net forces up to this limit cause a relative change
/// of the complementary energy of the same order.
constexpr double kBalanced = 1e-3;

struct Sums {
  int n = 0;  // number of touching contacts
  double kn = 0.0;
  double kt = 0.0;
  double force = 0.0;  // sum of the normal forces F_N
  double complementary = 0.0;
  // sum of K_N S over touching contacts, where S is the sum of F^2/K over the springs of the contact
  double scaled = 0.0;
  double virial = 0.0;  // sum of |F_N| r over touching contacts, with the distance r between centres
};

template <int Dim>
Sums sum_over_contacts(const ContactNetwork<Dim>& network) {
  Sums s;
  for (const NetworkContact<Dim>& c : network.contacts) {
    if (c.distant) continue;
    const double terms = compliance_term(c.normal_force * c.normal_force, c.kn) +
                         compliance_term(c.shear_force.squaredNorm(), c.kt) +
                         compliance_term(c.rolling_moment.squaredNorm(), c.kr) +
                         compliance_term(c.twisting_moment * c.twisting_moment, c.ktw);
    ++s.n;
    s.kn += c.kn;
    s.kt += c.kt;
    s.force += c.normal_force;
    s.virial += std::abs(c.normal_force) * c.branch.norm();
    s.complementary += terms;
    s.scaled += c.kn * terms;
  }
  return s;
}

/// Returns the mean-field bulk modulus z Phi K_N <r^2>/(2 Dim^2 <v>), with the coordination number z, the solid
/// fraction Phi, the distance r between the centres of touching grains and the mean volume <v> of a grain. In the Voigt
/// form, <r^2> = (<d^2> + <d>^2)/2, as if the diameters d of touching grains were independent. In the Reuss form, <r^2>
/// is replaced by <d>^2.
/// @param kn                  mean normal stiffness K_N
/// @param mean_square_branch  <r^2>, or <d>^2 for the Reuss form
/// @param mean_size_power     <d^Dim>
template <int Dim>
double mean_field_bulk(const MeanField& m, double kn, double mean_square_branch, double mean_size_power) {
  const double grain_volume = (Dim == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0) * mean_size_power;
  return 0.5 * m.coordination * m.solid_fraction / grain_volume * kn * mean_square_branch / (Dim * Dim);
}

template <int Dim>
void add_printed_forms(const ContactNetwork<Dim>& network, const MeanField& m, const Sums& s, Bounds& b) {
  double d = 0.0, d2 = 0.0, power = 0.0;
  for (const double radius : network.grain_size) {
    d += 2.0 * radius / network.n_grains;
    d2 += 4.0 * radius * radius / network.n_grains;
    power += std::pow(2.0 * radius, Dim) / network.n_grains;
  }
  const double kn = s.kn / s.n;
  const double ratio = s.kt / s.kn;
  b.Z2 = s.scaled / s.n / std::pow(s.force / s.n, 2);
  b.B_voigt_printed = mean_field_bulk<Dim>(m, kn, 0.5 * (d2 + d * d), power);
  b.G_voigt_printed = b.B_voigt_printed * (Dim == 2 ? (1.0 + ratio) / 2.0 : (6.0 + 9.0 * ratio) / 10.0);
  b.B_reuss_printed = mean_field_bulk<Dim>(m, kn, d * d, power) / b.Z2;
}

/// Returns the force and the moment that a contact carries, as components in the order of the rows of ContactRows:
/// normal force, tangential force, moment about the normal (in 3D), rolling moment.
template <int Dim>
RowStiffness<Dim> row_forces(const NetworkContact<Dim>& c) {
  RowStiffness<Dim> f;
  f[0] = c.normal_force;
  f.template segment<Dim - 1>(1) = c.frame.template rightCols<Dim - 1>().transpose() * c.shear_force;
  RotationVector<Dim> moment = c.rolling_moment;
  if constexpr (Dim == 3) moment += c.twisting_moment * c.normal();
  f.template tail<kRotations<Dim>>() = rotation_axes(c.frame).transpose() * moment;
  return f;
}

/// Returns whether the contact forces balance on every grain and on each pair of opposite walls. The two walls of an
/// axis count as one body, because they may move together. The Reuss bound follows from the principle of minimum
/// complementary energy, which admits only forces that balance.
template <int Dim>
bool forces_balance(const ContactNetwork<Dim>& network) {
  Eigen::VectorXd on_grains = Eigen::VectorXd::Zero(network.n_unknowns());
  Vec<Dim> on_walls = Vec<Dim>::Zero();
  double largest = 0.0, largest_on_walls = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    const RowStiffness<Dim> forces = row_forces(c);
    on_grains.segment<kDofs<Dim>>(first_unknown<Dim>(c.i)) += rows.on_i.transpose() * forces;
    on_grains.segment<kDofs<Dim>>(first_unknown<Dim>(c.j)) += rows.on_j.transpose() * forces;
    on_walls += rows.on_wall.transpose() * forces;
    const double force = std::abs(c.normal_force) + c.shear_force.norm();
    largest = std::max(largest, force);
    if (c.on_wall()) largest_on_walls += std::abs(c.normal_force);
  }
  for (int i = 0; i < network.n_grains; ++i) {
    const auto load = on_grains.segment<kDofs<Dim>>(first_unknown<Dim>(i));
    const double moment = load.template tail<kRotations<Dim>>().norm() / network.grain_size[i];
    if (std::max(load.template head<Dim>().norm(), moment) > kBalanced * largest) return false;
  }
  return std::ranges::all_of(network.wall_axes,
                             [&](int a) { return std::abs(on_walls[a]) <= kBalanced * largest_on_walls; });
}

/// Returns the reason why B_reuss <= B_C <= B_voigt is not guaranteed (see Bounds::fault); empty if it is guaranteed.
template <int Dim>
std::string fault_of_bounds(const ContactNetwork<Dim>& network, double B_reuss) {
  const auto any = [&](auto&& has) { return std::ranges::any_of(network.contacts, has); };
  using Contact = NetworkContact<Dim>;
  if (any([](const Contact& c) { return c.distant; }))
    return "attractions across gaps have a negative stiffness, for which the complementary energy has no "
           "minimum";
  if (any([](const Contact& c) { return std::min({c.kn, c.kt, c.kr, c.ktw}) < 0.0; }))
    return "some contacts have a negative stiffness, for which the complementary energy has no minimum";
  if (B_reuss > 0.0 && !forces_balance(network)) return "the contact forces do not balance";
  return "";
}

}  // namespace

template <int Dim>
Bounds elastic_bounds(const ContactNetwork<Dim>& network, double pressure, const MeanField& mean_field) {
  Bounds b;
  const Eigen::MatrixXd affine = affine_stiffness(network, StrainSet::diagonal) / network.volume;
  b.B_voigt = bulk_modulus(affine);
  b.G_voigt = pure_shear_modulus(affine);
  const Sums s = sum_over_contacts(network);
  const bool loaded = std::abs(pressure) * Dim * network.volume > kNoPressure * s.virial;
  if (loaded && s.complementary > 0.0) b.B_reuss = network.volume * pressure * pressure / s.complementary;
  b.fault = fault_of_bounds(network, b.B_reuss);
  if (s.n > 0) add_printed_forms(network, mean_field, s, b);
  return b;
}

template Bounds elastic_bounds(const ContactNetwork<2>&, double, const MeanField&);
template Bounds elastic_bounds(const ContactNetwork<3>&, double, const MeanField&);

}  // namespace floc
