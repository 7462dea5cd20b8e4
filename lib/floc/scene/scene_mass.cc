#include "floc/scene/scene_mass.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <numbers>

#include "floc/base/error.h"

namespace floc {

std::optional<double> mass_per_cubed_diameter(const std::string& scene, int dimension,
                                              const std::string& place) {
  try {
    const toml::table text = toml::parse(scene);
    if (!text.contains("grains")) return std::nullopt;
    const auto density = text["grains"]["density"].value<double>();
    const double unit_sphere = std::numbers::pi / (dimension == 2 ? 4.0 : 6.0);
    return density ? *density * unit_sphere : 1.0;
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", place, error.source().begin.line), std::string(error.description()));
  }
}

}  // namespace floc
