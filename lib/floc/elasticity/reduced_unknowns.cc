#include "floc/elasticity/reduced_unknowns.h"

namespace floc {

template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept) {
  ReducedUnknowns r;
  r.row.assign(kept.size(), -1);
  for (int u = 0; u < static_cast<int>(kept.size()); ++u)
    if (kept[u]) r.row[u] = static_cast<int>(r.unknown.size()), r.unknown.push_back(u);
  r.length.resize(static_cast<Eigen::Index>(r.unknown.size()));
  for (int a = 0; a < r.length.size(); ++a) {
    const int u = r.unknown[a];
    r.length[a] = u % kDofs<Dim> < Dim ? 1.0 : 1.0 / network.grain_size[u / kDofs<Dim>];
  }
  return r;
}

Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& unknowns,
                                   double unit) {
  const ReducedUnknowns& r = unknowns;
  const int n = static_cast<int>(r.unknown.size());
  Eigen::SparseMatrix<double> reduced(n, n);
  if (n == 0) return reduced;  // Eigen cannot compress a matrix without columns
  reduced.reserve(grains.nonZeros());
  for (int b = 0; b < n; ++b) {
    reduced.startVec(b);
    for (Eigen::SparseMatrix<double>::InnerIterator it(grains, r.unknown[b]); it; ++it)
      if (const int a = r.row[it.row()]; a >= 0)
        reduced.insertBack(a, b) = it.value() * (r.length[a] * r.length[b]) / unit;
  }
  reduced.finalize();
  return reduced;
}

template <int Dim>
std::vector<int> grain_of_rows(const ReducedUnknowns& unknowns) {
  std::vector<int> grain;
  grain.reserve(unknowns.unknown.size());
  for (const int u : unknowns.unknown) grain.push_back(u / kDofs<Dim>);
  return grain;
}

template ReducedUnknowns reduce_unknowns(const ContactNetwork<2>&, const std::vector<bool>&);
template ReducedUnknowns reduce_unknowns(const ContactNetwork<3>&, const std::vector<bool>&);
template std::vector<int> grain_of_rows<2>(const ReducedUnknowns&);
template std::vector<int> grain_of_rows<3>(const ReducedUnknowns&);

}  // namespace floc
