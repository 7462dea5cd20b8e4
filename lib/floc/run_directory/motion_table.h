#pragma once

#include <string>
#include <vector>

#include "floc/loading/run.h"

namespace floc {

/// A table in the directory of a run whose rows are recorded while the packing moves. A run that is resumed
/// keeps the rows up to the point from which it goes on.
template <int Dim>
class MotionTable {
 public:
  virtual ~MotionTable() = default;

  /// Takes in the equilibrium that a step ended with: the next one begins with it.
  virtual void finish_step(const Run<Dim>& run) = 0;

  /// Writes the file anew. @throws IoError if it cannot be written
  void write() const;

 protected:
  /// @param header  columns; the first are step, branch, P and time (since the beginning of the run)
  /// @throws InputError if the file is there and is not such a table
  MotionTable(std::string file, std::string header, const RunPoint& point);

  void add_row(std::string row) { rows_.push_back(std::move(row)); }
  /// "step,branch,P" of the step that a run is in.
  static std::string place_of(const Run<Dim>& run);
  /// The row that the table ended with when the run was resumed; empty for a new one.
  std::string last_row() const { return rows_.empty() ? "" : rows_.back(); }

 private:
  void read_rows(const RunPoint& point);

  std::string file_, header_;
  std::vector<std::string> rows_;
};

}  // namespace floc
