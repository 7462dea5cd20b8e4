#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/bounds.h"
#include "floc/elasticity/elastic_response.h"
#include "floc/packing/packing.h"

namespace floc {

class ParallelSolver;

/// Method by which the moduli are computed. It determines their cost, and whether their errors are bounds or estimates.
enum class ModuliMethod {
  factor,         ///< Cholesky factor in double precision; gives error bounds
  single_factor,  ///< Cholesky factor in single precision, refined in double: half the memory; gives error estimates
  iterative,  ///< conjugate gradients from the solution of the last state, with its factor; gives error estimates
  /// Middle between the lower and the upper bound of each modulus: no system is solved, and the error is a bound. Fails
  /// if the bounds are not guaranteed (Bounds::fault). B_S and its error are NaN if the stress is not isotropic.
  bounds,
  petsc,  ///< conjugate gradients by PETSc, on one process or many; gives error estimates
};

struct ModuliOptions {
  ModuliMethod method = ModuliMethod::factor;
  StrainSet strains = StrainSet::diagonal;
  /// Adds the geometric terms of the forces in the state. The moduli are then derivatives of the Cauchy stress.
  bool prestress = false;
  /// Normal force below which a contact of a cohesionless packing counts as carrying no force when rattlers are
  /// searched, in units of F1 = max(F0, P a^(Dim-1)). The default is the tolerance of an equilibrium (docs/physics.md,
  /// "Equilibrium").
  double force_tolerance = 1e-5;
  /// If given, rolling stiffness (force * length) that replaces the rolling stiffness of every touching contact.
  std::optional<double> rolling_stiffness;
  Ordering ordering = Ordering::automatic;
  /// Whether the packing was brought to equilibrium under zero stress. Any stress that its forces give is then residual
  /// and bounds no modulus (B_reuss = 0).
  bool unloaded = false;
  /// Relative tolerance on B and G. A warning is given if their error bounds exceed it.
  double tolerance = 1e-10;
  /// Largest size of a factor (bytes); see Moduli::failure.
  double largest_factor = std::numeric_limits<double>::infinity();

  /// Returns the contacts from which the moduli of a packing are computed: without the contacts of rattlers, and with
  /// `rolling_stiffness` if it is given.
  template <int Dim>
  ContactNetwork<Dim> loaded_network(const Packing<Dim>& packing) const;

