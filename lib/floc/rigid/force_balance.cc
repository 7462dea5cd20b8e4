#include "floc/rigid/force_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/network/contact_network.h"
#include "floc/network/rigidity_matrix.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Smaller coefficients count as rounding errors, after rows are divided by scale(). For example, the lever arm of a
/// normal force on a round grain is not exactly zero.
constexpr double kNoCoefficient = 1e-12;

/// All rows of the balance and their loads. Rows without coefficients are left out later.
template <int Dim>
class BalanceRows {
 public:
  BalanceRows(const Packing<Dim>& packing, const ForceBalanceOptions<Dim>& options)
      : network_(contact_network(packing)),
        strains_(packing.walls.empty() && !options.axis_stress ? StrainSet::full : StrainSet::diagonal),
        by_wall_(options.wall_force.has_value()),
        n_boundary_(by_wall_ ? static_cast<int>(packing.walls.size())
                             : n_boundary_unknowns(network_, strains_)),
        load_(Eigen::VectorXd::Zero(first_of_boundary() + n_boundary_)) {
    for (int i = 0; i < network_.n_grains; ++i)
      load_.segment(first_unknown<Dim>(i), Dim) = packing.grains.mass[i] * packing.gravity;
    for (int w = 0; by_wall_ && w < n_boundary_; ++w)
      load_[first_of_boundary() + w] = (*options.wall_force)[w].value_or(0.0);
    if (options.stress)
      for (int s = 0; s < n_boundary_; ++s)
        load_[first_of_boundary() + s] =
            network_.volume * options.stress->cwiseProduct(unit_strain<Dim>(s)).sum();
    if (options.axis_stress) load_.segment(first_of_boundary(), Dim) = network_.volume * *options.axis_stress;
  }

  const ContactNetwork<Dim>& network() const { return network_; }
  int first_of_boundary() const { return network_.n_unknowns(); }
  int n_rows() const { return static_cast<int>(load_.size()); }
  int n_boundary() const { return n_boundary_; }
  Eigen::VectorXd& load() { return load_; }

  /// Returns the axis of a row of the boundary: of a strain along an axis, or of a shift of the two walls of an axis.
  /// The result is Dim or more for a shear strain.
  int axis_of(int s) const {
    const int n_strains = n_boundary_ - static_cast<int>(network_.wall_axes.size());
    return s < n_strains || by_wall_ ? s : network_.wall_axes[static_cast<std::size_t>(s - n_strains)];
  }

  /// Returns the size of the load on the boundary, as force times length. For a compression, this is the sum, over all
  /// contacts, of the normal force times the length of the branch vector: the trace of the stress times the volume. If
  /// the forces on walls are given, the function returns the sum of these forces and of the weights of the grains.
  double sum_of_loads() const {
    if (by_wall_) return load_.cwiseAbs().sum();
    const auto on_cell = load_.segment(first_of_boundary(), n_strains<Dim>(strains_)).cwiseAbs();
    return std::max(on_cell.head(Dim).sum(), on_cell.maxCoeff());
  }

  /// Calls visit(row, coefficient) for each row of the balance to which a contact contributes. The contribution is the
  /// scalar product of `coefficient` and the force (F_N, T) of the contact.
  void for_each_row(const NetworkContact<Dim>& c, const auto& visit) const {
    const ContactRows<Dim> rows = contact_rows(c);
    for (int a = 0; a < kDofs<Dim>; ++a) {
      visit(first_unknown<Dim>(c.i) + a, Vec<Dim>(rows.on_i.col(a).template head<Dim>()));
      if (c.i != c.j) visit(first_unknown<Dim>(c.j) + a, Vec<Dim>(rows.on_j.col(a).template head<Dim>()));
    }
    if (by_wall_) {
      if (c.on_wall()) visit(first_of_boundary() + c.wall, Vec<Dim>(Vec<Dim>::Unit(0)));
      return;
    }
    const BoundaryRows<Dim> boundary = boundary_rows(network_, rows, strains_);
    for (int s = 0; s < n_boundary_; ++s)
      visit(first_of_boundary() + s, Vec<Dim>(boundary.col(s).template head<Dim>()));
  }

