#pragma once

namespace floc {

/// Neighbouring doubles that one register of the widest set holds.
inline constexpr int kWindow = 8;

/// Vector instructions the force loop is compiled for. All give the same bits: lanes are independent, sums have
/// a fixed order, nothing is fused.
enum class InstructionSet {
  portable,  ///< two doubles: what every processor of the architecture has
  avx2,      ///< four
  avx512,    ///< eight
};

/// Whether floc was compiled for these instructions (FLOC_INSTRUCTION_SETS of CMake) and this processor has them.
bool supported(InstructionSet set);

/// The widest of those.
InstructionSet widest_instruction_set();

}  // namespace floc
