# Compiler flags, for our own targets only.
add_library(geodrop_flags INTERFACE)

# -Wno-psabi: GCC notes that 32-byte vectors are passed differently with AVX; nothing outside is handed one.
target_compile_options(geodrop_flags INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Wno-psabi)
# Of files that are compiled together a local name may be that of another file, and g++ takes a file's own types for a header's.
target_compile_options(geodrop_flags INTERFACE
  $<IF:$<AND:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<CXX_COMPILER_ID:GNU>>,-Wshadow=local$<SEMICOLON>-Wno-subobject-linkage,-Wshadow>)
# GCC 12 reports overlapping copies inside std::string's operator+ that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(geodrop_flags INTERFACE -Wno-restrict)
endif()
if(GEODROP_WERROR)
  target_compile_options(geodrop_flags INTERFACE -Werror)
endif()

# Not -ffast-math: it reorders sums, and would fold away the checks for NaN. No fused multiply-adds but those that the
# source asks for: the bits of a run then depend neither on the compiler nor on the processor (docs/reproducibility.md).
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG -fno-math-errno -fno-trapping-math -ffp-contract=off")
set(CMAKE_CXX_FLAGS_DEBUG "-g -ffp-contract=off")

# Kernels are compiled for AVX2 and AVX-512 as well and chosen at start (src/base/levels.hpp); this is the least they
# need. In builds of one level the kernels alone are for GEODROP_MARCH: other code gains nothing from it.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(geodrop_flags INTERFACE -march=x86-64-v2)
endif()
# g++ -O0 and -O1 and Clang do not inline a whole kernel into each level.
if(GEODROP_MARCH OR GEODROP_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug"
   OR NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_definitions(geodrop_flags INTERFACE GEODROP_ONE_LEVEL)
endif()
if(GEODROP_MARCH)
  file(GLOB_RECURSE kernel_sources "${PROJECT_SOURCE_DIR}/src/transfer/*.cpp")
  # GCC 12 with AVX takes a node record that is filled lane by lane for uninitialised.
  set_source_files_properties(${kernel_sources} PROPERTIES COMPILE_OPTIONS
                              "-march=${GEODROP_MARCH};$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>")
endif()

# Tests call; what they compile themselves needs no speed. -O1 lets g++ 12 see overlaps inside std::string that are not there.
set(GEODROP_TEST_OPTIONS -O1 $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
    $<$<AND:$<BOOL:${GEODROP_UNITY}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)

if(GEODROP_SANITIZE)
  set(GEODROP_TEST_OPTIONS "")
  target_compile_options(geodrop_flags INTERFACE $<IF:$<STREQUAL:$<TARGET_PROPERTY:NAME>,geodrop_tests>,-O0,-O1> -g1
                         -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all)
  # Null pointers and objects that are too small are found by the address sanitizer where they are used: less to compile.
  target_compile_options(geodrop_flags INTERFACE -fno-sanitize=null,object-size)
  target_link_options(geodrop_flags INTERFACE -fsanitize=address,undefined)
  # With address sanitizer Eigen would align by hand what the tests of the release build free: one way for all.
  target_compile_definitions(geodrop_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  # GCC 12 takes parts of std::regex for uninitialised there.
  set_source_files_properties(src/reader/parse_scene.cpp PROPERTIES COMPILE_OPTIONS
                              "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>")
endif()
