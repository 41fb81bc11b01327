// What frames show of particles: every field that is shown as it is, and what follows from them.
#pragma once

#include <geodrop/measure/measure.hpp>
#include <geodrop/state/state.hpp>

#include <string>
#include <vector>

namespace geodrop {

inline float narrow(double value) { return static_cast<float>(value); }

/// Calls column(name, names of components, write) for the fields of particles that are shown as they are: write(p, to)
/// gives the value of one particle.
template <class P, class Column>
void for_each_shown_field(const P& particles, Column&& column) {
  using namespace particle_role;
  for_each_field<shown | shown_if_any>(particles, [&](const auto& entry, const Array<double>& values) {
    if (values.empty() && (entry.roles & shown) == 0) return;
    column(entry.name, {}, [&](std::size_t p, float* to) { *to = values.empty() ? 0.0F : narrow(values[p]); });
  });
}

inline const std::vector<std::string> vector_components = {"X", "Y", "Z"};
inline const std::vector<std::string> tensor_components = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};

/// The same for all that particles of a body show.
template <int Dim, class Column>
void for_each_column(const Body<Dim>& body, Column column) {
  column("velocity", vector_components, [&](std::size_t p, float* to) {
    for (int a = 0; a < Dim; ++a) to[a] = narrow(body.v[a][p]);
  });
  column("displacement", vector_components, [&](std::size_t p, float* to) {
    for (int a = 0; a < Dim; ++a) to[a] = narrow(body.x[a][p] - body.initial_x[a][body.id[p]]);
  });
  column("stress", tensor_components, [&](std::size_t p, float* to) {
    const auto stress = total_stress(body, p);
    for (int k = 0; k < stress_components<Dim>; ++k) to[k] = narrow(stress[k]);
  });
  column("mean_pressure", {}, [&](std::size_t p, float* to) { *to = narrow(mean_pressure(body, p)); });
  column("volumetric_strain", {}, [&](std::size_t p, float* to) { *to = narrow(body.J[p] - 1); });
  column("density", {}, [&](std::size_t p, float* to) { *to = narrow(reference_density(body.material) / body.J[p]); });
  for_each_shown_field(body, column);
}

/// The names of all columns that particles of any law may show.
std::vector<std::string> particle_columns();

}  // namespace geodrop
