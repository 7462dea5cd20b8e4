#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/assembly/assembly_options.h"
#include "floc/base/range.h"
#include "floc/contact/law.h"
#include "floc/loading/load_path.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Options of one run: how a packing of grains is made, and how it is then loaded. Runs with equal options give bitwise
/// identical results.
struct RunOptions {
  int dimension = 2;
  std::string units = "reduced";  ///< system of units, "reduced" or "SI"
  GrainOptions grains;
  Law law;
  AssemblyOptions assembly;
  std::vector<LoadStage> load;
  RelaxationOptions relaxation;
  std::uint64_t seed = 1;
  /// text of the scene file in TOML, after the user's overrides; it is stored in every saved state
  std::string text;

  /// Whether contact dynamics moves the grains. It does if the contacts are rigid or the grains have shapes.
  bool has_contact_dynamics() const {
    return law.is_rigid() || grains.shape.has_value() || assembly.saved.has_shapes;
  }

  static constexpr WholeRange kThreads{.least = 1, .most = 1024};
};

}  // namespace floc
