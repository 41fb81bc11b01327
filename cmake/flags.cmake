# Compiler flags, for our own targets only.
add_library(geodrop_flags INTERFACE)

# -Wno-psabi: GCC notes that 32-byte vectors are passed differently with AVX; nothing outside is handed one.
target_compile_options(geodrop_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-psabi)
# GCC 12 reports overlapping copies inside std::string's operator+ that are not there (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(geodrop_flags INTERFACE -Wno-restrict)
endif()
if(GEODROP_WERROR)
  target_compile_options(geodrop_flags INTERFACE -Werror)
endif()

# Not -ffast-math: it reorders sums, and would fold away the checks for NaN.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG -fno-math-errno -fno-trapping-math")

# Kernels are compiled for AVX2 and FMA as well and chosen at start (target_clones); this is the least they need.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(geodrop_flags INTERFACE -march=x86-64-v2)
else()
  target_compile_definitions(geodrop_flags INTERFACE GEODROP_NO_CLONES)
endif()

# The choice of a clone runs before the sanitizers are ready, hence no clones.
if(GEODROP_SANITIZE)
  target_compile_definitions(geodrop_flags INTERFACE GEODROP_NO_CLONES)
  target_compile_options(geodrop_flags INTERFACE -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined
                         -fno-sanitize-recover=all)
  target_link_options(geodrop_flags INTERFACE -fsanitize=address,undefined)
endif()
