# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)

install(TARGETS rondel rondel_io EXPORT rondelTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/rondel ${PROJECT_BINARY_DIR}/include/rondel
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT rondelTargets NAMESPACE rondel::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel)
configure_package_config_file(cmake/rondelConfig.cmake.in ${PROJECT_BINARY_DIR}/rondelConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rondelConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rondelConfig.cmake ${PROJECT_BINARY_DIR}/rondelConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel)
if(RONDEL_BUILD_TOOL)
  install(TARGETS rondel_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
