#include "floc/tradeoff/observables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_observables.h"

namespace floc {
namespace {

using Source = ObservableSource;
using M = StateMeasures;

}  // namespace

const std::array<DeclaredObservable, kObservables>& declared_observables() {
  // The index of an entry is its number in the enumeration Observable, with which other functions find the entry. The
  // entries must therefore have the order of this enumeration.
  static const std::array<DeclaredObservable, kObservables> observables = {{
      {"phi", "1", "solid fraction", Source::state, [](const M& m) { return m.solid_fraction; }},
      {"z_plus", "1", "coordination number of contacts in compression", Source::state,
       [](const M& m) { return m.z_plus; }},
      {"z_minus", "1", "coordination number of contacts in tension", Source::state,
       [](const M& m) { return m.z_minus; }},
      {"B", "stress", "bulk modulus", Source::moduli, [](const M& m) { return m.B; }},
      {"G", "stress", "shear modulus", Source::moduli, [](const M& m) { return m.G; }},
      {"B_reuss", "stress", "lower bound of Reuss on the bulk modulus", Source::moduli,
       [](const M& m) { return m.B_reuss; }},
      {"tail_plus", "F1", "decay force of the exponential tail of the compressive forces", Source::state,
       [](const M& m) { return m.tail_plus; }},
      {"tail_minus", "F1", "decay force of the exponential tail of the tensile forces", Source::state,
       [](const M& m) { return m.tail_minus; }},
      // The consolidation law is fitted to a whole path, so its parameters have no value in a single state.
      {"lambda", "1", "slope of the consolidation law", Source::path, nullptr},
      {"alpha", "1", "exponent with which the consolidation law approaches Phi_max", Source::path, nullptr},
      {"Phi_max", "1", "maximum solid fraction of the consolidation law", Source::path, nullptr},
      {"z", "1", "coordination number", Source::state, [](const M& m) { return m.z; }},
      {"rattlers", "1", "fraction of grains that carry no force", Source::state,
       [](const M& m) { return m.rattlers; }},
      {"Z2", "1", "mean square of the elastic normal forces, divided by the square of the mean", Source::state,
       [](const M& m) { return m.force_moment; }},
      {"mobilised", "1", "mean ratio of tangential to normal force in contacts whose force is above the mean",
       Source::state, [](const M& m) { return m.mobilised; }},
      {"n_wall_contacts", "1", "number of contacts with walls, divided by the number of grains", Source::state,
       [](const M& m) { return m.wall_contacts; }},
      {"lateral_ratio", "1", "ratio of the stress across the driven axis to the stress along it", Source::state,
       [](const M& m) { return m.lateral_ratio; }},
      {"stress_ratio", "1",
       "mobilised friction: (s1 - s2)/(s1 + s2) in 2D, q/p in 3D; in simple shear, shear stress divided by "
       "normal stress",
       Source::state, [](const M& m) { return m.stress_ratio; }},
      {"bridges", "1", "number of liquid bridges, divided by the number of grains", Source::state,
       [](const M& m) { return m.bridges; }},
      {"bridge_volume", "1", "mean volume of a liquid bridge divided by the cube of the largest diameter",
       Source::state, [](const M& m) { return m.bridge_volume; }},
      {"z_pairs", "1", "twice the number of pairs of grains in contact, divided by the number of grains",
       Source::state, [](const M& m) { return m.pairs; }},
      {"indeterminacy", "1", "degree of static indeterminacy of the forces, divided by the number of grains",
       Source::state, [](const M& m) { return m.indeterminacy; }},
      {"force_freedom", "1", "relative distance of the forces from the forces of least elastic energy",
       Source::state, [](const M& m) { return m.force_freedom; }},
      {"K0", "1", "ratio of lateral to axial stress in the first loading of an oedometer test", Source::path,
       nullptr},
      {"M_oedometer", "stress", "constrained modulus in the first loading of an oedometer test", Source::path,
       nullptr},
      {"peak_ratio", "1", "largest mobilised friction of a shear test", Source::path, nullptr},
      {"critical_ratio", "1", "mean mobilised friction over the last quarter of a shear test", Source::path,
       nullptr},
      {"dilatancy", "1", "dilatancy angle at the peak of a shear test (degrees)", Source::path, nullptr},
      {"E_lattice", "stress", "Young's modulus of cemented grains", Source::lattice, nullptr},
      {"spread_nodes", "1", "standard deviation of the stress of all nodes divided by its mean",
       Source::lattice, nullptr},
      {"beta_grain", "1", "decay rate of the exponential tail of the ratio of a stress in grains to the mean",
       Source::lattice, nullptr},
      {"beta_matrix", "1",
       "decay rate of the exponential tail of the ratio of a stress in the matrix to the mean", Source::lattice,
       nullptr},
      {"beta_forces", "1",
       "decay rate of the exponential tail of the ratio of a force between cemented grains to the mean",
       Source::lattice, nullptr},
  }};
  return observables;
}

std::vector<std::string> observable_names() {
  std::vector<std::string> names;
  for (const DeclaredObservable& o : declared_observables()) names.emplace_back(o.name);
  return names;
}

std::string kind_of_study(const Scene& scene, Subject subject) {
  if (subject == Subject::states) return scene_kind(scene);
  return scene.dimension == 2 ? "disks-cemented" : "spheres-cemented";
}

bool applies(const DeclaredObservable& observable, const Scene& scene, Subject subject) {
  const bool is_of_lattice = observable.source == ObservableSource::lattice;
  return is_of_lattice == (subject == Subject::lattice) && has_observable(scene, observable.name);
}

std::vector<std::string> observable_names(const Scene& scene, Subject subject) {
  std::vector<std::string> names;
  for (const DeclaredObservable& o : declared_observables())
    if (applies(o, scene, subject)) names.emplace_back(o.name);
  return names;
}

std::string unit_of(const DeclaredObservable& observable, const Scene& scene) {
  if (observable.unit != std::string("stress")) return observable.unit;
  if (scene.units != "SI") return scene.units;
  return scene.dimension == 2 ? "N/m" : "Pa";
}

void require_observables(const std::vector<std::string>& names, const Scene& scene, Subject subject) {
  const std::vector<std::string> known = observable_names(scene, subject);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(
          "--observables " + name,
          fmt::format("a study of the kind \"{}\" does not have this observable; the most similar name is {}; "
                      "expected one of {}",
                      kind_of_study(scene, subject), nearest_name(name, known), fmt::join(known, ", ")));
}

double size_of(int k, const Observation& x, const Observation& y) {
  const auto size = [](const Observation& o, int of) {
    return of == kZPlus || of == kZMinus ? o[kZPlus] + o[kZMinus] : std::abs(o[static_cast<std::size_t>(of)]);
  };
  return 0.5 * (size(x, k) + size(y, k));
}

}  // namespace floc
