#include "floc/base/instruction_set.h"

namespace floc {

bool supported(InstructionSet set) {
  switch (set) {
#ifdef FLOC_HAS_AVX512
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
#endif
#ifdef FLOC_HAS_AVX2
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2");
#endif
    default:
      return set == InstructionSet::portable;
  }
}

InstructionSet widest_instruction_set() {
  if (supported(InstructionSet::avx512)) return InstructionSet::avx512;
  if (supported(InstructionSet::avx2)) return InstructionSet::avx2;
  return InstructionSet::portable;
}

}  // namespace floc
