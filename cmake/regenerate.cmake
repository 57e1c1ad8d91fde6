# Writes the kernels of every committed order, by one run of the generator:
#   cmake -DZONAL_GEN=path/to/zonal-gen -DOUT=folder -P cmake/regenerate.cmake
include("${CMAKE_CURRENT_LIST_DIR}/orders.cmake")
list(JOIN ZONAL_COMMITTED_ORDERS "+" cpp_orders)
list(JOIN ZONAL_COMMITTED_SHADER_ORDERS "+" shader_orders)
# By the tables of this tree, wherever the program was built.
set(ENV{ZONAL_TABLES_DIR} "${CMAKE_CURRENT_LIST_DIR}/../generator/tables")
execute_process(COMMAND "${ZONAL_GEN}" emit
    --languages "cpp:${cpp_orders},glsl:${shader_orders},spirv:${shader_orders}" --out "${OUT}"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
