#include "floc/elasticity/parallel/local_rows.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "floc/network/geometric_springs.h"

namespace floc {
namespace {

/// Bound on the relative rounding error of an entry of SpringSystem::on_free or SpringSystem::on_boundary: the change
/// of a spring's length per unit of an unknown.
constexpr double kEntryRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// Shift that is added to the diagonal of the stiffness matrix. The entries of the matrix are of order one. The shift
/// is above rounding errors, and below the stiffness of the softest motions that influence the response.
constexpr double kShift = 1e-11;

template <int Dim>
bool is_semidefinite(const ContactNetwork<Dim>& network, bool prestress) {
  return !prestress && std::ranges::all_of(network.contacts, [](const NetworkContact<Dim>& c) {
    return row_stiffness(c).minCoeff() >= 0.0;
  });
}

/// Returns the displacement of a point in a rigid rotation about the origin.
/// @param axis   axis of the rotation times its angle (radians)
/// @param place  position of the point
Vec<2> turned(const RotationVector<2>& axis, const Vec<2>& place) {
  return axis[0] * Vec<2>(-place[1], place[0]);
}
Vec<3> turned(const RotationVector<3>& axis, const Vec<3>& place) {
  return axis.cross(place);
}

}  // namespace

template <int Dim>
LocalRows<Dim>::LocalRows(const ContactNetwork<Dim>& network, const std::vector<bool>& kept,
                          const GrainShares& shares, int process, double unit, const ResponseOptions& options)
    : network_(network),
      kept_(kept),
      shares_(shares),
      unit_(unit),
      strains_(options.strains),
      prestress_(options.prestress),
      shift_(is_semidefinite(network, options.prestress) ? kShift : 0.0),
      first_(shares.first[process]),
      n_grains_(shares.first[process + 1] - shares.first[process]) {
  gather(process);
}

/// Finds the contacts of the grains of this process, and the grains of other processes that these contacts touch.
template <int Dim>
void LocalRows<Dim>::gather(int process) {
  at_hand_.assign(shares_.grain.begin() + first_, shares_.grain.begin() + shares_.first[process + 1]);
  place_.assign(shares_.block.size(), -1);
  for (int p = 0; p < n_grains_; ++p) place_[at_hand_[p]] = p;
  const auto is_own = [this](int grain) {
    const int block = shares_.block[grain];
    return block >= first_ && block < first_ + n_grains_;
  };
  of_start_.assign(n_grains_ + 1, 0);
  // `at_hand_` first lists the grains of this process, in the order of their rows, and then those grains of other
  // processes that touch a grain of this process. A counting sort then lists the contacts of each grain of this
  // process; a contact between two grains of this process is listed for both.
  for (int k = 0; k < static_cast<int>(network_.contacts.size()); ++k) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    if (!is_own(c.i) && !is_own(c.j)) continue;
    contacts_.push_back(k);
    for (const int grain : {c.i, c.j})
      if (place_[grain] < 0) {
        place_[grain] = static_cast<int>(at_hand_.size());
        at_hand_.push_back(grain);
      }
    if (is_own(c.i)) ++of_start_[place_[c.i] + 1];
    if (is_own(c.j) && c.j != c.i) ++of_start_[place_[c.j] + 1];
  }
  std::partial_sum(of_start_.begin(), of_start_.end(), of_start_.begin());
  of_.resize(of_start_.back());
  std::vector<int> next(of_start_.begin(), of_start_.end() - 1);
  for (const int k : contacts_) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    if (is_own(c.i)) of_[next[place_[c.i]]++] = k;
    if (is_own(c.j) && c.j != c.i) of_[next[place_[c.j]]++] = k;
  }
}

template <int Dim>
Eigen::Map<const Eigen::VectorXi> LocalRows<Dim>::contacts_of(int place) const {
  return {of_.data() + of_start_[place], of_start_[place + 1] - of_start_[place]};
}

