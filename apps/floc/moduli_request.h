#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "moduli_rows.h"

namespace floc {

/// What `floc moduli` is asked.
struct ModuliCommand {
  std::vector<std::string> files;
  std::string strains = "diagonal";
  bool prestress = false;
  bool force = false;
  ModuliOptions options;
  std::string method = "factor";
  std::string solver = "automatic";
  std::optional<double> memory;       ///< GB that a factor may take; none: by what is free
  std::vector<std::string> accuracy;  ///< "X", or "B=X", "G=X"; empty: the method says what is spent
  std::vector<double> rolling_stiffness;
  std::string increments;  ///< file for the increments of every contact; empty: none
  std::string output;      ///< file for the table; empty: stdout
  std::string format;
};

/// What the solvers are asked for.
/// @throws InputError naming the option at fault
ModuliRequest request_of(const ModuliCommand& command);

/// @throws InputError where the strains asked for are none of what holds the state
void require_strains(const std::string& file, const AnyState& any, StrainSet strains);

/// What of the accuracy asked for a row does not keep, in words; empty where it keeps all.
std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy);

/// The table of the rows that a command asked for.
Table moduli_table(const ModuliCommand& command, const std::vector<ModuliRow>& rows);

}  // namespace floc
