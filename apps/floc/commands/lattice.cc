#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>

#include "commands/lattice_arguments.h"
#include "commands/lattice_command.h"
#include "commands/lattice_files.h"
#include "floc/base/error.h"
#include "floc/base/free_memory.h"
#include "floc/base/seconds_since.h"
#include "floc/base/sha256.h"
#include "floc/base/version.h"
#include "floc/elasticity/elastic_response.h"
#include "floc/elasticity/force_increments.h"
#include "floc/lattice/grain_forces.h"
#include "floc/lattice/irregular_lattice.h"
#include "floc/lattice/lattice_packing.h"
#include "floc/network/contact_network.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/tables/lattice_row.h"
#include "process/output.h"
#include "process/output_files.h"
#include "process/printing.h"

namespace floc {
namespace {

using Clock = std::chrono::steady_clock;

void say(const std::string& line) {
  std::cerr << line << '\n';
}

/// Smallest number of nodes per mean grain diameter for which no warning is printed. With fewer nodes, the
/// computed moduli and forces have errors of several per cent.
constexpr double kCoarse = 8.0;
/// Largest number of lattice nodes of a sample that --strength breaks without the option --yes.
constexpr int kBrokenUnasked = 20000;

/// Returns the memory (bytes) that the solution of a lattice is expected to take. The formulas are measured values with
/// a margin. For 1e5 nodes, 2.5 kB per node were measured in 2D, and 2.3 kB in 3D. In 2D the memory of the Cholesky
/// factor per node grows with the logarithm of the number of nodes.
double expected_memory(int dimension, double n_nodes) {
  if (dimension == 3) return 2600.0 * n_nodes;
  return n_nodes * (1600.0 + 90.0 * std::log2(std::max(n_nodes, 2.0)));
}

void refuse_too_large(int dimension, double n_nodes) {
  const double needed = expected_memory(dimension, n_nodes);
  const double available = free_memory();
  if (needed <= available) return;
  throw InputError("floc lattice",
                   fmt::format("a lattice of {:.3g} nodes takes about {:.1f} GB of memory, but only {:.1f} GB "
                               "are free: give a larger --spacing or a smaller --per-diameter",
                               n_nodes, needed / 1e9, available / 1e9));
}

template <int Dim>
Lattice<Dim> make_lattice(const LatticeArguments& arguments, const Packing<Dim>& packing, double spacing) {
  const double n_nodes = packing.cell.volume() / (std::pow(spacing, Dim) * (Dim == 2 ? 0.8660254 : 1.0));
  refuse_too_large(Dim, n_nodes);
  if constexpr (Dim == 2) {
    return triangular_lattice_in(packing.cell, spacing);
  } else {
    const IrregularLatticeOptions options{spacing, arguments.jitter, arguments.seed};
    if (const auto faults = options.validate(); !faults.empty())
      throw InputError("floc lattice", faults.front());
    return irregular_lattice(packing.cell, options);
  }
}

template <int Dim>
CementedSample<Dim> make_sample(const LatticeArguments& arguments, const Packing<Dim>& packing,
                                LatticeRow& row) {
  const double diameter = mean_diameter(packing.grains.radius);
  const double spacing =
      arguments.spacing.value_or(diameter / arguments.per_diameter.value_or(Dim == 2 ? 15.0 : 6.5));
  const CementOptions options{arguments.matrix, arguments.bridge_gap};
  if (const auto faults = options.validate(); !faults.empty()) throw InputError("floc lattice", faults.front());
  CementedSample<Dim> sample = cement(packing, make_lattice(arguments, packing, spacing), options);
  row.n_nodes = sample.lattice.n_nodes();
  row.spacing = sample.lattice.spacing;
  row.nodes_a_diameter = sample.mean_diameter / sample.lattice.spacing;
  row.fit_strain = sample.strain;
  row.grain_content = sample.grain_content;
  row.matrix_content = sample.matrix_content;
  row.bridge_width = sample.bridge_width;
  row.n_bridges = sample.n_bridges;
  if (row.nodes_a_diameter < kCoarse)
    say(fmt::format(
        "floc: warning: a lattice with {:.1f} nodes per mean grain diameter is coarse: even with 9 nodes, "
        "Young's modulus is 12 % too low, and the forces between grains have a correlation "
        "coefficient of 0.95 with those of a fine lattice; give --per-diameter 15 for forces "
        "and moduli, and 35 for the tails of the stress distribution",
        row.nodes_a_diameter));
  return sample;
}

template <int Dim>
LatticeNetwork<Dim> make_network(const LatticeArguments& arguments, const CementedSample<Dim>& sample,
                                 const ElementStiffness& stiffness, LatticeRow& row) {
  LatticeNetwork<Dim> network = lattice_network(sample, stiffness, boundary_of(arguments), row.axis);
  if (network.n_directions < Dim)
    throw InputError(
        "floc lattice",
        fmt::format("the sample cannot carry a load, because its grains and matrix {}; give a larger --matrix "
                    "or --bridge-gap to connect "
                    "more grains",
                    boundary_of(arguments) != LatticeBoundary::periodic
                        ? std::string("do not connect the boundaries of the sample")
                        : fmt::format("are connected across the cell along only {} of {} directions",
                                      network.n_directions, Dim)));
  row.n_elements = static_cast<std::int64_t>(network.elements.size());
  row.n_removed = network.n_removed;
  row.n_islands = network.n_islands;
  row.n_bare = network.count(ElementKind::bare);
  row.k_grain = stiffness.grain;
  row.k_matrix = stiffness.matrix;
  row.k_interface = stiffness.of(ElementKind::interface);
  row.k_contact = stiffness.of(ElementKind::bare);
  return network;
}

/// Returns the settings of the solver of the lattice.
/// @param telling  whether the progress of the solver is printed. The settings keep a reference to this variable: the
/// caller may change the variable later, and must keep it as long as the settings exist
template <int Dim>
RelaxationSettings settings_of(const LatticeArguments& arguments, const bool& telling) {
  RelaxationSettings settings;
  settings.tolerance = arguments.tolerance.value_or(Dim == 2 ? 1e-10 : 1e-9);
  settings.observe = [&telling](const RelaxationRound& r) {
    if (!telling) return;
    say(
        fmt::format("round {} of the solver: {} contacts between grains without matrix are open, {} opened or "
                    "closed in this round, {} steps of "
                    "conjugate gradients{}; imbalance of the forces divided by the load: {:.1e}",
                    r.round, r.n_open, r.n_changed, r.n_steps, r.factorized ? " with a new factorization" : "",
                    r.imbalance));
  };
  return settings;
}

/// Returns the normal forces that the contacts of a packing would carry under a load if all contacts were elastic beams
/// of equal stiffness. `floc lattice` compares the forces between the grains of its lattice with those of this simple
/// model.
/// @param width  width of the beams (length)
template <int Dim>
std::vector<double> bonded_forces(const Packing<Dim>& packing, const LatticeLoad<Dim>& load, double width) {
  ContactNetwork<Dim> network = contact_network(packing);
  for (NetworkContact<Dim>& c : network.contacts) {
    c.kn = c.kt = 1.0;
    c.kr = width * width / 12.0;
  }
  const ElasticResponse response = elastic_response(network, {.strains = StrainSet::full});
  const Eigen::VectorXd strain = (response.relaxed / network.volume).ldlt().solve(Eigen::VectorXd(load.value));
  std::vector<double> normal;
  for (const ForceIncrement<Dim>& f : force_increments(network, response, strain)) normal.push_back(f.normal);
  return normal;
}

template <int Dim>
std::vector<double> normal_forces(const std::vector<Contact<Dim>>& contacts) {
  std::vector<double> normal;
  for (const Contact<Dim>& c : contacts) normal.push_back(c.normal_force);
  return normal;
}

/// Reads the state of --compare.
/// @throws InputError if the grains of this state are not those of the lattice
template <int Dim>
Packing<Dim> packing_to_compare(const LatticeArguments& arguments, const Packing<Dim>& packing) {
  const AnyState other = read_state(arguments.compare);
  const State<Dim>* same = std::get_if<State<Dim>>(&other);
  const int n = packing.grains.size();
  bool equal = same != nullptr && same->packing.grains.size() == n;
  if (equal) {
    /// Largest relative difference between the radii of a grain in the two states. States that floc lattice has written
    /// differ more, but by the same factor for all grains, because the packing was fitted to the lattice.
    constexpr double kDifferent = 1e-6;
    const std::vector<double>& here = packing.grains.radius;
    const std::vector<double>& there = same->packing.grains.radius;
    const double factor = mean_diameter(there) / mean_diameter(here);
    for (int i = 0; i < n; ++i)
      equal = equal && std::abs(there[i] - factor * here[i]) <= kDifferent * factor * here[i];
  }
  if (!equal)
    throw InputError(arguments.compare,
                     fmt::format("this state, given with --compare, does not have the grains of the lattice: "
                                 "expected a state of the same {} grains in {}D, with the same radii",
                                 n, Dim));
  return same->packing;
}

/// Computes the normal forces between the grains, and their correlation with the forces of equal beams (see
/// bonded_forces()). If --compare names a state, also computes their correlation with the contact forces of that state.
/// @param other     packing of the state of --compare, if any
/// @param sign      1 if the load is compressive, -1 if it is tensile
/// @param rounding  magnitude below which the stress of a node is a rounding error (stress)
/// @return the packing of the grains, with the computed forces as contact forces
template <int Dim>
Packing<Dim> add_grain_forces(const LatticeArguments& arguments, const State<Dim>& state,
                              const std::optional<Packing<Dim>>& other, const LatticeLoad<Dim>& load,
                              LoadedSample<Dim>& loaded, double sign, double rounding, LatticeRow& row) {
  const auto forces = grain_forces(loaded.sample, loaded.network, loaded.solution);
  row.n_pairs = static_cast<int>(forces.size());
  for (const GrainForce<Dim>& f : forces) loaded.pair_force.push_back(f.normal);
  row.forces =
      stress_distribution(loaded.pair_force, sign, rounding * std::pow(loaded.sample.mean_diameter, Dim - 1));
  Packing<Dim> grains = packing_of(loaded.sample, state.packing, forces);
  if (boundary_of(arguments) == LatticeBoundary::periodic && !load.imposed.any()) {
    const double width = loaded.sample.bridge_width * 0.5 * loaded.sample.mean_diameter;
    const std::vector<double> bonded = bonded_forces(grains, load, std::max(width, row.spacing));
    row.pearson_bonded = agreement(forces, grains.contacts, bonded).pearson;
  }
  if (other) {
    const std::vector<Contact<Dim>> contacts = contacts_in_images_of(loaded.sample, *other);
    const ForceAgreement of_state = agreement(forces, contacts, normal_forces(contacts));
    // Smallest accepted share of the contacts of the other state between grains that the lattice joins, too. Another
    // packing of equal grains has hardly any such contacts.
    constexpr double kSmallestCommon = 0.1;
    if (of_state.n_common < kSmallestCommon * static_cast<double>(contacts.size()))
      throw InputError(
          arguments.compare,
          fmt::format("this state, given with --compare, is another packing: only {} of its {} contacts "
                      "join grains between which the lattice has a force",
                      of_state.n_common, contacts.size()));
    row.pearson_state = of_state.pearson;
    row.n_compared = of_state.n_common;
  }
  return grains;
}

template <int Dim>
void write_packing(const std::string& path, const LatticeArguments& arguments, const State<Dim>& from,
                   Packing<Dim> packing, const char* branch) {
  State<Dim> state;
  state.units = from.units;
  state.packing = std::move(packing);
  state.target_stress = static_stress(state.packing).diagonal();
  state.path.branch = branch;
  state.provenance = from.provenance;
  state.provenance.program = "floc " + version();
  state.provenance.commit = commit();
  if (arguments.file != "-") state.provenance.parent_sha256 = sha256_of_file(arguments.file);
  measure(state);
  write_once(path, [&] { write_state(path, state); });
}

/// Returns bounds of the bulk and shear moduli of a sample of grains, matrix and voids. The bounds follow from the
/// volume fractions and the moduli of these phases. The moduli of a phase are those of a lattice in which all elements
/// have the stiffness of this phase. In 2D, closed formulas for the triangular lattice give the moduli. In 3D, the
/// lattice of the sample is solved with a single stiffness.
template <int Dim>
CompositeBounds bounds_of(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                          const RelaxationSettings& settings) {
  const double voids = 1.0 - sample.grain_content - sample.matrix_content;
  ElasticPhase unit{1.0, 0.0, 0.0};
  if constexpr (Dim == 2) {
    unit = triangular_moduli(1.0, 1.0, stiffness.shear);
    if (stiffness.by_facet) unit.K /= std::sqrt(3.0), unit.G /= std::sqrt(3.0);
  } else {
    CementedSample<Dim> whole = sample;
    whole.phase.assign(whole.phase.size(), Phase::matrix);
    ElementStiffness one = stiffness;
    one.matrix = 1.0;
    const LatticeNetwork<Dim> network = lattice_network(whole, one);
    RelaxationSettings quiet = settings;
    quiet.observe = {};
    LatticeSolver<Dim> solver(network, quiet);
    LatticeLoad<Dim> none;
    none.imposed.setConstant(true);
    (void)solver.solve(none);
    const Eigen::MatrixXd C = solver.moduli();
    unit.K = C.topLeftCorner(Dim, Dim).mean();
    unit.G = C.diagonal().tail(kSymmetric<Dim> - Dim).mean();
  }
  return composite_bounds({{sample.grain_content, stiffness.grain * unit.K, stiffness.grain * unit.G},
                           {sample.matrix_content, stiffness.matrix * unit.K, stiffness.matrix * unit.G},
                           {std::max(voids, 0.0), 0.0, 0.0}},
                          Dim);
}

/// Refuses to break a sample of more than kBrokenUnasked nodes without --yes. Breaking can take long, because each
/// broken element needs a new solution of the lattice.
/// @throws InputError that gives the expected wall time, if --yes is missing
void refuse_long_breaking(const LatticeArguments& arguments, const LatticeRow& row) {
  if (arguments.strength.empty() || arguments.yes || row.n_nodes <= kBrokenUnasked) return;
  /// Two estimates from which the expected time follows: the number of elements that break before the stress has
  /// fallen, divided by the number of nodes along a side of the sample; and the time of one solution, divided by the
  /// number of nodes (s).
  constexpr double kBrokenAcross = 10.0, kSecondsPerNode = 1e-5;
  const auto n = static_cast<double>(row.n_nodes);
  const double minutes = kBrokenAcross * std::pow(n, 1.0 - 1.0 / row.dimension) * kSecondsPerNode * n / 60.0;
  throw InputError("floc lattice",
                   fmt::format("breaking a sample of {} lattice nodes takes about {:.0f} minutes, to "
                               "within a factor of three: give --yes to break the sample nevertheless",
                               row.n_nodes, std::max(1.0, minutes)));
}

template <int Dim>
void break_sample(const LatticeArguments& arguments, const LatticeLoad<Dim>& load, LatticeSolver<Dim>& solver,
                  const LoadedSample<Dim>& loaded, LatticeRow& row) {
  FractureOptions options;
  options.strength = strength_of(arguments);
  options.end_at = arguments.end_at;
  auto last = Clock::now();
  options.observe = [&last](const Breakage& b, int n) {
    if (seconds_since(last) > 2.0) {
      say(fmt::format("{} elements have broken so far; the last one broke at strain {:.4g} and stress {:.4g}",
                      n, b.strain, b.stress));
      last = Clock::now();
    }
    return true;
  };
  row.fracture = fracture(loaded.network, solver, load, row.axis, options);
  say(fmt::format("{} elements broke; reason for the end: {}", row.fracture->broken.size(), row.fracture->end));
}

template <int Dim>
void describe(const LatticeArguments& arguments, const State<Dim>& state, LatticeRow& row) {
  row.file = arguments.file;
  row.dimension = Dim;
  row.n_grains = state.packing.grains.size();
  row.axis = axis_of(arguments, Dim);
  row.load = arguments.load;
  row.boundary = arguments.boundary;
}

/// Returns the magnitude below which the stress of a node is a rounding error. It is a share of the stress of the cell,
/// and larger if the tolerance of the solution is large.
template <int Dim>
double rounding_stress(const LatticeSolution<Dim>& solution) {
  /// Margin between the imbalance of a solution, divided by the load, and the errors of single nodes.
  constexpr double kErrorOfImbalance = 10.0;
  return std::max(kRoundingShare, kErrorOfImbalance * solution.report.imbalance) *
         solution.stress.cwiseAbs().maxCoeff();
}

/// Warns that a state cannot contain the points at which the forces of elements act, if these are not the middles of
/// the elements.
template <int Dim>
void warn_of_arms(const LatticeArguments& arguments, const ElementStiffness& stiffness) {
  if (Dim == 2 || stiffness.central() || arguments.output.empty()) return;
  say(fmt::format(
      "floc: warning: the forces of elements with --shear act at the centres of the facets between the "
      "nodes in 3D, and a state cannot contain these points: in {} the moments on the nodes are not "
      "balanced, and floc moduli refuses it; give --moduli for the moduli of the lattice",
      arguments.output));
}

template <int Dim>
int run_lattice(const LatticeArguments& arguments, const State<Dim>& state) {
  const auto start = Clock::now();
  LatticeRow row;
  describe(arguments, state, row);
  const LatticeLoad<Dim> load = load_of<Dim>(arguments);
  const ElementStiffness stiffness = stiffness_of(arguments);
  // The options --strength and --compare and those of the pictures are used only after the solution. They are checked
  // before the solution, because the solution can take minutes.
  if (!arguments.strength.empty()) (void)strength_of(arguments);
  check_lattice_pictures(arguments, state.packing.cell);
  std::optional<Packing<Dim>> other;
  if (!arguments.compare.empty()) other = packing_to_compare(arguments, state.packing);
  if (arguments.moduli && is_between_plates(arguments))
    throw InputError(
        "floc lattice",
        fmt::format("a sample between plates has only one modulus, E along their axis, because its other "
                    "sides are free: give --moduli without --boundary {}",
                    arguments.boundary));
  const CementedSample<Dim> sample = make_sample(arguments, state.packing, row);
  const LatticeNetwork<Dim> network = make_network(arguments, sample, stiffness, row);
  refuse_long_breaking(arguments, row);
  bool telling = true;
  const RelaxationSettings settings = settings_of<Dim>(arguments, telling);
  LatticeSolver<Dim> solver(network, settings, boundary_of(arguments), row.axis);
  row.n_unknowns = solver.n_unknowns();
  row.seconds_lattice = seconds_since(start);
  say(
      fmt::format("lattice of {} nodes, {} elements and {} unknowns; volume fractions: grains rho_p = {:.4f}, "
                  "matrix rho_m = {:.4f}; {:.1f} nodes per mean grain diameter",
                  row.n_nodes, row.n_elements, row.n_unknowns, row.grain_content, row.matrix_content,
                  row.nodes_a_diameter));

  const auto solving = Clock::now();
  const LatticeSolution<Dim> solution = solver.solve(load);
  row.seconds_solve = seconds_since(solving);
  row.report = solution.report;
  row.n_open = solution.n_open();
  row.strain.assign(solution.strain.begin(), solution.strain.end());
  row.stress.assign(solution.stress.begin(), solution.stress.end());
  row.loaded_along_axis = measured_component(load, row.axis) == row.axis;
  // If the solution has not converged, its stresses are not valid: the row of the table is printed, but no other file
  // is written.
  if (!solution.report.holds || !solution.report.converged) {
    say(solution.report.holds
            ? fmt::format("floc: {}: the solution has not converged: the forces on the nodes "
                          "are out of balance by {:.1e} of the load",
                          arguments.file, solution.report.imbalance)
            : fmt::format(
                  "floc: {}: the sample cannot carry this load: contacts between grains without matrix (bare "
                  "contacts) open until parts of the sample move freely, or are held by less than 1e-8 of the "
                  "stiffness of the elements",
                  arguments.file));
    row.seconds = seconds_since(start);
    print_table(table_of(row), arguments.printing);
    return kNotConverged;
  }
  LoadedSample<Dim> loaded{sample, network, solution, node_stress(sample.lattice, network, solution), {}};
  // Stresses with the sign of the load are positive in the distributions, both for compression and for tension.
  // If the load has no stress along the axis, the sign is that of compression.
  const double rounding = rounding_stress(solution);
  const double sign = solution.stress[row.axis] < -rounding ? -1.0 : 1.0;
  row.all = stress_distribution(stresses_of(loaded, row.axis, std::nullopt), sign, rounding);
  row.grain = stress_distribution(stresses_of(loaded, row.axis, Phase::grain), sign, rounding);
  row.matrix = stress_distribution(stresses_of(loaded, row.axis, Phase::matrix), sign, rounding);
  Packing<Dim> grains = add_grain_forces(arguments, state, other, load, loaded, sign, rounding, row);
  if (arguments.moduli) {
    row.moduli = solver.moduli();
    row.bounds = bounds_of(sample, stiffness, settings);
    row.bounds_hold = bounds_that_hold(network, stiffness, row.n_open);
  }
  if (!arguments.forces.empty())
    write_packing(arguments.forces, arguments, state, std::move(grains), "lattice-forces");
  if (!arguments.output.empty())
    write_packing(arguments.output, arguments, state, packing_of(sample.lattice, network, solution), "lattice");
  warn_of_arms<Dim>(arguments, stiffness);
  write_lattice_files(arguments, row, loaded);
  if (!arguments.strength.empty()) {
    // The solver computes a new solution after each broken element. The rounds of the solver are no longer printed,
    // because break_sample() prints how many elements have broken.
    telling = false;
    break_sample(arguments, load, solver, loaded, row);
    write_fracture_files(arguments, row, loaded);
  }
  row.seconds = seconds_since(start);
  print_table(table_of(row), arguments.printing);
  return kDone;
}

}  // namespace

Command add_lattice(CommandLine program) {
  CommandLine app = program.add_subcommand("lattice",
                                           "Compute the stresses in cemented grains (a saved packing with a "
                                           "solid matrix), modelled as a lattice of elastic elements");
  const auto arguments = std::make_shared<LatticeArguments>();
  add_lattice_options(app, *arguments);
  return {app, [arguments] {
            return for_each_state(
                {arguments->file}, [&](const std::string&, const AnyState& any, const Remarks&) {
                  return std::visit([&](const auto& state) { return run_lattice(*arguments, state); }, any);
                });
          }};
}

}  // namespace floc