/// Returns the numbers of the blocks that belong to a grain of this process and to the grains that it touches, in
/// ascending order. A block consists of the rows of one grain in the stiffness matrix.
template <int Dim>
std::vector<int> LocalRows<Dim>::columns_of(int place) const {
  std::vector<int> columns{first_ + place};
  for (const int k : contacts_of(place)) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    columns.push_back(shares_.block[c.i == at_hand_[place] ? c.j : c.i]);
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

/// Returns, for each unknown of a grain, the ratio of the unknown to the value that is solved for; 0 if the unknown is
/// not solved for.
template <int Dim>
typename LocalRows<Dim>::Unknowns LocalRows<Dim>::scale_of(int grain) const {
  Unknowns scale;
  for (int b = 0; b < kDofs<Dim>; ++b)
    scale[b] = !kept_[first_unknown<Dim>(grain) + b] ? 0.0 : b < Dim ? 1.0 : 1.0 / network_.grain_size[grain];
  return scale;
}

template <int Dim>
typename LocalRows<Dim>::Unknowns LocalRows<Dim>::motion_of(int grain, const Eigen::VectorXd& u) const {
  return scale_of(grain).cwiseProduct(u.template segment<kDofs<Dim>>(kDofs<Dim> * place_[grain]));
}

/// For the springs of a contact, calls visit(rows, stiffness, boundary). `rows` are the ContactRows of the contact,
/// `stiffness` contains the stiffnesses of the springs, divided by `unit_`, and `boundary` contains the changes of the
/// lengths of the springs per unit of each boundary unknown (strain or wall displacement).
template <int Dim>
template <class Visit>
void LocalRows<Dim>::for_each_spring(const NetworkContact<Dim>& c, const Visit& visit) const {
  const ContactRows<Dim> rows = contact_rows(c);
  visit(rows, RowStiffness<Dim>(row_stiffness(c) / unit_), boundary_rows(network_, rows, strains_));
  if (!prestress_) return;
  for_each_geometric_term(network_, c, rows, [&](const ContactRows<Dim>& moved, const RowStiffness<Dim>& k) {
    visit(moved, RowStiffness<Dim>(k / unit_), boundary_rows(network_, moved, strains_));
  });
}

template <int Dim>
double LocalRows<Dim>::set_row(int place, ParallelSolver& solver) const {
  constexpr int kSize = kDofs<Dim>;
  const int grain = at_hand_[place];
  const std::vector<int> columns = columns_of(place);
  Eigen::Matrix<double, kSize, Eigen::Dynamic, Eigen::RowMajor> values(kSize, kSize * columns.size());
  values.setZero();
  const auto at = [&](int block) {
    const auto found = std::lower_bound(columns.begin(), columns.end(), block);
    return values.template middleCols<kSize>(kSize * (found - columns.begin()));
  };
  const Unknowns scale = scale_of(grain);
  for (const int k : contacts_of(place)) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    for_each_spring(c, [&](const ContactRows<Dim>& rows, const RowStiffness<Dim>& stiffness, const auto&) {
      // The contact adds G^T k G to the stiffness matrix, with the rigidity matrix G and the stiffnesses k. This call
      // adds only the rows of `grain`. Another call, perhaps in another process, adds the rows of the other grain. A
      // contact with a wall or with the grain's own image has i = j and no second grain.
      const bool is_i = c.i == grain;
      const Block mine = (is_i ? rows.on_i : rows.on_j) * scale.asDiagonal();
      const Block forces = stiffness.asDiagonal() * mine;
      at(first_ + place) += mine.transpose() * forces;
      if (c.i == c.j) return;
      const int other = is_i ? c.j : c.i;
      const Block theirs = (is_i ? rows.on_j : rows.on_i) * scale_of(other).asDiagonal();
      at(shares_.block[other]) += forces.transpose() * theirs;
    });
  }
  // Unknowns that are not solved for have the scale 0. Each of them gets a one on the diagonal, so that all blocks have
  // the same size.
  auto own = at(first_ + place);
  for (int b = 0; b < kSize; ++b)
    if (scale[b] == 0.0)
      own(b, b) = 1.0;
    else
      own(b, b) += shift_;
  solver.set_row(first_ + place, columns, {values.data(), static_cast<std::size_t>(values.size())});
  return own.diagonal().maxCoeff();
}

/// Returns the rigid motions of all grains together, one per column: the translations, then the rotations about the
/// middle of the packing. The angle of a rotation is 1/(half the extent of the packing), so that no grain moves much
/// farther than in a translation.
template <int Dim>
std::vector<double> LocalRows<Dim>::rigid_motions(const std::vector<Vec<Dim>>& centres) const {
  constexpr int kMotions = Dim + kRotations<Dim>;
  Vec<Dim> low = centres.front(), high = low;
  for (const Vec<Dim>& x : centres) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double reach = std::max(0.5 * (high - low).maxCoeff(), network_.grain_size.front());
  std::vector<double> motions(static_cast<std::size_t>(kMotions * n_own()), 0.0);
  Eigen::Map<Eigen::MatrixXd> columns(motions.data(), n_own(), kMotions);
  for (int p = 0; p < n_grains_; ++p) {
    const int grain = at_hand_[p];
    const Vec<Dim> place = centres[grain] - 0.5 * (low + high);
    auto rows = columns.template middleRows<kDofs<Dim>>(kDofs<Dim> * p);
    rows.template topLeftCorner<Dim, Dim>().setIdentity();
    for (int m = 0; m < kRotations<Dim>; ++m) {
      const RotationVector<Dim> axis = RotationVector<Dim>::Unit(m) / reach;
      rows.col(Dim + m).template head<Dim>() = turned(axis, place);
      rows.col(Dim + m).template tail<kRotations<Dim>>() = network_.grain_size[grain] * axis;
    }
    for (int b = 0; b < kDofs<Dim>; ++b)
      if (!kept_[first_unknown<Dim>(grain) + b]) rows.row(b).setZero();
  }
  return motions;
}

