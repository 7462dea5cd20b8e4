#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/contact/damping/viscous_damping.h"

namespace floc {

/// A contact law as a scene or a saved state names it: slots with their parameters, absent where the scene says
/// nothing. `law_table.h` turns it into the composed type.
struct LawParameters {
  struct Adhesion {
    double force;  ///< pull-off force F0
    double range;  ///< D0 of the linear tail (length); 0 for constant adhesion without a tail
    bool operator==(const Adhesion&) const = default;
  };
  struct Damping {
    double restitution;
    DampingMass mass = DampingMass::effective;
    bool operator==(const Damping&) const = default;
  };
  struct Friction {
    double coefficient;  ///< mu
    double stiffness;    ///< K_T (force/length)
    bool operator==(const Friction&) const = default;
  };
  struct Rolling {
    double coefficient;  ///< mu_R (length)
    double stiffness;    ///< K_R (force * length)
    bool operator==(const Rolling&) const = default;
  };

  double normal_stiffness = 0.0;  ///< K_N (force/length)
  std::optional<Adhesion> adhesion;
  std::optional<Damping> damping;
  std::optional<Friction> friction;
  std::optional<Rolling> rolling;

  bool operator==(const LawParameters&) const = default;

  /// F0, or 0 without adhesion.
  double pull_off_force() const { return adhesion ? adhesion->force : 0.0; }
  /// Largest gap at which the law acts; adhesion of zero force acts nowhere.
  double range() const { return pull_off_force() > 0.0 ? adhesion->range : 0.0; }

  /// Every fault as "key = value: requirement"; empty when the law can be used.
  std::vector<std::string> validate() const;
};

}  // namespace floc
