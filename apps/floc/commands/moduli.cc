#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

#include "floc/base/error.h"
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
  std::string stiffness_per = "point";
  /// Largest memory that a Cholesky factor of the stiffness matrix may take (GB).
  std::optional<double> memory;
  /// Required relative errors of the moduli: "X" for all moduli, or "B=X", "G=X"; if empty, `method` is used.
  std::vector<std::string> accuracy;
  bool force = false;
  /// Name of the csv file for the force increments of every contact; if empty, no file is written.
  std::string increments;
  std::string output;  ///< name of the file for the table of moduli; if empty, the table is printed on stdout
  Printing printing;
};

/// Converts the command line to the options of the library. @throws InputError that names the invalid option
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
  options.stiffness_per = stiffness_per(command.stiffness_per);
  options.increments = !command.increments.empty();
  for (const std::string& fault : options.validate()) throw InputError("floc moduli", "--" + fault);
  return options;
}

/// Returns whether the moduli in all rows reach the required accuracy. If not, prints an error for the first row with
/// too inaccurate moduli.
bool accuracy_met(const std::vector<ModuliRow>& rows, const std::optional<ModuliAccuracy>& accuracy) {
  return std::ranges::all_of(rows, [&](const ModuliRow& row) {
    const std::string fault = accuracy_fault(row, accuracy);
    if (!fault.empty()) std::cerr << fmt::format("floc: {}: {}\n", row.file, fault);
    return fault.empty();
  });
}

/// Returns whether the moduli of a state are to be computed: true if the state is in equilibrium or `force` is set. If
/// the state is not in equilibrium, prints a warning (if `force` is set) or an error.
bool accepts_state(const std::string& file, const AnyState& any, bool force, const Remarks& remarks) {
  if (force) {
    std::visit([&](const auto& state) { warn_unless_in_equilibrium(file, state, remarks); }, any);
    return true;
  }
  const std::string faults = std::visit([](const auto& state) { return equilibrium_faults(state); }, any);
  // Positions with only six digits in an imported file cause large residuals. Such a state needs a larger tolerance.
  const bool imported = std::visit([](const auto& state) { return state.path.branch == "imported"; }, any);
  const char* advice =
      imported ? ", or convert the file with a larger --tolerance if its numbers have few digits" : "";
  if (!faults.empty())
    std::cerr << "floc: " << file << ": this state is not in equilibrium: " << faults
              << "; give --force to compute its moduli nevertheless" << advice << '\n';
  return faults.empty();
}

/// Writes a table to a file in the format of the option `--format`, which is csv without this option.
/// @throws IoError if the file cannot be written
void write_file(const std::string& path, const Table& table, const Printing& printing) {
  std::ostringstream text;
  write_table(text, with_chosen_columns(table, printing, false),
              printing.format.empty() ? TableFormat::csv : chosen_format(printing.format));
  write_output(path, text.str());
}

void print_rows(const ModuliCommand& command, const ModuliTableOptions& options,
                const std::vector<ModuliRow>& rows) {
  const Table table = moduli_table(options, rows);
  if (command.output.empty() || command.output == "-")
    print_table(table, command.printing);
  else
    write_file(command.output, table, command.printing);
}

/// Computes the moduli of all states, one state after another, in this process alone.
int run_alone(const ModuliCommand& command, const ModuliTableOptions& options) {
  ModuliRows computation(options);
  std::vector<ModuliRow> rows;
  Table increments;
  const int code =
      for_each_state(command.files, [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
        require_moduli_of(file, any, options);
        if (!accepts_state(file, any, command.force, remarks)) return int{kVerificationFailed};
        std::vector<ModuliRow> computed = std::visit(
            [&](const auto& state) {
              return computation.of(file, state, options.increments ? &increments : nullptr, remarks);
            },
            any);
        const int outcome = accuracy_met(computed, options.accuracy) ? kDone : kNotConverged;
        std::ranges::move(computed, std::back_inserter(rows));
        return outcome;
      });
  if (options.increments) write_csv_unless_failed(command.increments, increments, code);
  print_rows(command, options, rows);
  return code;
}

