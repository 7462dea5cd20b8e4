#include "floc/elasticity/force_increments.h"

namespace floc {

template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain) {
  const Eigen::VectorXd motion = response.fluctuation * strain;
  std::vector<ForceIncrement<Dim>> increments;
  increments.reserve(network.contacts.size());
  for (const NetworkContact<Dim>& c : network.contacts) {
    // A dead end follows its holder; its contact stays as it is.
    if (response.free.dead_end[c.i] || response.free.dead_end[c.j]) {
      increments.push_back({0.0, Eigen::Matrix<double, Dim - 1, 1>::Zero(), Spin<Dim>::Zero()});
      continue;
    }
    const ContactRows<Dim> g = contact_rows(c);
    const Eigen::Matrix<double, kDofs<Dim>, 1> forces =
        row_stiffness(c).cwiseProduct(g.on_i * motion.segment<kDofs<Dim>>(first_unknown<Dim>(c.i)) +
                                      g.on_j * motion.segment<kDofs<Dim>>(first_unknown<Dim>(c.j)) +
                                      g.on_strain.leftCols(strain.size()) * strain);
    increments.push_back(
        {forces[0], forces.template segment<Dim - 1>(1), forces.template tail<kRotations<Dim>>()});
  }
  return increments;
}

template std::vector<ForceIncrement<2>> force_increments(const ContactNetwork<2>&, const ElasticResponse&,
                                                         const Eigen::VectorXd&);
template std::vector<ForceIncrement<3>> force_increments(const ContactNetwork<3>&, const ElasticResponse&,
                                                         const Eigen::VectorXd&);

}  // namespace floc
