# gracilis_embed(TARGET NAME FILE): compiles the text of a file into a target, as the variable
# `extern const std::string_view NAME` in namespace gracilis::embedded.
function(gracilis_embed target name file)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DFROM=${file} -DTO=${source} -P ${gracilis_embed_script}
    DEPENDS ${file} ${gracilis_embed_script} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(gracilis_embed_script ${CMAKE_CURRENT_LIST_FILE})
  return()
endif()

# Run as a script: writes the source. The quotation marks are those of a raw string, which no file may contain.
file(READ ${FROM} text)
file(WRITE ${TO} "#include <string_view>

namespace gracilis::embedded {

extern const std::string_view ${NAME};
const std::string_view ${NAME} = R\"embedded_text(${text})embedded_text\";

}  // namespace gracilis::embedded
")
