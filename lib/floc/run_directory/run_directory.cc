#include "floc/run_directory/run_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/base/sha256.h"
#include "floc/io/atomic_file.h"
#include "floc/run_directory/checkpoint.h"
#include "floc/run_directory/path_row.h"
#include "floc/scene/scene_changes.h"

namespace floc {
namespace fs = std::filesystem;
namespace {

/// Returns the number of cells in a row of a CSV table. A comma within quotation marks, as in the name of a branch,
/// does not separate cells.
int n_cells(const std::string& row) {
  int n = 1;
  bool quoted = false;
  for (const char c : row) {
    quoted ^= c == '"';
    n += c == ',' && !quoted;
  }
  return n;
}

/// Reads a state of a run from its file. @throws InputError if the state does not have Dim dimensions
template <int Dim>
State<Dim> read_run_state(const std::string& file) {
  AnyState any = read_state(file);
  if (State<Dim>* state = std::get_if<State<Dim>>(&any)) return std::move(*state);
  throw InputError(file, fmt::format("this state has dimension {}: expected a state of a run in {}D",
                                     Dim == 2 ? 3 : 2, Dim));
}

/// Returns whether two stresses, lengths or strains are equal up to rounding. A tolerance is needed because the load of
/// a step is computed from other numbers if its stage has been lengthened.
bool same_load(double a, double b) {
  constexpr double kRounding = 1e-9;
  return std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b));
}

/// Returns whether the load of a state equals the load of a planned equilibrium.
template <int Dim>
bool is_load_of(const PlannedEquilibrium& planned, const State<Dim>& state) {
  const StageReference& turn = state.path.turn;
  if (planned.branch != state.path.branch || planned.is_isotropic() != turn.empty()) return false;
  if (planned.is_isotropic()) return same_load(state.target_stress.mean(), planned.pressure);
  if (planned.axis != turn.axis || !same_load(planned.shear, turn.shear)) return false;
  const LoadTarget<Dim> load = load_target<Dim>(planned.axes, turn);
  for (int a = 0; a < Dim; ++a)
    if (!same_load(load.side[a], state.target_side[a]) ||
        (!load.strained(a) && !same_load(load.stress[a], state.target_stress[a])))
      return false;
  return true;
}

}  // namespace

RunDirectory::RunDirectory(const std::string& path, Existing existing, const RunOptions& options)
    : path_(path),
      claim_(path, existing, "run"),
      dimension_(options.dimension),
      boxed_(options.assembly.box.has_value()),
      rigid_(options.law.is_rigid()) {
  std::error_code failed;
  fs::create_directories(fs::path(path) / "checkpoint", failed);
  if (failed) throw IoError(path, "the directory cannot be created: " + failed.message());
  if (existing == Existing::overwrite) {
    for (const auto& [step, file] : numbered_states(path)) fs::remove(file);
    fs::remove(path_table());
    fs::remove(contact_table());
    fs::remove(energy_table());
    remove_checkpoint();
  }
  require_one_run(path);
  if (count_states() > 0) {
    check_scene(state_path(0), options);
    check_scene(state_path(count_states() - 1), options);
  } else if (fs::exists(checkpoint_path())) {
    check_scene(checkpoint_path(), options);
  }
}

void RunDirectory::check_scene(const std::string& file, const RunOptions& options) const {
  std::visit(
      [&](const auto& state) {
        const bool same_seed = state.provenance.seed == options.seed;
        if (same_seed && state.scene == options.text) return;
        if (same_seed && continues_path(options.text, state.scene)) return check_longer_path(options);
        throw InputError(file, fmt::format("this state was made with another scene or seed (the given seed "
                                           "is {}, and the seed of the state is {}): a run can only be "
                                           "continued with the scene, settings and seed with which it began, "
                                           "except that the load path may be longer",
                                           options.seed, state.provenance.seed));
      },
      read_state(file));
}

void RunDirectory::check_longer_path(const RunOptions& options) const {
  const std::vector<PlannedEquilibrium> plan =
      plan_run(options.assembly, options.law, options.load, options.dimension);
  std::vector<std::string> files;
  for (const auto& [step, file] : numbered_states(path_)) files.push_back(file);
  if (fs::exists(checkpoint_path())) files.push_back(checkpoint_path());
  for (const std::string& file : files)
    std::visit(
        [&](const auto& state) {
          const auto step = static_cast<std::size_t>(state.path.step);
          if (step >= plan.size() || !is_load_of(plan[step], state))
            throw InputError(file,
                             fmt::format("step {} of the load path in the scene differs from the step that "
                                         "made this state: a run can be continued with a longer load path "
                                         "only if the steps already made are unchanged; if the last stage is "
                                         "made longer, its steps must keep their size",
                                         step));
        },
        read_state(file));
}

