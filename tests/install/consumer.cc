#include <cstdio>
#include <variant>

#include "floc/base/version.h"
#include "floc/contact/law_table.h"

int main() {
  floc::LawParameters parameters;
  parameters.normal_stiffness = 100.0;
  parameters.adhesion = {2.0, 0.0};
  const auto force = [](const auto& law) { return law.normal(-0.25).force(); };
  const double f = std::visit(force, floc::compose_law(parameters));
  std::printf("floc %s: %g\n", floc::version().c_str(), f);
  return f == 23.0 ? 0 : 1;
}
