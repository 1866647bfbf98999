# Installs the build in BUILD_FOLDER below WORK_FOLDER, then configures, builds and runs the project beside this file
# against it, and the one that the C++ page of the guide shows. Anything from earlier runs is removed first, so that nothing
# stale can be found.
function(run what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_FOLDER} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result})")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(configure_and_build source binary)
  run("Configuration" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${source} -B ${binary}
      -DCMAKE_PREFIX_PATH=${WORK_FOLDER}/installed -DCMAKE_BUILD_TYPE=${BUILD_TYPE} "-DCMAKE_CXX_FLAGS=${FLAGS}")
  run("Build" ${CMAKE_COMMAND} --build ${binary})
endfunction()

# Writes the page's block of this language to a file.
function(take_from_page language file)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/../../docs/guide/cpp.md page)
  string(FIND "${page}" "```${language}\n" begin)
  string(LENGTH "```${language}\n" fence)
  math(EXPR begin "${begin} + ${fence}")
  string(SUBSTRING "${page}" ${begin} -1 page)
  string(FIND "${page}" "\n```" end)
  string(SUBSTRING "${page}" 0 ${end} block)
  file(WRITE ${WORK_FOLDER}/flex/${file} "${block}\n")
endfunction()

file(REMOVE_RECURSE ${WORK_FOLDER})
file(MAKE_DIRECTORY ${WORK_FOLDER})
run("Installation" ${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${WORK_FOLDER}/installed)
configure_and_build(${CMAKE_CURRENT_LIST_DIR} ${WORK_FOLDER}/build)
run("uses_core" ${WORK_FOLDER}/build/uses_core)

take_from_page(cmake CMakeLists.txt)
take_from_page(cpp flex.cpp)
configure_and_build(${WORK_FOLDER}/flex ${WORK_FOLDER}/flex/build)
run("flex" ${WORK_FOLDER}/flex/build/flex)
if(NOT output MATCHES "20 degrees  iliacus_r: volume (100\\.[0-4]|99\\.[5-9])")
  message(FATAL_ERROR "flex does not tell the muscle's volume")
endif()
if(NOT EXISTS ${WORK_FOLDER}/iliacus_r.vtp)
  message(FATAL_ERROR "flex wrote no surface")
endif()
