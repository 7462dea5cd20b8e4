#pragma once

#include "floc/packing/contact.h"

namespace floc {

/// Mean mobilisation of friction, separately for contacts with large and with small forces. The mobilisation |F_T|/N is
/// the tangential force divided by the elastic normal force. A force N is large if it is above the mean of N. Contacts
/// are added one by one.
class MobilisationByForce {
 public:
  /// @param mean  mean elastic normal force of the contacts, > 0 (force)
  explicit MobilisationByForce(double mean) : mean_(mean) {}

  /// Adds a contact; contacts without a positive elastic normal force are ignored.
  template <int Dim>
  void add(const Contact<Dim>& c) {
    if (!(c.elastic_force > 0.0)) return;
    Mean& side = c.elastic_force > mean_ ? above_ : below_;
    side.sum += c.shear_force.norm() / c.elastic_force;
    ++side.n;
  }

  /// Returns the mean of |F_T|/N over the contacts with N above the mean; 0 without such contacts.
  double M1() const { return above_.value(); }
  /// Returns the mean of |F_T|/N over the contacts with N at most the mean; 0 without such contacts.
  double M2() const { return below_.value(); }

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
