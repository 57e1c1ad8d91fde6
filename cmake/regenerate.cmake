# Writes the kernels of every committed order, by one run of the generator:
#   cmake -DZONAL_GEN=path/to/zonal-gen -DOUT=folder -P cmake/regenerate.cmake
include("${CMAKE_CURRENT_LIST_DIR}/orders.cmake")
list(JOIN ZONAL_COMMITTED_ORDERS "+" orders)
list(JOIN ZONAL_COMMITTED_SHADER_ORDERS "+" shader_orders)
set(languages "cpp:${orders},js:${orders}")
foreach(language glsl hlsl spirv wgsl)
  string(APPEND languages ",${language}:${shader_orders}")
endforeach()
# By the tables of this tree, wherever the program was built.
set(ENV{ZONAL_TABLES_DIR} "${CMAKE_CURRENT_LIST_DIR}/../generator/tables")
execute_process(COMMAND "${ZONAL_GEN}" emit
    --languages "${languages}" --out "${OUT}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
