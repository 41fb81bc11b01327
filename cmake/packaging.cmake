# `cmake --install` and the Debian package (cpack -G DEB; needs dpkg-dev and file, which find out the dependencies).
set(share "${CMAKE_INSTALL_DATADIR}/geodrop")
install(TARGETS geodrop)
# The page of the manual and the completion of bash tell what the program knows: it writes them itself.
set(told "${PROJECT_BINARY_DIR}/manual")
file(MAKE_DIRECTORY "${told}")
add_custom_command(TARGET geodrop POST_BUILD
                   COMMAND geodrop manual > "${told}/geodrop.1"
                   COMMAND geodrop manual --completion > "${told}/geodrop"
                   COMMENT "Writing page of the manual and completion" VERBATIM)
install(FILES "${told}/geodrop.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${told}/geodrop" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(DIRECTORY cases paraview DESTINATION "${share}" PATTERN __pycache__ EXCLUDE)
install(FILES perf/instructions.csv DESTINATION "${share}/perf")  # for bench --instructions
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES README.md CHANGELOG.md CITATION.cff codemeta.json LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
# What the pages link to lies beside them as in the source tree, so that links lead somewhere.
file(GLOB pages CONFIGURE_DEPENDS *.md docs/*.md docs/*/*.md paraview/*.md perf/*.md)
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(REPLACE "](" "<link>" text "${text}")  # CMake splits no list at brackets
  string(REGEX MATCHALL "<link>[^)#:]+[)#]" links "${text}")
  cmake_path(GET page PARENT_PATH directory)
  foreach(link IN LISTS links)
    string(REGEX REPLACE "<link>(.*)[)#]" "\\1" target "${link}")
    cmake_path(ABSOLUTE_PATH target BASE_DIRECTORY "${directory}" NORMALIZE)
    if(NOT EXISTS "${target}")
      message(FATAL_ERROR "${page} links to ${target}, which is not there")
    endif()
    cmake_path(RELATIVE_PATH target BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
    cmake_path(GET target PARENT_PATH folder)
    if(NOT folder MATCHES "^docs")
      install(FILES "${target}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}")
    endif()
  endforeach()
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The geodrop authors <geodrop@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS paraview)
include(CPack)
