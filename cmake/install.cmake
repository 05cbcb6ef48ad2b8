# `cmake --install`: library, headers and the package for find_package(nda CONFIG).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nda)

install(TARGETS nda EXPORT nda-targets)
install(DIRECTORY include/nda ${PROJECT_BINARY_DIR}/include/nda
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")

install(EXPORT nda-targets NAMESPACE nda:: DESTINATION ${package_dir})
configure_package_config_file(cmake/nda-config.cmake.in ${PROJECT_BINARY_DIR}/nda-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nda-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nda-config.cmake ${PROJECT_BINARY_DIR}/nda-config-version.cmake
              cmake/clp.cmake cmake/lemon.cmake
        DESTINATION ${package_dir})
