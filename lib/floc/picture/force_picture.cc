#include "floc/picture/force_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/network/components.h"
#include "floc/network/rattlers.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/require_periodic.h"
#include "floc/packing/wall_forces.h"
#include "floc/structure/contact_statistics.h"
#include "floc/structure/particle_stress.h"

namespace floc {
namespace {

/// Unit in which the forces in a picture are expressed: the magnitude of the unit (force), and the symbol of the unit
/// in the legend.
struct UnitForce {
  double size;
  const char* name;
};

template <int Dim>
UnitForce unit_force_of(const Packing<Dim>& packing) {
  if (const double F0 = pull_off_force(packing); F0 > 0.0) return {F0, "F₀"};
  double sum = 0.0;
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts)
    if (c.normal_force > 0.0) sum += c.normal_force, ++n;
  return {n == 0 ? 1.0 : sum / n, "⟨F⟩"};
}

template <int Dim>
LineKind kind_of(const Contact<Dim>& c, double zero_force) {
  if (c.distant) return LineKind::distant;
  if (std::abs(c.normal_force) <= zero_force) return LineKind::zero;
  return c.normal_force > 0.0 ? LineKind::compression : LineKind::tension;
}

template <int Dim>
double size_of_force(const Contact<Dim>& c, const UnitForce& unit) {
  return std::hypot(c.normal_force, c.shear_force.norm()) / unit.size;
}

/// Returns the sign of the pressure of each grain: 1 or -1. The sign is 0 for rattlers, and for grains whose pressure
/// is at most zero_force/a^(Dim-1) in magnitude, where a is the largest diameter.
template <int Dim>
std::vector<int> signs_of(const Packing<Dim>& packing, const std::vector<bool>& rattler, double zero_force) {
  std::vector<int> sign;
  for (const double p : pressure_beyond_zero(packing, particle_pressure(packing), rattler, zero_force))
    sign.push_back(p == 0.0 ? 0 : p > 0.0 ? 1 : -1);
  return sign;
}

/// Sets `shade` to `value` for the grains of the largest cluster. A cluster consists of grains that are connected by
/// the contacts marked in `active`.
template <int Dim>
void mark_largest(const ContactNetwork<Dim>& network, const Adjacency& of, const std::vector<bool>& active,
                  double value, std::vector<double>& shade) {
  std::vector<int> largest;
  for (Component<Dim>& part : find_components(network, of, active))
    if (part.grains.size() > largest.size()) largest = std::move(part.grains);
  for (const int i : largest) shade[i] = value;
}

LineKind line_of_kind(ContactType kind) {
  return kind == ContactType::kFaceFace ? LineKind::tension
         : kind == ContactType::kDouble ? LineKind::distant
                                        : LineKind::compression;
}

/// Returns the kind of a contact between a grain and a wall: the part of the grain that touches the wall is a vertex,
/// an edge or a face. The kind follows from the number of contact points with a force.
template <int Dim>
ContactType kind_on_wall(const Packing<Dim>& packing, const Contact<Dim>& contact, double zero_force) {
  const auto of_grain = std::ranges::equal_range(packing.contacts, contact.i, {}, &Contact<Dim>::i);
  const auto n = std::ranges::count_if(of_grain, [&](const Contact<Dim>& c) {
    return c.j == contact.j && std::abs(c.normal_force) > zero_force;
  });
  if (n >= Dim) return ContactType::kFaceFace;
  return n == 2 ? ContactType::kDouble : ContactType::kVertexFace;
}

}  // namespace

template <int Dim>
PackingPicture<Dim> equilibrium_forces(const Packing<Dim>& given, double zero_force) {
  const Packing<Dim> packing = with_walls_at_cell(given);
  PackingPicture<Dim> picture = grains_of(packing);
  const UnitForce unit = unit_force_of(packing);
  picture.rattler = find_rattlers(packing, zero_force);
  picture.force_unit = unit.name;
  for (const Contact<Dim>& c : packing.contacts)
    picture.lines.push_back(contact_line(packing, c, kind_of(c, zero_force), size_of_force(c, unit)));
  return picture;
}

