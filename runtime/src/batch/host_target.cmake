# zonal_host_batch_target(VARIABLE NAME:HIGHWAY_TARGET...): the first of the targets that the building processor runs,
# by Highway's own word, which also chooses while the program runs.
function(zonal_host_batch_target variable)
  set(tests "")
  foreach(target IN LISTS ARGN)
    string(REPLACE ":" ";" target ${target})
    list(GET target 0 name)
    list(GET target 1 highway_target)
    string(APPEND tests "  if (${highway_target} == 0 || (hwy::SupportedTargets() & ${highway_target}) != 0) return std::puts(\"${name}\"), 0;\n")
  endforeach()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/host_target.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT
    "#include <hwy/targets.h>\n\n#include <cstdio>\n\nint main() {\n@tests@  return 1;\n}\n" @ONLY)
  try_run(status compiled "${CMAKE_CURRENT_BINARY_DIR}/host_target" "${source}" LINK_LIBRARIES hwy::hwy
    COMPILE_OUTPUT_VARIABLE log RUN_OUTPUT_VARIABLE name)
  if(NOT compiled OR NOT status EQUAL 0)
    message(FATAL_ERROR "ZONAL_BATCH_TARGETS: found 'host', and a program that asks this processor did not run; "
      "name the instruction sets with -DZONAL_BATCH_TARGETS. ${log}")
  endif()
  string(STRIP "${name}" name)
  message(STATUS "Batches: ${name} is the best instruction set of this processor")
  set(${variable} "${name}" PARENT_SCOPE)
endfunction()
