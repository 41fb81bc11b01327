#include "limit_warnings.hpp"

#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/materials/materials.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace geodrop {
namespace {

constexpr int digits = 3;
constexpr double most_mach = 0.3;        // errors of the order of its square: 9 %
constexpr double most_rise = 0.1;        // of the density
constexpr double most_growth = 0.01;     // of the area inside a membrane
constexpr double most_widening = 2;      // of cells along a membrane
constexpr double lone_particles = 0.01;  // share of a body that may be denser: splashes

std::string percent(double share) { return format_number(100 * share, digits) + " %"; }

std::string at(double t) { return ", by t = " + format_number(t, 4) + " s"; }

bool is_pumped(const Scene& scene, const std::string& body) {
  return std::any_of(scene.pumps.begin(), scene.pumps.end(), [&](const PumpSpec& pump) { return pump.body == body; });
}

}  // namespace

void LimitWatch::say(const std::string& what, const std::string& text) {
  if (said_.insert(what).second) new_.push_back("warning: " + text);
}

void LimitWatch::look_at_row(const Scene& scene, const HistoryTable& history, std::size_t row) {
  const std::vector<double>&now = history.rows[row], &start = history.rows.front();
  double speed = 0;
  for (const BodySpec& body : scene.bodies) speed = std::max(speed, now[history.find(body.name + ".velocity_rms_m_s")]);
  for (const BodySpec& body : scene.bodies) {
    const Material material = make_material(*find_material(scene, body.material));
    if (!std::holds_alternative<Newtonian>(material) || speed <= most_mach * wave_speed(material)) continue;
    say(body.name + " mach", "bodies move at " + format_number(speed / wave_speed(material), digits) +
                                 " of the wave speed of '" + body.name + "'" + at(now.front()) +
                                 "; a fluid is weakly compressible up to 0.3 only: raise its sound_speed");
  }
  for (const MembraneSpec& membrane : scene.membranes) {
    const std::size_t column = history.find(membrane.name + ".area_m2");
    if (column == history.columns.size() || is_pumped(scene, membrane.body)) continue;
    const double growth = now[column] / start[column] - 1;
    if (growth > most_growth)
      say(membrane.name + " area", "the outline of membrane '" + membrane.name + "' encloses " + percent(growth) +
                                       " more than at the start" + at(now.front()) +
                                       "; what is inside has opened (soil: void_memory), or what is around leaks in");
  }
}

/// A few particles may be pressed together in a splash.
template <int Dim>
void LimitWatch::look_at_density(const Body<Dim>& body, double t) {
  if (body.field == waiting || !std::holds_alternative<Newtonian>(body.material)) return;
  const double dense = 1 / (1 + most_rise);
  const auto count = std::count_if(body.J.begin(), body.J.end(), [&](double J) { return J < dense; });
  if (static_cast<double>(count) > lone_particles * static_cast<double>(body.size()))
    say(body.name + " density", "more than " + percent(lone_particles) + " of '" + body.name + "' is over " +
                                    percent(most_rise) + " denser than without pressure" + at(t) +
                                    "; raise its bulk_modulus or sound_speed");
}

/// Of a membrane that is in the finest cells of an axis in part.
template <int Dim>
void LimitWatch::look_at_cells(const GridSpec& grid, const Membrane<Dim>& membrane, double t) {
  if (membrane.field == waiting) return;
  for (int a = 0; a < Dim; ++a) {
    const AxisMap axis(grid, a);
    if (!axis.graded()) continue;
    const auto width = [&](double x) { return axis.span_width(static_cast<int>(std::lround(axis.to_grid(x)))); };
    const auto [least, most] = std::ranges::minmax(membrane.x[a], {}, width);
    if (width(least) > 1.01 * axis.finest() || width(most) <= most_widening * axis.finest()) continue;
    const std::string name(1, "xyz"[a]);
    say(membrane.name + " cells " + name, "a part of membrane '" + membrane.name + "' has left the fine cells along " +
                                              name + ": " + format_number(width(most), digits) + " m wide at " + name +
                                              " = " + format_number(most, digits) + " m, " +
                                              format_number(axis.finest(), digits) + " m where they are finest" +
                                              at(t) + "; a longer zone of grid.refine follows it");
  }
}

template <int Dim>
std::vector<std::string> LimitWatch::look(const Scene& scene, const State<Dim>& state, const HistoryTable& history) {
  for (; rows_seen_ < history.rows.size(); ++rows_seen_) look_at_row(scene, history, rows_seen_);
  for (const Body<Dim>& body : state.bodies) look_at_density(body, state.t);
  for (const Membrane<Dim>& membrane : state.membranes) look_at_cells(scene.grid, membrane, state.t);
  if (state.constraint_watch.unsolved > 0)
    say("constraint", "the pressures on sharp membranes were not found to 1e-8 in some steps" + at(state.t) +
                          "; the run ends if that lasts for 100 steps");
  return std::exchange(new_, {});
}

template std::vector<std::string> LimitWatch::look(const Scene&, const State<2>&, const HistoryTable&);
template std::vector<std::string> LimitWatch::look(const Scene&, const State<3>&, const HistoryTable&);

}  // namespace geodrop
