# zonal_add_kernels(TARGET ORDERS N... [LANGUAGE cpp])
#
# Has zonal-gen write the kernels of the given orders (2 to 20) when TARGET is built, and again when the program
# or a table of the orders changes. TARGET, and what links to it, can then include "zonal/orderNN.hpp".
# Needs zonal-gen: built in this tree (ZONAL_BUILD_GENERATOR=ON) or installed with the package zonal.
include("${CMAKE_CURRENT_LIST_DIR}/zonal_tables.cmake")

function(zonal_add_kernels target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "LANGUAGE" "ORDERS")
  set(call "zonal_add_kernels(${target})")
  if(NOT TARGET "${target}")
    message(FATAL_ERROR "${call}: found no target of that name, wanted one that exists; add it before this call")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${call}: found '${arg_UNPARSED_ARGUMENTS}', wanted TARGET ORDERS N... [LANGUAGE cpp]; "
      "correct the call")
  endif()
  if(NOT DEFINED arg_LANGUAGE)
    set(arg_LANGUAGE cpp)
  endif()
  if(NOT arg_LANGUAGE STREQUAL "cpp")
    message(FATAL_ERROR "${call}: LANGUAGE: found '${arg_LANGUAGE}', wanted cpp; correct the call")
  endif()
  if("${arg_ORDERS}" STREQUAL "")
    message(FATAL_ERROR "${call}: ORDERS: found nothing, wanted at least one order from 2 to 20; correct the call")
  endif()

  if(TARGET zonal-gen)
    set(program zonal-gen)
  elseif(TARGET zonal::zonal-gen)
    set(program zonal::zonal-gen)
  else()
    message(FATAL_ERROR "${call}: found no zonal-gen, wanted the program of this tree or of the package zonal; "
      "configure zonal with ZONAL_BUILD_GENERATOR=ON")
  endif()

  set(folder "${CMAKE_CURRENT_BINARY_DIR}/zonal_kernels/${target}/${arg_LANGUAGE}")
  set(headers "")
  list(REMOVE_DUPLICATES arg_ORDERS)
  foreach(order IN LISTS arg_ORDERS)
    if(NOT order MATCHES "^([2-9]|1[0-9]|20)$")
      message(FATAL_ERROR "${call}: ORDERS: found '${order}', wanted whole numbers from 2 to 20; correct the call")
    endif()
    set(digits ${order})
    if(order LESS 10)
      set(digits "0${order}")
    endif()
    set(header "${folder}/zonal/order${digits}.hpp")
    zonal_tables_of(tables ${order})
    add_custom_command(OUTPUT "${header}"
      COMMAND ${program} emit --order ${order} --language ${arg_LANGUAGE} --out "${folder}"
      DEPENDS ${program} ${tables}
      COMMENT "Writing the kernels of order ${order} for ${target}"
      VERBATIM)
    list(APPEND headers "${header}")
  endforeach()

  add_custom_target(${target}_zonal_kernels DEPENDS ${headers})
  add_dependencies(${target} ${target}_zonal_kernels)
  set(scope PUBLIC)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${folder}>")
endfunction()
