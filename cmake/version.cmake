# <geodrop/version.hpp> with GEODROP_VERSION: "0.2.0", and the commit where there is one: "0.2.0+bb82614-dirty".
# Written at every build, so that it is true of the sources that were compiled; touched only when it changes.
if(CMAKE_SCRIPT_MODE_FILE)
  if(EXISTS "${SOURCE_DIR}/.git")
    execute_process(COMMAND git --no-optional-locks describe --always --dirty --exclude * WORKING_DIRECTORY "${SOURCE_DIR}"
                    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
      set(VERSION "${VERSION}+${commit}")
    endif()
  else()  # an archive of the sources: git noted its commit there (.gitattributes)
    file(STRINGS "${SOURCE_DIR}/cmake/commit.txt" commit LIMIT_COUNT 1)
    if(commit MATCHES "^[0-9a-f]+$")
      set(VERSION "${VERSION}+${commit}")
    endif()
  endif()
  file(CONFIGURE OUTPUT "${HEADER}" CONTENT "#pragma once\n#define GEODROP_VERSION \"${VERSION}\"\n")
  return()
endif()

set(version_header "${PROJECT_BINARY_DIR}/generated/geodrop/version.hpp")
add_custom_target(geodrop_version_header BYPRODUCTS "${version_header}" COMMENT "Noting the version" VERBATIM
                  COMMAND "${CMAKE_COMMAND}" "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DVERSION=${PROJECT_VERSION}"
                          "-DHEADER=${version_header}" -P "${CMAKE_CURRENT_LIST_FILE}")
add_library(geodrop_version INTERFACE)
add_dependencies(geodrop_version geodrop_version_header)
target_include_directories(geodrop_version INTERFACE "${PROJECT_BINARY_DIR}/generated")
