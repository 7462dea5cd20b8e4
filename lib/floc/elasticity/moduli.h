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

/// Method by which moduli are computed; it determines their cost and the kind of error they come with.
enum class ModuliMethod {
  factor,         ///< Cholesky factor in double precision, error bounds
  single_factor,  ///< in single precision, refined in double: half the memory, error estimates
  iterative,      ///< conjugate gradients from the last state's solution, with its factor: error estimates
  /// The middle between the bounds of the network: no system is solved, the error is a bound. Fails where the
  /// bounds do not hold (Bounds::fault); B_S and its error are NaN where the stress is not isotropic.
  bounds,
  petsc,  ///< conjugate gradients by PETSc, on one process or many: error estimates
};

struct ModuliOptions {
  ModuliMethod method = ModuliMethod::factor;
  StrainSet strains = StrainSet::diagonal;
  /// Adds the geometric terms of the forces the state carries; moduli are then derivatives of the Cauchy
  /// stress.
  bool prestress = false;
  /// Normal force below which a contact of a cohesionless packing carries nothing (rattlers), in units of
  /// F1 = max(F0, P a^(Dim-1)). The default is the tolerance of an equilibrium (docs/physics.md,
  /// "Equilibrium").
  double force_tolerance = 1e-5;
  /// Rolling stiffness given to every touching contact in place of its own (force * length).
  std::optional<double> rolling_stiffness;
  Ordering ordering = Ordering::automatic;
  /// The packing was brought to equilibrium under no stress: any stress that its forces leave is residual, and
  /// bounds no modulus (B_reuss = 0).
  bool unloaded = false;
  /// Relative tolerance on B and G. A warning is given where their error bounds stay above it.
  double tolerance = 1e-10;
  /// Bytes that a factor may take; see Moduli::failure.
  double largest_factor = std::numeric_limits<double>::infinity();

