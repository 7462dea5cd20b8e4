#pragma once

#include <memory>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// One kind of interaction in a packing: the pairs it acts between, the law it acts by and the kernel that
/// evaluates it.
template <int Dim>
class Interaction {
 public:
  /// @param law   as composed for the kernels (laws_of_same_rows())
  /// @param rows  that all interactions of the packing write: those of the law between grains
  /// @param largest_radius  of the grains
  Interaction(Partner partner, const Law& parameters, std::shared_ptr<const ComposedLaw> law, RowKind rows,
              double largest_radius, InstructionSet instructions, LatticeShape shape);
  Interaction(Interaction&&) = delete;  // the kernel is given the address of its law

  Partner partner() const { return partner_; }
  const ComposedLaw& law() const { return *law_; }
  RowKind rows() const { return rows_; }
  /// Gaps that its lists of pairs reach across: those of the law, or of the bridges that exist.
  double range() const { return range_; }
  void set_range(double range) { range_ = range; }
  const StepKernels<Dim>& kernels() const { return *kernel_.kernels; }
  const PairArrays<Dim>& pairs() const { return pairs_; }
  /// Volumes of the liquid bridges; after a change, refresh_bridges().
  typename PairArrays<Dim>::Component& bridge_volume() { return pairs_.bridge_volume(); }
  void refresh_bridges() { pairs_.refresh_bridges(*law_); }
  const PairView<Dim>& view() const { return arrays_; }
  /// With rows elsewhere: where that of a pair goes, and those of the pairs after it.
  PairView<Dim> view(double* row, int with_row) const {
    PairView<Dim> pairs = arrays_;
    pairs.row = row;
    pairs.with_row = with_row;
    return pairs;
  }

  /// Takes a new list of pairs, which inherits the history of the one before.
  void set_pairs(PairArrays<Dim> pairs);
  /// Drops numbers that a list which is about to be replaced needs no more.
  void drop_numbers() { pairs_.drop_numbers(); }
  /// Drops what forces alone need.
  void keep_history_alone() { pairs_.keep_history_alone(); }
  /// Where the rows of the list begin.
  void set_rows(double* rows) { arrays_.row = rows; }
  /// Rows, springs and history of the pairs of the blocks [first, last). @param pairs  a view of them
  void compute(const PairView<Dim>& pairs, int first, int last, const GrainView<Dim>& grains,
               const PairCell<Dim>& cell) const;

  /// Copies the history of a contact into that of its pair, and back. @param swapped  the pair is the contact
  /// seen from its other grain
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
    std::shared_ptr<const void> law;  ///< that the kernels are given
  };
  static KernelAndLaw kernel_of(const ComposedLaw& law, Partner partner, InstructionSet instructions,
                                LatticeShape shape);
  KernelAndLaw kernel_;
  PairArrays<Dim> pairs_;
  PairView<Dim> arrays_;
};

/// The laws of the interactions of a packing, composed so that all rows can be of one kind: where some have
/// friction, the others have a spring that can carry nothing.
/// @param parameters  those of grains, then perhaps those of walls
std::vector<std::shared_ptr<const ComposedLaw>> laws_of_same_rows(const std::vector<Law>& parameters);

/// What the rows of pairs of grains hold under this law.
template <int Dim>
RowKind row_kind(const ComposedLaw& law);

}  // namespace floc
