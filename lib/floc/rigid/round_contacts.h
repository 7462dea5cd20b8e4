#pragma once

#include <algorithm>
#include <cmath>

#include "floc/base/aligned_vector.h"
#include "floc/geometry/frame.h"
#include "floc/rigid/packed_contacts.h"

namespace floc {

/// Contacts of disks, spheres and planes. The normal of each contact goes through the centres of both bodies, so the
/// normal impulse exerts no moment. The moment of inertia of a body is equal about all axes, so all tangential
/// directions are equivalent. Tangential vectors have the type Shear of geometry/frame.h.
template <int Dim, bool Cell>
struct RoundContacts {
  static constexpr int kDim = Dim;

  struct alignas(kCacheLine) Body {
    Vec<Dim> velocity, inverse_mass;
    RotationVector<Dim> angular_velocity;
    double inverse_inertia;
    bool moves;
  };
  struct Impulse {
    double normal;
    Shear<Dim> tangential;

    Impulse operator+(const Impulse& p) const { return {normal + p.normal, tangential + p.tangential}; }
    Impulse operator-(const Impulse& p) const { return {normal - p.normal, tangential - p.tangential}; }
    friend Impulse operator*(double factor, const Impulse& p) {
      return {factor * p.normal, factor * p.tangential};
    }
    double squaredNorm() const { return normal * normal + tangential.squaredNorm(); }
  };
  /// A contact with response (A_n, A_t), compliance (C_n, C_t), bias (b_n, b_t) and relative velocity (u_n, u_t). In
  /// the solution, its impulse (P, p_t) satisfies the equations below. Here [x]_+ = max(x, 0), and proj_{mu P} is the
  /// projection onto the vectors with |p_t| <= mu P.
  ///     P = [P - (u_n + b_n + C_n P)/A_n]_+,      p_t = proj_{mu P}(p_t - (u_t + b_t + C_t p_t)/A_t).
  struct alignas(kCacheLine / 4) Contact : CellArm<Dim, Cell> {
    int i, j;
    Vec<Dim> normal;
    double arm_i, arm_j;                        // a_i = arm_i n, a_j = -arm_j n
    double inverse_normal, inverse_tangential;  // 1/A_n, 1/A_t
    double keep_normal, keep_tangential;        // factors of the present impulse: 1 - C_n/A_n and 1 - C_t/A_t
    double bias_normal;                         // b_n/A_n
    Shear<Dim> bias_tangential;                 // b_t/A_t
    double friction;
    Impulse impulse;
  };

  static Body pack(const BodyMotion<Dim>& bodies, int i, bool moves) {
    Body out{};
    out.velocity = bodies.velocity[i];
    out.inverse_mass = bodies.inverse_mass[i];
    out.angular_velocity = bodies.angular_velocity[i];
    out.inverse_inertia = bodies.inverse_inertia[i](0, 0);
    out.moves = moves;
    return out;
  }

  static Contact pack(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c, double shared) {
    Contact out{};
    if constexpr (Cell) out.branch = c.branch;
    out.i = c.i;
    out.j = c.j;
    out.normal = c.frame.col(0);
    // A body that does not rotate, such as a plane, may have any shape; the arm of such a body is set to zero.
    out.arm_i = bodies.inverse_inertia[c.i](0, 0) > 0.0 ? c.arm_i.dot(out.normal) : 0.0;
    out.arm_j = bodies.inverse_inertia[c.j](0, 0) > 0.0 ? -c.arm_j.dot(out.normal) : 0.0;
    // The sum of the absolute values in a row of the response is an upper bound (Gershgorin). The first row gives the
    // bound for the normal direction. The largest sum of the other rows is the bound for the tangential directions.
    // Off-diagonal components are due to walls and to the cell.
    const Vec<Dim> bound = packed_response(bodies, c, c.frame, shared).cwiseAbs().rowwise().sum();
    const double normal = bound[0], tangential = bound.template tail<Dim - 1>().maxCoeff();
    out.inverse_normal = 1.0 / normal;
    out.inverse_tangential = 1.0 / tangential;
    out.keep_normal = 1.0 - c.normal_compliance / normal;
    out.keep_tangential = 1.0 - c.tangential_compliance / tangential;
    const Impulse bias = in_normal_and_tangents(c.frame, packed_bias<Dim, Cell>(bodies, c));
    out.bias_normal = bias.normal / normal;
    out.bias_tangential = bias.tangential / tangential;
    out.friction = c.friction;
    out.impulse = in_normal_and_tangents(c.frame, c.impulse);
    return out;
  }

