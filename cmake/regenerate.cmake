# Writes the kernels of every committed order:
#   cmake -DZONAL_GEN=path/to/zonal-gen -DOUT=folder -P cmake/regenerate.cmake
include("${CMAKE_CURRENT_LIST_DIR}/orders.cmake")
foreach(language cpp)
  foreach(order IN LISTS ZONAL_COMMITTED_ORDERS)
    execute_process(COMMAND "${ZONAL_GEN}" emit --order ${order} --language ${language} --out "${OUT}/${language}"
      OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
