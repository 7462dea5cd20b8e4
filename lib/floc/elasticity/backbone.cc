#include "floc/elasticity/backbone.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// A contact carries part of a change of stress if the change of its force, divided by the largest change in any
/// contact, exceeds this number. In real packings this ratio is either above 1e-4 or, if it is due to rounding alone,
/// about 1e-15.
constexpr double kCarries = 1e-9;

template <int Dim>
double size_of(const ForceIncrement<Dim>& f, double grain_size) {
  return std::sqrt(f.normal * f.normal + f.shear.squaredNorm() +
                   (f.rolling_moment.squaredNorm() + f.twisting_moment * f.twisting_moment) /
                       (grain_size * grain_size));
}

}  // namespace

template <int Dim>
std::vector<bool> mechanical_backbone(const ContactNetwork<Dim>& network, const StepResponse<Dim>& step) {
  std::vector<double> size;
  for (std::size_t c = 0; c < network.contacts.size(); ++c)
    size.push_back(size_of(step.increments[c], network.grain_size[network.contacts[c].i]));
  const double largest = size.empty() ? 0.0 : *std::max_element(size.begin(), size.end());
  std::vector<bool> carries;
  for (const double s : size) carries.push_back(s > kCarries * largest);
  return carries;
}

template std::vector<bool> mechanical_backbone(const ContactNetwork<2>&, const StepResponse<2>&);
template std::vector<bool> mechanical_backbone(const ContactNetwork<3>&, const StepResponse<3>&);

}  // namespace floc
