# Every library that is not ours, behind one target. The Debian packages that hold them: packages.txt.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(fmt 9 REQUIRED)
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
find_library(XXHASH_LIBRARY xxhash REQUIRED)

# VTK's own CMake files name every part of VTK and stop if one is not there, so they serve only where VTK's
# development package is installed whole. Where just its headers are unpacked (what the wrapper does, see
# packages.txt) the few libraries that we need are named here. --as-needed drops those that are not called.
if(GEODROP_VTK_HEADERS)
  file(STRINGS "${GEODROP_VTK_HEADERS}/vtkVersionMacros.h" version_line REGEX "define VTK_VERSION ")
  string(REGEX MATCH "[0-9]+\\.[0-9]+" vtk_series "${version_line}")
  add_library(geodrop_vtk INTERFACE)
  target_include_directories(geodrop_vtk SYSTEM INTERFACE "${GEODROP_VTK_HEADERS}")
  target_link_options(geodrop_vtk INTERFACE LINKER:--as-needed)
  foreach(part CommonCore CommonDataModel CommonMisc CommonExecutionModel IOCore IOXML IOXMLParser sys)
    find_library(VTK_${part}_LIBRARY NAMES libvtk${part}-${vtk_series}.so libvtk${part}-${vtk_series}.so.1 REQUIRED)
    target_link_libraries(geodrop_vtk INTERFACE "${VTK_${part}_LIBRARY}")
  endforeach()
else()
  find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel CommonMisc IOXML)
  add_library(geodrop_vtk INTERFACE)
  target_link_libraries(geodrop_vtk INTERFACE ${VTK_LIBRARIES})
endif()

add_library(geodrop_packages INTERFACE)
target_include_directories(geodrop_packages SYSTEM INTERFACE "${XXHASH_INCLUDE_DIR}")
target_link_libraries(geodrop_packages INTERFACE Eigen3::Eigen OpenMP::OpenMP_CXX CLI11::CLI11
                      tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json fmt::fmt "${XXHASH_LIBRARY}" geodrop_vtk)
