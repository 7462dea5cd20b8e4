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

/// Point from which a run continues, with its packing.
template <int Dim>
struct ReachedPoint {
  RunPoint point;
  Packing<Dim> packing;
};

/// The directory of one run: DIR/state-NNNN.h5, DIR/path.csv and DIR/checkpoint/. Every file is replaced as a whole,
/// in an order that allows a run to be resumed after it was killed at any moment. While this object exists, no other
/// process writes into the directory.
class RunDirectory {
 public:
  /// Opens or makes the directory; with `overwrite`, removes the files of an earlier run.
  /// @throws InputError if another process writes into it, if it holds a run and `existing` is refuse, or if it holds
  /// the run of another scene or states that do not belong together
  /// @throws IoError if it cannot be written
  RunDirectory(const std::string& path, Existing existing, const RunOptions& options);

  /// Returns the point that an earlier run reached: its checkpoint, or the last saved state if that is further.
  /// Completes path.csv if the run was killed between saving a state and its row. Empty for a new run.
  /// @pre Dim is the dimension of the run
  template <int Dim>
  std::optional<ReachedPoint<Dim>> resume_point();

  /// Saves an equilibrium and its row. @param seconds  wall time of its step (s); none: the cell stays empty
  /// @return SHA-256 of the file of the state
  template <int Dim>
  std::string save(const State<Dim>& state, std::optional<double> seconds);
  template <int Dim>
  void save_checkpoint(const State<Dim>& state, const RunPoint& point);
  void remove_checkpoint();
  /// Checks the lock; to be called before anything else is written into the directory.
  /// @throws IoError if the path now leads to another directory
  void require_held() const { claim_.require_held(); }

  std::string state_path(int step) const;
  std::string path_table() const;
  std::string contact_table() const;
  std::string energy_table() const;
  /// Returns the packing at the beginning of a step: the equilibrium before it. @pre that equilibrium is saved
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
  std::map<int, std::string> rows_;           ///< lines of path.csv by step
  std::map<int, std::vector<double>> sides_;  ///< sides of the cell (length) by step, for states read or saved
};

}  // namespace floc
