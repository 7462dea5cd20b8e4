#include "floc/picture/force_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/network/rattlers.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// A force in which those of a packing are measured, and its name.
struct UnitForce {
  double size;
  const char* name;
};

UnitForce unit_force_of(const Packing<2>& packing) {
  if (packing.law.pull_off_force() > 0.0) return {packing.law.pull_off_force(), "F₀"};
  double sum = 0.0;
  int n = 0;
  for (const Contact<2>& c : packing.contacts)
    if (c.normal_force > 0.0) sum += c.normal_force, ++n;
  return {n == 0 ? 1.0 : sum / n, "⟨F⟩"};
}

LineKind kind_of(const Contact<2>& c, double zero_force) {
  if (c.distant) return LineKind::distant;
  if (std::abs(c.normal_force) <= zero_force) return LineKind::zero;
  return c.normal_force > 0.0 ? LineKind::compression : LineKind::tension;
}

ContactLine line_of(const Packing<2>& packing, const Contact<2>& c, LineKind kind, double force) {
  const Vec<2>& from = packing.grains.position[c.i];
  return {from, from + branch(packing, c), kind, force};
}

}  // namespace

PackingPicture equilibrium_forces(const Packing<2>& packing, double zero_force) {
  PackingPicture picture = grains_of(packing);
  const UnitForce unit = unit_force_of(packing);
  picture.rattler = find_rattlers(packing, zero_force);
  picture.force_unit = unit.name;
  for (const Contact<2>& c : packing.contacts)
    picture.lines.push_back(line_of(packing, c, kind_of(c, zero_force),
                                    std::hypot(c.normal_force, c.shear_force.norm()) / unit.size));
  return picture;
}

PackingPicture increment_forces(const Packing<2>& packing, const ContactNetwork<2>& network,
                                const StepResponse<2>& step) {
  PackingPicture picture = grains_of(packing);
  const double largest = packing.grains.size() == 0 ? 1.0 : largest_diameter(picture.radius);
  picture.force_unit = "a δP";
  picture.force_symbol = "δF";
  picture.compression_name = "force grows";
  picture.tension_name = "force falls";
  picture.note = fmt::format("in colour: {:.0f} % of the contacts, which hold 95 % of the energy",
                             100.0 * step.energy_share_95);
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const ForceIncrement<2>& f = step.increments[k];
    const LineKind kind = step.rank[k] >= step.n_holding ? LineKind::background
                          : f.normal >= 0.0              ? LineKind::compression
                                                         : LineKind::tension;
    picture.lines.push_back(line_of(packing, packing.contacts[network.contacts[k].source], kind,
                                    std::hypot(f.normal, f.shear.norm()) / largest));
  }
  return picture;
}

}  // namespace floc
