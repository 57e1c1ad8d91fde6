# Writes the kernels of every committed order:
#   cmake -DZONAL_GEN=path/to/zonal-gen -DOUT=folder -P cmake/regenerate.cmake
include("${CMAKE_CURRENT_LIST_DIR}/orders.cmake")
set(cpp_orders ${ZONAL_COMMITTED_ORDERS})
set(glsl_orders ${ZONAL_COMMITTED_SHADER_ORDERS})
set(spirv_orders ${ZONAL_COMMITTED_SHADER_ORDERS})
foreach(language cpp glsl spirv)
  foreach(order IN LISTS ${language}_orders)
    execute_process(COMMAND "${ZONAL_GEN}" emit --order ${order} --language ${language} --out "${OUT}/${language}"
      OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
