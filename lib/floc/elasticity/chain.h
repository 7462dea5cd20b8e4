#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/base/vec.h"

namespace floc {

/// Stiffnesses of a contact, the same for all contacts of a chain of disks, all > 0.
struct ChainStiffness {
  double normal;      ///< normal stiffness K_N (force/length)
  double tangential;  ///< tangential stiffness K_T (force/length)
  double rolling;     ///< rolling stiffness K_R (force * length)
};

/// Allowed range of the number of disks of a chain. A chain of a million disks takes six seconds and 2.7 GB.
inline constexpr WholeRange kChainLength{.least = 2, .most = 1000000};

/// Returns the compliance 1/K_N^(n) = (n-1)/K_N of a straight chain of n disks along itself (length/force).
/// @param n  number of disks, in kChainLength
/// @throws InputError if n is out of range or a stiffness is not positive
double chain_axial_compliance(int n, const ChainStiffness& k);

/// Returns the transverse compliance 1/K_T^(n) of the two-disk equivalent of a straight chain of n disks
/// (length/force).
///
///   1/K_T^(n) = (n-1)/K_T + n (n-1) (n-2) R^2 / (3 K_R)
///
/// The equivalent is a pair of disks of radius (n-1) R, with their contact in the middle of the chain, where a
/// transverse force does not turn the two ends relative to each other. The formula is exact: it equals the solved
/// network to rounding. The formula printed as Eq. 16 of [GRC2008] is a different displacement, see
/// end_disk_deflection().
/// @param n  number of disks, in kChainLength; for n = 2 the chain is a single contact
/// @param R  radius of the disks (length), > 0
/// @throws InputError if n is out of range, or if R or a stiffness is not positive
double chain_transverse_compliance(int n, double R, const ChainStiffness& k);

/// Returns the compliance 1/K_R^(n) = (n-1)/K_R of a straight chain of n disks in bending, in 1/(force * length).
/// @throws InputError if n is out of range or a stiffness is not positive
double chain_rolling_compliance(int n, const ChainStiffness& k);

/// Returns the displacement of the centre of the last disk of a straight chain whose first disk is fixed, for a unit
/// transverse force along a line through the last contact (length/force; [GRC2008], Eq. 16 as printed).
///
///   (n-1)/K_T + (n-1) (4 n^2 - 11 n + 6) R^2 / (3 K_R)
///
/// For large n it is the displacement l^3/(3 EI) of a cantilever, with EI = 2 R K_R and l = 2 (n-1) R.
/// @throws InputError if n is out of range, or if R or a stiffness is not positive
double end_disk_deflection(int n, double R, const ChainStiffness& k);

/// Number with a bound on its error.
struct BoundedValue {
  double value;
  double error;  ///< upper bound on |value - exact value|; infinite if no digit is correct

  bool resolved() const { return error < value; }
};

/// Compliances of a straight or bent chain of disks whose first disk is fixed, found by solving its contact network.
struct SolvedChain {
  BoundedValue
      axial;  ///< displacement along the line through the end disks' centres, per force along this line
  /// displacement across the line through the end disks' centres, per force across its middle
  BoundedValue transverse;
  BoundedValue rolling;  ///< rotation of the last disk per moment on it
  /// displacement of the last disk's centre across that line, per force through the last contact
  BoundedValue end_disk;
  double
      condition;  ///< estimated condition number of the stiffness matrix; infinite if it is singular to rounding
};

/// Returns the directions of the n - 1 branches of an evenly bent chain of n disks, as unit vectors: each branch is
/// turned by `bend` (radians) relative to the previous one. With bend = 0 the chain is straight along x.
/// @throws InputError if n is out of range or `bend` is not finite
std::vector<Vec<2>> bent_chain(int n, double bend);

/// Solves the network of a chain for its compliances, with error bounds.
/// @param branches  unit vectors from each disk to the next, one fewer than the number of disks, which kChainLength
///                  limits; the last disk must not coincide with the first
/// @param R         radius of the disks (length), > 0
/// @throws InputError if R or a stiffness is not positive, or if the last disk lies on the first
SolvedChain solve_chain(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k);

}  // namespace floc
