# zonal_add_kernels(TARGET ORDERS N... [KERNELS NAME...] [LANGUAGES cpp...])
#
# Has zonal-gen write kernels of the given orders (2 to 20) when TARGET is built, and again when the program or a table
# of the orders changes. KERNELS: these, such as rotate and blocks, and what they call; without it all. LANGUAGES: some
# of cpp (the default), glsl, hlsl, js, spirv, wgsl.
# C++: TARGET, and what links to it, can then include "zonal/orderNN.hpp" or, of KERNELS, "zonal/orderNN/NAME.hpp".
# Others: the property ZONAL_KERNELS_FOLDER of TARGET names the folder that holds LANGUAGE/orderNN/NAME.*.
# Needs zonal-gen: built in this tree (ZONAL_BUILD_GENERATOR=ON) or installed with the package zonal.
include("${CMAKE_CURRENT_LIST_DIR}/zonal_tables.cmake")

function(zonal_add_kernels target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ORDERS;KERNELS;LANGUAGES")
  set(call "zonal_add_kernels(${target})")
  if(NOT TARGET "${target}")
    message(FATAL_ERROR "${call}: found no target of that name, wanted one that exists; add it before this call")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${call}: found '${arg_UNPARSED_ARGUMENTS}', wanted TARGET ORDERS N... [KERNELS NAME...] "
      "[LANGUAGES cpp...]; correct the call")
  endif()
  if(NOT DEFINED arg_LANGUAGES)
    set(arg_LANGUAGES cpp)
  endif()
  set(ending_cpp hpp)
  set(ending_glsl glsl)
  set(ending_hlsl hlsl)
  set(ending_js mjs)
  set(ending_spirv spvasm)
  set(ending_wgsl wgsl)
  foreach(language IN LISTS arg_LANGUAGES)
    if(NOT DEFINED ending_${language})
      message(FATAL_ERROR "${call}: LANGUAGES: found '${language}', wanted some of cpp, glsl, hlsl, js, spirv, "
        "wgsl; correct the call")
    endif()
  endforeach()
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

  set(folder "${CMAKE_CURRENT_BINARY_DIR}/zonal_kernels/${target}")
  list(JOIN arg_LANGUAGES "," languages)
  set(chosen "")
  if(arg_KERNELS)
    list(JOIN arg_KERNELS "," kernels)
    set(chosen --kernels "${kernels}")
  endif()
  set(files "")
  list(REMOVE_DUPLICATES arg_ORDERS)
  foreach(order IN LISTS arg_ORDERS)
    if(NOT order MATCHES "^([2-9]|1[0-9]|20)$")
      message(FATAL_ERROR "${call}: ORDERS: found '${order}', wanted whole numbers from 2 to 20; correct the call")
    endif()
    set(digits ${order})
    if(order LESS 10)
      set(digits "0${order}")
    endif()
    # One file of each language stands for all that a run writes.
    set(first_kernel rotate)
    if(arg_KERNELS)
      list(GET arg_KERNELS 0 first_kernel)
    endif()
    set(written "")
    foreach(language IN LISTS arg_LANGUAGES)
      set(place "${language}/order${digits}")
      if(language STREQUAL "cpp")
        set(place "cpp/zonal/order${digits}")
      endif()
      list(APPEND written "${folder}/${place}/${first_kernel}.${ending_${language}}")
    endforeach()
    zonal_tables_of(tables ${order})
    add_custom_command(OUTPUT ${written}
      COMMAND ${program} emit --order ${order} --languages ${languages} ${chosen} --out "${folder}"
      DEPENDS ${program} ${tables}
      COMMENT "Writing kernels of order ${order} for ${target}"
      VERBATIM)
    list(APPEND files ${written})
  endforeach()

  add_custom_target(${target}_zonal_kernels DEPENDS ${files})
  add_dependencies(${target} ${target}_zonal_kernels)
  set_property(TARGET ${target} PROPERTY ZONAL_KERNELS_FOLDER "${folder}")
  if("cpp" IN_LIST arg_LANGUAGES)
    set(scope PUBLIC)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "INTERFACE_LIBRARY")
      set(scope INTERFACE)
    endif()
    target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${folder}/cpp>")
  endif()
endfunction()
