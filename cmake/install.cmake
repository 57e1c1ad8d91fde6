# What `cmake --install` puts where, and the package that find_package(zonal) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/zonal")

# One export set per component, so that kernels alone need no library to be found.
set_target_properties(zonal_generated PROPERTIES EXPORT_NAME generated)
set_target_properties(zonal_runtime PROPERTIES EXPORT_NAME runtime)
install(TARGETS zonal_generated EXPORT zonal-generated INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS zonal_runtime EXPORT zonal-runtime INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
set_target_properties(zonal_parallel PROPERTIES EXPORT_NAME parallel)
install(TARGETS zonal_parallel EXPORT zonal-parallel)
install(TARGETS zonal-rotate-map)
set(components generated runtime parallel)
if(ZONAL_BUILD_GENERATOR)
  install(TARGETS zonal-gen EXPORT zonal-generator)
  install(DIRECTORY generator/tables/ DESTINATION "${CMAKE_INSTALL_DATADIR}/zonal/tables"
    FILES_MATCHING PATTERN "*.json")
  list(APPEND components generator)
endif()
foreach(component IN LISTS components)
  install(EXPORT zonal-${component} NAMESPACE zonal:: DESTINATION "${package_folder}"
    FILE "zonal-${component}-targets.cmake")
endforeach()

install(DIRECTORY "${ZONAL_GENERATED_DIR}/zonal" runtime/include/zonal
  "${PROJECT_BINARY_DIR}/runtime/include/zonal"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

set(installed_tables "${CMAKE_INSTALL_DATADIR}/zonal/tables")
configure_package_config_file(cmake/zonal-config.cmake.in "${PROJECT_BINARY_DIR}/zonal-config.cmake"
  INSTALL_DESTINATION "${package_folder}" PATH_VARS installed_tables)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/zonal-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/zonal-config.cmake" "${PROJECT_BINARY_DIR}/zonal-config-version.cmake"
  cmake/zonal_add_kernels.cmake cmake/zonal_tables.cmake DESTINATION "${package_folder}")
