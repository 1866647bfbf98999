# gracilis_batches(FOLDER SOURCE...): where CMAKE_UNITY_BUILD is on, as in the preset 'release', these sources of one
# folder are compiled some at a time as one file, so that the headers which all of them include are read once. Their
# target needs UNITY_BUILD_MODE GROUP. A source that Highway includes again for every instruction set stays alone.
function(gracilis_batches folder)
  set(number 0)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} includes_itself REGEX "foreach_target[.]h")
    if(NOT includes_itself)
      math(EXPR batch "${number} / ${CMAKE_UNITY_BUILD_BATCH_SIZE}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
      math(EXPR number "${number} + 1")
    endif()
  endforeach()
endfunction()