  /// Returns the factor by which a row is divided to make its coefficients of order one.
  double scale(int row) const {
    if (row >= first_of_boundary()) return boundary_scale();
    const bool turns = row % kDofs<Dim> >= Dim;
    return turns ? network_.grain_size[row / kDofs<Dim>] : 1.0;
  }
  double boundary_scale() const {
    return unit_length() * std::sqrt(static_cast<double>(std::max<std::size_t>(1, network_.contacts.size())));
  }
  /// Typical coefficient in a row of the boundary: the length of a branch vector; 1 if the row is the force on a wall.
  double unit_length() const {
    return by_wall_ ? 1.0 : std::pow(network_.volume / std::max(1, network_.n_grains), 1.0 / Dim);
  }

 private:
  ContactNetwork<Dim> network_;
  StrainSet strains_;
  bool by_wall_;  ///< whether each row of the boundary is the force on one wall
  int n_boundary_;
  Eigen::VectorXd load_;
};

/// Returns whether the load in a row of the boundary is arbitrary, or follows from the balance of the grains: along an
/// axis with an open end, the weights alone determine the stress and the force on the wall.
/// @param s     number of the row among the rows of the boundary, counted from 0
/// @param axis  axis of this row; Dim or more for a shear component
template <int Dim>
bool is_free(const Packing<Dim>& packing, const ForceBalanceOptions<Dim>& options, int s, int axis) {
  if (options.wall_force) return !(*options.wall_force)[static_cast<std::size_t>(s)];
  return axis < Dim &&
         ((s < Dim && options.open_axis[static_cast<std::size_t>(s)]) || is_open_along(packing.walls, axis));
}

/// Returns the present force (F_N, T) of a contact in the frame of the contact.
template <int Dim>
Vec<Dim> present_force(const NetworkContact<Dim>& c) {
  Vec<Dim> f = c.frame.transpose() * c.shear_force;
  f[0] = c.normal_force;
  return f;
}

/// Marks the contacts whose force must be zero in equilibrium: a contact without adhesion is marked if it is the only
/// contact of a grain. After such a contact is removed, another grain may have only one contact left, and the search
/// continues with this grain. With gravity, no contact is marked.
template <int Dim>
std::vector<bool> idle_contacts(const Packing<Dim>& packing) {
  // With gravity, the only contact of a grain may carry the weight of this grain.
  if (!packing.gravity.isZero(0.0)) return std::vector<bool>(packing.contacts.size(), false);
  const int n = packing.grains.size();
  std::vector<std::vector<int>> contacts_of(n);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    const Contact<Dim>& c = packing.contacts[k];
    contacts_of[c.i].push_back(static_cast<int>(k));
    if (!packing.is_wall(c.j)) contacts_of[c.j].push_back(static_cast<int>(k));
  }
  std::vector<bool> idle(packing.contacts.size(), false);
  std::vector<int> pending(n);
  for (int i = 0; i < n; ++i) pending[i] = i;
  while (!pending.empty()) {
    const int grain = pending.back();
    pending.pop_back();
    int only = -1, count = 0;
    for (const int k : contacts_of[grain])
      if (!idle[k]) only = k, ++count;
    if (count != 1) continue;
    const Contact<Dim>& c = packing.contacts[only];
    // An attraction across a gap keeps its present force. A contact with the adhesion F_a = elastic_force -
    // normal_force has the repulsive force P = F_a even if its total force is zero.
    if (c.distant || c.elastic_force > c.normal_force) continue;
    idle[only] = true;
    // The other grain has lost a contact and is tested again. A contact is marked at most once, so the search ends.
    for (const int body : {c.i, c.j})
      if (body != grain && !packing.is_wall(body)) pending.push_back(body);
  }
  return idle;
}

/// Returns the mean of the positive stiffnesses; 1 if no stiffness is positive.
template <int Dim>
double mean_stiffness(const std::vector<NetworkContact<Dim>>& contacts,
                      double NetworkContact<Dim>::*stiffness) {
  double sum = 0.0;
  int n = 0;
  for (const NetworkContact<Dim>& c : contacts)
    if (c.*stiffness > 0.0) sum += c.*stiffness, ++n;
  return n == 0 ? 1.0 : sum / n;
}

