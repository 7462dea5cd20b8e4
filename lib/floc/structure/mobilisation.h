#pragma once

#include "floc/packing/contact.h"

namespace floc {

/// Mean mobilisation |F_T|/N of contacts whose force is above, and below, the mean force; contacts are added
/// one by one.
class MobilisationByForce {
 public:
  /// @param mean  elastic force of the contacts, > 0 (force)
  explicit MobilisationByForce(double mean) : mean_(mean) {}

  /// Contacts without an elastic force do not count.
  template <int Dim>
  void add(const Contact<Dim>& c) {
    if (!(c.elastic_force > 0.0)) return;
    Mean& side = c.elastic_force > mean_ ? above_ : below_;
    side.sum += c.shear_force.norm() / c.elastic_force;
    ++side.n;
  }

  double M1() const { return above_.value(); }  ///< mean over contacts above the mean force, 0 without any
  double M2() const { return below_.value(); }  ///< mean over the other contacts, 0 without any

 private:
  struct Mean {
    double sum = 0.0;
    int n = 0;
    double value() const { return n > 0 ? sum / n : 0.0; }
  };

  double mean_;
  Mean above_, below_;
};

}  // namespace floc
