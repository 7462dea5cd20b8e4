#include "moduli_request.h"

#include <fmt/format.h>

#include <map>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "free_memory.h"

namespace floc {
namespace {

const std::map<std::string, ModuliSolver> kSolvers = {
    {"automatic", ModuliSolver::automatic}, {"cholmod", ModuliSolver::cholmod}, {"petsc", ModuliSolver::petsc}};

ModuliOptions options_of(const ModuliCommand& command) {
  ModuliOptions options = command.options;
  options.strains = command.strains == "full" ? StrainSet::full : StrainSet::diagonal;
  options.prestress = command.prestress;
  options.method = moduli_method(command.method);
  std::vector<std::string> faults = options.validate();
  if (options.method != ModuliMethod::factor && !command.increments.empty())
    faults.push_back(
        "increments: expects --method factor, because the forces of the other methods are approximate");
  for (const double kr : command.rolling_stiffness) {
    ModuliOptions with = command.options;
    with.rolling_stiffness = kr;
    for (const std::string& fault : with.validate()) faults.push_back(fault);
  }
  if (!command.increments.empty() && command.rolling_stiffness.size() > 1)
    faults.push_back(
        "increments: expects at most one rolling stiffness, because each contact has one set of forces in the "
        "file");
  for (const std::string& fault : faults) throw InputError("floc moduli", "--" + fault);
  return options;
}

/// Reads --accuracy: "X" for both moduli, "B=X", "G=X"; nothing where it is not given.
std::optional<ModuliAccuracy> accuracy_of(const ModuliCommand& command) {
  if (command.accuracy.empty()) return std::nullopt;
  ModuliAccuracy accuracy;
  for (const std::string& text : command.accuracy) {
    const std::size_t equals = text.find('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const auto error = parse_number<double>(equals == std::string::npos ? text : text.substr(equals + 1));
    if (!error || (!name.empty() && name != "B" && name != "G"))
      throw InputError("floc moduli",
                       fmt::format("--accuracy {}: expected X, B=X or G=X with X a relative error", text));
    if (name != "G") accuracy.B = *error;
    if (name != "B") accuracy.G = *error;
  }
  for (const std::string& fault : accuracy.validate()) throw InputError("floc moduli", "--" + fault);
  if (!command.increments.empty())
    throw InputError("floc moduli", "--increments: expects --method factor in place of --accuracy");
  return accuracy;
}

/// Bytes that a factor may take: the rest of the memory is for its matrix and workspace.
double largest_factor(const ModuliCommand& command) {
  constexpr double kShare = 0.7, kGigabyte = 1e9;
  return command.memory ? kGigabyte * *command.memory : kShare * free_memory();
}

}  // namespace

ModuliRequest request_of(const ModuliCommand& command) {
  ModuliRequest request{options_of(command), accuracy_of(command), command.rolling_stiffness,
                        kSolvers.at(command.solver)};
  const bool by_factor = request.options.method == ModuliMethod::factor && !request.accuracy;
  if (request.solver == ModuliSolver::automatic && by_factor)
    request.options.largest_factor = largest_factor(command);
  if (request.solver != ModuliSolver::petsc) return request;
  if (!by_factor)
    throw InputError("floc moduli",
                     "--solver petsc: expected without --method and --accuracy; --tolerance sets its accuracy");
  if (!command.increments.empty())
    throw InputError(
        "floc moduli",
        "--increments: expects --solver cholmod, because the forces of the other solvers are approximate");
  return request;
}

void require_strains(const std::string& file, const AnyState& any, StrainSet strains) {
  if (strains == StrainSet::full &&
      std::visit([](const auto& state) { return !state.packing.walls.empty(); }, any))
    throw InputError(file, "has walls, which cannot shear the grains: expected --strains diagonal");
}

std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy) {
  if (!accuracy || accuracy->met_by(row.moduli)) return "";
  return fmt::format(
      "no method gives B and G as accurately as asked: the error bounds of the factor are {:.1e} of {:.6g} and "
      "{:.1e} of {:.6g}",
      row.moduli.B_error, row.moduli.B, row.moduli.G_error, row.moduli.G);
}

Table moduli_table(const ModuliCommand& command, const std::vector<ModuliRow>& rows) {
  return to_table(moduli_columns({!command.rolling_stiffness.empty(), command.prestress}, rows), rows);
}

}  // namespace floc
