# zonal_tables_of(VARIABLE ORDER): the files that the kernels of an order are made of: its tables, those of every
# band, and the published bounds. A table that is added or removed makes CMake configure again.
function(zonal_tables_of variable order)
  set(digits ${order})
  if(order LESS 10)
    set(digits "0${order}")
  endif()
  file(GLOB tables CONFIGURE_DEPENDS
    "${ZONAL_TABLES_FOLDER}/shared/order${digits}.json" "${ZONAL_TABLES_FOLDER}/rotate_zhf/order${digits}.json"
    "${ZONAL_TABLES_FOLDER}/band/*.json" "${ZONAL_TABLES_FOLDER}/band_mirrored/*.json"
    "${ZONAL_TABLES_FOLDER}/../bounds/bounds.json")
  set(${variable} ${tables} PARENT_SCOPE)
endfunction()
