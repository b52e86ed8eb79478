# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0

# Debian's packages, one for each component of cmake/RondelInstall.cmake and one for Python. scripts/package debs
# configures for them: shared libraries, prefix /usr (docs/decisions/024-packages.md).

if(NOT BUILD_SHARED_LIBS OR NOT RONDEL_BUILD_TOOL OR NOT RONDEL_BUILD_C OR NOT RONDEL_BUILD_PYTHON)
  message(FATAL_ERROR "Debian's packages hold everything, with shared libraries: scripts/package debs")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rondel)
set(CPACK_PACKAGE_VENDOR "The Rondel authors")
set(CPACK_PACKAGE_CONTACT "The Rondel authors <authors@rondel.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each component has one
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src ${PROJECT_BINARY_DIR}/src/distributed
                                                ${PROJECT_BINARY_DIR}/bindings/c)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(this "(= ${PROJECT_VERSION})")
set(about "Rondel computes Delaunay triangulations, Voronoi, regular and power diagrams
of points on a sphere: exactly, on every input, with one result that does
not depend on the order of the points.")
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/debian)
set(changelog ${PROJECT_BINARY_DIR}/debian/changelog)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian/changelog.in ${changelog} @ONLY)
execute_process(COMMAND gzip -9nf ${changelog} COMMAND_ERROR_IS_FATAL ANY)

# rondel_debian_package(COMPONENT NAME SECTION SUMMARY DEPENDS MORE [PART...]): MORE ends the long description; the
# package holds the parts of scripts/tools/third-party.
macro(rondel_debian_package component name section summary depends more)
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${about}\n\n${more}")
  set(copyright ${PROJECT_BINARY_DIR}/debian/${name}/copyright)
  configure_file(cmake/debian/copyright ${copyright} COPYONLY)
  if(${ARGC} GREATER 6)
    execute_process(COMMAND scripts/tools/third-party "${name} holds" ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                    OUTPUT_VARIABLE parts COMMAND_ERROR_IS_FATAL ANY)
    file(APPEND ${copyright} "\n${parts}")
  endif()
  install(FILES ${copyright} ${changelog}.gz DESTINATION share/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES cmake/debian/lintian-overrides/${name} DESTINATION share/lintian/overrides
          COMPONENT ${component} EXCLUDE_FROM_ALL OPTIONAL)
endmacro()

rondel_debian_package(tool rondel science "Delaunay triangulations and Voronoi diagrams on the sphere"
  "librondel${soversion} ${this}"
  "This package contains the command line tool." cli11 json)
rondel_debian_package(runtime librondel${soversion} libs "triangulations on the sphere - shared libraries" ""
  "This package contains the shared libraries of C++." fast_float json)
rondel_debian_package(c_runtime librondel-c1 libs "triangulations on the sphere - shared library of C"
  "librondel${soversion} ${this}"
  "This package contains the shared library for C and what calls C.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_C_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
rondel_debian_package(development librondel-dev libdevel "triangulations on the sphere - development files"
  "librondel${soversion} ${this}, librondel-c1 ${this}"
  "This package contains the headers and what CMake and pkg-config read.")
find_package(Python 3.11 COMPONENTS Interpreter REQUIRED)
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
rondel_debian_package(python python3-rondel python "triangulations on the sphere - Python 3"
  "librondel${soversion} ${this}, python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy"
  "This package contains the module for Python." nanobind robin_map)
install(DIRECTORY bindings/python/rondel DESTINATION ${RONDEL_PYTHON_DESTINATION} COMPONENT python EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst
                                              ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
include(CPack)
