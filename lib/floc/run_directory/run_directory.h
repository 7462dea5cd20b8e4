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

/// Point from which a run continues, and the packing at this point.
template <int Dim>
struct ReachedPoint {
  RunPoint point;
  Packing<Dim> packing;
};

/// The directory of one run, with the files DIR/state-NNNN.h5, DIR/path.csv and DIR/checkpoint/. Every file is replaced
/// as a whole, in an order that allows a run to be resumed even if it was killed at any moment. While this object
/// exists, no other process of floc writes into the directory.
class RunDirectory {
 public:
  /// Opens the directory, or creates it. With Existing::overwrite, the files of an earlier run are removed.
  /// @throws InputError if another process writes into the directory, if it contains a run and `existing` is
  /// Existing::refuse, or if it contains the run of another scene or states that do not belong together
  /// @throws IoError if it cannot be written
  RunDirectory(const std::string& path, Existing existing, const RunOptions& options);

  /// Returns the point that an earlier run reached in this directory: its checkpoint, or the last saved state if that
  /// is further. Returns std::nullopt for a new run. Adds rows missing in path.csv, in case the run was killed after
  /// saving a state and before writing its row.
  /// @pre Dim is the dimension of the run
  template <int Dim>
  std::optional<ReachedPoint<Dim>> resume_point();

  /// Saves an equilibrium as a state file, and its row of path.csv.
  /// @param seconds  wall time of its step (s); if absent, this cell of the row stays empty
  /// @return SHA-256 of the state file
  template <int Dim>
  std::string save(const State<Dim>& state, std::optional<double> seconds);
  template <int Dim>
  void save_checkpoint(const State<Dim>& state, const RunPoint& point);
  void remove_checkpoint();
  /// Checks that the directory is still locked. This function must be called before other files are written into the
  /// directory.
  /// @throws IoError if the path now leads to another directory
  void require_held() const { claim_.require_held(); }

  std::string state_path(int step) const;
  std::string path_table() const;
  std::string contact_table() const;
  std::string energy_table() const;
  /// Returns the packing at the beginning of a step, which is the equilibrium of the previous step. @pre the previous
  /// equilibrium is saved
  template <int Dim>
  Packing<Dim> start_of(int step) const;

 private:
  int count_states() const;
  void check_scene(const std::string& file, const RunOptions& options) const;
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
  std::map<int, std::string> rows_;  ///< lines of path.csv by the number of the step
  /// sides of the cell (length) by step, for the states that were read or saved so far
  std::map<int, std::vector<double>> sides_;
};

}  // namespace floc
