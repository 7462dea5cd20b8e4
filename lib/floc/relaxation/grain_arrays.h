#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "floc/base/aligned_vector.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

inline bool all_equal(std::span<const double> numbers) {
  return std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) == numbers.end();
}

/// Grains in the form that the loop over pairs reads: one array per component of each quantity, with the grains in the
/// order of space_order(). The arrays are padded with zeros to whole blocks of kGrainBlock grains and then with kWindow
/// more entries, so that kWindow entries can be read beginning with any grain.
template <int Dim>
struct GrainArrays {
  using Component = AlignedVector<double>;

  std::vector<int> index;        ///< index in the packing of the k-th grain of these arrays
  std::array<Component, Dim> x;  ///< position of each grain (length), which may be outside the cell
  /// Peculiar velocity of each grain, that is, the velocity without the affine motion of the lattice (length/time).
  std::array<Component, Dim> v;
  std::array<Component, Dim> force;
  std::array<Component, kRotations<Dim>> spin;
  std::array<Component, kRotations<Dim>> torque;
  std::array<Component, kOrientationNumbers<Dim>> orientation;
  Component radius, mass, inertia;
  Component inverse_mass, inverse_inertia;
  /// Identifiers of the grains, in the order of the packing; empty if the grains have none.
  std::vector<std::int64_t> id;

  GrainArrays(const Grains<Dim>& grains, const std::vector<int>& order);

  int size() const { return static_cast<int>(index.size()); }
  int n_blocks() const { return (size() + kGrainBlock - 1) / kGrainBlock; }
  /// Returns the entries of an array that belong to grains, without the padding.
  std::span<const double> of_grains(const Component& component) const {
    return {component.data(), index.size()};
  }
  void copy_positions_to(Grains<Dim>& grains) const;
  /// Sets the velocities and spins of all grains to zero.
  void stop();
  /// Returns the orientation of the k-th grain of these arrays.
  Orientation<Dim> orientation_of(std::size_t k) const;
  /// Returns pointers to these arrays, in the form that kernels (compiled loops over grains or pairs) read.
  /// @param x_list  positions of the grains when the neighbour lists were built (length)
  /// @param inverse_skin_squared  the number 1/s^2 for each grain, where s is its skin: the distance that the grain may
  /// move before new neighbour lists are built (1/length^2)
  GrainView<Dim> view(const std::array<Component, Dim>& x_list, const Component& inverse_skin_squared);

 private:
  void set_orientation(const Orientation<Dim>& lies, std::size_t k);
};

template <int Dim>
Orientation<Dim> GrainArrays<Dim>::orientation_of(std::size_t k) const {
  if constexpr (Dim == 2) {
    return orientation[0][k];
  } else {
    return Orientation<3>(orientation[0][k], orientation[1][k], orientation[2][k], orientation[3][k])
        .normalized();
  }
}

template <int Dim>
void GrainArrays<Dim>::set_orientation(const Orientation<Dim>& lies, std::size_t k) {
  if constexpr (Dim == 2) {
    orientation[0][k] = lies;
  } else {
    const double numbers[] = {lies.w(), lies.x(), lies.y(), lies.z()};
    for (int a = 0; a < 4; ++a) orientation[a][k] = numbers[a];
  }
}

template <int Dim>
GrainArrays<Dim>::GrainArrays(const Grains<Dim>& grains, const std::vector<int>& order)
    : index(order), id(grains.id) {
  const std::size_t n = order.size();
  const std::size_t padded = (n + kGrainBlock - 1) / kGrainBlock * kGrainBlock + kWindow;
  for (auto* component : {&radius, &mass, &inertia, &inverse_mass, &inverse_inertia})
    component->assign(padded, 0.0);
  for (auto* vector : {&x, &v, &force})
    for (auto& component : *vector) component.assign(padded, 0.0);
  for (auto* vector : {&spin, &torque})
    for (auto& component : *vector) component.assign(padded, 0.0);
  for (auto& component : orientation) component.assign(padded, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const int i = order[k];
    for (int a = 0; a < Dim; ++a) {
      x[a][k] = grains.position[i][a];
      v[a][k] = grains.velocity[i][a];
    }
    for (int a = 0; a < kRotations<Dim>; ++a) spin[a][k] = grains.angular_velocity[i][a];
    set_orientation(grains.orientation[i], k);
    radius[k] = grains.radius[i];
    mass[k] = grains.mass[i];
    inertia[k] = grains.inertia(i);
    inverse_mass[k] = 1.0 / mass[k];
    inverse_inertia[k] = 1.0 / inertia[k];
  }
}

template <int Dim>
void GrainArrays<Dim>::copy_positions_to(Grains<Dim>& grains) const {
  for (int k = 0; k < size(); ++k)
    for (int a = 0; a < Dim; ++a) grains.position[k][a] = x[a][k];
}

template <int Dim>
void GrainArrays<Dim>::stop() {
  for (Component& component : v) std::fill(component.begin(), component.end(), 0.0);
  for (Component& component : spin) std::fill(component.begin(), component.end(), 0.0);
}

template <int Dim>
GrainView<Dim> GrainArrays<Dim>::view(const std::array<Component, Dim>& x_list,
                                      const Component& inverse_skin_squared) {
  GrainView<Dim> out;
  for (int a = 0; a < Dim; ++a) {
    out.x[a] = x[a].data();
    out.v[a] = v[a].data();
    out.force[a] = force[a].data();
    out.x_list[a] = x_list[a].data();
  }
  out.inverse_skin_squared = inverse_skin_squared.data();
  for (int a = 0; a < kRotations<Dim>; ++a) {
    out.spin[a] = spin[a].data();
    out.torque[a] = torque[a].data();
  }
  for (int a = 0; a < kOrientationNumbers<Dim>; ++a) out.orientation[a] = orientation[a].data();
  out.own_masses = all_equal(of_grains(mass)) && all_equal(of_grains(inertia)) ? 0 : -1;
  out.mass = mass.data();
  out.inverse_mass = inverse_mass.data();
  out.inertia = inertia.data();
  out.inverse_inertia = inverse_inertia.data();
  return out;
}

}  // namespace floc