template <int Dim>
double LocalRows<Dim>::assemble(const std::vector<Vec<Dim>>& centres, ParallelSolver& solver) const {
  std::vector<int> own(n_grains_), foreign(n_grains_);
  for (int p = 0; p < n_grains_; ++p)
    for (const int block : columns_of(p)) ++(block >= first_ && block < first_ + n_grains_ ? own : foreign)[p];
  solver.begin_matrix(kDofs<Dim>, own, foreign);
  double norm = 0.0;
  for (int p = 0; p < n_grains_; ++p) norm = std::max(norm, set_row(p, solver));
  solver.finish_matrix(rigid_motions(centres), Dim + kRotations<Dim>);
  std::vector<int> ghosts;
  for (auto grain = at_hand_.begin() + n_grains_; grain != at_hand_.end(); ++grain)
    ghosts.push_back(shares_.block[*grain]);
  solver.set_ghosts(ghosts);
  return norm;
}

template <int Dim>
typename LocalRows<Dim>::Balance LocalRows<Dim>::balance(const Eigen::VectorXd& u, int boundary) const {
  Balance out{Eigen::VectorXd::Zero(n_own())};
  const auto add = [&](int grain, const Block& rows, const RowStiffness<Dim>& force) {
    if (place_[grain] < n_grains_)
      out.net.template segment<kDofs<Dim>>(kDofs<Dim> * place_[grain]) -=
          scale_of(grain).cwiseProduct(rows.transpose() * force);
  };
  for (const int k : contacts_) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    const Unknowns motion_i = motion_of(c.i, u), motion_j = motion_of(c.j, u);
    for_each_spring(c, [&](const ContactRows<Dim>& rows, const RowStiffness<Dim>& stiffness, const auto& on) {
      const RowStiffness<Dim> stretch = rows.on_i * motion_i + rows.on_j * motion_j + on.col(boundary);
      const RowStiffness<Dim> force = stiffness.cwiseProduct(stretch);
      if (place_[c.i] < n_grains_) out.energy += force.dot(stretch);
      add(c.i, rows.on_i, force);
      if (c.j != c.i) add(c.j, rows.on_j, force);
    });
  }
  return out;
}

template <int Dim>
typename LocalRows<Dim>::Energies LocalRows<Dim>::energies(const std::vector<Eigen::VectorXd>& u) const {
  const auto n = static_cast<Eigen::Index>(u.size());
  using Stretches = BoundaryRows<Dim>;
  Energies out{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (const int k : contacts_) {
    const NetworkContact<Dim>& c = network_.contacts[k];
    if (place_[c.i] >= n_grains_) continue;
    for_each_spring(c, [&](const ContactRows<Dim>& rows, const RowStiffness<Dim>& stiffness, const auto& on) {
      Stretches stretch = on, rounding = on.cwiseAbs();
      for (Eigen::Index b = 0; b < n; ++b) {
        const Unknowns motion_i = motion_of(c.i, u[static_cast<std::size_t>(b)]);
        const Unknowns motion_j = motion_of(c.j, u[static_cast<std::size_t>(b)]);
        stretch.col(b) += rows.on_i * motion_i + rows.on_j * motion_j;
        rounding.col(b) +=
            rows.on_i.cwiseAbs() * motion_i.cwiseAbs() + rows.on_j.cwiseAbs() * motion_j.cwiseAbs();
      }
      rounding *= kEntryRounding;
      const Stretches size = stretch.cwiseAbs() + rounding;
      const RowStiffness<Dim> magnitude = stiffness.cwiseAbs();
      out.stiffness += stretch.transpose() * stiffness.asDiagonal() * stretch;
      out.rounding += size.transpose() * magnitude.asDiagonal() * rounding +
                      rounding.transpose() * magnitude.asDiagonal() * size;
    });
  }
  return out;
}

template class LocalRows<2>;
template class LocalRows<3>;

}  // namespace floc
