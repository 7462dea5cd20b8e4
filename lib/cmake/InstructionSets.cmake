# Kernels are loops that are compiled for several instruction sets; the widest set that the processor has is chosen at
# run time. Eigen's own vector code is switched off in these files, because functions that they share with the rest of
# the program must not contain instructions that some processors lack. These files do not use the precompiled header,
# which is compiled without these options.
set(floc_kernel_options -O3 -DEIGEN_DONT_VECTORIZE)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Kernels contain independent chains of operations. They run side by side only if the compiler interleaves their
  # instructions, which these options make it do.
  list(APPEND floc_kernel_options -fschedule-insns -fsched-pressure)
  # GCC warns of its own intrinsics, which leave registers uninitialised on purpose (GCC bug 105593).
  list(APPEND floc_kernel_options -Wno-maybe-uninitialized)
endif()
set(floc_portable_options)
set(floc_avx2_options -mavx2)
set(floc_avx512_options -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
set(floc_avx2_features avx2)
set(floc_avx512_features avx512f avx512dq avx512vl)

# Instruction sets of x86-64 to compile for, the widest first: all of them, or only the first one that this machine has.
set(floc_instruction_sets)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  include(CheckCXXSourceRuns)
  foreach(set avx512 avx2)
    if(FLOC_INSTRUCTION_SETS STREQUAL "here")
      list(TRANSFORM floc_${set}_features REPLACE "(.+)" "__builtin_cpu_supports(\"\\1\")" OUTPUT_VARIABLE tests)
      list(JOIN tests " && " test)
      check_cxx_source_runs("int main() { return ${test} ? 0 : 1; }" FLOC_MACHINE_HAS_${set})
    endif()
    if(FLOC_INSTRUCTION_SETS STREQUAL "all" OR (FLOC_MACHINE_HAS_${set} AND NOT floc_instruction_sets))
      list(APPEND floc_instruction_sets ${set})
    endif()
  endforeach()
endif()
# Sources that choose between instruction sets are compiled with these definitions.
set(floc_instruction_set_definitions)
foreach(set IN LISTS floc_instruction_sets)
  string(TOUPPER ${set} upper)
  list(APPEND floc_instruction_set_definitions FLOC_HAS_${upper})
endforeach()

# floc_kernels(SET source...)
# Compiles sources for one instruction set, or leaves them out.
function(floc_kernels set)
  if(set STREQUAL "portable" OR set IN_LIST floc_instruction_sets)
    set_source_files_properties(${ARGN} PROPERTIES
      COMPILE_OPTIONS "${floc_kernel_options};${floc_${set}_options}" SKIP_PRECOMPILE_HEADERS ON)
  else()
    set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
  endif()
endfunction()
