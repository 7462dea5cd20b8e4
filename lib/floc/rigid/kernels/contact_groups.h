#pragma once

#include <cstdint>

#include "floc/base/aligned_vector.h"
#include "floc/base/vec.h"
#include "floc/geometry/frame.h"
#include "floc/rigid/coupled_response.h"

/// Bodies and contacts of a time step in the form that the sweeps of GaussSeidel read and change: plain arrays of
/// doubles. All values that do not change during the sweeps are computed once.
namespace floc {

/// Number of contacts in a group. The contacts of a group share no body that moves, and are solved side by side.
inline constexpr int kGroup = 8;

/// One number for each contact of a group.
using Lanes = double[kGroup];

/// Layout of the row of a body: the places of its components, in doubles from the beginning of the row.
template <int Dim>
struct BodyRow {
  static constexpr int kVelocity = 0, kSpin = Dim;
  static constexpr int kInverseMass = kDofs<Dim>;  ///< one component for each axis of space
  /// Components xx, yy, zz, yz, xz, xy of the inverse inertia tensor in 3D; in 2D the inverse moment of inertia.
  static constexpr int kInverseInertia = kInverseMass + Dim;
  /// Number of doubles at the beginning of the row that contain the velocity and the spin, rounded up to a power of two.
  static constexpr int kMotion = Dim == 2 ? 4 : 8;
  static constexpr int kSize = Dim == 2 ? 8 : 16;
};

/// Branch vectors r of the contacts of a group, stored only if the rate of stretch L of the cell is an unknown of the
/// step. If L is imposed, the velocity L r is part of the bias.
template <int Dim, bool Cell>
struct BranchLanes {
  Lanes branch[Dim];
};
template <int Dim>
struct BranchLanes<Dim, false> {};

/// Values that the groups of all models (RoundGroup and CoupledGroup) have.
template <int Dim, bool Cell, int n_impulse>
struct alignas(kCacheLine) ContactGroup : BranchLanes<Dim, Cell> {
  static constexpr int kDim = Dim;
  static constexpr bool kCell = Cell;
  /// number of components of an impulse
  static constexpr int kImpulse = n_impulse;

  int i[kGroup], j[kGroup];  ///< indices of the bodies
  /// For each contact, whether its bodies move. Several threads may solve contacts of a body that does not move, so no
  /// thread may change this body.
  std::uint8_t moves_i[kGroup], moves_j[kGroup];
  bool touches_itself;  ///< whether a contact is between a body and its own periodic image
  bool is_idle;         ///< whether the group is left out (TeamSweeps)
  /// Numbers of a whole group begin with a cache line, so that no vector register is loaded from two.
  alignas(kCacheLine) Lanes impulse[kImpulse];
  /// Impulses y_t and y_(t-1) at the start of the last sweep and of the sweep before (TeamSweeps::share_of_change()).
  Lanes start[kImpulse], earlier_start[kImpulse];
};

/// Contacts of disks, spheres and planes. The normal of each contact goes through the centres of both bodies, so the
/// normal impulse exerts no moment. The moment of inertia of a body is equal about all axes, so all tangential
/// directions are equivalent. Tangential vectors have the type Shear of geometry/frame.h. The components of an impulse
/// are its normal component, followed by its tangential vector.
///
/// A contact has the response (A_n, A_t), the compliance (C_n, C_t), the bias (b_n, b_t) and the relative velocity
/// (u_n, u_t). In the solution, its impulse (P, p_t) satisfies the equations below. Here [x]_+ = max(x, 0), and
/// proj_{mu P} is the projection onto the vectors with |p_t| <= mu P.
///     P = [P - (u_n + b_n + C_n P)/A_n]_+,      p_t = proj_{mu P}(p_t - (u_t + b_t + C_t p_t)/A_t).
template <int Dim, bool Cell>
struct RoundGroup : ContactGroup<Dim, Cell, 1 + kShearComponents<Dim>> {
  Lanes normal[Dim];
  Lanes arm_i, arm_j;                            // a_i = arm_i n, a_j = -arm_j n
  Lanes inverse_normal, inverse_tangential;      // 1/A_n, 1/A_t
  Lanes keep_normal, keep_tangential;            // factors of the present impulse: 1 - C_n/A_n and 1 - C_t/A_t
  Lanes bias_normal;                             // b_n/A_n
  Lanes bias_tangential[kShearComponents<Dim>];  // b_t/A_t
  Lanes friction;
};

/// Contacts of bodies of any shape, at any points of their surfaces. In 3D the tangents of a contact are the axes in
/// which the matrix of the response to tangential impulses is diagonal. Impulses are in the frame of the contact.
template <int Dim, bool Cell>
struct CoupledGroup : ContactGroup<Dim, Cell, Dim> {
  Lanes frame[Dim * Dim];  // components of the normal, then those of each tangent
  Lanes arm_i[Dim], arm_j[Dim], bias[Dim];
  Lanes normal_compliance, tangential_compliance;
  Lanes response[CoupledResponse<Dim>::kNumbers];
};

}  // namespace floc
