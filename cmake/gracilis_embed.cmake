# gracilis_embed(TARGET NAME FILE): compiles the text of a file into a target, as the variable
# `extern const std::string_view NAME` in namespace gracilis::embedded.
function(gracilis_embed target name file)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DNAME=${name} -DFROM=${file} -DTO=${source} -P ${gracilis_embed_script}
    DEPENDS ${file} ${gracilis_embed_script} VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()

# gracilis_embed_bytes(TARGET NAME FILE): the same of a file of any bytes that the build makes.
function(gracilis_embed_bytes target name file)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[#include <string_view>

asm(".pushsection .rodata\n"
    ".balign 8\n"
    "@name@_begin:\n"
    ".incbin \"@file@\"\n"
    "@name@_end:\n"
    ".popsection\n");
extern "C" {
__attribute__((visibility("hidden"))) extern const char @name@_begin[], @name@_end[];
}

namespace gracilis::embedded {

extern const std::string_view @name@;
const std::string_view @name@(@name@_begin, static_cast<std::size_t>(@name@_end - @name@_begin));

}  // namespace gracilis::embedded
]])
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${file} SKIP_UNITY_BUILD_INCLUSION ON)
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
