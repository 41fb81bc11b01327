// A frame copied out of the state: what the writer thread works on while the step loop goes on.
#pragma once

#include <cstdint>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// One value of `components` numbers per particle or segment, Float32.
struct Field {
  std::string name;
  std::vector<std::string> components;  ///< names; empty: one number without a name
  std::vector<float> values;

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// How positions are written: single ones are right to 6e-8 of the largest coordinate, which is too coarse where that
/// is 1e5 particles from the origin, as in national coordinates.
enum class Precision { single, twice };

/// Particles of all bodies, body by body, each body in the order of its storage.
struct ParticleSnapshot {
  std::vector<double> points;  ///< three per particle [m]
  Precision precision = Precision::single;
  std::vector<Field> fields;
  std::vector<std::uint8_t> layer;      ///< horizontal band at the start
  std::vector<std::uint32_t> material;  ///< index in the scene
  std::vector<std::uint32_t> body;      ///< index in the scene
  std::vector<std::uint32_t> id;        ///< index within the body at the start
};

/// Segments, or in space triangles, of all membranes.
struct MembraneSnapshot {
  std::vector<double> points;  ///< three per node [m]
  Precision precision = Precision::single;
  int corners = 2;                          ///< of a segment; of a triangle 3
  std::vector<std::uint32_t> connectivity;  ///< that many nodes per segment
  std::vector<Field> fields;                ///< per segment
  std::vector<std::uint32_t> membrane;      ///< index in the scene, per segment
};

/// Lines of the surfaces of all rigid bodies that are there.
struct RigidSnapshot {
  std::vector<double> points;  ///< three per corner [m]
  Precision precision = Precision::single;
  std::vector<std::uint32_t> connectivity;  ///< two corners per line
  std::vector<Field> fields;                ///< per corner
  std::vector<std::uint32_t> rigid;         ///< index in the scene, per line
};

struct Snapshot {
  double t = 0;           ///< [s]
  std::size_t index = 0;  ///< of the frame, in file names
  ParticleSnapshot particles;
  MembraneSnapshot membranes;  ///< empty if the scene has none
  bool has_rigid = false;      ///< the scene has rigid bodies with lines to draw, there or not
  RigidSnapshot rigid;
};

/// `materials`: names in the order of the scene. `fields`: those of particles that are wanted, of
/// measure/particle_columns; empty: all.
template <int Dim>
Snapshot take_snapshot(const State<Dim>& state, const std::vector<std::string>& materials,
                       const std::vector<std::string>& fields = {});

/// Fields of the segments or triangles of membranes that bear tension, measure/membrane_balance: curvature_load,
/// pressure_jump [Pa].
template <int Dim>
void add_balance(const Scene& scene, const State<Dim>& state, Snapshot& snapshot);

}  // namespace geodrop
