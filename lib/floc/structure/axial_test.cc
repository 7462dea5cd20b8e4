#include "floc/structure/axial_test.h"

namespace floc {
namespace {

/// Returns the mean of the values on the axes other than the driven axis.
template <int Dim>
double lateral_mean(int axis, const Vec<Dim>& values) {
  return (values.sum() - values[axis]) / (Dim - 1);
}

/// Returns the value on the driven axis minus the mean of the values on the other axes. For stresses, this is the
/// deviator q. For strains, it is proportional to eps_q, the strain on which q does work.
template <int Dim>
double difference(int axis, const Vec<Dim>& values) {
  return values[axis] - lateral_mean<Dim>(axis, values);
}

}  // namespace

template <int Dim>
AxialTest measure_axial_test(int axis, const Vec<Dim>& stress, const Vec<Dim>& strain,
                             const Vec<Dim>* strain_before) {
  AxialTest test;
  test.mean_stress = stress.mean();
  test.deviator = difference<Dim>(axis, stress);
  test.lateral_ratio = lateral_mean<Dim>(axis, stress) / stress[axis];
  test.volumetric_strain = strain.sum();
  test.mobilised = test.deviator / (Dim == 2 ? stress.sum() : test.mean_stress);
  if (strain_before == nullptr) return test;
  const Vec<Dim> increment = strain - *strain_before;
  const double shear = (Dim == 2 ? 1.0 : 2.0 / 3.0) * difference<Dim>(axis, increment);
  if (shear != 0.0) test.dilatancy = -increment.sum() / shear;
  return test;
}

template AxialTest measure_axial_test(int, const Vec<2>&, const Vec<2>&, const Vec<2>*);
template AxialTest measure_axial_test(int, const Vec<3>&, const Vec<3>&, const Vec<3>*);

}  // namespace floc
