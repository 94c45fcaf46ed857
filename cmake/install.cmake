# `cmake --install`: the library, its public headers, the package files for find_package(chasles), the executable.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/chasles)

install(
  TARGETS chasles
  EXPORT chaslesTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT chaslesTargets NAMESPACE chasles:: DESTINATION ${package_dir})

get_target_property(chasles_library_type chasles TYPE)
configure_package_config_file(cmake/chaslesConfig.cmake.in ${PROJECT_BINARY_DIR}/chaslesConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/chaslesConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/chaslesConfig.cmake ${PROJECT_BINARY_DIR}/chaslesConfigVersion.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(TARGET chasles_cli)
  # The executable finds a shared library beside it, wherever the prefix is moved.
  file(RELATIVE_PATH libraries_from_executable /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(chasles_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_executable}")
  install(TARGETS chasles_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