/// Computes the moduli of all states, one state after another. All processes of mpirun compute each state together, and
/// the first process prints the table.
int run_together(const ModuliCommand& command, const ModuliTableOptions& options) {
  const std::unique_ptr<ParallelSolver> solver = load_parallel_solver();
  std::vector<ModuliRow> rows;
  const auto check = [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
    require_moduli_of(file, any, options);
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
                 "strains of the cell for which moduli are computed: diagonal (only extensions along the axes; "
                 "shear strains are held at zero) or full "
                 "(also shear strains; their moduli are then computed, too)")
      .one_of({"diagonal", "full"})
      .show_default();
  app.add_flag("--prestress", command->options.moduli.prestress,
               "include the geometric stiffness due to the contact forces (for disks and spheres, except the "
               "tangential force F_T); moduli are then derivatives of the Cauchy stress");
  const Option tolerance = app.add_option("--tolerance", command->options.moduli.tolerance,
                                          "required relative error of the moduli B and G; the achieved error "
                                          "is printed, with a warning if it is larger")
                               .show_default();
  const Option method =
      app.add_option(
             "--method", command->method,
             "method by which moduli are computed. factor: Cholesky factor of the stiffness matrix in double "
             "precision; single-factor: Cholesky "
             "factor in single precision, with iterative refinement; iterative: conjugate gradients to the "
             "accuracy of "
             "--tolerance, started from the solution of the previous state; bounds: mean of the lower "
             "and upper bounds of the moduli. The last three methods are approximate; their errors are printed")
          .one_of({"factor", "single-factor", "iterative", "bounds"})
          .show_default();
  // The option --accuracy selects the method and its tolerance, so it excludes the options --method and --tolerance.
  const Option accuracy =
      app.add_option("--accuracy", command->accuracy,
                     "X, or B=X,G=X: largest acceptable relative errors of both moduli, or of B and G; the "
                     "cheapest method that achieves them is used and named in the column method")
          .delimiter(',')
          .excludes(method)
          .excludes(tolerance)
          .one_argument_each();
  app.add_option("--force-tolerance", command->options.moduli.force_tolerance,
                 "in packings without cohesion, largest normal force that counts as none in the search for "
                 "rattlers, which "
                 "are left out with all their contacts; in units of max(F0, P a^(d-1)) (F0: pull-off force, P: "
                 "pressure, a: largest diameter, d: dimension)")
      .show_default();
  app.add_option("--rolling-stiffness", command->options.rolling_stiffness,
                 "rolling stiffness K_R to use for all touching contacts, in place of the rolling stiffness in "
                 "the state "
                 "(force * length); one row is printed for each value")
      .delimiter(',')
      .excludes(method)
      .excludes(accuracy)
      .one_argument_each();
  app.add_option("--kn", command->options.kn,
                 "for rigid grains, whose contacts have no stiffness: normal stiffness K_N of each "
                 "contact point, or of each pair with --stiffness-per contact (force/length)");
  app.add_option("--kt", command->options.kt,
                 "for rigid grains with friction: tangential stiffness K_T of each contact point, or of each "
                 "pair (force/length)");
  app.add_option(
         "--stiffness-per", command->stiffness_per,
         "what has the stiffnesses --kn and --kt: each contact point, or the contact of each pair of grains, "
         "whose contact points then have equal shares")
      .one_of({"point", "contact"})
      .show_default();
  app.add_option(
      "--increments", command->increments,
      "csv file to write, with one row per contact: increments of the contact forces per unit of isotropic "
      "and of deviatoric stress, the elastic energy of these increments, the rank of the contact by this "
      "energy, and whether the contact "
      "is a dead end or part of a backbone");
  app.add_flag("--force", command->force, "accept states that are not in equilibrium [they are rejected]");
  app.add_option(
         "--solver", command->solver,
         "linear solver. cholmod: Cholesky factorization; petsc: iterative solver, which needs less memory and "
         "can run on all "
         "processes of mpirun; automatic: cholmod if its Cholesky factor fits into memory, otherwise petsc")
      .one_of({"automatic", "cholmod", "petsc"})
      .show_default();
  // The unit of command->memory is GB. The function options_of() converts it to bytes, the unit of
  // ModuliTableOptions::memory.
  app.add_option(
         "--memory", command->memory,
         "with --solver automatic, petsc is used if a Cholesky factor would need more memory than this (GB) "
         "[0.7 of the free memory]")
      .positive();
  app.add_option("-o,--output", command->output,
                 "write the table to this file instead of stdout; the file is written completely or not at all "
                 "(useful with mpirun, which does not report a full disk)");
  add_printing_options(app, command->printing);
  return {app, [command] { return run_moduli(*command); }};
}

}  // namespace floc
