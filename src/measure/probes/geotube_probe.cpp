#include "geotube_probe.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>
#include <geodrop/calculators/geotube.hpp>
#include <geodrop/measure/measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/fixed_order_sum.hpp"
#include "base/text.hpp"

namespace geodrop {
namespace {

/// Mean pressure of the particles within `near` of a level, carried on to it by the fluid's weight [Pa].
double pressure_at(const Body<2>& fill, double unit_weight, double level, double near) {
  struct Sums {
    double volume = 0, pressure = 0;
    Sums& operator+=(const Sums& other) {
      volume += other.volume;
      pressure += other.pressure;
      return *this;
    }
  };
  const Sums sums = fixed_order_sum<Sums>(fill.size(), [&](Sums& part, std::size_t p) {
    const double above = fill.x[1][p] - level, volume = fill.volume(p);
    if (std::abs(above) > near) return;
    part.volume += volume;
    part.pressure += volume * (mean_pressure(fill, p) + unit_weight * above);
  });
  return sums.volume > 0 ? sums.pressure / sums.volume : std::numeric_limits<double>::quiet_NaN();
}

double unit_weight_of(const Scene& scene, const Material& material) {
  return -scene.gravity[1] * reference_density(material);
}

/// Empty if there is none, as for more fluid than the circle holds.
std::optional<Geotube> exact_tube(const Scene& scene, const GeotubeProbeSpec& probe, const Membrane<2>& membrane,
                                  const Body<2>& fill) {
  GeotubeInput input{};
  input.perimeter = std::accumulate(membrane.rest_length.begin(), membrane.rest_length.end(), 0.0);
  input.unit_weight = unit_weight_of(scene, fill.material);
  input.stiffness = membrane.axial_stiffness;
  if (!probe.water.empty())
    input.water = {probe.water_level, unit_weight_of(scene, make_material(*find_material(scene, probe.water)))};
  input.given = GeotubeQuantity::area;
  input.value = std::accumulate(fill.mass.begin(), fill.mass.end(), 0.0) / reference_density(fill.material);
  try {
    return find_geotube(input);
  } catch (const SceneError&) {
    return std::nullopt;
  }
}

std::string csv_line(std::initializer_list<double> values) {
  std::string line;
  for (const double value : values) line += (line.empty() ? "" : ",") + format_number(value);
  return line + '\n';
}

}  // namespace

std::vector<std::pair<std::string, double>> geotube_columns(const Scene& scene, const GeotubeProbeSpec& probe,
                                                            const State<2>* state) {
  MembraneMeasures<2> now;
  double bottom = 0, top = 0;
  std::optional<Geotube> exact = Geotube{};
  if (state) {
    const Membrane<2>& membrane = find_named(state->membranes, probe.membrane);
    const Body<2>& fill = find_named(state->bodies, membrane.body);
    const double unit_weight = unit_weight_of(scene, fill.material), near = scene.grid.spacing;
    now = measure(membrane);
    bottom = pressure_at(fill, unit_weight, now.lower[1], near);
    top = pressure_at(fill, unit_weight, now.upper[1], near);
    exact = exact_tube(scene, probe, membrane, fill);
  }
  const auto of_exact = [&](double Geotube::*quantity) {
    return exact ? (*exact).*quantity : std::numeric_limits<double>::quiet_NaN();
  };
  return {{"height_m", now.upper[1] - now.lower[1]},
          {"width_m", now.upper[0] - now.lower[0]},
          {"tension_mean_N_m", now.tension_mean},
          {"tension_std_N_m", now.tension_deviation},
          {"pressure_bottom_Pa", bottom},
          {"pressure_top_Pa", top},
          {"exact_height_m", of_exact(&Geotube::height)},
          {"exact_width_m", of_exact(&Geotube::width)},
          {"exact_tension_N_m", of_exact(&Geotube::tension)},
          {"exact_pressure_bottom_Pa", of_exact(&Geotube::fill_pressure_bottom)},
          {"exact_pressure_top_Pa", of_exact(&Geotube::fill_pressure_top)},
          {"height_error_ratio", (now.upper[1] - now.lower[1]) / of_exact(&Geotube::height) - 1},
          {"width_error_ratio", (now.upper[0] - now.lower[0]) / of_exact(&Geotube::width) - 1},
          {"tension_error_ratio", now.tension_mean / of_exact(&Geotube::tension) - 1}};
}

void GeotubeProbeSpec::write_profile(const Scene& scene, const State<2>& state,
                                     const std::filesystem::path& directory) const {
  const Membrane<2>& tube = find_named(state.membranes, membrane);
  const Body<2>& fill = find_named(state.bodies, tube.body);
  const MembraneMeasures<2> now = measure(tube);
  const std::size_t n = tube.nodes();
  std::string outline = "x_m,y_m,tension_N_m\n";
  for (std::size_t k = 0; k <= n; ++k)  // closed; of the segment behind each node
    outline += csv_line({tube.x[0][k % n], tube.x[1][k % n], tube.tension[k % n]});
  write_file_atomically(directory / ("geotube_" + name + "_outline.csv"), outline);

  std::string pressures = "height_m,pressure_Pa\n";
  for (std::size_t p = 0; p < fill.size(); ++p) pressures += csv_line({fill.x[1][p], mean_pressure(fill, p)});
  write_file_atomically(directory / ("geotube_" + name + "_pressure.csv"), pressures);

  const std::optional<Geotube> exact = exact_tube(scene, *this, tube, fill);
  if (!exact) return;
  constexpr int segments = 360;
  const double middle = 0.5 * (now.lower[0] + now.upper[0]), ground = now.lower[1];
  std::string exact_outline = "x_m,y_m,pressure_Pa,tension_N_m\n";
  for (const OutlinePoint& point : geotube_outline(*exact, segments)) {
    const double fill_pressure = exact->fill_pressure_bottom - exact->unit_weight * point.z;
    exact_outline += csv_line({middle + point.x, ground + point.z, fill_pressure, exact->tension});
  }
  write_file_atomically(directory / ("geotube_" + name + "_exact.csv"), exact_outline);
}

}  // namespace geodrop
