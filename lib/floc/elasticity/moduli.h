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

/// Method by which the moduli are computed. The method determines the cost of the moduli, and whether their errors are
/// bounds or estimates.
enum class ModuliMethod {
  factor,  ///< Cholesky factor in double precision; gives error bounds
  /// Cholesky factor in single precision, with refinement in double precision; needs half the memory and gives error
  /// estimates
  single_factor,
  /// conjugate gradients that start from the solution of the last state, with the factor of that state as
  /// preconditioner; gives error estimates
  iterative,
  /// Mean of the lower and the upper bound of each modulus; no system is solved. Half the distance between the bounds
  /// is a bound on the error. Fails if the bounds are not guaranteed (Bounds::fault). The bulk modulus B_S under
  /// imposed stress, and the error of B_S, are NaN if the stress is not isotropic.
  bounds,
  petsc,  ///< conjugate gradients by PETSc, on one process or many; gives error estimates
};

struct ModuliOptions {
  ModuliMethod method = ModuliMethod::factor;
  StrainSet strains = StrainSet::diagonal;
  /// Whether the geometric terms, which result from the contact forces, are added to the stiffness. The moduli are in
  /// this case derivatives of the Cauchy stress.
  bool prestress = false;
  /// Tolerance for the search for rattlers of a cohesionless packing. A contact counts as carrying no force if its
  /// normal force is at most this number, in units of F1 = max(F0, P a^(Dim-1)) (pull-off force F0, pressure P, largest
  /// diameter a). The default is the tolerance of an equilibrium (docs/physics.md, "Equilibrium").
  double force_tolerance = 1e-5;
  /// Rolling stiffness of every touching contact (force * length), in place of the stiffness of the contact law. If
  /// absent, the contact law applies.
  std::optional<double> rolling_stiffness;
  Ordering ordering = Ordering::automatic;
  /// Whether the packing was brought to equilibrium under zero stress. If so, the small stress of the contact forces is
  /// only a residual, and B_reuss is 0.
  bool unloaded = false;
  /// Tolerance on the relative errors of B and G. A warning is given if an error bound exceeds this tolerance.
  double tolerance = 1e-10;
  /// Largest size of a factor (bytes). If the factor would be larger, no moduli are computed, see Moduli::failure.
  double largest_factor = std::numeric_limits<double>::infinity();

  /// Returns the contacts from which the moduli of a packing are computed: all contacts except the contacts of
  /// rattlers, with `rolling_stiffness` if it is given.
  /// @throws InputError if the contacts are rigid
  template <int Dim>
  ContactNetwork<Dim> loaded_network(const Packing<Dim>& packing) const;

