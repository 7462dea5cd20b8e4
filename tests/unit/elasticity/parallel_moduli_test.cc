#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/elasticity/moduli.h"
#include "floc/petsc/parallel_solver.h"
#include "support/network_packings.h"

/// Compares moduli from PETSc with moduli from the factorization by CHOLMOD, in one process. tests/cli compares
/// them with several processes.
namespace floc {
namespace {

using testing::HasSubstr;

/// The only solver of this test program, because a process can start MPI only once.
ParallelSolver& solver() {
  static const std::unique_ptr<ParallelSolver> only = load_parallel_solver();
  return *only;
}

ModuliOptions full(bool prestress = false) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  options.prestress = prestress;
  return options;
}

template <int Dim>
Moduli by_petsc(const Packing<Dim>& packing, const ModuliOptions& options) {
  return elastic_moduli(options.loaded_network(packing), packing.grains.position,
                        network_load(packing, options.unloaded), options, solver());
}

/// Returns the packing sheared to a cell with an angle of 60 degrees.
template <int Dim>
Packing<Dim> skewed(Packing<Dim> packing) {
  Mat<Dim> shear = Mat<Dim>::Identity();
  shear(1, 0) = 0.577;
  packing.cell.matrix = (packing.cell.matrix * shear).eval();
  for (auto& x : packing.grains.position) x = (shear.transpose() * x).eval();
  find_contacts(packing);
  return packing;
}

/// Returns the packing with its normal forces multiplied by `share`. A small factor makes the forces of random packings
/// realistic, because their overlaps are larger than those of real states.
template <int Dim>
Packing<Dim> pressed(Packing<Dim> packing, double share) {
  for (auto& c : packing.contacts) c.normal_force *= share;
  return packing;
}

template <int Dim>
void expect_equal(const Packing<Dim>& packing, const ModuliOptions& options) {
  const Moduli exact = elastic_moduli(packing, options);
  const Moduli m = by_petsc(packing, options);
  ASSERT_EQ(m.failure, "");
  EXPECT_EQ(m.method, ModuliMethod::petsc);
  const double size = exact.C.cwiseAbs().maxCoeff();
  ASSERT_GT(size, 0.0);
  EXPECT_LE((m.C - exact.C).cwiseAbs().maxCoeff(), 1e-8 * size);
  // The error is at most its estimate, and the estimate is at most the requested tolerance.
  EXPECT_LE((m.C - exact.C).cwiseAbs().maxCoeff(), (m.C_error + exact.C_error).maxCoeff());
  EXPECT_LE(m.C_error.maxCoeff(), 1e-9 * size);
  EXPECT_EQ(m.n_coupled_mechanisms, exact.n_coupled_mechanisms);
  EXPECT_EQ(m.n_rattlers, exact.n_rattlers);
  EXPECT_EQ(m.B_without_prestress.has_value(), options.prestress);
}

TEST(ParallelModuli, EqualThoseOfAFactorInEveryEntry) {
  if (!has_parallel_solver()) GTEST_SKIP() << "built without PETSc";
  const auto loose2 = test::random_packing<2>(300, 2, test::elastic_law(1.0, 0.8, 0.01), 1.7);
  const auto dense2 = test::random_packing<2>(300, 1, test::elastic_law(1.0, 0.8, 0.01), 2.6);
  const auto dense3 = test::random_packing<3>(200, 3, test::elastic_law(1.0, 0.7, 0.0), 2.4);
  {
    SCOPED_TRACE("2D, loose");
    expect_equal(loose2, full());
  }
  {
    SCOPED_TRACE("2D, dense");
    expect_equal(dense2, full());
  }
  {
    SCOPED_TRACE("2D, prestress");
    expect_equal(pressed(test::random_packing<2>(300, 4, test::elastic_law(1.0, 0.8, 0.01), 2.6), 0.02),
                 full(true));
  }
  {
    SCOPED_TRACE("3D");
    expect_equal(dense3, full());
  }
  {
    SCOPED_TRACE("3D, prestress");
    expect_equal(pressed(dense3, 0.02), full(true));
  }
  {
    SCOPED_TRACE("3D, skewed cell");
    expect_equal(skewed(dense3), full());
  }
}

/// Without friction, this loose random packing has floppy modes. If a strain excites a floppy mode, a modulus vanishes.
/// All other floppy modes do not change the moduli. The moduli must be right in both cases.
TEST(ParallelModuli, OfAStateWithFloppyModesAreThoseOfTheFactor) {
  if (!has_parallel_solver()) GTEST_SKIP() << "built without PETSc";
  const auto packing = test::random_packing<2>(120, 5, test::elastic_law(1.0, 0.0, 0.0), 1.3);
  const Moduli exact = elastic_moduli(packing, full());
  ASSERT_GT(exact.n_mechanisms, 0);
  const Moduli m = by_petsc(packing, full());
  ASSERT_EQ(m.failure, "");
  EXPECT_LE((m.C - exact.C).cwiseAbs().maxCoeff(),
            (m.C_error + exact.C_error).maxCoeff() + 1e-8 * exact.C.cwiseAbs().maxCoeff());
}

/// The compressive forces are so large that the packing is unstable: grains would roll off each other.
TEST(ParallelModuli, OfAnUnstableStateAreRefusedInWords) {
  if (!has_parallel_solver()) GTEST_SKIP() << "built without PETSc";
  auto packing = test::random_packing<2>(120, 6, test::elastic_law(1.0, 0.0, 0.0), 1.7);
  packing = pressed(packing, 30.0);
  ASSERT_GT(elastic_moduli(packing, full(true)).n_negative, 0);
  const Moduli m = by_petsc(packing, full(true));
  EXPECT_THAT(m.failure, HasSubstr("not positive"));
}

TEST(ParallelModuli, AFactorThatWouldBeTooLargeIsNotMade) {
  ModuliOptions options = full();
  options.largest_factor = 1e3;
  const auto packing = test::random_packing<2>(300, 2, test::elastic_law(1.0, 0.8, 0.01));
  const Moduli m = elastic_moduli(packing, options);
  EXPECT_GT(m.factor_bytes, 1e5);
  EXPECT_THAT(m.failure, HasSubstr("but at most 0.0 GB are allowed"));
  options.largest_factor = 1.01 * m.factor_bytes;
  EXPECT_EQ(elastic_moduli(packing, options).failure, "");
}

}  // namespace
}  // namespace floc