template <int Dim>
PackingPicture<Dim> contact_kinds_of(const Packing<Dim>& given, double zero_force) {
  if (given.grains.are_round())
    throw InputError("--forces kinds",
                     "the grains are disks or spheres, whose contacts are all of one kind: expected grains "
                     "with corners");
  const Packing<Dim> packing = with_walls_at_cell(given);
  PackingPicture<Dim> picture = grains_of(packing);
  const UnitForce unit = unit_force_of(packing);
  picture.force_unit = unit.name;
  picture.compression_name = Dim == 2 ? "vertex and side" : "vertex and face, or two edges";
  picture.distant_name = "edge and face";
  picture.tension_name = Dim == 2 ? "two sides" : "two faces";
  picture.rattler = find_rattlers(packing, zero_force);
  CarryingStructure carrying;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    if (!packing.is_wall(packing.contacts[k].j) && std::abs(packing.contacts[k].normal_force) > zero_force)
      carrying.contacts.push_back(static_cast<int>(k));
  std::size_t next = 0;
  for (const ContactPair& pair : contact_pairs(packing, carrying))
    for (int k = 0; k < pair.n_points; ++k) {
      const Contact<Dim>& c = packing.contacts[carrying.contacts[next++]];
      picture.lines.push_back(contact_line(packing, c, line_of_kind(pair.kind), size_of_force(c, unit)));
    }
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j) && std::abs(c.normal_force) > zero_force)
      picture.lines.push_back(
          contact_line(packing, c, line_of_kind(kind_on_wall(packing, c, zero_force)), size_of_force(c, unit)));
  return picture;
}

template <int Dim>
PackingPicture<Dim> pressure_phases_of(const Packing<Dim>& packing, double zero_force) {
  require_periodic(packing, "phases are drawn");
  constexpr double kPale = 0.4;
  PackingPicture<Dim> picture = grains_of(packing);
  const UnitForce unit = unit_force_of(packing);
  picture.force_unit = unit.name;
  picture.compression_name = "bond of two grains under pressure";
  picture.tension_name = "bond of two grains under tension";
  picture.shade.name = "sign of the pressure of a grain, pale outside the largest cluster,";
  picture.rattler = find_rattlers(packing, zero_force);
  const std::vector<int> sign = signs_of(packing, picture.rattler, zero_force);
  for (const int s : sign) picture.shade.value.push_back(kPale * s);
  const ContactNetwork<Dim> network = contact_network(packing);
  const Adjacency of = contacts_of_grains(network);
  for (const int phase : {1, -1}) {
    const LineKind kind = phase > 0 ? LineKind::compression : LineKind::tension;
    std::vector<bool> active;
    for (const Contact<Dim>& c : packing.contacts) {
      active.push_back(sign[c.i] == phase && sign[c.j] == phase);
      if (active.back()) picture.lines.push_back(contact_line(packing, c, kind, size_of_force(c, unit)));
    }
    mark_largest(network, of, active, phase, picture.shade.value);
  }
  return picture;
}

template <int Dim>
PackingPicture<Dim> increment_forces(const Packing<Dim>& given, const ContactNetwork<Dim>& network,
                                     const StepResponse<Dim>& step) {
  const Packing<Dim> packing = with_walls_at_cell(given);
  PackingPicture<Dim> picture = grains_of(packing);
  const double largest = packing.grains.size() == 0 ? 1.0 : largest_diameter(picture.radius);
  const double unit = std::pow(largest, Dim - 1);
  picture.force_unit = Dim == 2 ? "a δP" : "a² δP";
  picture.force_symbol = "δF";
  picture.compression_name = "force grows";
  picture.tension_name = "force falls";
  picture.note = fmt::format("in colour: {:.0f} % of the contacts, with 95 % of the elastic energy",
                             100.0 * step.energy_share_95);
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const ForceIncrement<Dim>& f = step.increments[k];
    const LineKind kind = step.rank[k] >= step.n_holding ? LineKind::background
                          : f.normal >= 0.0              ? LineKind::compression
                                                         : LineKind::tension;
    picture.lines.push_back(contact_line(packing, packing.contacts[network.contacts[k].source], kind,
                                         std::hypot(f.normal, f.shear.norm()) / unit));
  }
  return picture;
}

template PackingPicture<2> equilibrium_forces(const Packing<2>&, double);
template PackingPicture<3> equilibrium_forces(const Packing<3>&, double);
template PackingPicture<2> contact_kinds_of(const Packing<2>&, double);
template PackingPicture<3> contact_kinds_of(const Packing<3>&, double);
template PackingPicture<2> pressure_phases_of(const Packing<2>&, double);
template PackingPicture<3> pressure_phases_of(const Packing<3>&, double);
template PackingPicture<2> increment_forces(const Packing<2>&, const ContactNetwork<2>&,
                                            const StepResponse<2>&);
template PackingPicture<3> increment_forces(const Packing<3>&, const ContactNetwork<3>&,
                                            const StepResponse<3>&);

}  // namespace floc
