#pragma once

#include <memory>
#include <vector>

#include "floc/relaxation/pair_arrays.h"

namespace floc {

/// Interaction between the grains of a packing, or between its grains and walls: the pairs, their contact law, and the
/// kernels (compiled loops over pairs) that evaluate the law.
template <int Dim>
class Interaction {
 public:
  /// @param law  contact law in the form that the kernels use (laws_of_same_rows())
  /// @param rows  layout of the rows (force and moments of a pair) that kernels write. All interactions of the packing
  /// use the layout for the law between grains.
  /// @param largest_radius  largest radius of a grain (length)
  Interaction(Partner partner, const Law& parameters, std::shared_ptr<const ComposedLaw> law, RowKind rows,
              double largest_radius, InstructionSet instructions, LatticeShape shape);
  // An interaction cannot be moved, because the address of its contact law is passed to its kernels.
  Interaction(Interaction&&) = delete;

  Partner partner() const { return partner_; }
  const ComposedLaw& law() const { return *law_; }
  RowKind rows() const { return rows_; }
  /// Returns the largest gap across which bodies interact (length): the range of the contact law, or the widest gap
  /// that an existing liquid bridge spans.
  double range() const { return range_; }
  void set_range(double range) { range_ = range; }
  const StepKernels<Dim>& kernels() const { return *kernel_.kernels; }
  const PairArrays<Dim>& pairs() const { return pairs_; }
  /// Volumes of the liquid bridges (length^3). After a change, refresh_bridges() has to be called.
  typename PairArrays<Dim>::Component& bridge_volume() { return pairs_.bridge_volume(); }
  void refresh_bridges() { pairs_.refresh_bridges(*law_); }
  const PairView<Dim>& view() const { return arrays_; }
  /// Returns pointers to the arrays of the pairs. Kernels that use these pointers write the rows (force and moments) of
  /// the pairs to the address `row` and not to the address set by set_rows().
  /// @param row  address to which the row of the pair with index `with_row` is written, followed by the rows of later
  /// pairs
  PairView<Dim> view(double* row, int with_row) const {
    PairView<Dim> pairs = arrays_;
    pairs.row = row;
    pairs.with_row = with_row;
    return pairs;
  }

  /// Replaces the list of pairs. Pairs that are in the old and in the new list keep their history variables.
  void set_pairs(PairArrays<Dim> pairs);
  /// Frees the arrays that are not copied into the next list of pairs (PairArrays::drop_numbers()).
  void drop_numbers() { pairs_.drop_numbers(); }
  /// Frees all data except the history of the pairs (PairArrays::keep_history_alone()).
  void keep_history_alone() { pairs_.keep_history_alone(); }
  /// Sets the address to which kernels write the rows (force and moments) of the pairs.
  void set_rows(double* rows) { arrays_.row = rows; }
  /// Computes the rows (forces and moments) of the pairs of the blocks of grains [first, last), and updates the history
  /// variables of these pairs.
  /// @param pairs  a view of the pairs of this interaction
  void compute(const PairView<Dim>& pairs, int first, int last, const GrainView<Dim>& grains,
               const PairCell<Dim>& cell) const;

  /// load_history() copies the history variables of a contact to its pair. history() returns the history variables of a
  /// pair as variables of its contact.
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
    /// Contact law for which the kernels are compiled; its address is passed to the kernels.
    std::shared_ptr<const void> law;
  };
  static KernelAndLaw kernel_of(const ComposedLaw& law, Partner partner, InstructionSet instructions,
                                LatticeShape shape);
  KernelAndLaw kernel_;
  PairArrays<Dim> pairs_;
  PairView<Dim> arrays_;
};

/// Makes the contact laws of the interactions of a packing from their parameters. Kernels write a row of numbers for
/// each pair: the force and, with friction, the moments. All rows must have one layout. Therefore, if any law has
/// friction, each law without friction gets a friction spring with a coefficient of zero.
/// @param parameters  parameters of the law between grains, then of the law between grains and walls if there are walls
std::vector<std::shared_ptr<const ComposedLaw>> laws_of_same_rows(const std::vector<Law>& parameters);

/// Returns the layout of the rows (forces and moments) of pairs of grains under a contact law.
template <int Dim>
RowKind row_kind(const ComposedLaw& law);

}  // namespace floc