std::string RunDirectory::state_path(int step) const {
  return state_file(path_, step);
}
std::string RunDirectory::path_table() const {
  return path_ + "/path.csv";
}
std::string RunDirectory::contact_table() const {
  return path_ + "/contacts.csv";
}
std::string RunDirectory::energy_table() const {
  return path_ + "/energy.csv";
}

template <int Dim>
Packing<Dim> RunDirectory::start_of(int step) const {
  return read_run_state<Dim>(state_path(step - 1)).packing;
}

std::string RunDirectory::checkpoint_path() const {
  return path_ + "/checkpoint/checkpoint.h5";
}

int RunDirectory::count_states() const {
  int n = 0;
  while (fs::exists(state_path(n))) ++n;
  return n;
}

template <int Dim>
std::optional<ReachedPoint<Dim>> RunDirectory::resume_point() {
  read_rows();
  std::optional<ReachedPoint<Dim>> reached;
  const int n_states = count_states();
  for (int step = 0; step < n_states; ++step) {
    if (rows_.contains(step) && step + 1 < n_states) continue;
    State<Dim> state = read_run_state<Dim>(state_path(step));
    // A row is missing if the run was killed before it wrote the row. In this case the wall time of the step is
    // unknown.
    if (!rows_.contains(step)) rows_[step] = row_of(state, std::nullopt);
    if (step + 1 == n_states)
      reached =
          ReachedPoint<Dim>{point_after(state, sha256_of_file(state_path(step))), std::move(state.packing)};
  }
  rows_.erase(rows_.lower_bound(n_states), rows_.end());
  if (n_states > 0) write_rows();
  if (fs::exists(checkpoint_path())) {
    RunPoint inside = parse_progress(read_progress(checkpoint_path()), checkpoint_path());
    if (inside.step >= n_states)
      reached = ReachedPoint<Dim>{std::move(inside), read_run_state<Dim>(checkpoint_path()).packing};
  }
  return reached;
}

/// Returns the sides of the cell (length) in the equilibrium with the number `step`. This equilibrium has been saved or
/// is being saved.
template <int Dim>
Vec<Dim> RunDirectory::sides_of(int step) {
  std::vector<double>& sides = sides_[step];
  if (sides.empty()) {
    const Mat<Dim> cell = read_run_state<Dim>(state_path(step)).packing.cell.matrix;
    for (int a = 0; a < Dim; ++a) sides.push_back(cell(a, a));
  }
  return Eigen::Map<const Vec<Dim>>(sides.data());
}

template <int Dim>
std::string RunDirectory::row_of(const State<Dim>& state, std::optional<double> seconds) {
  const int step = state.path.step;
  const Vec<Dim> sides = state.packing.cell.matrix.diagonal();
  sides_[step].assign(sides.begin(), sides.end());
  PathReference<Dim> reference{sides_of<Dim>(0), {}};
  if (step > 0) reference.sides_before = sides_of<Dim>(step - 1);
  return path_row(state, reference, seconds, fs::path(state_path(step)).filename());
}

template <int Dim>
std::string RunDirectory::save(const State<Dim>& state, std::optional<double> seconds) {
  require_held();
  const std::string file = state_path(state.path.step);
  write_state(file, state);
  rows_[state.path.step] = row_of(state, seconds);
  write_rows();
  return sha256_of_file(file);
}

template <int Dim>
void RunDirectory::save_checkpoint(const State<Dim>& state, const RunPoint& point) {
  require_held();
  write_state(checkpoint_path(), state, progress_text(point));
}

void RunDirectory::remove_checkpoint() {
  require_held();
  fs::remove(checkpoint_path());
}

void RunDirectory::read_rows() {
  if (!fs::exists(path_table())) return;
  std::istringstream in(read_file(path_table()));
  std::string line;
  if (!std::getline(in, line)) return;
  if (in.eof()) return;  // the first line, with the names of the columns, is incomplete: there are no rows
  if (line != path_header(dimension_, boxed_, rigid_))
    throw InputError(path_table() + ":1",
                     "the columns of this table differ from those that this version of floc writes: " + line);
  const int n_columns = n_cells(line);
  while (std::getline(in, line)) {
    int step = -1;
    std::istringstream first(line);
    // A row without a newline character, or with too few cells, is left out; it is then written again from its state
    // file.
    const bool whole = !in.eof() && n_cells(line) == n_columns;
    if (whole && first >> step && step >= 0) rows_[step] = line;
  }
}

void RunDirectory::write_rows() const {
  std::string text = path_header(dimension_, boxed_, rigid_) + "\n";
  for (const auto& [step, line] : rows_) text += line + "\n";
  write_bytes_atomically(path_table(), text);
}

#define FLOC_INSTANTIATE(Dim)                                                        \
  template std::optional<ReachedPoint<Dim>> RunDirectory::resume_point<Dim>();       \
  template std::string RunDirectory::save(const State<Dim>&, std::optional<double>); \
  template void RunDirectory::save_checkpoint(const State<Dim>&, const RunPoint&);   \
  template Packing<Dim> RunDirectory::start_of<Dim>(int) const;
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
