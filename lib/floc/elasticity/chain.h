#pragma once

#include <vector>

#include "floc/base/range.h"
#include "floc/base/vec.h"

namespace floc {

/// Stiffnesses of each contact in a chain of disks; all > 0.
struct ChainStiffness {
  double normal;      ///< normal stiffness K_N (force/length)
  double tangential;  ///< tangential stiffness K_T (force/length)
  double rolling;     ///< rolling stiffness K_R (force * length)
};

/// Allowed numbers of disks of a chain. A chain of a million disks takes six seconds and 2.7 GB.
inline constexpr WholeRange kChainLength{.least = 2, .most = 1000000};

/// Returns the compliance 1/K_N^(n) = (n-1)/K_N of a straight chain of n disks along its axis (length/force).
/// @param n  number of disks, in kChainLength
/// @param k  stiffnesses K_N, K_T, K_R of a contact
/// @throws InputError if n is out of range or a stiffness is not positive
double chain_axial_compliance(int n, const ChainStiffness& k);

/// Returns the transverse compliance 1/K_T^(n) of a straight chain of n disks (length/force).
///
///   1/K_T^(n) = (n-1)/K_T + n (n-1) (n-2) R^2 / (3 K_R)
///
/// The chain is equivalent to two disks of radius (n-1) R whose contact has this compliance and lies in the middle of
/// the chain. A transverse force at this point does not turn the two ends of the chain relative to each other. The
/// formula is exact: it equals the compliance of the solved network up to rounding errors. Eq. 16 of [GRC2008], as
/// printed, describes another displacement, see end_disk_deflection().
/// @param n  number of disks, in kChainLength; for n = 2 the chain is a single contact
/// @param R  radius of the disks (length), > 0
/// @param k  stiffnesses K_N, K_T, K_R of a contact
/// @throws InputError if n is out of range, or if R or a stiffness is not positive
double chain_transverse_compliance(int n, double R, const ChainStiffness& k);

/// Returns the compliance 1/K_R^(n) = (n-1)/K_R of a straight chain of n disks in bending (1/(force * length)).
/// @param n  number of disks, in kChainLength
/// @param k  stiffnesses K_N, K_T, K_R of a contact
/// @throws InputError if n is out of range or a stiffness is not positive
double chain_rolling_compliance(int n, const ChainStiffness& k);

/// Returns the transverse displacement of the centre of the last disk in a straight chain (length/force; [GRC2008], Eq.
/// 16 as printed). The first disk is fixed, and a unit transverse force acts along a line through the last contact.
///
///   (n-1)/K_T + (n-1) (4 n^2 - 11 n + 6) R^2 / (3 K_R)
///
/// For large n, the result is the displacement l^3/(3 EI) of a cantilever with the bending stiffness EI = 2 R K_R and
/// the length l = 2 (n-1) R.
/// @param n  number of disks, in kChainLength
/// @param R  radius of the disks (length), > 0
/// @param k  stiffnesses K_N, K_T, K_R of a contact
/// @throws InputError if n is out of range, or if R or a stiffness is not positive
double end_disk_deflection(int n, double R, const ChainStiffness& k);

/// Number with a bound on its error.
struct BoundedValue {
  double value;
  double error;  ///< upper bound on |value - exact value|; infinite if no digit is correct

  bool resolved() const { return error < value; }
};

/// Compliances of a straight or bent chain of disks whose first disk is fixed, found by solving its contact network.
/// The chord is the line through the centres of the end disks.
struct SolvedChain {
  BoundedValue axial;  ///< displacement of the last disk along the chord, per force along the chord
  /// displacement of the last disk across the chord, per force that acts across the chord at the middle of the chord
  BoundedValue transverse;
  BoundedValue rolling;  ///< rotation of the last disk per moment on this disk
  /// displacement of the last disk's centre across the chord, per force that acts across the chord at the last contact
  BoundedValue end_disk;
  /// estimated condition number of the stiffness matrix; infinite if rounding makes the matrix singular
  double condition;
};

/// For an evenly bent chain of n disks, returns the unit vectors from each disk to the next. Each vector is turned by
/// `bend` (radians) relative to the previous vector. With bend = 0 the chain is straight along x.
/// @throws InputError if n is out of range or `bend` is not finite
std::vector<Vec<2>> bent_chain(int n, double bend);

/// Solves the contact network of a chain for its compliances, with error bounds.
/// @param branches  unit vectors from the centre of each disk to the centre of the next disk: one fewer than the
///                  number of disks, which has to be in kChainLength. The last disk must not coincide with the first
/// @param R         radius of the disks (length), > 0
/// @param k         stiffnesses of a contact
/// @throws InputError if R or a stiffness is not positive, or if the last disk lies on the first
SolvedChain solve_chain(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k);

}  // namespace floc
