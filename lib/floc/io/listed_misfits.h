#pragma once

#include <string>

#include "floc/io/listed_packing.h"
#include "floc/packing/packing.h"

namespace floc {

/// Compares listed contact points of grains with corners with the shapes, and counts the points that do not fit. At a
/// contact point, the surfaces of the two bodies lie on both sides of the plane across the normal, and the distance
/// between them is the gap.
class PointMisfits {
 public:
  /// Adds a contact point.
  /// @param row  line of the file, for messages
  /// @throws InputError if the normal points from the second body of the contact to the first
  template <int Dim>
  void add(const ListedContact& row, const Packing<Dim>& packing, const Contact<Dim>& contact);

  /// Returns a sentence with the number of points that do not fit and the largest misfit; empty if all points fit.
  std::string sentence() const;

 private:
  int n_points_ = 0;
  int n_misfits_ = 0;
  std::string first_;     ///< place and bodies of the first misfit
  double largest_ = 0.0;  ///< largest misfit, divided by the diameter of the smaller body
  std::string worst_;     ///< place and bodies of the largest misfit
};

}  // namespace floc