  static Impulse normal_impulse(double p) { return {p, Shear<Dim>::Zero()}; }

  static Vec<Dim> in_frame(const Contact& c, const Mat<Dim>& frame) {
    Vec<Dim> out = frame.transpose() * from_shear<double>(c.normal, c.impulse.tangential);
    out[0] = c.impulse.normal;
    return out;
  }

  static void apply(const Contact& c, const Impulse& impulse, Body* bodies, Vec<Dim>& gain) {
    Vec<Dim> in_space = c.normal * impulse.normal;
    in_space += from_shear<double>(c.normal, impulse.tangential);
    const RotationVector<Dim> turn = moment_of_tangential(c.normal, impulse.tangential);
    // Several threads may solve contacts of a body that does not move, so no thread may change this body.
    if (Body& i = bodies[c.i]; i.moves) {
      i.velocity -= i.inverse_mass.cwiseProduct(in_space);
      i.angular_velocity -= (i.inverse_inertia * c.arm_i) * turn;
    }
    if (Body& j = bodies[c.j]; j.moves) {
      j.velocity += j.inverse_mass.cwiseProduct(in_space);
      j.angular_velocity -= (j.inverse_inertia * c.arm_j) * turn;
    }
    c.add_gain(in_space, gain);
  }

  static void solve(Contact& c, Body* bodies, const Vec<Dim>& stretch, Vec<Dim>& gain) {
    const Impulse free = unlimited(c, bodies, stretch);
    const double normal = std::max(free.normal, 0.0);
    const Shear<Dim> tangential = limited(free.tangential, c.friction * normal);
    const Impulse change{normal - c.impulse.normal, tangential - c.impulse.tangential};
    c.impulse = {normal, tangential};
    apply(c, change, bodies, gain);
  }

  /// Returns contact_error() of a contact, computed with the response in its record.
  static double error(const Contact& c, const Body* bodies, const Vec<Dim>& stretch) {
    const Impulse free = unlimited(c, bodies, stretch);
    const Shear<Dim> tangential = limited(free.tangential, c.friction * std::max(c.impulse.normal, 0.0));
    return std::max(std::abs(std::max(free.normal, 0.0) - c.impulse.normal),
                    (tangential - c.impulse.tangential).norm());
  }

  static double normal(const Contact& c) { return c.impulse.normal; }

 private:
  static Impulse in_normal_and_tangents(const Mat<Dim>& frame, const Vec<Dim>& v) {
    const Vec<Dim> n = frame.col(0);
    return {v[0],
            to_shear<double>(n, Vec<Dim>(frame.template rightCols<Dim - 1>() * v.template tail<Dim - 1>()))};
  }
  /// Returns the moment n x p_t of a tangential impulse p_t with the normal n as lever arm.
  static RotationVector<Dim> moment_of_tangential(const Vec<Dim>& n, const Shear<Dim>& p) {
    if constexpr (Dim == 2)
      return p;
    else
      return moment<double>(n, p);
  }
  /// Returns the velocity w x n of the tip of the normal n for the angular velocity w, as a tangential vector.
  static Shear<Dim> turned_normal(const RotationVector<Dim>& w, const Vec<Dim>& n) {
    if constexpr (Dim == 2)
      return w;
    else
      return cross<double>(w, n);
  }
  /// Returns the impulse before the limits P >= 0 and |p_t| <= mu P are applied: the arguments of [ ]_+ and proj in the
  /// equations of Contact.
  static Impulse unlimited(const Contact& c, const Body* bodies, const Vec<Dim>& stretch) {
    const Body &i = bodies[c.i], &j = bodies[c.j];
    Vec<Dim> u = j.velocity - i.velocity;
    c.add_velocity(stretch, u);
    const RotationVector<Dim> spin = c.arm_i * i.angular_velocity + c.arm_j * j.angular_velocity;
    const Shear<Dim> slip = to_shear<double>(c.normal, u) - turned_normal(spin, c.normal);
    return {c.keep_normal * c.impulse.normal - (c.inverse_normal * c.normal.dot(u) + c.bias_normal),
            c.keep_tangential * c.impulse.tangential - (c.inverse_tangential * slip + c.bias_tangential)};
  }
  static Shear<Dim> limited(const Shear<Dim>& p, double most) {
    if constexpr (Dim == 2) {
      return Shear<2>(std::clamp(p[0], -most, most));
    } else {
      const double square = p.squaredNorm();
      return p * (square > most * most ? most / std::sqrt(square) : 1.0);
    }
  }
};

}  // namespace floc
