#include "floc/structure/contact_statistics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "floc/packing/contact_order.h"

namespace floc {
namespace {

/// Smallest number of forces from which a parameter is estimated.
constexpr int kFewestForces = 10;
/// If the deviatoric stress divided by the mean stress is below this value, the deviatoric stress is only a residual
/// error of the equilibrium, and its direction has no meaning.
constexpr double kIsotropic = 1e-4;

template <int Dim>
ContactType kind_of(const Contact<Dim>& first, int n_points) {
  if (n_points == 1)
    return first.type == ContactType::kEdgeEdge ? ContactType::kEdgeEdge : ContactType::kVertexFace;
  return Dim == 3 && n_points == 2 ? ContactType::kDouble : ContactType::kFaceFace;
}

/// Log-likelihood, up to a constant, of forces x in units of their mean. The forces are assumed to follow the joined
/// form of the distribution, see ForceShape.
struct JoinedForm {
  double n = 0.0;
  double log_below = 0.0;     ///< sum of ln x over the forces x < 1
  double beyond_above = 0.0;  ///< sum of x - 1 over the forces x > 1

  static double beta(double alpha) { return std::sqrt((1.0 - alpha) * (2.0 - alpha)); }
  double log_likelihood(double alpha) const {
    const double b = beta(alpha);
    return -n * std::log(1.0 / (1.0 - alpha) + 1.0 / b) - alpha * log_below - b * beyond_above;
  }
};

/// Returns the argument between `low` and `high` at which f is largest, by golden-section search. @pre f has a single
/// maximum
template <class Function>
double maximum(const Function& f, double low, double high) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = f(a), fb = f(b);
  for (int k = 0; k < 100; ++k) {
    if (fa > fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

template <int Dim>
Mat<Dim> deviatoric_part(const Mat<Dim>& m) {
  const Mat<Dim> symmetric = 0.5 * (m + m.transpose());
  return symmetric - symmetric.trace() / Dim * Mat<Dim>::Identity();
}

/// Returns the likeliest decay rate of the forces above `bound`, in units of their mean, and its standard error; absent
/// if there are few such forces.
std::pair<std::optional<double>, std::optional<double>> decay_beyond(double bound, double mean,
                                                                     const std::vector<double>& forces) {
  double sum = 0.0, n = 0.0;
  for (const double force : forces)
    if (const double x = force / mean; x >= bound) sum += x - bound, n += 1.0;
  if (n < kFewestForces || !(sum > 0.0)) return {};
  return {n / sum, n / sum / std::sqrt(n)};
}

}  // namespace

template <int Dim>
std::vector<ContactPair> contact_pairs(const Packing<Dim>& packing, const CarryingStructure& carrying) {
  std::vector<ContactPair> pairs;
  const auto at = [&](std::size_t k) -> const Contact<Dim>& { return packing.contacts[carrying.contacts[k]]; };
  for (std::size_t first = 0, last; first < carrying.contacts.size(); first = last) {
    double force = 0.0;
    for (last = first; last < carrying.contacts.size() && same_pair(at(first), at(last)); ++last)
      force += at(last).normal_force;
    const int n_points = static_cast<int>(last - first);
    if (!packing.is_wall(at(first).j)) pairs.push_back({kind_of(at(first), n_points), force, n_points});
  }
  return pairs;
}

ContactKinds contact_kinds(const std::vector<ContactPair>& pairs, int n_held) {
  ContactKinds out;
  if (pairs.empty() || n_held == 0) return out;
  out.z = 2.0 * static_cast<double>(pairs.size()) / n_held;
  double sum = 0.0;
  for (const ContactPair& pair : pairs) sum += pair.normal_force;
  for (const ContactPair& pair : pairs) {
    const auto kind = static_cast<std::size_t>(pair.kind);
    out.share[kind] += 1.0 / static_cast<double>(pairs.size());
    if (sum != 0.0) out.force[kind] += pair.normal_force / sum;
  }
  return out;
}

ForceShape force_shape(const std::vector<double>& forces) {
  ForceShape out;
  if (forces.empty()) return out;
  const double n = static_cast<double>(forces.size());
  const double mean = std::accumulate(forces.begin(), forces.end(), 0.0) / n;
  JoinedForm form{.n = n};
  int n_below = 0;
  for (const double force : forces) {
    const double x = force / mean;
    if (x < 1.0)
      ++n_below, form.log_below += std::log(x);
    else
      form.beyond_above += x - 1.0;
  }
  out.below_mean = n_below / n;
  std::tie(out.beta, out.beta_error) = decay_beyond(1.0, mean, forces);
  std::tie(out.beta2, out.beta2_error) = decay_beyond(2.0, mean, forces);
  if (n < kFewestForces || n_below == 0 || !(form.beyond_above > 0.0)) return out;
  // Values of alpha in packings are far from both ends of the interval of search. If the likeliest alpha lies at an
  // end, the distribution does not have the joined form.
  constexpr double kLeast = -50.0, kMost = 0.999, kStep = 1e-4;
  const auto likelihood = [&](double alpha) { return form.log_likelihood(alpha); };
  const double alpha = maximum(likelihood, kLeast, kMost);
  if (alpha < kLeast + 1e-3 || alpha > kMost - 1e-3) return out;
  out.alpha = alpha;
  const double curvature =
      (likelihood(alpha + kStep) - 2.0 * likelihood(alpha) + likelihood(alpha - kStep)) / (kStep * kStep);
  if (curvature < 0.0) out.alpha_error = 1.0 / std::sqrt(-curvature);
  return out;
}

template <int Dim>
std::optional<ContactAnisotropy> contact_anisotropy(const Packing<Dim>& packing,
                                                    const CarryingStructure& carrying) {
  Mat<Dim> fabric = Mat<Dim>::Zero(), force = fabric, tangential = fabric, length = fabric, slant = fabric,
           stress = fabric;
  double sum_force = 0.0, sum_length = 0.0;
  int n = 0;
  for (const int k : carrying.contacts) {
    const Contact<Dim>& c = packing.contacts[k];
    if (packing.is_wall(c.j)) continue;
    const Vec<Dim> r = c.arm_i - c.arm_j, normal = c.normal;
    const Mat<Dim> outer = normal * normal.transpose();
    const double l = r.dot(normal);
    ++n;
    sum_force += c.normal_force;
    sum_length += l;
    fabric += outer;
    force += c.normal_force * outer;
    tangential -= c.shear_force * normal.transpose();
    length += l * outer;
    slant += (r - l * normal) * normal.transpose();
    stress += (c.normal_force * normal - c.shear_force) * r.transpose();
  }
  if (n == 0 || !(sum_force > 0.0) || !(sum_length > 0.0)) return std::nullopt;
  const Mat<Dim> deviatoric = deviatoric_part<Dim>(stress);
  const double size = deviatoric.norm();
  if (!(stress.trace() > 0.0) || size < kIsotropic * stress.trace() / Dim) return std::nullopt;
  // Norm of a deviatoric tensor of unit amplitude: diag(1, -1) in 2D, diag(2, -1, -1) in 3D.
  const double unit = Dim == 2 ? std::sqrt(2.0) : std::sqrt(6.0);
  const auto along = [&](const Mat<Dim>& m) {
    return deviatoric_part<Dim>(m).cwiseProduct(deviatoric).sum() / (size * unit);
  };
  // Let A and C be the tensors of ContactAnisotropy, and D the dimension. Over the normals n, the mean of n n is (1 + 2
  // A/(D + 2))/D. The mean of t n is C/(D + 2), where t is the tangential part of a force or branch vector.
  constexpr double kOfNormals = 0.5 * Dim * (Dim + 2), kOfTangents = Dim == 2 ? 4.0 : 1.5 * 5.0;
  ContactAnisotropy out;
  out.normals = kOfNormals * along(fabric) / n;
  out.normal_force = kOfNormals * along(force) / sum_force - out.normals;
  out.branch_normal = kOfNormals * along(length) / sum_length - out.normals;
  out.tangential_force = kOfTangents * along(tangential) / sum_force;
  out.branch_tangential = kOfTangents * along(slant) / sum_length;
  out.stress_ratio = size / unit / (stress.trace() / Dim);
  out.predicted_ratio = (Dim == 2 ? 0.5 : 0.4) * (out.normals + out.normal_force + out.tangential_force +
                                                  out.branch_normal + out.branch_tangential);
  return out;
}

template <int Dim>
std::optional<double> mean_mobilisation(const Packing<Dim>& packing, const CarryingStructure& carrying) {
  double sum = 0.0;
  int n = 0;
  for (const int k : carrying.contacts) {
    const Contact<Dim>& c = packing.contacts[k];
    const double limit = packing.law_of(c).friction_coefficient() * c.elastic_force;
    if (packing.is_wall(c.j) || !(limit > 0.0)) continue;
    sum += c.shear_force.norm() / limit;
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / n;
}

#define FLOC_INSTANTIATE(Dim)                                                                                  \
  template std::vector<ContactPair> contact_pairs(const Packing<Dim>&, const CarryingStructure&);              \
  template std::optional<ContactAnisotropy> contact_anisotropy(const Packing<Dim>&, const CarryingStructure&); \
  template std::optional<double> mean_mobilisation(const Packing<Dim>&, const CarryingStructure&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
