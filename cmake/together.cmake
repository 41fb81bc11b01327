# Test files of a folder that are compiled together, a handful at a time: what they include is read once. Not CMake's unity builds, where
# names of two files may meet: here all headers come first, then each file in a namespace of its own, where its #includes find nothing
# left to do. None of them may depend on a condition.
if(CMAKE_SCRIPT_MODE_FILE)  # -DTOGETHER=file to write -DSOURCES=files
  foreach(source IN LISTS SOURCES)
    cmake_path(GET source PARENT_PATH beside)
    file(STRINGS "${source}" lines REGEX "^#include ")
    foreach(line IN LISTS lines)
      string(REGEX MATCH "^#include [\"<]([^\">]*)[\">]" include "${line}")
      if(EXISTS "${beside}/${CMAKE_MATCH_1}")
        set(include "#include \"${beside}/${CMAKE_MATCH_1}\"")
      endif()
      list(APPEND includes "${include}")
    endforeach()
    cmake_path(GET source STEM name)
    string(APPEND files "namespace file_${name} {\n#include \"${source}\"\n}\n")
  endforeach()
  list(REMOVE_DUPLICATES includes)
  list(JOIN includes "\n" includes)
  file(CONFIGURE OUTPUT "${TOGETHER}" CONTENT "${includes}\n${files}")  # touched only when it changes
  return()
endif()

set(most_together 6)

# put_together(SOURCES): in the list of this name, files of a folder of tests/ become files that include up to six of them.
function(put_together sources)
  foreach(source IN LISTS ${sources})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder STEM folder)
    file(STRINGS "${source}" foreign REGEX "^namespace [a-z]" LIMIT_COUNT 1)
    if(foreign OR folder STREQUAL "support")  # adds to a namespace of others
      list(APPEND alone "${source}")
    else()
      list(APPEND folders "${folder}")
      list(APPEND in_${folder} "${source}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH in_${folder} count)
    math(EXPR groups "(${count} + ${most_together} - 1) / ${most_together}")
    math(EXPR size "(${count} + ${groups} - 1) / ${groups}")
    math(EXPR last "${count} - 1")
    foreach(first RANGE 0 ${last} ${size})
      list(SUBLIST in_${folder} ${first} ${size} some)
      set(together "${PROJECT_BINARY_DIR}/tests/${folder}_${first}.cpp")
      add_custom_command(OUTPUT "${together}" DEPENDS ${some} "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" VERBATIM
                         COMMAND "${CMAKE_COMMAND}" "-DTOGETHER=${together}" "-DSOURCES=${some}"
                                 -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}")
      list(APPEND all "${together}")
    endforeach()
  endforeach()
  set(${sources} ${all} ${alone} PARENT_SCOPE)
endfunction()