template <int Dim>
std::vector<UnknownForce<Dim>> unknown_forces(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                              const ForceBalanceOptions<Dim>& options) {
  const std::vector<bool> idle = idle_contacts(packing);
  const double mean_kn = mean_stiffness(network.contacts, &NetworkContact<Dim>::kn);
  const double mean_kt = mean_stiffness(network.contacts, &NetworkContact<Dim>::kt);
  // A contact with zero stiffness, such as the Hertz contact of two spheres that just touch, gets the mean stiffness.
  const auto stiffness = [](const std::optional<double>& given, double own, double mean) {
    return given ? *given : own > 0.0 ? own : mean;
  };
  std::vector<UnknownForce<Dim>> out;
  for (const NetworkContact<Dim>& c : network.contacts) {
    const Contact<Dim>& contact = packing.contacts[c.source];
    if (c.distant || idle[c.source]) continue;
    UnknownForce<Dim>& u = out.emplace_back();
    u.contact = c.source;
    const Law& law = c.on_wall() ? packing.wall_law : packing.law;
    u.friction = options.friction.value_or(law.friction_coefficient());
    u.adhesion = std::max(0.0, contact.elastic_force - contact.normal_force);
    u.present = present_force(c);
    u.present[0] += u.adhesion;
    u.kn = stiffness(options.kn, c.kn, mean_kn);
    u.kt = stiffness(options.kt, c.kt, mean_kt);
    u.frame = c.frame;
  }
  return out;
}

template <int Dim>
void require_balance(const std::string& place, const Packing<Dim>& packing,
                     const ForceBalanceOptions<Dim>& options) {
  for (const std::string& fault : options.validate()) throw InputError(place, fault);
  for (const Law* law : {&packing.law, &packing.wall_law})
    if (law->has_rolling() || law->has_twisting())
      throw InputError(
          place,
          "its contact law resists rolling or twisting; forces at rest can be computed only for contacts "
          "without moments");
  if (options.wall_force && options.wall_force->size() != packing.walls.size())
    throw InputError(place, fmt::format("wall_force has {} numbers: expected {}, one for each wall",
                                        options.wall_force->size(), packing.walls.size()));
  if (options.stress && !packing.walls.empty())
    throw InputError(place,
                     "a stress cannot be given for a packing between walls: the contact forces have to "
                     "balance the forces on the walls in the file");
}

}  // namespace

template <int Dim>
std::vector<std::string> ForceBalanceOptions<Dim>::validate() const {
  std::vector<std::string> faults;
  if (friction && !(*friction >= 0.0 && std::isfinite(*friction)))
    faults.push_back(fmt::format("friction = {}: expected a number >= 0", *friction));
  for (const auto& [name, value] : {std::pair{"kn", kn}, {"kt", kt}})
    if (value && !(*value > 0.0 && std::isfinite(*value)))
      faults.push_back(fmt::format("{} = {}: expected a positive stiffness (force/length)", name, *value));
  if (!(accepted_error > 0.0))
    faults.push_back(fmt::format("accepted_error = {}: expected a positive number", accepted_error));
  if (axis_stress && !axis_stress->allFinite()) faults.emplace_back("axis_stress: expected finite components");
  if (!axis_stress && std::ranges::count(open_axis, true) > 0)
    faults.emplace_back("open_axis: expected axis_stress to be given, too");
  if (wall_force && (stress || axis_stress))
    faults.emplace_back("wall_force: expected that neither stress nor axis_stress is given");
  if (stress && axis_stress) faults.emplace_back("axis_stress: expected that stress is not given, too");
  if (stress && !stress->allFinite()) faults.emplace_back("stress: expected finite components");
  return faults;
}

