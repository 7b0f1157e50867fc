# What `cmake --install` puts down: the library, its public headers, and a package, so that
# `find_package(cairn)` gives a user `cairn::cairn`.
include(CMakePackageConfigHelpers)

set(cairn_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cairn)

install(TARGETS cairn EXPORT cairn_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/cairn DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

install(EXPORT cairn_targets NAMESPACE cairn:: DESTINATION ${cairn_package_dir})
# The core needs no package but the system's threads.
set(cairn_config "include(\${CMAKE_CURRENT_LIST_DIR}/cairn_targets.cmake)\n")
if(Threads_FOUND)
  string(PREPEND cairn_config "include(CMakeFindDependencyMacro)\nfind_dependency(Threads)\n")
endif()
file(WRITE ${PROJECT_BINARY_DIR}/cairn-config.cmake "${cairn_config}")
# Until 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cairn-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cairn-config.cmake ${PROJECT_BINARY_DIR}/cairn-config-version.cmake
  DESTINATION ${cairn_package_dir})