  /// Returns every invalid option as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Load of a contact network. Its moduli depend on the load as well as on its contacts.
template <int Dim>
struct NetworkLoad {
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static stress, compression positive (force/length^(Dim-1))
  bool unloaded = false;               ///< whether the network is unloaded, see ModuliOptions
  MeanField mean_field{};              ///< averages for the mean-field forms of the bounds
  int n_mobilised =
      0;  ///< number of mobilised contacts (at a limit of force), which the network treats as elastic
};

/// Returns the load of a packing: its stress, mean-field averages and number of mobilised contacts.
/// @param unloaded  whether the packing is unloaded, see ModuliOptions
template <int Dim>
NetworkLoad<Dim> network_load(const Packing<Dim>& packing, bool unloaded);

/// Elastic moduli of one state, as stress (force/length^(Dim-1)), with their errors, bounds and warnings.
struct Moduli {
  /// Matrix of moduli: stress per strain, both positive in compression, in the order of StrainSet; symmetric.
  Eigen::MatrixXd C;
  double B = 0.0;  ///< strain-controlled bulk modulus B_C: mean of the entries of C for diagonal strains
  /// stress-controlled bulk modulus: 1/(sum of the entries of the inverse of C for diagonal strains)
  double B_S = 0.0;
  double G = 0.0;  ///< shear modulus (C11 + C22 - 2 C12)/4; in 3D its mean over the pairs of axes
  /// Bounds on the errors from solving and rounding in C (entry by entry), B, B_S and G, in their units; see
  /// ElasticResponse::error. Infinite if no bound can be given.
  Eigen::MatrixXd C_error;
  double B_error = 0.0;
  double B_S_error = 0.0;
  double G_error = 0.0;
  double isotropy_defect =
      0.0;        ///< difference of the largest and smallest of C11, C22 (and C33), over their mean
  Bounds bounds;  ///< bounds on these moduli; not guaranteed with prestress, see Bounds::fault
  /// Whether the principal stresses of the load are equal to one part in 10^4, or bounds.B_reuss is zero.
  bool isotropic_stress = true;
  int n_negative = 0;    ///< number of negative eigenvalues of the stiffness matrix, strains included
  int n_mechanisms = 0;  ///< number of zero eigenvalues of the stiffness matrix, free motions not included
  /// Number of mechanisms that strain the cell and that no stiffness resists: the moduli along them are zero.
  int n_coupled_mechanisms = 0;
  int n_rattlers = 0;
  int n_free_rollers = 0;
  int n_mobilised =
      0;  ///< number of mobilised contacts (at a limit of force or moment); C treats them as elastic
  double pressure = 0.0;  ///< pressure: mean of the diagonal of load_stress() (force/length^(Dim-1))
  double residual = 0.0;  ///< relative backward error of the solution
  double condition =
      1.0;  ///< estimated condition number of the stiffness matrix; infinite if there are mechanisms
  /// B and G without prestress, present if `options.prestress` is set: the differences to B and G are the contributions
  /// of prestress.
  std::optional<double> B_without_prestress;
  std::optional<double> G_without_prestress;
  /// Response of loaded_network() without prestress; mechanisms, force increments and the backbone are computed from
  /// it.
  ElasticResponse response;
  /// Method that was used: the one in the options, or ModuliMethod::factor if that one failed. Other methods count
  /// neither negative eigenvalues nor mechanisms. Their errors are estimates or, with ModuliMethod::bounds, half the
  /// distance between the bounds.
  ModuliMethod method = ModuliMethod::factor;
  int steps = 0;  ///< number of refinement steps
  std::vector<std::string> warnings;
  /// Returns whether bounds.B_reuss <= B <= bounds.B_voigt is guaranteed.
  bool bounds_hold() const { return bounds.fault.empty(); }
  /// Returns whether bounds.B_reuss <= B_S is guaranteed.
  bool bounds_hold_B_S() const { return bounds_hold() && isotropic_stress; }
  /// Reason why there are no moduli, as a sentence; only `bounds` is then meaningful. Empty if there are moduli.
  std::string failure;
  /// Predicted size of the factor (bytes) if the failure is that the factor would be too large; otherwise 0.
  double factor_bytes = 0.0;
};

/// Computes the moduli of a state, with every contact treated as elastic. Without prestress C = K/V, with the stiffness
/// K of the strains after relaxation of the grains and the volume V. With prestress, the Cauchy stress sigma responds
/// to the symmetric strain E by dsigma = K E/V - sym(sigma E) + sigma tr E. For diagonal strains this is C_ab = K_ab/V
/// + sigma_a (1 - delta_ab), which equals H_ab/V + sigma_a for the relaxed Hessian H of the energy in ln L; relative to
/// H, B increases by P and G does not change. If the stress is not isotropic, this matrix is not symmetric, and C is
/// its symmetric part. A modulus that is within its error bound of zero is set to zero and counted as a coupled
/// mechanism. Moduli without any correct digit are NaN, with a warning.
/// @param network  contacts that carry load; `options` changes none of them
/// @throws InputError if an option is invalid
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                    const ModuliOptions& options);

/// Computes the moduli with prestress, given the moduli without prestress; `options.prestress` is ignored.
/// @param without  moduli of the same network without prestress
template <int Dim>
[[nodiscard]] Moduli prestressed_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                        ModuliOptions options, Moduli without);

/// Computes the moduli of a packing, from options.loaded_network(packing), under the stress that the packing carries.
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options);

/// Computes the moduli by ModuliMethod::petsc; `options.method` is ignored. All processes of the solver have to call
/// this function with the same arguments, and all obtain the same moduli.
/// @param centres  centres of the grains, by which grains are distributed over the processes (length)
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const std::vector<Vec<Dim>>& centres,
                                    const NetworkLoad<Dim>& load, const ModuliOptions& options,
                                    ParallelSolver& solver);

/// Computes the moduli of a packing for each of several rolling stiffnesses, with a single symbolic factorization.
/// @param rolling_stiffness  values >= 0 that replace options.rolling_stiffness one after another (force * length)
/// @return one entry per rolling stiffness
template <int Dim>
[[nodiscard]] std::vector<Moduli> elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options,
                                                 const std::vector<double>& rolling_stiffness);

/// Computation of the moduli of a sequence of states, such as those of a loading path. With ModuliMethod::iterative,
/// each state starts from the solution of the previous one if both have the same number of grains.
template <int Dim>
class ModuliSequence {
 public:
  /// @throws InputError if an option is invalid
  explicit ModuliSequence(ModuliOptions options);
  /// Computes the moduli of the next state.
  /// @param unloaded  whether the packing is unloaded, see ModuliOptions
  [[nodiscard]] Moduli next(const Packing<Dim>& packing, bool unloaded);

 private:
  ModuliOptions options_;
  ResponseMemory memory_;
};

}  // namespace floc
