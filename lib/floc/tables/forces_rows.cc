#include "floc/tables/forces_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "floc/base/error.h"
#include "floc/base/seconds_since.h"
#include "floc/network/rigidity_matrix.h"
#include "floc/packing/body_name.h"
#include "floc/rigid/near_contacts.h"
#include "floc/rigid/static_forces.h"

namespace floc {
namespace {

/// Tolerance for contact forces, in units of the mean normal force. A force below the tolerance counts as zero. The
/// friction of a contact counts as mobilised if the tangential force differs from its limit by less than the tolerance.
/// The errors of balanced forces are smaller than the tolerance by a few orders of magnitude.
constexpr double kNothing = 1e-6;
/// Time (s). If computing the ranges of all forces is predicted to take longer, a remark gives the predicted time.
constexpr double kLongSeconds = 2.0;

const char* name_of(ForceSelection selection) {
  return selection == ForceSelection::kClosest ? "closest" : "canonical";
}

template <int Dim>
std::optional<Mat<Dim>> stress_of(const std::vector<double>& components) {
  if (components.empty()) return std::nullopt;
  const int n = static_cast<int>(components.size());
  if (n != 1 && n != Dim && n != kSymmetric<Dim>)
    throw InputError("stress", fmt::format("there are {} components: expected the pressure, {} components "
                                           "along the axes, or {} components in Voigt order",
                                           n, Dim, kSymmetric<Dim>));
  if (n == 1) return Mat<Dim>(components[0] * Mat<Dim>::Identity());
  Mat<Dim> stress = Mat<Dim>::Zero();
  for (int s = 0; s < n; ++s) {
    // The matrix unit_strain() has two entries 1/2 for a shear component. A unit stress has two entries 1 instead.
    const Mat<Dim> unit = unit_strain<Dim>(s);
    stress += components[s] * (s < Dim ? unit : Mat<Dim>(2.0 * unit));
  }
  return stress;
}

double mean_magnitude(const std::vector<double>& forces) {
  double sum = 0.0;
  for (const double f : forces) sum += std::abs(f);
  return forces.empty() ? 0.0 : sum / static_cast<double>(forces.size());
}

/// Counts the contacts that carry a force, and the contacts whose friction is at its limit.
template <int Dim>
void count_contacts(const BalancedForces<Dim>& forces, ForcesRow& row) {
  const double nothing = kNothing * mean_magnitude(forces.normal_force);
  double sum = 0.0;
  int mobilised = 0;
  for (std::size_t k = 0; k < forces.normal_force.size(); ++k) {
    const double normal = forces.normal_force[k], shear = forces.shear_force[k].norm();
    if (std::abs(normal) <= nothing && shear <= nothing) continue;
    ++row.n_carrying;
    sum += normal;
    if (shear >= forces.friction_limit[k] - nothing) ++mobilised;
  }
  if (row.n_carrying == 0) return;
  row.mean_normal_force = sum / row.n_carrying;
  row.mobilised = static_cast<double>(mobilised) / row.n_carrying;
}

/// Returns the range of the normal force of each contact; absent for contacts that the options do not select.
template <int Dim>
std::vector<std::optional<ForceRange>> ranges_of(const std::string& file, StaticForces<Dim>& forces,
                                                 int n_contacts, const ForcesTableOptions& options,
                                                 const Remarks& remarks) {
  std::vector<std::optional<ForceRange>> out(n_contacts);
  if (!options.ranges) return out;
  std::vector<int> chosen = options.range_of;
  for (const int k : chosen)
    if (k < 0 || k >= n_contacts)
      throw InputError(
          file,
          fmt::format("contact {}: this state has no contact with this number: expected a number from 0 to {}",
                      k, n_contacts - 1));
  if (chosen.empty())
    for (int k = 0; k < n_contacts; ++k) chosen.push_back(k);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    out[chosen[n]] = forces.range(chosen[n]);
    // The time for all ranges is predicted from the time that the first ranges took.
    const double seconds = seconds_since(start);
    const std::size_t sample = std::min<std::size_t>(5, chosen.size());
    if (n + 1 == sample &&
        seconds / static_cast<double>(sample) * static_cast<double>(chosen.size()) > kLongSeconds)
      remarks.remark(
          file, fmt::format(
                    "the smallest and largest forces of {} contacts will take about {:.0f} s to compute",
                    chosen.size(), seconds / static_cast<double>(sample) * static_cast<double>(chosen.size())));
  }
  return out;
}

/// Adds a row with the forces of each contact to a table that `floc convert --contacts` can read.
template <int Dim>
void add_contacts(const std::string& file, const Packing<Dim>& packing, const BalancedForces<Dim>& forces,
                  const std::vector<std::optional<ForceRange>>& ranges, bool with_ranges, Table& table) {
  std::vector<std::string> names{"file", "contact", "id1", "id2"};
  for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("image{}", a));
  names.emplace_back("gap");
  names.emplace_back("normal_force");
  for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("shear_force{}", a));
  if (with_ranges) names.insert(names.end(), {"smallest_normal_force", "largest_normal_force"});
  expect_columns(file, names, table);
  const BodyNumbers<Dim> numbers(packing);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    const Contact<Dim>& c = packing.contacts[k];
    std::vector<TableValue>& row = table.rows.emplace_back();
    row.emplace_back(file);
    row.push_back(count(static_cast<std::int64_t>(k)));
    row.push_back(count(numbers.of(c.i)));
    row.push_back(count(numbers.of(c.j)));
    for (int a = 0; a < Dim; ++a) row.push_back(count(c.image[a]));
    row.emplace_back(c.gap);
    row.emplace_back(forces.normal_force[k]);
    for (int a = 0; a < Dim; ++a) row.emplace_back(forces.shear_force[k][a]);
    if (!with_ranges) continue;
    row.push_back(ranges[k] ? TableValue{ranges[k]->smallest} : TableValue{});
    row.push_back(!ranges[k]                       ? TableValue{}
                  : std::isinf(ranges[k]->largest) ? TableValue{std::string("unbounded")}
                                                   : TableValue{ranges[k]->largest});
  }
}

