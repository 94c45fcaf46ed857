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
install(FILES chasles/ompl.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/chasles) # for users who have OMPL
install(EXPORT chaslesTargets NAMESPACE chasles:: DESTINATION ${package_dir})

configure_package_config_file(cmake/chaslesConfig.cmake.in ${PROJECT_BINARY_DIR}/chaslesConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/chaslesConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/chaslesConfig.cmake ${PROJECT_BINARY_DIR}/chaslesConfigVersion.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/chasles) # where tools of ROS look for it

if(TARGET chasles_cli)
  install(TARGETS chasles_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
