#include "rigid_motion.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <numbers>

#include "base/value_at.hpp"

namespace geodrop {
namespace {

constexpr double radians = std::numbers::pi / 180;

template <int Dim>
std::array<double, Dim> as_array(const Point& v, double factor = 1) {
  std::array<double, Dim> array;
  for (int a = 0; a < Dim; ++a) array[a] = factor * v[a];
  return array;
}

/// Sets angle and displacement from the time for which the body has moved.
template <int Dim>
struct Pose {
  RigidBody<Dim>& body;

  void operator()(std::monostate) const {}
  void operator()(const HingeMotionSpec& hinge) const {
    const double most = hinge.stop_angle_deg * radians;
    body.angle = std::clamp(hinge.rate * body.moved, -most, most);
  }
  void operator()(const TranslationMotionSpec& translation) const {
    body.displacement = as_array<Dim>(translation.velocity, body.moved);
  }
  void operator()(const TableMotionSpec& table) const {
    if (!table.angles_deg.empty())
      body.angle = radians * value_at(body.moved, table.times, table.angles_deg);
    else
      body.displacement =
          as_array<Dim>(value_at(body.moved, table.times, table.displacements, [](Point a, const Point& b, double s) {
            for (std::size_t k = 0; k < a.size(); ++k) a[k] += s * (b[k] - a[k]);
            return a;
          }));
  }
};

}  // namespace

template <int Dim>
std::array<double, Dim> centre_of(const RigidMotion& motion) {
  if (const auto* hinge = std::get_if<HingeMotionSpec>(&motion)) return as_array<Dim>(hinge->centre);
  if (const auto* table = std::get_if<TableMotionSpec>(&motion))
    if (!table->angles_deg.empty()) return as_array<Dim>(table->centre);
  return {};
}

template <int Dim>
void move_rigid_bodies(const std::vector<RigidSpec>& specs, double dt, State<Dim>& state) {
  for (RigidBody<Dim>& body : state.rigid) {
    const double angle = body.angle;
    const std::array<double, Dim> displacement = body.displacement;
    if (body.moving) {
      body.moved += dt;
      std::visit(Pose<Dim>{body}, find_named(specs, body.name).motion);
    }
    body.angle_rate = (body.angle - angle) / dt;
    for (int a = 0; a < Dim; ++a) body.velocity[a] = (body.displacement[a] - displacement[a]) / dt;
  }
}

template std::array<double, 2> centre_of<2>(const RigidMotion&);
template std::array<double, 3> centre_of<3>(const RigidMotion&);
template void move_rigid_bodies(const std::vector<RigidSpec>&, double, State<2>&);
template void move_rigid_bodies(const std::vector<RigidSpec>&, double, State<3>&);

}  // namespace geodrop
