#pragma once

#include <string>
#include <vector>

#include "floc/loading/run.h"

namespace floc {

/// A table in the directory of a run, to which rows are added while the packing moves. When a run is resumed, the rows
/// up to the point from which it continues are kept.
template <int Dim>
class MotionTable {
 public:
  virtual ~MotionTable() = default;

  /// Records the equilibrium at the end of a step, which is also the beginning of the next step.
  virtual void finish_step(const Run<Dim>& run) = 0;

  /// Writes the whole table into its file, replacing the file. @throws IoError if the file cannot be written
  void write() const;

 protected:
  /// @param header  names of the columns, of which the first are step, branch, P and time (since the beginning of the
  /// run)
  /// @param point  point of the run from which the table continues
  /// @throws InputError if the file exists and has other columns or an invalid time
  MotionTable(std::string file, std::string header, const RunPoint& point);

  void add_row(std::string row) { rows_.push_back(std::move(row)); }
  /// Returns the beginning of a row, "step,branch,P", for the present step of the load path of a run.
  static std::string place_of(const Run<Dim>& run);
  /// Returns the last row of the table, which is the last row before a run was resumed as long as no row has been
  /// added; an empty text if the table has no rows.
  std::string last_row() const { return rows_.empty() ? "" : rows_.back(); }

 private:
  void read_rows(const RunPoint& point);

  std::string file_, header_;
  std::vector<std::string> rows_;
};

}  // namespace floc
