#include "floc/packing/overlaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/contact/law_parameters.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Largest solid fraction without a warning, divided by the largest solid fraction of hard grains. The ratio is above 1
/// to allow for crystals that are compressed by some tenths of a percent.
constexpr double kCompressedCrystal = 1.01;
/// Two radii count as equal if their relative difference is below this number, which allows for rounding.
constexpr double kEqual = 1e-9;

std::string small_overlaps_rule(const Law& law) {
  return fmt::format("normal.law = \"{}\" is valid only for small overlaps", law.normal_keyword());
}

/// Returns a message if the grains are equal and their solid fraction is impossible for hard grains; otherwise an empty
/// text.
template <int Dim>
std::string density_fault(const Packing<Dim>& packing) {
  const auto& radius = packing.grains.radius;
  if (radius.empty() || !packing.grains.are_round()) return {};
  const auto [least, largest] = std::minmax_element(radius.begin(), radius.end());
  const double phi = solid_fraction(packing);
  if (*largest > (1.0 + kEqual) * *least || phi <= kCompressedCrystal * densest_of_equal(Dim)) return {};
  return fmt::format("the solid fraction is {:.4g}, but equal {} that do not overlap fill at most {:.4g}", phi,
                     Dim == 2 ? "disks" : "spheres", densest_of_equal(Dim));
}

}  // namespace

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing) {
  Overlaps out;
  int n_touching = 0, n_deep = 0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (c.distant || (c.bonded && c.gap > 0.0)) continue;  // surfaces that do not touch
    const double overlap = -c.gap / smaller_radius(packing, c);
    ++n_touching;
    n_deep += overlap > kDeepOverlap;
    out.mean += overlap;
    out.largest = std::max(out.largest, overlap);
  }
  if (n_touching == 0) return out;
  out.mean /= n_touching;
  out.deep_share = static_cast<double>(n_deep) / n_touching;
  return out;
}

template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing) {
  const Overlaps found = measure_overlaps(packing);
  std::string text;
  if (found.deep_share > 0.0)
    text = fmt::format(
        "{:.3g} % of the contacts overlap by more than a tenth of a radius; the largest overlap is {:.3g} of a "
        "radius, the mean overlap of all contacts is {:.3g} of a radius",
        100.0 * found.deep_share, found.largest, found.mean);
  if (const std::string dense = density_fault(packing); !dense.empty())
    text += (text.empty() ? "" : "; ") + dense;
  if (text.empty()) return {};
  return fmt::format("{}: {}{}", text,
                     packing.law.is_for_small_overlaps() ? small_overlaps_rule(packing.law) + "; " : "",
                     question_of_units(packing.law));
}

std::string question_of_units(const Law& law) {
  return law.parameters().normal.visit([]<class Model>(const Model& model) -> std::string {
    if constexpr (requires { Model::kNumbers; }) {
      const Number<Model>& stiffness = Model::kNumbers[0];
      return fmt::format("is {} = {:.6g} consistent with the units of lengths and forces?", stiffness.symbol,
                         model.*stiffness.member);
    } else {
      return "are the positions and the radii in the same unit of length?";
    }
  });
}

template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing) {
  if (!packing.law.is_for_small_overlaps()) return;
  const Overlaps found = measure_overlaps(packing);
  if (found.mean > kDeepestMean)
    throw InputError(place,
                     fmt::format("the mean overlap of the contacts is {:.3g} of a radius, but at most {} of "
                                 "a radius is allowed: {}",
                                 found.mean, kDeepestMean, small_overlaps_rule(packing.law)));
}

#define FLOC_INSTANTIATE(Dim)                                \
  template Overlaps measure_overlaps(const Packing<Dim>&);   \
  template std::string overlap_warning(const Packing<Dim>&); \
  template void require_small_overlaps(const std::string&, const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
