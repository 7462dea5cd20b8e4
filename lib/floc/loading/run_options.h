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

/// Options of a run. Runs with equal options give identical results, bit for bit.
struct RunOptions {
  int dimension = 2;
  std::string units = "reduced";  ///< "reduced" or "SI"
  GrainOptions grains;
  Law law;
  AssemblyOptions assembly;
  std::vector<LoadStage> load;
  RelaxationOptions relaxation;
  std::uint64_t seed = 1;
  std::string text;  ///< text of the scene with all overrides applied, which is stored in every state

  static constexpr WholeRange kThreads{.least = 1, .most = 1024};
};

}  // namespace floc
