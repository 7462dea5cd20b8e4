#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/loading/run.h"
#include "floc/run_directory/directory_lock.h"
#include "floc/run_directory/one_run.h"

namespace floc {

/// Point at which a run continues, and the packing at this point.
template <int Dim>
struct ReachedPoint {
  RunPoint point;
  Packing<Dim> packing;
};

/// Directory DIR of one run, with the files DIR/state-NNNN.h5 (one for each equilibrium), DIR/path.csv (a table of the
/// equilibria) and DIR/checkpoint/checkpoint.h5. Files are always replaced as a whole, in an order that allows a run to
/// be resumed at whatever time it was killed. While this object exists, no other process of floc writes into the
/// directory.
class RunDirectory {
 public:
  /// Opens the directory of a run, or creates it. If `existing` is Existing::overwrite, the files of an earlier run in
  /// it are removed.
  /// @throws InputError if another process writes into the directory; if the directory contains a run and `existing` is
  /// Existing::refuse; or if it contains the run of another scene, or states of different runs
  /// @throws IoError if the directory cannot be written
  RunDirectory(const std::string& path, Existing existing, const RunOptions& options);

  /// Returns the point from which an earlier run in this directory continues: the checkpoint or the last saved state,
  /// whichever was reached later in the run. Returns std::nullopt if the directory contains no run. If the run was
  /// killed between saving a state and writing the row of this state into path.csv, this function adds the row.
  /// @pre Dim is the dimension of the run
  template <int Dim>
  std::optional<ReachedPoint<Dim>> resume_point();

  /// Saves an equilibrium: writes its state file and its row of path.csv.
  /// @param seconds  wall time since the previous equilibrium (s); if absent, the cell of the wall time in path.csv is
  /// empty
  /// @return SHA-256 checksum of the state file
  template <int Dim>
  std::string save(const State<Dim>& state, std::optional<double> seconds);
  template <int Dim>
  void save_checkpoint(const State<Dim>& state, const RunPoint& point);
  void remove_checkpoint();
  /// Checks that the path of the directory still refers to the locked directory. This function must be called before
  /// other files are written into the directory.
  /// @throws IoError if the path no longer refers to the locked directory
  void require_held() const { claim_.require_held(); }

  std::string state_path(int step) const;
  std::string path_table() const;
  std::string contact_table() const;
  std::string energy_table() const;
  /// Returns the packing at the beginning of a step, which is the saved equilibrium of the previous step. @pre step >
  /// 0, and this equilibrium is saved
  template <int Dim>
  Packing<Dim> start_of(int step) const;

 private:
  int count_states() const;
  void check_scene(const std::string& file, const RunOptions& options) const;
  /// Checks that the states and the checkpoint in the directory agree with the load path of `options`, which may have
  /// more steps.
  void check_longer_path(const RunOptions& options) const;
  template <int Dim>
  std::string row_of(const State<Dim>& state, std::optional<double> seconds);
  template <int Dim>
  Vec<Dim> sides_of(int step);
  void read_rows();
  void write_rows() const;
  std::string checkpoint_path() const;

  std::string path_;
  ClaimedDirectory claim_;
  int dimension_;
  bool boxed_;
  bool rigid_;
  std::map<int, std::string> rows_;  ///< rows of path.csv; the key is the number of the equilibrium
  /// sides of the cell (length) in each state that was read or saved so far; the key is the number of the state
  std::map<int, std::vector<double>> sides_;
};

}  // namespace floc
