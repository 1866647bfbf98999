# Installs the build in BUILD_FOLDER below WORK_FOLDER, then configures, builds and runs the project beside this file
# against it. Anything from earlier runs is removed first, so that nothing stale can be found.
function(run what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_FOLDER} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result})")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_FOLDER})
file(MAKE_DIRECTORY ${WORK_FOLDER})
run("Installation" ${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${WORK_FOLDER}/installed)
run("Configuration" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_FOLDER}/build
    -DCMAKE_PREFIX_PATH=${WORK_FOLDER}/installed -DCMAKE_BUILD_TYPE=${BUILD_TYPE} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("Build" ${CMAKE_COMMAND} --build ${WORK_FOLDER}/build)
run("uses_core" ${WORK_FOLDER}/build/uses_core)
run("uses_toolkit" ${WORK_FOLDER}/build/uses_toolkit)
