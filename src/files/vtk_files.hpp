// One frame as VTK files, and the collections (.pvd) that give their times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "snapshot.hpp"

namespace geodrop {

enum class Compression { none, lz4 };

/// "particles_000012.vtu"
std::string frame_file_name(const std::string& kind, std::size_t index, const std::string& extension);

/// Every particle a vertex cell. Throws WriteError, as all functions here, if the disk does not take it.
void write_particles(const std::filesystem::path& path, const ParticleSnapshot& particles, double t,
                     Compression compression);
/// Every segment a line cell.
void write_membranes(const std::filesystem::path& path, const MembraneSnapshot& membranes, double t,
                     Compression compression);

/// Every line of an outline a line cell.
void write_rigid(const std::filesystem::path& path, const RigidSnapshot& rigid, double t, Compression compression);

/// `kind`.pvd in `directory` with the files of frames 0..times.size()-1, written whole and renamed, so that a reader
/// never sees half of it.
void write_collection(const std::filesystem::path& directory, const std::string& kind, const std::string& extension,
                      const std::vector<double>& times);

}  // namespace geodrop
