#pragma once

#include <string>
#include <vector>

#include "floc/loading/run.h"

namespace floc {

/// Table in the directory of a run. Rows are added while the packing moves. A resumed run keeps the rows up to the time
/// from which it continues.
template <int Dim>
class MotionTable {
 public:
  virtual ~MotionTable() = default;

  /// Records the equilibrium at the end of a step. The next step begins from this equilibrium.
  virtual void finish_step(const Run<Dim>& run) = 0;

  /// Writes the table into its file, replacing the whole file. @throws IoError if the file cannot be written
  void write() const;

 protected:
  /// @param file  file of the table; if it exists, its rows up to the time of `point` are kept
  /// @param header  names of the columns, separated by commas; the first four are step, branch, P and time (since the
  /// beginning of the run)
  /// @param point  point of the run from which the table continues
  /// @throws InputError if the file exists and has other columns than `header`, or a time that is not a number
  MotionTable(std::string file, std::string header, const RunPoint& point);

  void add_row(std::string row) { rows_.push_back(std::move(row)); }
  /// Returns the first cells of a row, "step,branch,P", for the present step of a run.
  static std::string place_of(const Run<Dim>& run);
  /// Returns the last row of the table; an empty text if there are no rows. Just after a run has been resumed, this is
  /// the last row that was kept.
  std::string last_row() const { return rows_.empty() ? "" : rows_.back(); }

 private:
  void read_rows(const RunPoint& point);

  std::string file_, header_;
  std::vector<std::string> rows_;
};

}  // namespace floc
