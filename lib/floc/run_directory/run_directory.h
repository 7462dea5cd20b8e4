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

/// The point that a run goes on from.
template <int Dim>
struct ReachedPoint {
  RunPoint point;
  Packing<Dim> packing;
};

/// The directory of one run: DIR/state-NNNN.h5, DIR/path.csv and DIR/checkpoint/. Every file is replaced whole,
/// and in an order that lets a run be resumed after being killed at any moment. While this object exists, no
/// other process writes into the directory.
class RunDirectory {
 public:
  /// Opens or makes the directory; with `overwrite`, removes what an earlier run left.
  /// @throws InputError if another process writes into it, if it holds a run and neither resume nor overwrite
  /// was asked for, or if it holds another scene's run or states that do not belong together
  /// @throws IoError if it cannot be written
  RunDirectory(const std::string& path, Existing existing, const RunOptions& options);

  /// Where an earlier run got to: its checkpoint, or the last saved state if that is further.
  /// Completes path.csv where the run was killed between saving a state and its row. Empty for a new run.
  /// @pre Dim is the dimension of the run
  template <int Dim>
  std::optional<ReachedPoint<Dim>> resume_point();

  /// Saves an equilibrium and its row. @param seconds  that it took; none: the row leaves them out
  /// @return SHA-256 of the state's file
  template <int Dim>
  std::string save(const State<Dim>& state, std::optional<double> seconds);
  template <int Dim>
  void save_checkpoint(const State<Dim>& state, const RunPoint& point);
  void remove_checkpoint();
  /// To be called before anything else is written into it. @throws IoError if the path leads to another directory now
  void require_held() const { claim_.require_held(); }

  std::string state_path(int step) const;
  std::string path_table() const;
  std::string contact_table() const;
  std::string energy_table() const;
  /// The packing that a step begins with: the equilibrium before it. @pre it is saved
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
  std::map<int, std::vector<double>> sides_;  ///< of the cell (length), of the states seen so far
};

}  // namespace floc