/// Returns the distance between forces and the canonical forces of the same balance. If rounding errors end the search
/// for the canonical forces, a remark says so and the result is absent.
template <int Dim>
std::optional<double> distance_to_canonical(const std::string& file, StaticForces<Dim>& problem,
                                            const BalancedForces<Dim>& found, const Remarks& remarks) {
  try {
    return force_distance(found, problem.canonical());
  } catch (const NoResult& reason) {
    remarks.remark(file,
                   fmt::format("force_freedom is not known, because the canonical forces were not found: {}",
                               reason.what()));
    return std::nullopt;
  }
}

}  // namespace

ForceSelection force_selection_named(const std::string& name) {
  for (const ForceSelection selection : {ForceSelection::kClosest, ForceSelection::kCanonical})
    if (name == name_of(selection)) return selection;
  throw InputError("forces",
                   fmt::format("\"{}\" selects no forces: expected \"closest\" or \"canonical\"", name));
}

std::vector<std::string> ForcesTableOptions::validate() const {
  std::vector<std::string> faults;
  const auto check = [&faults](const std::string& fault) {
    if (!fault.empty()) faults.push_back(fault);
  };
  if (gap) check(range_fault("gap", *gap, kNearGap));
  for (const int contact : range_of) check(range_fault("range_of", std::int64_t{contact}, kAnyContact));
  if (!range_of.empty() && !ranges) faults.emplace_back("range_of: expected ranges = true");
  return faults;
}

template <int Dim>
ForcesRow forces_row(const std::string& file, const State<Dim>& state, const ForcesTableOptions& options,
                     Table& contacts, const Remarks& remarks) {
  for (const std::string& fault : options.validate()) throw InputError(file, fault);
  Packing<Dim> packing = state.packing;
  if (options.gap) {
    const double smallest = *std::ranges::min_element(packing.grains.radius);
    add_near_contacts(packing, *options.gap * 2.0 * smallest);
  }
  const bool has_forces =
      std::ranges::any_of(packing.contacts, [](const Contact<Dim>& c) { return c.normal_force != 0.0; });
  const ForceSelection selection =
      options.selection.value_or(has_forces ? ForceSelection::kClosest : ForceSelection::kCanonical);
  StaticForces<Dim> problem(file, packing,
                            {.friction = options.friction,
                             .kn = options.kn,
                             .kt = options.kt,
                             .stress = stress_of<Dim>(options.stress),
                             .axis_stress = std::nullopt});
  const bool is_canonical = selection == ForceSelection::kCanonical;
  const BalancedForces<Dim> found = is_canonical ? problem.canonical() : problem.closest();

  ForcesRow row;
  row.file = file;
  row.dimension = Dim;
  row.n_grains = packing.grains.size();
  row.n_contacts = static_cast<int>(packing.contacts.size());
  row.selection = selection;
  row.friction = options.friction.value_or(packing.law.friction_coefficient());
  if (has_forces) {
    const BalancedForces<Dim> present = problem.present();
    row.net_force_before = present.error.force;
    row.moved = force_distance(present, found);
  }
  row.net_force = found.error.force;
  row.net_moment = found.error.moment;
  row.stress_error = found.error.stress;
  row.force_freedom = is_canonical ? 0.0 : distance_to_canonical(file, problem, found, remarks);
  row.n_factorizations = found.n_factorizations;
  count_contacts(found, row);
  if (options.contacts)
    add_contacts(file, packing, found, ranges_of(file, problem, row.n_contacts, options, remarks),
                 options.ranges, contacts);
  return row;
}

std::vector<Column<ForcesRow>> forces_columns() {
  return {{"file", [](const auto& r) { return r.file; }},
          {"dimension", [](const auto& r) { return count(r.dimension); }},
          {"n_grains", [](const auto& r) { return count(r.n_grains); }},
          {"n_contacts", [](const auto& r) { return count(r.n_contacts); }},
          {"n_carrying", [](const auto& r) { return count(r.n_carrying); }},
          {"selection", [](const auto& r) { return std::string(name_of(r.selection)); }},
          {"friction", [](const auto& r) { return r.friction; }},
          {"mean_normal_force", [](const auto& r) { return r.mean_normal_force; }},
          {"mobilised", [](const auto& r) { return r.mobilised; }},
          {"net_force_before", [](const auto& r) { return or_undefined(r.net_force_before); }},
          {"net_force", [](const auto& r) { return r.net_force; }},
          {"net_moment", [](const auto& r) { return r.net_moment; }},
          {"stress_error", [](const auto& r) { return r.stress_error; }},
          {"moved", [](const auto& r) { return or_undefined(r.moved); }},
          {"force_freedom", [](const auto& r) { return or_undefined(r.force_freedom); }},
          {"n_factorizations", [](const auto& r) { return count(r.n_factorizations); }}};
}

template ForcesRow forces_row(const std::string&, const State<2>&, const ForcesTableOptions&, Table&,
                              const Remarks&);
template ForcesRow forces_row(const std::string&, const State<3>&, const ForcesTableOptions&, Table&,
                              const Remarks&);

}  // namespace floc