template <int Dim>
ForceBalance<Dim> force_balance(const std::string& place, const Packing<Dim>& packing,
                                const ForceBalanceOptions<Dim>& options) {
  require_balance(place, packing, options);
  BalanceRows<Dim> rows(packing, options);
  const std::vector<NetworkContact<Dim>>& contacts = rows.network().contacts;
  ForceBalance<Dim> out;
  out.unknowns = unknown_forces(packing, rows.network(), options);
  if (out.unknowns.empty())
    throw InputError(place, "no contact can carry a force, so there are no forces to balance");

  // Unless a stress is given, the load in the rows of the boundary is computed from the present forces.
  Eigen::VectorXd& load = rows.load();
  const auto add = [&](const NetworkContact<Dim>& c, const Vec<Dim>& force, double sign, int from) {
    rows.for_each_row(c, [&](int row, const Vec<Dim>& coefficient) {
      if (row >= from) load[row] += sign * coefficient.dot(force);
    });
  };
  if (!options.stress && !options.axis_stress && !options.wall_force)
    for (const NetworkContact<Dim>& c : contacts) add(c, present_force(c), 1.0, rows.first_of_boundary());
  for (const NetworkContact<Dim>& c : contacts)
    if (c.distant) add(c, present_force(c), -1.0, 0);
  double sum = 0.0;
  for (const UnknownForce<Dim>& u : out.unknowns) {
    add(contacts[u.contact], u.adhesion * Vec<Dim>::Unit(0), 1.0, 0);
    sum += std::abs(u.present[0]);
  }
  const double n = static_cast<double>(out.unknowns.size());
  const double branch = rows.boundary_scale() / std::sqrt(static_cast<double>(contacts.size()));
  const double weight = packing.gravity.norm() * total_mass(packing.grains);
  out.unit = std::max({sum, rows.sum_of_loads() / branch, weight}) / n;
  if (!(out.unit > 0.0))
    throw InputError(
        place, "all contact forces of the packing are zero: give the stress that the forces have to balance");

  // Only rows to which at least one contact contributes get numbers.
  std::vector<int> number(rows.n_rows(), -1);
  for (const UnknownForce<Dim>& u : out.unknowns)
    rows.for_each_row(contacts[u.contact], [&](int row, Vec<Dim> coefficient) {
      coefficient.template tail<Dim - 1>() *= u.friction;
      if (coefficient.template lpNorm<Eigen::Infinity>() / rows.scale(row) > kNoCoefficient) number[row] = 0;
    });
  for (int s = 0; s < rows.n_boundary(); ++s)
    if (is_free(packing, options, s, rows.axis_of(s)))
      number[rows.first_of_boundary() + s] = -1, load[rows.first_of_boundary() + s] = 0.0;
  std::vector<double> scaled_load;
  int last_group = -1;
  for (int row = 0; row < rows.n_rows(); ++row) {
    const bool inside = row < rows.first_of_boundary();
    const int grain = inside ? row / kDofs<Dim> : -1;
    // A row to which no contact contributes is left out if its load is zero. If its load is not zero, the row stays,
    // and the balance has no solution.
    if (number[row] < 0 && std::abs(load[row]) <= kNoCoefficient * rows.scale(row) * out.unit) continue;
    number[row] = static_cast<int>(scaled_load.size());
    scaled_load.push_back(load[row] / (rows.scale(row) * out.unit));
    if (!inside || out.row_grain.empty() || grain != out.row_grain.back()) ++last_group;
    out.program.group.push_back(last_group);
    out.row_grain.push_back(grain);
    out.row_is_moment.push_back(inside && row % kDofs<Dim> >= Dim);
  }
  out.program.load = Eigen::Map<const Eigen::VectorXd>(scaled_load.data(), scaled_load.size());
  out.unit_of_boundary = n * branch / (Dim * rows.boundary_scale());
  for (const UnknownForce<Dim>& u : out.unknowns) {
    rows.for_each_row(contacts[u.contact], [&](int row, Vec<Dim> coefficient) {
      if (number[row] < 0) return;
      coefficient.template tail<Dim - 1>() *= u.friction;
      out.program.row.push_back(number[row]);
      out.program.coefficient.push_back(coefficient / rows.scale(row));
    });
    out.program.first.push_back(static_cast<int>(out.program.row.size()));
  }
  out.program.compliance.assign(out.unknowns.size(), Vec<Dim>::Zero());
  out.program.linear = out.program.compliance;
  return out;
}

template struct ForceBalanceOptions<2>;
template struct ForceBalanceOptions<3>;
template ForceBalance<2> force_balance(const std::string&, const Packing<2>&, const ForceBalanceOptions<2>&);
template ForceBalance<3> force_balance(const std::string&, const Packing<3>&, const ForceBalanceOptions<3>&);

}  // namespace floc
