#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "floc/contact/law.h"

/// Contact laws put together from models by name, so that a test which needs some law does not depend on the headers of
/// all models:
///
///   Law law;
///   law += test::linear(1e5);
///   law += test::coulomb(0.5, 1e5);
namespace floc::test {

/// Something that a law is to have, in place of what it has there.
struct Part {
  std::function<void(LawParameters&)> put;
};

Part linear(double stiffness);
Part hertz(double modulus, double poisson);
Part tail_adhesion(double force, double range);
Part constant_adhesion(double force);
/// @param form, formation  the first keyword of a scene, or another one
Part liquid(double surface_tension, double contact_angle, double water_content, double density_ratio,
            const std::string& form = "exponential", const std::string& formation = "gap");
Part viscous_damping(double restitution);
Part critical_damping(double critical_fraction);
Part coulomb(double coefficient, double stiffness);
Part mindlin(double coefficient);
Part rolling_spring(double coefficient, double stiffness);
Part twisting_spring(double coefficient, double stiffness);
/// Nothing in a slot, "friction" for instance.
Part without(const std::string& slot);
/// Another value of a number that the law has, "friction.coefficient" for instance.
Part changed(const std::string& key, double value);
/// Another keyword of a choice, "damping.mass" for instance.
Part chosen(const std::string& key, const std::string& keyword);

Law& operator+=(Law& law, const Part& part);
Law law_of(std::initializer_list<Part> parts);

/// The contact law of [GRC2008] in units F0 = a = m = 1, with small rolling resistance.
Law cohesive_law();

/// A number of a law by its key in a scene, "normal.stiffness" for instance. @pre it has this number
double law_number(const Law& law, const std::string& key);

}  // namespace floc::test
