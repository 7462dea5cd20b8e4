#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/base/vec.h"

namespace floc {

/// Stiffnesses of every contact of a chain, all > 0.
struct ChainStiffness {
  double normal;      ///< K_N (force/length)
  double tangential;  ///< K_T (force/length)
  double rolling;     ///< K_R (force * length)
};

/// Range of the number of disks of a chain: a million take six seconds and 2.7 GB.
inline constexpr WholeRange kChainLength{.least = 2, .most = 1000000};

/// Returns the compliance 1/K_N^(n) = (n-1)/K_N of a straight chain along itself (length/force).
/// @param n  number of disks, in kChainLength
/// @throws InputError for another n or a stiffness that is not positive
double chain_axial_compliance(int n, const ChainStiffness& k);

/// Returns the transverse compliance 1/K_T^(n) of the two-disk equivalent of a straight chain (length/force).
///
///   1/K_T^(n) = (n-1)/K_T + n (n-1) (n-2) R^2 / (3 K_R)
///
/// The equivalent has radii (n-1) R and its contact at mid-chain, where a transverse force does not turn the
/// ends against each other.
/// @param n  number of disks, in kChainLength; n = 2 is the contact itself.
/// @param R  radius of the disks (length), > 0.
/// The formula is exact: it equals the solved network to rounding. The form printed as Eq. 16 of [GRC2008] is another
/// displacement; it is `end_disk_deflection()`.
/// @throws InputError for another n, or if R or a stiffness is not positive.
double chain_transverse_compliance(int n, double R, const ChainStiffness& k);

/// Returns the compliance 1/K_R^(n) = (n-1)/K_R of a straight chain in bending, in 1/(force * length).
/// @throws InputError for another n or a stiffness that is not positive.
double chain_rolling_compliance(int n, const ChainStiffness& k);

/// Returns the displacement of the centre of the last disk of a straight chain whose first disk is held, for a
/// unit transverse force on a line through the last contact (length/force; [GRC2008], Eq. 16 as printed).
///
///   (n-1)/K_T + (n-1) (4 n^2 - 11 n + 6) R^2 / (3 K_R)
///
/// For large n it is the displacement of a cantilever, l^3/(3 EI), with EI = 2 R K_R and l = 2 (n-1) R.
/// @throws InputError for another n, or if R or a stiffness is not positive.
double end_disk_deflection(int n, double R, const ChainStiffness& k);

/// A number and a bound on its error.
struct BoundedValue {
  double value;
  double error;  ///< |value - exact| is below this; infinite where no digit is left

  bool resolved() const { return error < value; }
};

/// Compliances of a chain found by solving its network, disk 1 held, straight or bent.
struct SolvedChain {
  BoundedValue axial;       ///< along the line through the end disks' centres, for a force along it
  BoundedValue transverse;  ///< across it, for a force across it through its middle
  BoundedValue rolling;     ///< rotation of the last disk for a moment
  BoundedValue end_disk;    ///< displacement across it of the last centre, for a force through the last contact
  double condition;  ///< condition number of the stiffness, estimated; infinite if rounding leaves no rank
};

/// Returns the directions of the n - 1 branches of a chain of n disks bent evenly: each is turned by `bend`
/// (radians) relative to the one before; with 0 the chain is straight along x.
/// @throws InputError for another n, or a bend that is not finite
std::vector<Vec<2>> bent_chain(int n, double bend);

/// Solves the network of a chain for its compliances, with error bounds.
/// @param branches  unit vectors from each disk to the next, fewer than the disks allowed by kChainLength, which do
///                  not lead back to the start
/// @param R         radius of the disks (length), > 0
/// @throws InputError if R or a stiffness is not positive, or the last disk lies on the first.
SolvedChain solve_chain(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k);

}  // namespace floc
