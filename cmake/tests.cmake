# One test binary; one ctest entry per test file, named like the file: "materials/mohr_coulomb", labelled by its folder.
find_package(doctest REQUIRED)

file(GLOB_RECURSE test_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/*.cpp")
# Compiled for each build: what asks for the place of the program, for NDEBUG or for sanitizers.
set(own_tests main.cpp support/paths.cpp step/written_fields.cpp command_line/exit_codes.cpp
              fuzz/calculators.cpp fuzz/checkpoint.cpp fuzz/overrides.cpp fuzz/scene.cpp)
list(TRANSFORM own_tests PREPEND "${PROJECT_SOURCE_DIR}/tests/")
set(compiled_tests ${test_sources})
list(REMOVE_ITEM compiled_tests ${own_tests})
if(GEODROP_UNITY)
  include(together)
  put_together(compiled_tests)
endif()
if(GEODROP_TEST_OBJECTS)
  # The core comes first: of an inline function that is compiled there and here, the linker takes the one with sanitizers.
  add_executable(geodrop_tests ${own_tests})
  list(TRANSFORM compiled_tests REPLACE "^(${PROJECT_BINARY_DIR}|${PROJECT_SOURCE_DIR})/(.*)$" "${GEODROP_TEST_OBJECTS}/\\2.o")
  target_link_libraries(geodrop_tests PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,geodrop_core> ${compiled_tests} doctest::doctest)
else()
  add_executable(geodrop_tests ${own_tests} ${compiled_tests})
  target_link_libraries(geodrop_tests PRIVATE geodrop_core doctest::doctest)
endif()
target_include_directories(geodrop_tests PRIVATE tests)
target_compile_options(geodrop_tests PRIVATE ${GEODROP_TEST_OPTIONS})
# What nearly every test reads is parsed once: that is half of the work.
target_precompile_headers(geodrop_tests PRIVATE <doctest/doctest.h> <geodrop/step/pipeline.hpp> <geodrop/reader/scene_reader.hpp>)
set_source_files_properties("${PROJECT_SOURCE_DIR}/tests/main.cpp" PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
set_source_files_properties("${PROJECT_SOURCE_DIR}/tests/support/paths.cpp" PROPERTIES COMPILE_DEFINITIONS
                            "GEODROP_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\";GEODROP_PROGRAM=\"$<TARGET_FILE:geodrop>\"")
add_dependencies(geodrop_tests geodrop)

add_test(NAME wrapper COMMAND "${PROJECT_SOURCE_DIR}/tests/wrapper.sh")
set_tests_properties(wrapper PROPERTIES LABELS wrapper)
if(NOT GEODROP_SANITIZE)  # valgrind runs no program with address sanitizer
  add_test(NAME installed COMMAND "${PROJECT_SOURCE_DIR}/tests/installed.sh" "${PROJECT_BINARY_DIR}")
  set_tests_properties(installed PROPERTIES LABELS installed TIMEOUT "${GEODROP_TEST_TIMEOUT}")
endif()
# Skipped unless GEODROP_TEST_SLURM=1 (docs/running.md).
add_test(NAME slurm COMMAND "${PROJECT_SOURCE_DIR}/tests/slurm.sh" "$<TARGET_FILE:geodrop>"
                            "${PROJECT_SOURCE_DIR}/cases/gravity_column.toml")
set_tests_properties(slurm PROPERTIES LABELS slurm SKIP_RETURN_CODE 77 TIMEOUT 1800)

# ctest runs several tests at once: bound or spinning threads of two of them would fight for one core.
set(test_environment OMP_PROC_BIND=false OMP_WAIT_POLICY=passive OMP_NUM_THREADS=2)
if(GEODROP_SANITIZE)
  list(APPEND test_environment GEODROP_ONE_RUN=1)  # golden/hashes: memory is looked at, not threads
endif()
foreach(source IN LISTS test_sources)
  cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}/tests" OUTPUT_VARIABLE relative)
  if(relative STREQUAL "main.cpp" OR relative MATCHES "^support/")
    continue()
  endif()
  string(REGEX REPLACE "\\.cpp$" "" name "${relative}")
  string(REGEX REPLACE "/.*" "" folder "${name}")
  add_test(NAME "${name}" COMMAND geodrop_tests "--source-file=*/tests/${relative}")
  # A filter that matches no test case must not pass.
  set_tests_properties("${name}" PROPERTIES
    LABELS "${folder}"
    TIMEOUT "${GEODROP_TEST_TIMEOUT}"
    SKIP_RETURN_CODE 77  # support/not_tested
    ENVIRONMENT "${test_environment}"
    FAIL_REGULAR_EXPRESSION "test cases: +0 [|]")
endforeach()

# Longest first, or one core runs the last of them alone: ctest knows how long a test takes only once it has run there.
set(cost 100)
foreach(name scenes/dumping invariants/threads scenes/geotube scenes/stacked_tubes scenes/capstan scenes/drag scenes/graded
             scenes/release scenes/silent_side)
  set_tests_properties("${name}" PROPERTIES COST "${cost}")
  math(EXPR cost "${cost} - 10")
endforeach()

# The golden hashes with the kernels of lesser processors as well; a build for one processor has no choice.
if(NOT GEODROP_MARCH AND NOT GEODROP_SANITIZE)
  foreach(level v2 v3)
    add_test(NAME "golden/hashes_${level}" COMMAND geodrop_tests "--source-file=*/tests/golden/hashes.cpp")
    set_tests_properties("golden/hashes_${level}" PROPERTIES
      LABELS "golden"
      TIMEOUT "${GEODROP_TEST_TIMEOUT}"
      ENVIRONMENT "${test_environment};GEODROP_KERNELS=x86-64-${level}"
      FAIL_REGULAR_EXPRESSION "test cases: +0 [|]")
  endforeach()
endif()
