# Builds the solver and pressed_ball.cpp for WebAssembly in WORK_FOLDER, runs that by Node.js and compares its numbers with
# those of NATIVE, the same program for this machine. Says that it skipped where there is no compiler or no Node.js.
find_program(compiler NAMES clang++ clang++-14)
find_program(linker NAMES wasm-ld wasm-ld-14)
find_program(node NAMES node nodejs)
find_path(system wasi/api.h PATHS /usr/include/wasm32-wasi)
if(NOT compiler OR NOT linker OR NOT node OR NOT system)
  message("skipped: clang, lld, wasi-libc, libc++-dev-wasm32 or nodejs is not there")
  return()
endif()

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_FOLDER} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} failed (${result})")
  endif()
endfunction()

set(source ${SOURCE_FOLDER}/src/gracilis)
file(GLOB_RECURSE solver ${source}/dynamics/*.cpp)
set(below ${source}/core/parallel_serial.cpp ${source}/geometry/field_path.cpp ${source}/geometry/half_edges.cpp
          ${source}/geometry/measures.cpp ${source}/geometry/point_triangle.cpp ${source}/geometry/rotations.cpp
          ${source}/geometry/topology.cpp)
# Compiled as one file, so that what all include is read once; but not what Highway includes again.
set(together "")
set(alone "")
foreach(file IN LISTS solver below)
  file(STRINGS ${file} includes_itself REGEX "foreach_target[.]h")
  if(includes_itself)
    list(APPEND alone ${file})
  else()
    string(APPEND together "#include \"${file}\"\n")
  endif()
endforeach()
file(WRITE ${WORK_FOLDER}/solver.cpp "${together}")
run(${compiler} --target=wasm32-wasi -msimd128 -O1 -std=c++20 -fno-exceptions -I${SOURCE_FOLDER}/src -I${SOURCE_FOLDER}/tests
    -isystem ${EIGEN_FOLDER} solver.cpp ${alone} ${CMAKE_CURRENT_LIST_DIR}/pressed_ball.cpp -o pressed_ball.wasm)
run(${node} --no-warnings --experimental-wasi-unstable-preview1 ${CMAKE_CURRENT_LIST_DIR}/agree.mjs pressed_ball.wasm ${NATIVE})
