# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)

# Components are packages: the tool, the shared libraries, what developers need, and the library for C.

set(RONDEL_TARGETS rondel)
set(RONDEL_C_TARGETS "")
set(RONDEL_PACKAGES rondel)
# The headers of the core, and with polygons all of them.
set(RONDEL_HEADERS "check|delaunay|diagram|dynamic|error|export|hull|names|predicates|query|rondel|sites|triangulation|types|version")
if(RONDEL_BUILD_POLYGONS)
  list(APPEND RONDEL_TARGETS rondel_geo)
  list(APPEND RONDEL_PACKAGES rondel-geo)
  set(RONDEL_HEADERS "[^/]+")
endif()
if(RONDEL_BUILD_IO)
  list(APPEND RONDEL_TARGETS rondel_distributed)
  list(APPEND RONDEL_PACKAGES rondel-distributed)
endif()
if(TARGET rondel_wasm_exceptions)
  list(APPEND RONDEL_TARGETS rondel_wasm_exceptions)
endif()
if(RONDEL_BUILD_C)
  set(RONDEL_C_TARGETS rondel_c)
  list(APPEND RONDEL_PACKAGES rondel-c)
  install(FILES bindings/c/include/rondel.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endif()
foreach(kind "" C_)
  if(RONDEL_${kind}TARGETS)
    string(TOLOWER ${kind}runtime component)
    install(TARGETS ${RONDEL_${kind}TARGETS} EXPORT rondelTargets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT development)
  endif()
endforeach()
install(DIRECTORY include/rondel ${PROJECT_BINARY_DIR}/include/rondel
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING REGEX "/(${RONDEL_HEADERS})\\.h$")
install(EXPORT rondelTargets NAMESPACE rondel::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel COMPONENT development)
get_target_property(RONDEL_LIBRARY_TYPE rondel TYPE)
string(COMPARE EQUAL "${RONDEL_LIBRARY_TYPE}" STATIC_LIBRARY RONDEL_IS_STATIC)
string(REPLACE "rondel-" "" RONDEL_COMPONENTS "${RONDEL_PACKAGES}")
configure_package_config_file(cmake/rondelConfig.cmake.in ${PROJECT_BINARY_DIR}/rondelConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rondelConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rondelConfig.cmake ${PROJECT_BINARY_DIR}/rondelConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/rondel COMPONENT development)

# For pkg-config: what a static library needs is linked with it, what a shared one needs it finds itself.
file(RELATIVE_PATH RONDEL_PREFIX_FROM_PKGCONFIG
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(RONDEL_LINK_RONDEL "")
if(RONDEL_PARALLEL)
  string(APPEND RONDEL_LINK_RONDEL "-pthread")
endif()
if(RONDEL_HAS_TBB)
  string(APPEND RONDEL_LINK_RONDEL " -ltbb")
endif()
set(RONDEL_LINK_GEO "-lz")
if(NOT RONDEL_IS_STATIC)
  set(RONDEL_LINK_RONDEL "")
  set(RONDEL_LINK_GEO "")
endif()
foreach(name ${RONDEL_PACKAGES})
  configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endforeach()
if(RONDEL_BUILD_TOOL)
  install(TARGETS rondel_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
endif()
