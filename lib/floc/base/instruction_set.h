#pragma once

namespace floc {

/// Number of doubles in a register of the widest instruction set.
inline constexpr int kWindow = 8;

/// Instruction sets for which kernels are compiled: the force loop, and the sweeps over the contacts of rigid grains.
/// All of them give bitwise identical results: the lanes of a register are independent, sums have a fixed order, and no
/// multiplication is fused with an addition.
enum class InstructionSet {
  portable,  ///< registers of two doubles; runs on every processor of the architecture
  avx2,      ///< AVX2, registers of four doubles
  avx512,    ///< AVX-512, registers of eight doubles
};

/// Whether floc was compiled for an instruction set (CMake option FLOC_INSTRUCTION_SETS) and this processor supports
/// it.
bool supported(InstructionSet set);

/// Returns the widest instruction set that is supported().
InstructionSet widest_instruction_set();

}  // namespace floc
