#pragma once

#include <string>
#include <vector>

#include "floc/loading/run.h"

namespace floc {

/// A table in the directory of a run whose rows are recorded while the packing moves. A run that is resumed keeps the
/// rows up to the point from which it continues.
template <int Dim>
class MotionTable {
 public:
  virtual ~MotionTable() = default;

  /// Records the equilibrium at the end of a step; the next step begins with it.
  virtual void finish_step(const Run<Dim>& run) = 0;

  /// Rewrites the whole file. @throws IoError if it cannot be written
  void write() const;

 protected:
  /// @param header  columns; the first are step, branch, P and time (since the beginning of the run)
  /// @throws InputError if the file exists and is not such a table
  MotionTable(std::string file, std::string header, const RunPoint& point);

  void add_row(std::string row) { rows_.push_back(std::move(row)); }
  /// Returns "step,branch,P" of the present step of a run.
  static std::string place_of(const Run<Dim>& run);
  /// Returns the last row of the table when the run was resumed; empty for a new run.
  std::string last_row() const { return rows_.empty() ? "" : rows_.back(); }

 private:
  void read_rows(const RunPoint& point);

  std::string file_, header_;
  std::vector<std::string> rows_;
};

}  // namespace floc
