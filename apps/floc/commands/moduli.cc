#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/packing/equilibrium_check.h"
#include "floc/tables/equilibrium_warning.h"
#include "floc/tables/moduli_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/states_together.h"

namespace floc {
namespace {

struct ModuliCommand {
  std::vector<std::string> files;
  ModuliTableOptions options;
  std::string strains = "diagonal";
  std::string method = "factor";
  std::string solver = "automatic";
  std::optional<double> memory;       ///< GB
  std::vector<std::string> accuracy;  ///< "X", or "B=X", "G=X"; empty: `method` is used
  bool force = false;
  std::string increments;  ///< file for the increments of every contact; empty: none
  std::string output;      ///< file for the table; empty: stdout
  Printing printing;
};

/// Returns the options of the library. @throws InputError naming the option at fault
ModuliTableOptions options_of(const ModuliCommand& command) {
  constexpr double kGigabyte = 1e9;
  ModuliTableOptions options = command.options;
  options.moduli.strains = strain_set(command.strains);
  options.moduli.method = moduli_method(command.method);
  options.accuracy = moduli_accuracy(command.accuracy);
  options.solver = command.solver == "petsc"     ? ModuliSolver::petsc
                   : command.solver == "cholmod" ? ModuliSolver::cholmod
                                                 : ModuliSolver::automatic;
  if (command.memory) options.memory = kGigabyte * *command.memory;
  options.increments = !command.increments.empty();
  for (const std::string& fault : options.validate()) throw InputError("floc moduli", "--" + fault);
  return options;
}

/// Returns whether rows reach the required accuracy; prints on stderr how one misses it.
bool accuracy_met(const std::vector<ModuliRow>& rows, const std::optional<ModuliAccuracy>& accuracy) {
  return std::ranges::all_of(rows, [&](const ModuliRow& row) {
    const std::string fault = accuracy_fault(row, accuracy);
    if (!fault.empty()) std::cerr << fmt::format("floc: {}: {}\n", row.file, fault);
    return fault.empty();
  });
}

/// Returns whether the moduli of a state are to be computed: those of an equilibrium, and with `force` of any state,
/// after a warning. Prints an error if not.
bool accepts_state(const std::string& file, const AnyState& any, bool force, const Remarks& remarks) {
  if (force) {
    std::visit([&](const auto& state) { warn_unless_in_equilibrium(file, state, remarks); }, any);
    return true;
  }
  const std::string faults = std::visit([](const auto& state) { return equilibrium_faults(state); }, any);
  if (!faults.empty())
    std::cerr << "floc: " << file << ": this state is not in equilibrium: " << faults
              << "; --force computes moduli anyway\n";
  return faults.empty();
}

/// Writes a table in the format of `--format`, as csv without it. @throws IoError if the file cannot be written
void write_file(const std::string& path, const Table& table, const Printing& printing) {
  std::ostringstream text;
  write_table(text, with_chosen_columns(table, printing, false),
              printing.format.empty() ? TableFormat::csv : chosen_format(printing.format));
  write_bytes_atomically(path, text.str());
}

void print_rows(const ModuliCommand& command, const ModuliTableOptions& options,
                const std::vector<ModuliRow>& rows) {
  const Table table = moduli_table(options, rows);
  if (command.output.empty() || command.output == "-")
    print_table(table, command.printing);
  else
    write_file(command.output, table, command.printing);
}

/// Computes the moduli of one state after the other, in this process.
int run_alone(const ModuliCommand& command, const ModuliTableOptions& options) {
  ModuliRows computation(options);
  std::vector<ModuliRow> rows;
  Table increments;
  const int code =
      for_each_state(command.files, [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
        if (!accepts_state(file, any, command.force, remarks)) return int{kVerificationFailed};
        require_strains(file, any, options.moduli.strains);
        std::vector<ModuliRow> computed = std::visit(
            [&](const auto& state) {
              return computation.of(file, state, options.increments ? &increments : nullptr, remarks);
            },
            any);
        const int outcome = accuracy_met(computed, options.accuracy) ? kDone : kNotConverged;
        std::ranges::move(computed, std::back_inserter(rows));
        return outcome;
      });
  if (options.increments) write_csv(command.increments, increments);
  print_rows(command, options, rows);
  return code;
}

/// Computes the moduli of each state on all processes of mpirun together. Only the first process prints.
int run_together(const ModuliCommand& command, const ModuliTableOptions& options) {
  const std::unique_ptr<ParallelSolver> solver = load_parallel_solver();
  std::vector<ModuliRow> rows;
  const auto check = [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
    require_strains(file, any, options.moduli.strains);
    return accepts_state(file, any, command.force, remarks) ? kDone : kVerificationFailed;
  };
  const auto work = [&](const std::string& file, AnyState& any, const Remarks& remarks) {
    std::visit(
        [&](auto& state) {
          std::ranges::move(parallel_moduli_rows(file, std::move(state), options, *solver, remarks),
                            std::back_inserter(rows));
        },
        any);
  };
  const int code = for_each_state_together(command.files, *solver, check, work);
  if (solver->rank() == 0) print_rows(command, options, rows);
  return solver->rank() == 0 ? code : int{kDone};
}

int run_moduli(const ModuliCommand& command) {
  const ModuliTableOptions options = options_of(command);
  return options.solver == ModuliSolver::petsc ? run_together(command, options) : run_alone(command, options);
}

}  // namespace

Command add_moduli(CommandLine program) {
  CommandLine app =
      program.add_subcommand("moduli", "Compute elastic moduli, bounds and stability of saved states");
  const auto command = std::make_shared<ModuliCommand>();
  add_states_argument(app, command->files);
  app.add_option("--strains", command->strains,
                 "diagonal: shear strains clamped; full: every component, which adds the shear moduli")
      .one_of({"diagonal", "full"})
      .show_default();
  app.add_flag("--prestress", command->options.moduli.prestress,
               "add the geometric terms of the forces (except those of F_T); stress is the Cauchy stress");
  const Option tolerance = app.add_option("--tolerance", command->options.moduli.tolerance,
                                          "relative error wanted of B and G; the error reached is printed, "
                                          "with a warning where it is larger")
                               .show_default();
  const Option method =
      app.add_option("--method", command->method,
                     "factor: in double precision; single-factor: in single precision, refined; iterative: "
                     "from the solution of the state before, to --tolerance; bounds: the middle between the "
                     "bounds. The last three are approximate, and their errors are printed too")
          .one_of({"factor", "single-factor", "iterative", "bounds"})
          .show_default();
  // --accuracy chooses the method and its tolerance itself, so it excludes both options.
  const Option accuracy = app.add_option("--accuracy", command->accuracy,
                                         "X, or B=X, G=X: relative errors that are good enough; the cheapest "
                                         "method that keeps them is taken and named in the column method")
                              .delimiter(',')
                              .excludes(method)
                              .excludes(tolerance)
                              .one_argument_each();
  app.add_option(
         "--force-tolerance", command->options.moduli.force_tolerance,
         "cohesionless packings: a contact below this force, in units of max(F0, P a^(d-1)), carries nothing")
      .show_default();
  app.add_option("--rolling-stiffness", command->options.rolling_stiffness,
                 "K_R of every touching contact, in the state's units; one row per value")
      .delimiter(',')
      .excludes(method)
      .excludes(accuracy)
      .one_argument_each();
  app.add_option("--increments", command->increments,
                 "file with one row per contact: what a unit of isotropic and of deviatoric stress adds to its "
                 "forces, energy and rank, dead end, backbones");
  app.add_flag("--force", command->force,
               "accept states that are not in equilibrium, which are refused otherwise");
  app.add_option("--solver", command->solver,
                 "cholmod: with a factor; petsc: without one, also on all processes of mpirun; automatic: "
                 "cholmod where its factor fits into memory")
      .one_of({"automatic", "cholmod", "petsc"})
      .show_default();
  // GB here, bytes in the options of the library: options_of() converts it.
  app.add_option("--memory", command->memory,
                 "GB that a factor may take before --solver automatic leaves it to petsc [0.7 of what is free]")
      .positive();
  app.add_option("-o,--output", command->output,
                 "file for the table in place of stdout, written whole or not at all: for mpirun, which does "
                 "not report a full disk");
  add_printing_options(app, command->printing);
  return {app, [command] { return run_moduli(*command); }};
}

}  // namespace floc
