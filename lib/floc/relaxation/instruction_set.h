#pragma once

namespace floc {

/// Neighbouring doubles that one register of the widest set holds.
inline constexpr int kWindow = 8;

/// Vector instructions that the force loop is compiled for. All give identical results, bit for bit: lanes are
/// independent, sums have a fixed order, and no operations are fused.
enum class InstructionSet {
  portable,  ///< two doubles, on every processor of the architecture
  avx2,      ///< four doubles
  avx512,    ///< eight doubles
};

/// Whether floc was compiled for these instructions (FLOC_INSTRUCTION_SETS of CMake) and this processor has them.
bool supported(InstructionSet set);

/// Widest instruction set that is supported().
InstructionSet widest_instruction_set();

}  // namespace floc