  /// Returns the contacts that moduli are computed from: without those of rattlers, with `rolling_stiffness` if
  /// given.
  template <int Dim>
  ContactNetwork<Dim> loaded_network(const Packing<Dim>& packing) const;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Load of a network, on which its moduli depend besides its contacts.
template <int Dim>
struct NetworkLoad {
  Mat<Dim> stress = Mat<Dim>::Zero();  ///< static, compression positive (force/length^(Dim-1))
  bool unloaded = false;               ///< see ModuliOptions
  MeanField mean_field{};              ///< for the bounds in their printed forms
  int n_mobilised = 0;                 ///< mobilised contacts (at a cap), which the network takes as elastic
};

/// Returns the load of a packing: its stress, mean-field averages and number of mobilised contacts.
/// @param unloaded  see ModuliOptions
template <int Dim>
NetworkLoad<Dim> network_load(const Packing<Dim>& packing, bool unloaded);

/// Elastic moduli of one state, as stress (force/length^(Dim-1)), with their errors, bounds and warnings.
struct Moduli {
  /// Stress against strain, both positive in compression, order of StrainSet; symmetric.
  Eigen::MatrixXd C;
  double B = 0.0;    ///< B_C: mean of the diagonal block of C, strain-controlled
  double B_S = 0.0;  ///< 1/(sum of the compliances of the diagonal block), stress-controlled
  double G = 0.0;    ///< (C11 + C22 - 2 C12)/4; in 3D its mean over the pairs of axes
  /// Bounds on the errors that solving and rounding leave in C (entry by entry), B, B_S and G, in their units:
  /// see ElasticResponse::error. Infinite where none can be given.
  Eigen::MatrixXd C_error;
  double B_error = 0.0;
  double B_S_error = 0.0;
  double G_error = 0.0;
  double isotropy_defect = 0.0;  ///< largest less smallest of C11, C22 (, C33), over their mean
  Bounds bounds;                 ///< bounds of these moduli; with prestress they do not hold, see Bounds::fault
  /// The principal stresses that load the network are equal, to one part in 10^4, or bounds.B_reuss is zero.
  bool isotropic_stress = true;
  int n_negative = 0;    ///< negative eigenvalues of K, strains included
  int n_mechanisms = 0;  ///< vanishing eigenvalues of K beyond free motions found by structure
  /// Mechanisms among them that strain the cell at no cost: the moduli along them are zero.
  int n_coupled_mechanisms = 0;
  int n_rattlers = 0;
  int n_free_rollers = 0;
  int n_mobilised = 0;     ///< mobilised contacts (sliding, or at a cap in rolling); C treats them as elastic
  double pressure = 0.0;   ///< mean of the diagonal of load_stress()
  double residual = 0.0;   ///< backward error of the solution
  double condition = 1.0;  ///< condition number of K, estimated; infinite with mechanisms
  /// B and G without prestress, present if `options.prestress` is set: the difference is the contribution of
  /// prestress.
  std::optional<double> B_without_prestress;
  std::optional<double> G_without_prestress;
  /// The response without prestress, of loaded_network(): mechanisms, increments and backbone follow from it.
  ElasticResponse response;
  /// The method used: that of the options, or the factor where that failed. Methods other than the factor count
  /// neither negative eigenvalues nor mechanisms; their errors are estimates or, with bounds, half the distance
  /// of the bounds.
  ModuliMethod method = ModuliMethod::factor;
  int steps = 0;  ///< number of refinement steps
  std::vector<std::string> warnings;
  /// Whether bounds.B_reuss <= B <= bounds.B_voigt is a theorem.
  bool bounds_hold() const { return bounds.fault.empty(); }
  /// Whether bounds.B_reuss <= B_S is a theorem as well.
  bool bounds_hold_B_S() const { return bounds_hold() && isotropic_stress; }
  /// Reason why there are no moduli, in words; only the bounds are then meaningful. Empty where there are
  /// moduli.
  std::string failure;
  /// Predicted size of the factor (bytes), where that is the reason of the failure; else 0.
  double factor_bytes = 0.0;
};

/// Computes the moduli of a state, with every contact taken as elastic. Without prestress C = relaxed K/V. With
/// it, the Cauchy stress sigma responds to the symmetric strain E by dsigma = relaxed K E/V - sym(sigma E) +
/// sigma tr E: for diagonal strains C_ab = K_ab/V + sigma_a (1 - delta_ab), which is H_ab/V + sigma_a for H the
/// relaxed Hessian of the energy in ln L, so relative to H, B gains P and G nothing. Where the stress is not
/// isotropic this is not symmetric; the symmetric part is given. A modulus that its error bound does not
/// distinguish from zero is given as zero and counted as a coupled mechanism. Moduli that have lost all digits
/// are NaN, with a warning.
/// @param network  the contacts that carry load; `options` changes none of them
/// @throws InputError with the faults of the options
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                    const ModuliOptions& options);

/// Computes the moduli with prestress from those without it; `options.prestress` is ignored.
/// @param without  moduli of the same network without prestress
template <int Dim>
[[nodiscard]] Moduli prestressed_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                                        ModuliOptions options, Moduli without);

/// Computes the moduli of options.loaded_network(packing) under the stress that the packing carries.
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options);

/// Computes the moduli by ModuliMethod::petsc; `options.method` is ignored. All processes of the solver have to
/// call it with the same arguments, and all get the same moduli.
/// @param centres  of the grains, which divide them among the processes (length)
template <int Dim>
[[nodiscard]] Moduli elastic_moduli(const ContactNetwork<Dim>& network, const std::vector<Vec<Dim>>& centres,
                                    const NetworkLoad<Dim>& load, const ModuliOptions& options,
                                    ParallelSolver& solver);

/// Computes the moduli of a packing for each of several rolling stiffnesses, with one symbolic factorization
/// for all.
/// @param rolling_stiffness  values >= 0 that replace options.rolling_stiffness in turn (force * length)
/// @return one entry per rolling stiffness
template <int Dim>
[[nodiscard]] std::vector<Moduli> elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options,
                                                 const std::vector<double>& rolling_stiffness);

/// Moduli of one state after another, such as those of a path: with ModuliMethod::iterative each starts from
/// the solution of the one before, if it has the same number of grains.
template <int Dim>
class ModuliSequence {
 public:
  /// @throws InputError with the faults of the options
  explicit ModuliSequence(ModuliOptions options);
  /// @param unloaded  see ModuliOptions
  [[nodiscard]] Moduli next(const Packing<Dim>& packing, bool unloaded);

 private:
  ModuliOptions options_;
  ResponseMemory memory_;
};

}  // namespace floc
