#include "floc/imports/conversion_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "floc/neighbors/nearest_pair.h"
#include "floc/packing/equilibrium_check.h"
#include "floc/verification/contact_check.h"

namespace floc {
namespace {

/// A normal force is reported if it differs from the normal force of the law by more than this fraction of the mean
/// normal force. Smaller differences can be rounding errors, because programs print forces with as few as six digits.
constexpr double kForceTolerance = 1e-6;

void add_list(const ListedContactCounts& listed, int n_kept, ConversionSummary& summary) {
  summary.lines.push_back(
      fmt::format("contacts: {} read, {} kept, {} left out because they have a gap and no force, {} left out "
                  "because they are tensile, {} moved to the nearest image",
                  listed.n_read, n_kept, listed.n_neighbors, listed.n_tensile, listed.n_other_image));
  // The line above is only information. Each message below reports a contradiction in the data. With --strict, the
  // program refuses a file with such a contradiction.
  if (listed.n_neighbors > 0)
    summary.inconsistencies.push_back(
        fmt::format("{} of the {} listed contacts are left out, because the grains do not touch: they have a "
                    "gap and no force, and the law has no attraction across the gap",
                    listed.n_neighbors, listed.n_read));
  if (listed.n_across_no_lattice > 0)
    summary.inconsistencies.push_back(fmt::format(
        "{} of the {} listed contacts cross a boundary that rotates the grains: these contacts "
        "keep the listed forces and have no stiffness; their normals are wrong, and so is the force "
        "balance of their second grains",
        listed.n_across_no_lattice, listed.n_read));
  // Tensile contacts are counted here only if the user allows to leave them out (--drop-tensile). Otherwise the reader
  // has ended with an InputError, see assemble().
  if (listed.n_tensile > 0)
    summary.inconsistencies.push_back(fmt::format(
        "{} of the {} listed contacts have a tensile force and are left out", listed.n_tensile, listed.n_read));
  if (listed.n_other_image > 0)
    summary.inconsistencies.push_back(
        fmt::format("{} of the {} listed images contradict the positions, perhaps because the positions were "
                    "moved into the cell without an update of the images: the nearest images are used instead",
                    listed.n_other_image, listed.n_read));
}

/// Reports listed stiffnesses that differ from the stiffnesses of the law. If the law has the mean of the listed
/// stiffnesses, the difference is reported as information, else as an inconsistency.
void add_stiffnesses(const Imported& imported, ConversionSummary& summary) {
  std::vector<std::string>& said = imported.law_of_contacts ? summary.lines : summary.inconsistencies;
  for (const std::string& difference : imported.listed_contacts.stiffness_differences)
    said.push_back(difference);
}

void add_contacts(const ContactCheck& check, bool cohesive, ConversionSummary& summary) {
  if (check.n_bonds > 0)
    summary.lines.push_back(fmt::format(
        "contacts: {} are bonds, or act across a gap up to --touch-gap, with stiffnesses of their own",
        check.n_bonds));
  summary.lines.push_back(fmt::format(
      "contacts: {} have a gap, {} are tensile, {} have a tangential force or moment at its limit; normal "
      "forces "
      "differ from the law by at most {:.1e} of their mean",
      check.n_with_gap + check.n_distant, check.n_pulling, check.n_mobilised, check.largest_difference));
  if (check.n_with_gap > 0)
    summary.inconsistencies.push_back(fmt::format(
        "{} contacts have a force although the law does not act across their gap", check.n_with_gap));
  if (check.n_pulling > 0 && !cohesive)
    summary.inconsistencies.push_back(
        fmt::format("{} contacts are tensile, but the law has no adhesion", check.n_pulling));
  if (check.n_beyond_cap > 0)
    summary.inconsistencies.push_back(fmt::format(
        "{} tangential forces or rolling moments are above their limit in the law", check.n_beyond_cap));
  if (check.n_different > 0)
    summary.inconsistencies.push_back(
        fmt::format("{} normal forces differ from the law, by up to {:.2g} of their mean (grains {}): the law "
                    "or a stiffness is wrong, or the file has too few digits",
                    check.n_different, check.largest_difference, check.most_different));
  if (check.n_missing > 0)
    summary.inconsistencies.push_back(
        fmt::format("{} pairs of grains touch but are not listed (grains {})", check.n_missing, check.missing));
}

/// Reports that a packing has no contacts. The usual cause is a wrong radius or a wrong edge of the cell; the message
/// asks about the length that is likely to be wrong.
template <int Dim>
void add_absence_of_contacts(const Packing<Dim>& packing, ConversionSummary& summary) {
  if (!packing.contacts.empty()) return;
  const std::optional<NearestPair> nearest = nearest_pair(packing);
  if (nearest && nearest->gap < 0.0)
    return;  // another message reports that this contact is missing in the file
  constexpr double kHard = 1e-3, kDoubled = 0.1;
  std::string cause = "are the radii and the cell in the same unit of length?";
  std::string where;
  if (nearest) {
    const auto& radius = packing.grains.radius;
    const double radii = radius[nearest->i] + radius[nearest->j];
    if (nearest->gap <= kHard * radii)
      cause =
          "simulations of hard grains end with small gaps; to treat such grains as touching, give "
          "--touch-gap with a length above the smallest gap";
    else if (std::abs(nearest->gap - radii) <= kDoubled * radii)
      cause =
          "the nearest grains would touch if their radii were twice as large: are the values read as diameters "
          "in fact radii?";
    where =
        fmt::format(" (the smallest gap is {:.3g}, {:.2g} of a mean diameter, of grains {}-{})", nearest->gap,
                    nearest->gap / radii, packing.grains.name(nearest->i), packing.grains.name(nearest->j));
  }
  summary.inconsistencies.push_back(fmt::format("no grains touch{}: {}", where, cause));
}

}  // namespace

template <int Dim>
ConversionSummary summarize(const Imported& imported, const State<Dim>& state) {
  ConversionSummary summary;
  if (imported.complete) return summary;
  summary.inconsistencies = imported.inconsistencies;
  ContactCheck check = check_contacts(state.packing, kForceTolerance);
  if (imported.contacts_known) {
    add_missing_contacts(state.packing, check);
    add_list(imported.listed_contacts, check.n_contacts, summary);
    add_stiffnesses(imported, summary);
  }
  add_contacts(check, state.packing.law.adheres(), summary);
  const Mat<Dim> by_rows = state.stress.transpose();  // transposed: Eigen stores a matrix column by column
  summary.lines.back() +=
      fmt::format("; stress {:.6g}", fmt::join(by_rows.data(), by_rows.data() + Dim * Dim, " "));
  add_absence_of_contacts(state.packing, summary);
  if (const std::string faults = equilibrium_faults(state); !faults.empty())
    summary.inconsistencies.push_back("this state is not in equilibrium: " + faults);
  return summary;
}

template ConversionSummary summarize(const Imported&, const State<2>&);
template ConversionSummary summarize(const Imported&, const State<3>&);

}  // namespace floc
