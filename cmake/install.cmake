# What `cmake --install` puts where, and the package that find_package(zonal) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/zonal")

# One export set per component, so that each looks for what it needs and no more.
set_target_properties(zonal_generated PROPERTIES EXPORT_NAME generated)
get_property(components GLOBAL PROPERTY ZONAL_BUILT_LIBRARIES)
foreach(component IN LISTS components)
  install(TARGETS zonal_${component} EXPORT zonal-${component} INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
endforeach()
if(ZONAL_BUILD_APPS)
  # Beside it in lib/ where libraries are shared, wherever the package is moved to.
  file(RELATIVE_PATH up "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(zonal PROPERTIES INSTALL_RPATH "\$ORIGIN/${up}")
  install(TARGETS zonal)
endif()
if(ZONAL_BUILD_GENERATOR)
  install(TARGETS zonal-gen EXPORT zonal-generator)
  install(DIRECTORY generator/tables/ DESTINATION "${CMAKE_INSTALL_DATADIR}/zonal/tables"
    FILES_MATCHING PATTERN "*.json")
  install(FILES generator/bounds/bounds.json DESTINATION "${CMAKE_INSTALL_DATADIR}/zonal/bounds")
  list(APPEND components generator)
endif()
foreach(component IN LISTS components)
  install(EXPORT zonal-${component} NAMESPACE zonal:: DESTINATION "${package_folder}"
    FILE "zonal-${component}-targets.cmake")
endforeach()

install(DIRECTORY "${ZONAL_GENERATED_DIR}/zonal" runtime/include/zonal
  "${PROJECT_BINARY_DIR}/runtime/include/zonal"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
# Other languages as they are committed.
install(DIRECTORY generated/glsl generated/hlsl generated/js generated/spirv generated/wgsl DESTINATION "${CMAKE_INSTALL_DATADIR}/zonal")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# What static libraries are linked with has to be found by who links them; shared ones bring it.
set(static_needs_packages ON)
if(BUILD_SHARED_LIBS)
  set(static_needs_packages OFF)
endif()
set(installed_tables "${CMAKE_INSTALL_DATADIR}/zonal/tables")
set(installed_kernels "${CMAKE_INSTALL_DATADIR}/zonal")
configure_package_config_file(cmake/zonal-config.cmake.in "${PROJECT_BINARY_DIR}/zonal-config.cmake"
  INSTALL_DESTINATION "${package_folder}" PATH_VARS installed_tables installed_kernels)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/zonal-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/zonal-config.cmake" "${PROJECT_BINARY_DIR}/zonal-config-version.cmake"
  cmake/zonal_add_kernels.cmake cmake/zonal_tables.cmake DESTINATION "${package_folder}")