  /// Returns every invalid option as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Load on a contact network. The moduli of the network depend on it.
template <int Dim>
struct NetworkLoad {
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static stress, compression positive (force/length^(Dim-1))
  /// whether the network was brought to equilibrium under zero stress, see ModuliOptions
  bool unloaded = false;
  MeanField mean_field{};  ///< averages for the mean-field forms of the bounds
  /// number of mobilised contacts (whose force is at its limit), which the moduli treat as elastic
  int n_mobilised = 0;
  bool has_weight = false;  ///< whether gravity acts on the grains
  bool has_walls = false;   ///< whether the grains are between walls
};

/// Returns the load of a packing: its stress, its mean-field averages and the number of its mobilised contacts.
/// @param unloaded  whether the packing was brought to equilibrium under zero stress, see ModuliOptions
template <int Dim>
NetworkLoad<Dim> network_load(const Packing<Dim>& packing, bool unloaded);

/// Elastic moduli of one state (force/length^(Dim-1)), with their errors, bounds and warnings.
struct Moduli {
  /// Matrix of moduli: stress per strain, both positive in compression, in the order of StrainSet; symmetric.
  Eigen::MatrixXd C;
  double B = 0.0;  ///< bulk modulus under imposed strain, B_C: mean of the entries of C for diagonal strains
  /// bulk modulus under imposed stress: 1/(sum of the entries of the inverse of C for diagonal strains)
  double B_S = 0.0;
  double G = 0.0;  ///< shear modulus (C11 + C22 - 2 C12)/4; in 3D its mean over the pairs of axes
  /// Bounds on the errors of C (entry by entry), B, B_S and G, in the units of these moduli. The errors result from
  /// solving and rounding; see ElasticResponse::error. Infinite if no bound can be given.
  Eigen::MatrixXd C_error;
  double B_error = 0.0;
  double B_S_error = 0.0;
  double G_error = 0.0;
  /// difference between the largest and the smallest of C11, C22 (and C33), divided by their mean
  double isotropy_defect = 0.0;
  Bounds bounds;  ///< bounds on these moduli; not guaranteed with prestress, see Bounds::fault
  /// Whether the principal stresses of the load are equal within one part in 10^4. Also true if bounds.B_reuss is zero.
  bool isotropic_stress = true;
  int n_negative = 0;    ///< number of negative eigenvalues of the stiffness matrix of grains and strains
  int n_mechanisms = 0;  ///< number of zero eigenvalues of the stiffness matrix; free motions do not count
  /// Number of mechanisms that change the strain of the cell. No stiffness resists such a mechanism, and the moduli for
  /// its strain are zero.
  int n_coupled_mechanisms = 0;
  int n_rattlers = 0;
  int n_free_rollers = 0;
  /// number of mobilised contacts (whose force or moment is at its limit); C treats them as elastic
  int n_mobilised = 0;
  double pressure = 0.0;  ///< pressure: mean of the diagonal of load_stress() (force/length^(Dim-1))
  /// relative backward error of the solution: largest net force on a grain, divided by the size of the forces whose sum
  /// is this net force
  double residual = 0.0;
  /// estimated condition number of the stiffness matrix; infinite if there are mechanisms
  double condition = 1.0;
  /// B and G without prestress; present if `options.prestress` is set. The differences between B and
  /// B_without_prestress, and between G and G_without_prestress, are the contributions of the prestress.
  std::optional<double> B_without_prestress;
  std::optional<double> G_without_prestress;
  /// Elastic response, without prestress, of the network from which the moduli were computed. Mechanisms, force
  /// increments and the backbone are computed from this response.
  ElasticResponse response;
  /// Method that was used: the method in the options or, if it failed, ModuliMethod::factor. Only ModuliMethod::factor
  /// counts negative eigenvalues and mechanisms, and gives error bounds from the solution. With ModuliMethod::bounds,
  /// the error is half the distance between the bounds. With all other methods, the error is an estimate.
  ModuliMethod method = ModuliMethod::factor;
  int steps = 0;  ///< number of refinement steps of the solution
  std::vector<std::string> warnings;
  /// Returns whether B_reuss <= B <= B_voigt is guaranteed, for the bulk modulus B and the bounds B_reuss and B_voigt
  /// in `bounds`.
  bool bounds_hold() const { return bounds.fault.empty(); }
  /// Returns whether B_reuss <= B_S is guaranteed, for the bulk modulus B_S under imposed stress and the bound B_reuss
  /// in `bounds`.
  bool bounds_hold_B_S() const { return bounds_hold() && isotropic_stress; }
  /// Reason why there are no moduli, as a sentence. Empty if there are moduli; otherwise only the member `bounds` is
  /// meaningful.
  std::string failure;
  /// Predicted size (bytes) of the factor if there are no moduli because the factor is too large; otherwise 0.
  double factor_bytes = 0.0;
};

/// Computes the moduli C of a state, with every contact treated as elastic.
///
/// Without prestress C = K/V, where K is the stiffness against strain after relaxation of the grains, and V the volume.
///
/// With prestress, a symmetric strain E changes the Cauchy stress sigma by dsigma = K E/V - sym(sigma E) + sigma tr E.
/// For diagonal strains this means C_ab = K_ab/V + sigma_a (1 - delta_ab), with the Kronecker delta. This equals H_ab/V
/// + sigma_a, where H is the Hessian, after relaxation, of the energy as a function of ln L, with the sides L of the
/// cell. H/V alone would give the same G, but a B that is smaller by the pressure P. If the stress is not isotropic,
/// this matrix is not symmetric, and C is its symmetric part.
///
/// An eigenvalue of C whose absolute value is within its error bound is set to zero and counted as a mechanism that
/// changes the strain of the cell. Moduli without any correct digit are NaN, with a warning.
/// @param network  contacts from which the moduli are computed; `options.rolling_stiffness` does not change them
/// @param load     load that the network carries
/// @throws InputError if an option is invalid
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                    const ModuliOptions& options);

/// Computes the moduli with prestress. Some members of the result, such as B_without_prestress, describe the network
/// without prestress; they are copied from `without`. The value of `options.prestress` has no influence.
/// @param without  moduli of the same network without prestress
template <int Dim>
[[nodiscard]] Moduli prestressed_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                        ModuliOptions options, Moduli without);

/// Computes the moduli of a packing from options.loaded_network(packing), under the stress that the packing carries.
/// @throws InputError as loaded_network() does, or if an option is invalid
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options);

/// Computes the moduli by ModuliMethod::petsc. The value of `options.method` has no influence. All processes of the
/// solver have to call this function with the same arguments, and all obtain the same moduli.
/// @param centres  centres of the grains (length), by which the grains are distributed over the processes
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const std::vector<Vec<Dim>>& centres,
                                    const NetworkLoad<Dim>& load, const ModuliOptions& options,
                                    ParallelSolver& solver);

/// Computes the moduli of a packing for several rolling stiffnesses, with a single symbolic factorization.
/// @param rolling_stiffness  rolling stiffnesses (force * length), >= 0; each of them in turn replaces
/// options.rolling_stiffness
/// @return moduli for each of these rolling stiffnesses
template <int Dim>
[[nodiscard]] std::vector<Moduli> elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options,
                                                 const std::vector<double>& rolling_stiffness);

/// Computes the moduli of successive states, such as those of a loading path. With ModuliMethod::iterative, the
/// iteration for a state starts from the solution of the previous state if both states have the same number of grains.
template <int Dim>
class ModuliSequence {
 public:
  /// @throws InputError if an option is invalid
  explicit ModuliSequence(ModuliOptions options);
  /// Computes the moduli of the next state.
  /// @param unloaded  whether the packing was brought to equilibrium under zero stress, see ModuliOptions
  [[nodiscard]] Moduli next(const Packing<Dim>& packing, bool unloaded);

 private:
  ModuliOptions options_;
  ResponseMemory memory_;
};

}  // namespace floc
