# Installs the build in BUILD_DIR below WORK_DIR, then configures, builds and runs the project in CONSUMER_DIR on it.
file(REMOVE_RECURSE "${WORK_DIR}")
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix" --config "${CONFIG}")
run("${WORK_DIR}/prefix/bin/floc" --version)
run("${WORK_DIR}/prefix/bin/floc" scene check "${WORK_DIR}/prefix/share/floc/scenes/demo.toml")
run("${CMAKE_COMMAND}" -S "${CONSUMER_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DCMAKE_BUILD_TYPE=${CONFIG}")
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --config "${CONFIG}")
run("${WORK_DIR}/build/consumer" "${WORK_DIR}/tiny")
foreach(file IN ITEMS man/man1/floc.1.gz man/man1/floc-fit.1.gz bash-completion/completions/floc zsh/site-functions/_floc)
  if(NOT EXISTS "${WORK_DIR}/prefix/share/${file}")
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()
# The package as Debian's Python finds it, with the place of this prefix named.
if(PYTHON)
  set(ENV{PYTHONPATH} "${WORK_DIR}/prefix/lib/python3/dist-packages")
  run("${PYTHON}" -c "import floc; assert floc.__file__.startswith('${WORK_DIR}/prefix'); floc.chain(2, 0.5, 1, 1, 1)")
  run("${PYTHON}" "${CONSUMER_DIR}/same_row.py" "${WORK_DIR}/prefix/bin/floc" "${WORK_DIR}/build/row"
    "${WORK_DIR}/tiny/state-0002.h5")
endif()
