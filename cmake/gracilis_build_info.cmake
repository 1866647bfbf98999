# gracilis_build_info(TARGET): commit and date of what is built, asked at every build. Its source changes with them only.
function(gracilis_build_info target)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/build_commit.cpp)
  find_program(GRACILIS_GIT git)
  add_custom_target(${target}_build_info BYPRODUCTS ${source}
    COMMAND ${CMAKE_COMMAND} -DGIT=${GRACILIS_GIT} -DFOLDER=${PROJECT_SOURCE_DIR} -DTO=${source} -P ${gracilis_build_info_script}
    VERBATIM)
  add_dependencies(${target} ${target}_build_info)
  target_sources(${target} PRIVATE ${source})
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON GENERATED ON)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(gracilis_build_info_script ${CMAKE_CURRENT_LIST_FILE})
  return()
endif()

# Run as a script. A source package has no git: what it was made of is then not known.
set(commit unknown)
set(date "")
if(GIT)
  execute_process(COMMAND ${GIT} -C ${FOLDER} log -1 --format=%h|%cs OUTPUT_VARIABLE line ERROR_QUIET RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed AND line MATCHES "^([0-9a-f]+)[|](.+)$")
    set(commit ${CMAKE_MATCH_1})
    set(date ${CMAKE_MATCH_2})
    execute_process(COMMAND ${GIT} -C ${FOLDER} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      string(APPEND commit ", changed")
    endif()
  endif()
endif()
set(text "namespace gracilis {

extern const char* const build_commit;
extern const char* const build_date;
const char* const build_commit = \"${commit}\";
const char* const build_date = \"${date}\";

}  // namespace gracilis
")
set(before "")
if(EXISTS ${TO})
  file(READ ${TO} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${TO} "${text}")
endif()
