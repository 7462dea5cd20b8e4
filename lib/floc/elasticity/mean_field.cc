#include "floc/elasticity/mean_field.h"

#include <cmath>
#include <numbers>

#include "floc/elasticity/compliance_term.h"

namespace floc {
namespace {

/// Returns the ratio G/B of the shear and bulk moduli if the grains follow the strain of the cell and the directions of
/// contacts are isotropic.
/// @param ratio  ratio K_T/K_N of tangential to normal stiffness
double shear_over_bulk(int dimension, double ratio) {
  return dimension == 2 ? (1.0 + ratio) / 2.0 : 0.6 * (1.0 + 1.5 * ratio);
}

struct Averages {
  double n = 0.0;
  double kn = 0.0, kt = 0.0, force = 0.0, complementary = 0.0;
  double n_pressed = 0.0;  // number of contacts with F_N > 0
  double pressed = 0.0, scaled = 0.0;
};

template <int Dim>
Averages average(const ContactNetwork<Dim>& network) {
  Averages m;
  for (const NetworkContact<Dim>& c : network.contacts) {
    if (c.distant) continue;
    const double N = c.normal_force, T2 = c.shear_force.squaredNorm();
    m.n += 1.0;
    m.kn += c.kn;
    m.kt += c.kt;
    m.force += N;
    m.complementary += compliance_term(N * N, c.kn) + compliance_term(T2, c.kt) +
                       compliance_term(c.rolling_moment.squaredNorm(), c.kr) +
                       compliance_term(c.twisting_moment * c.twisting_moment, c.ktw);
    if (!(N > 0.0)) continue;
    m.n_pressed += 1.0;
    m.pressed += N;
    m.scaled += std::pow(N, 5.0 / 3.0) * (1.0 + compliance_term(T2 * c.kn, c.kt) / (N * N));
  }
  for (double* sum : {&m.kn, &m.kt, &m.force, &m.complementary}) *sum /= m.n;
  for (double* sum : {&m.pressed, &m.scaled}) *sum /= m.n_pressed;
  return m;
}

/// Mean diameter <d>, mean squared diameter <d^2> and mean volume (area in 2D) of the grains.
struct Sizes {
  double d = 0.0, d2 = 0.0, volume = 0.0;
};

template <int Dim>
Sizes sizes_of(const ContactNetwork<Dim>& network) {
  Sizes s;
  for (const double radius : network.grain_size) {
    s.d += 2.0 * radius / network.n_grains;
    s.d2 += 4.0 * radius * radius / network.n_grains;
    s.volume += (Dim == 2 ? 1.0 : 4.0 / 3.0 * radius) * std::numbers::pi * radius * radius / network.n_grains;
  }
  return s;
}

}  // namespace

template <int Dim>
MeanFieldEstimates mean_field_estimates(const ContactNetwork<Dim>& network, double coordination,
                                        double solid_fraction) {
  MeanFieldEstimates out;
  const Averages m = average(network);
  if (m.n == 0.0) return out;
  const Sizes s = sizes_of(network);
  // Number of contacts per volume, divided by Dim^2. If the diameters d of the grains are drawn independently, the mean
  // squared distance between touching centres is (<d^2> + <d>^2)/2.
  const double density = 0.5 * coordination * solid_fraction / s.volume / (Dim * Dim);
  out.B_voigt = density * m.kn * 0.5 * (s.d2 + s.d * s.d);
  out.G_voigt_rough = shear_over_bulk(Dim, m.kt / m.kn) * out.B_voigt;
  out.G_voigt_smooth = shear_over_bulk(Dim, 0.0) * out.B_voigt;
  if (m.complementary > 0.0) out.B_reuss = density * s.d * s.d * m.force * m.force / m.complementary;
  if (m.n_pressed > 0.0) out.Z_hat = m.scaled / std::pow(m.pressed, 5.0 / 3.0);
  return out;
}

HertzMeanField hertz_mean_field(double coordination, double solid_fraction, double E, double ratio, double P,
                                double Z_third) {
  const double contacts = coordination * solid_fraction / (3.0 * std::numbers::pi);
  HertzMeanField out;
  out.B = 0.5 * std::pow(contacts * E, 2.0 / 3.0) * std::cbrt(P) * Z_third;
  out.kn_over_a = out.B / contacts;
  out.G_rough = shear_over_bulk(3, ratio) * out.B;
  out.G_smooth = shear_over_bulk(3, 0.0) * out.B;
  return out;
}

template MeanFieldEstimates mean_field_estimates(const ContactNetwork<2>&, double, double);
template MeanFieldEstimates mean_field_estimates(const ContactNetwork<3>&, double, double);

}  // namespace floc
