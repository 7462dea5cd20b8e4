#include "floc/packing/law/contact_response.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/springs.h"

namespace floc {
namespace {

constexpr double kOverlap = 0.1;

template <int Dim>
Law full_law() {
  Law law;
  law += test::linear(100.0);
  law += test::tail_adhesion(2.0, 0.05);
  law += test::coulomb(0.5, 80.0);
  law += test::rolling_spring(0.1, 3.0);
  if (Dim == 3) law += test::twisting_spring(0.2, 5.0);
  return law;
}

template <int Dim>
Packing<Dim> two_grains(const Law& law) {
  Packing<Dim> packing;
  packing.cell.matrix *= 10.0;
  packing.law = law;
  packing.grains = Grains<Dim>::with_size(2);
  packing.grains.radius = {1.0, 0.5};
  packing.grains.mass = {1.0, 0.25};
  return packing;
}

template <int Dim>
struct Touching {
  Contact<Dim> contact;
  SurfaceMotion<Dim> motion;
  Mat<Dim> frame;
};

/// Returns a contact with a random normal, random springs and a random motion.
/// @param tangential, rolling  elongations of the springs after the motion, divided by their limits
template <int Dim>
Touching<Dim> touching(double tangential, double rolling, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const double elastic = 100.0 * kOverlap;
  Touching<Dim> t;
  Vec<Dim> other;
  for (int a = 0; a < Dim; ++a) t.contact.normal[a] = normal(engine), other[a] = normal(engine);
  t.contact.normal.normalize();
  t.contact.gap = -kOverlap;
  const Shear<Dim> along = to_shear<double>(t.contact.normal, other).normalized();
  RotationVector<Dim> axis;
  for (int a = 0; a < kRotations<Dim>; ++a) axis[a] = normal(engine);
  axis = rolling_part<double>(t.contact.normal, axis).normalized();
  const double longest = 0.5 * elastic / 80.0;
  const double furthest = 0.1 * elastic / 3.0;
  test::shear_spring(t.contact) = 0.3 * tangential * longest * along;
  t.motion.slip = 0.7 * tangential * longest * along;
  test::rolling_spring(t.contact) = 0.6 * rolling * furthest * axis;
  t.motion.relative_rotation = 0.4 * rolling * furthest * axis;
  if constexpr (Dim == 3) {
    // In this test, the twisting spring exceeds its limit if and only if the rolling spring stays below its own limit.
    const double twist = (rolling > 1.0 ? 0.5 : -1.3) * 0.2 * elastic / 5.0;
    test::twisting_spring(t.contact) = 0.2 * twist;
    t.motion.twist = 0.8 * twist;
  }
  t.frame.col(0) = t.contact.normal;
  if constexpr (Dim == 2) {
    t.frame.col(1) = tangent<double>(t.contact.normal);
  } else {
    t.frame.col(1) = t.contact.normal.unitOrthogonal();
    t.frame.col(2) = t.contact.normal.cross(t.frame.col(1));
  }
  return t;
}

template <int Dim>
Contact<Dim> after(const Touching<Dim>& t) {
  Contact<Dim> c = t.contact;
  respond<Dim>(two_grains<Dim>(full_law<Dim>()), {&t.motion, 1}, {&c, 1});
  return c;
}

template <int Dim>
ContactTangent<Dim> tangent_at(const Touching<Dim>& t, const Law& law = full_law<Dim>()) {
  ContactTangent<Dim> k;
  contact_tangents<Dim>(two_grains<Dim>(law), {&t.contact, 1}, {&t.motion, 1}, {&t.frame, 1}, {&k, 1});
  return k;
}

template <int Dim>
ContactTangent<Dim> by_differences(const Touching<Dim>& t) {
  using Row = Eigen::Matrix<double, kDofs<Dim>, 1>;
  Mat<kRotations<Dim>> axes = Mat<kRotations<Dim>>::Identity();
  if constexpr (Dim == 3) axes = t.frame;
  const auto carried = [&](int dof, double by) {
    Touching<Dim> moved = t;
    if (dof == 0) moved.contact.gap -= by;
    if (dof > 0 && dof < Dim)
      moved.motion.slip += by * to_shear<double>(t.contact.normal, Vec<Dim>(t.frame.col(dof)));
    if (dof >= Dim)  // rotation of i relative to j
      moved.motion.relative_rotation -=
          by * rolling_part<double>(t.contact.normal, RotationVector<Dim>(axes.col(dof - Dim)));
    if (Dim == 3 && dof == Dim) moved.motion.twist -= by;
    const Contact<Dim> c = after(moved);
    Row f;
    f[0] = c.normal_force;
    for (int a = 1; a < Dim; ++a) f[a] = c.shear_force.dot(t.frame.col(a));
    f.template tail<kRotations<Dim>>() = axes.transpose() * spring_moment(c);
    return f;
  };
  constexpr double kStep = 1e-6;
  ContactTangent<Dim> k;
  for (int b = 0; b < kDofs<Dim>; ++b) k.col(b) = (carried(b, kStep) - carried(b, -kStep)) / (2.0 * kStep);
  return k;
}

template <int Dim>
void expect_tangents() {
  for (unsigned seed = 0; seed < 4; ++seed)
    for (const double tangential : {0.5, 1.6})
      for (const double rolling : {0.5, 1.6}) {
        const auto t = touching<Dim>(tangential, rolling, seed);
        EXPECT_EQ(after(t).sliding, tangential > 1.0);
        EXPECT_EQ(after(t).rolling_yield, rolling > 1.0);
        EXPECT_EQ(after(t).twisting_yield, Dim == 3 && rolling < 1.0);
        // The truncation error is the square of the step divided by the elongation of the spring, about 1e-9. The
        // rounding error is 1e-16/step. Both are multiplied by stiffnesses of up to 100.
        EXPECT_LT((tangent_at(t) - by_differences(t)).cwiseAbs().maxCoeff(), 1e-6)
            << tangential << " " << rolling;
      }
}

TEST(ContactResponse, HasTheTangentOfItsForcesIn2D) {
  expect_tangents<2>();
}

TEST(ContactResponse, HasTheTangentOfItsForcesIn3D) {
  expect_tangents<3>();
}

TEST(ContactResponse, OfASlidingContactFollowsTheElasticForce) {
  const auto t = touching<2>(1.6, 0.5, 0);
  const auto k = tangent_at(t);
  const double sign = t.motion.slip[0] > 0.0 ? 1.0 : -1.0;
  EXPECT_DOUBLE_EQ(k(1, 0), sign * 0.5 * 100.0);
  EXPECT_EQ(k(1, 1), 0.0);
  EXPECT_EQ(k(0, 1), 0.0);
}

template <int Dim>
void expect_to_slide_on() {
  for (unsigned seed = 0; seed < 8; ++seed) {
    auto t = touching<Dim>(1.0 + 1e-8, 1.0 + 1e-8, seed);  // slightly beyond both limits
    const auto sliding = tangent_at(t);
    t.contact = after(t);  // at both limits, up to rounding
    t.motion = {};
    EXPECT_LT((tangent_at(t) - sliding).cwiseAbs().maxCoeff(), 1e-5) << seed;
  }
}

TEST(ContactResponse, AtItsCapSlidesOn) {
  expect_to_slide_on<2>();
  expect_to_slide_on<3>();
}

template <int Dim>
void expect_no_friction_across_a_gap() {
  auto t = touching<Dim>(0.0, 0.0, 1);
  t.contact.gap = 0.02;
  ContactTangent<Dim> expected = ContactTangent<Dim>::Zero();
  expected(0, 0) = -2.0 / 0.05;
  EXPECT_EQ(tangent_at(t), expected);
  EXPECT_TRUE(after(t).distant);
}

TEST(ContactResponse, AcrossAGapIsNormalAlone) {
  expect_no_friction_across_a_gap<2>();
  expect_no_friction_across_a_gap<3>();
}

TEST(ContactResponse, WithoutMotionIsThatOfARefreshedContact) {
  Packing<2> packing = two_grains<2>(full_law<2>());
  packing.grains.position[1] = 1.4 * Vec<2>(0.6, 0.8);
  Contact<2> c;
  c.j = 1;
  test::shear_spring(c)[0] = 1.0;
  test::rolling_spring(c)[0] = -0.02;
  packing.contacts = {c};
  refresh_contacts(packing);
  const Contact<2>& expected = packing.contacts[0];
  Contact<2> responded = expected;
  test::shear_spring(responded)[0] = 1.0;
  const SurfaceMotion<2> still;
  respond<2>(packing, {&still, 1}, {&responded, 1});
  EXPECT_EQ(responded.shear_force, expected.shear_force);
  EXPECT_EQ(responded.rolling_moment, expected.rolling_moment);
  EXPECT_EQ(responded.normal_force, expected.normal_force);
  EXPECT_EQ(test::shear_spring(responded), test::shear_spring(expected));
  EXPECT_TRUE(responded.sliding);
}

TEST(ContactResponse, IsCarriedWithTheNormalIn3D) {
  auto t = touching<3>(0.5, 0.5, 2);
  const Vec<3> n0 = t.contact.normal;
  const Vec<3> n1 = (n0 + 0.1 * t.frame.col(1)).normalized();
  const auto start = t.contact;
  const auto moved = t.motion;
  transport_history<3>(history_quantities(full_law<3>(), 3), n1, 0.2, t.contact, t.motion);
  EXPECT_EQ(t.contact.normal, n1);
  EXPECT_LT(std::abs(test::shear_spring(t.contact).dot(n1)), 1e-15);
  EXPECT_NEAR(test::shear_spring(t.contact).norm(), test::shear_spring(start).norm(), 1e-15);
  EXPECT_EQ(t.motion.slip, Vec<3>(transport<double>(moved.slip, n0, n1, 0.2)));
  EXPECT_EQ(test::rolling_spring(t.contact),
            Vec<3>(transport<double>(test::rolling_spring(start), n0, n1, 0.2)));
}

}  // namespace
}  // namespace floc
