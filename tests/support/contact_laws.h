#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "floc/contact/law.h"

/// Builds contact laws from models by name, so that tests do not depend on the headers of all models:
///
///     Law law;
///     law += test::linear(1e5);
///     law += test::coulomb(0.5, 1e5);
namespace floc::test {

/// Change of a contact law: `law += part` replaces one model or number of the law.
struct Part {
  std::function<void(LawParameters&)> put;
};

Part linear(double stiffness);
Part hertz(double modulus, double poisson);
Part tail_adhesion(double force, double range);
Part constant_adhesion(double force);
/// @param form, formation  keywords as in a scene; without these arguments, the first of the keywords that a scene may
/// contain
Part liquid(double surface_tension, double contact_angle, double water_content, double density_ratio,
            const std::string& form = "exponential", const std::string& formation = "gap");
Part viscous_damping(double restitution);
Part critical_damping(double critical_fraction);
Part coulomb(double coefficient, double stiffness);
Part mindlin(double coefficient);
Part rolling_spring(double coefficient, double stiffness);
Part twisting_spring(double coefficient, double stiffness);
/// Removes the model of a slot, for instance "friction".
Part without(const std::string& slot);
/// Replaces a number of the law, for instance "friction.coefficient".
Part changed(const std::string& key, double value);
/// Replaces the keyword of a choice, for instance "damping.mass".
Part chosen(const std::string& key, const std::string& keyword);

Law& operator+=(Law& law, const Part& part);
Law law_of(std::initializer_list<Part> parts);

/// Returns the contact law of [GRC2008] in units F0 = a = m = 1, with small rolling resistance.
Law cohesive_law();

/// Returns a number of a law by its key in a scene, for instance "normal.stiffness".
/// @pre the law has this number
double law_number(const Law& law, const std::string& key);

}  // namespace floc::test
