#include "floc/lattice/spring_rows.h"

#include <cassert>

namespace floc {
namespace {

template <int Dim, int Size>
class RowBuilder {
 public:
  explicit RowBuilder(const LatticeNetwork<Dim>& network) : network_(network), here_(network.n_nodes, -1) {
    for (int k = 0; k < network.n_nodes; ++k)
      if (network.present[k]) {
        here_[k] = static_cast<int>(out_.node.size());
        out_.node.push_back(k);
      }
    out_.rows.reserve(network.elements.size());
    out_.on_strain.reserve(network.elements.size());
    out_.element.reserve(network.elements.size());
  }

  SpringRows<Dim, Size> build() {
    for (int e = 0; e < static_cast<int>(network_.elements.size()); ++e) {
      out_.first_row.push_back(static_cast<int>(out_.rows.size()));
      const LatticeElement<Dim>& element = network_.elements[e];
      if (element.unilateral) out_.one_sided.push_back(static_cast<int>(out_.rows.size()));
      add(e, element);
    }
    out_.first_row.push_back(static_cast<int>(out_.rows.size()));
    return std::move(out_);
  }

 private:
  void add(int e, const LatticeElement<Dim>& element) {
    // The element is described as a contact between two grains at its nodes. Therefore contact_rows() gives the same
    // kinematics as in packings.
    NetworkContact<Dim> c{};
    c.i = element.i;
    c.j = element.j;
    c.branch = element.branch;
    c.arm_i = element.arm_i;
    c.arm_j = element.arm_i - element.branch;
    c.frame = contact_frame(Vec<Dim>(element.branch.normalized()));
    c.kn = element.kn;
    // A unilateral element has a normal stiffness only. All its other rows are therefore left out below, and its single
    // spring has the number that build() has added to `one_sided`.
    if (!element.unilateral) {
      c.kt = network_.shear * element.kn;
      c.kr = network_.bending * element.kn * network_.spacing * network_.spacing;
    }
    const ContactRows<Dim> g = contact_rows(c);
    const RowStiffness<Dim> k = row_stiffness(c);
    for (int a = 0; a < kDofs<Dim>; ++a) {
      if (k[a] == 0.0) continue;
      typename SpringRows<Dim, Size>::Row row;
      row.i = here_[element.i];
      row.j = here_[element.j];
      row.on_i = unknowns(element.i, g.on_i.row(a));
      row.on_j = unknowns(element.j, g.on_j.row(a));
      row.stiffness = k[a];
      out_.rows.push_back(row);
      out_.on_strain.push_back(g.on_strain.row(a).transpose());
      out_.element.push_back(e);
    }
  }

  typename SpringRows<Dim, Size>::OnNode unknowns(int node, const auto& of_contact) const {
    typename SpringRows<Dim, Size>::OnNode on = of_contact.template head<Size>().transpose();
    if constexpr (Size > Dim) on.template tail<Size - Dim>() /= network_.spacing;
    if (!network_.held.empty())
      for (int a = 0; a < Dim; ++a)
        if (network_.held[Dim * node + a]) on[a] = 0.0;
    return on;
  }

  const LatticeNetwork<Dim>& network_;
  // for each node of the lattice, its index in SpringRows::node; -1 if the node has no element
  std::vector<int> here_;
  SpringRows<Dim, Size> out_;
};

}  // namespace

template <int Dim, int Size>
SpringRows<Dim, Size> spring_rows(const LatticeNetwork<Dim>& network) {
  assert(Size == kDofs<Dim> || network.central());
  return RowBuilder<Dim, Size>(network).build();
}

template SpringRows<2, 2> spring_rows(const LatticeNetwork<2>&);
template SpringRows<2, 3> spring_rows(const LatticeNetwork<2>&);
template SpringRows<3, 3> spring_rows(const LatticeNetwork<3>&);
template SpringRows<3, 6> spring_rows(const LatticeNetwork<3>&);

}  // namespace floc
