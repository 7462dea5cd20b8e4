#pragma once

#include <memory>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// One kind of interaction in a packing, between grains or between grains and walls: its pairs, its law and the
/// kernel that evaluates it.
template <int Dim>
class Interaction {
 public:
  /// @param law   as composed for the kernels (laws_of_same_rows())
  /// @param rows  kind of the rows of all interactions of the packing, which follows from the law between grains
  /// @param largest_radius  of the grains
  Interaction(Partner partner, const Law& parameters, std::shared_ptr<const ComposedLaw> law, RowKind rows,
              double largest_radius, InstructionSet instructions, LatticeShape shape);
  Interaction(Interaction&&) = delete;  // the kernel is given the address of its law

  Partner partner() const { return partner_; }
  const ComposedLaw& law() const { return *law_; }
  RowKind rows() const { return rows_; }
  /// Largest gap of the pairs in its lists (length): the reach of the law, or of the bridges that exist.
  double range() const { return range_; }
  void set_range(double range) { range_ = range; }
  const StepKernels<Dim>& kernels() const { return *kernel_.kernels; }
  const PairArrays<Dim>& pairs() const { return pairs_; }
  /// Volumes of the liquid bridges (length^3). Call refresh_bridges() after a change.
  typename PairArrays<Dim>::Component& bridge_volume() { return pairs_.bridge_volume(); }
  void refresh_bridges() { pairs_.refresh_bridges(*law_); }
  const PairView<Dim>& view() const { return arrays_; }
  /// View of the pairs that writes rows to another place.
  /// @param row  place of the row of pair `with_row`, followed by the rows of later pairs
  PairView<Dim> view(double* row, int with_row) const {
    PairView<Dim> pairs = arrays_;
    pairs.row = row;
    pairs.with_row = with_row;
    return pairs;
  }

  /// Takes a new list of pairs, which inherits the history of the one before.
  void set_pairs(PairArrays<Dim> pairs);
  /// Drops the numbers that are not inherited by the next list (PairArrays::drop_numbers()).
  void drop_numbers() { pairs_.drop_numbers(); }
  /// Drops all data but the history (PairArrays::keep_history_alone()).
  void keep_history_alone() { pairs_.keep_history_alone(); }
  /// Sets the place of the rows of the list.
  void set_rows(double* rows) { arrays_.row = rows; }
  /// Computes rows, springs and history of the pairs of the blocks [first, last).
  /// @param pairs  a view of the pairs
  void compute(const PairView<Dim>& pairs, int first, int last, const GrainView<Dim>& grains,
               const PairCell<Dim>& cell) const;

  /// Copies the history of a contact into that of its pair, and back.
  /// @param swapped  whether the first grain of the pair is the second grain of the contact
  void load_history(int pair, const ContactHistory<Dim>& history, bool swapped);
  ContactHistory<Dim> history(int pair, bool swapped) const;

 private:
  Partner partner_;
  std::shared_ptr<const ComposedLaw> law_;
  RowKind rows_;
  double range_;
  ContactHistory<Dim> swap_parity_;
  struct KernelAndLaw {
    const StepKernels<Dim>* kernels;
    std::shared_ptr<const void> law;  ///< kernel law, passed to the kernels
  };
  static KernelAndLaw kernel_of(const ComposedLaw& law, Partner partner, InstructionSet instructions,
                                LatticeShape shape);
  KernelAndLaw kernel_;
  PairArrays<Dim> pairs_;
  PairView<Dim> arrays_;
};

/// Composes the laws of the interactions of a packing so that all rows are of one kind: if any law has
/// friction, those without get a friction spring with a coefficient of zero.
/// @param parameters  law between grains, then the law with walls if there are any
std::vector<std::shared_ptr<const ComposedLaw>> laws_of_same_rows(const std::vector<Law>& parameters);

/// Kind of the rows that pairs of grains write under this law.
template <int Dim>
RowKind row_kind(const ComposedLaw& law);

}  // namespace floc
