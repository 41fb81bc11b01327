// Stress of a particle, and what a body or a membrane looks like as a whole.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <geodrop/measure/measure.hpp>
#include <limits>

#include "base/fixed_order_sum.hpp"
#include "geometry/polygon.hpp"
#include "mean_and_deviation.hpp"
#include "membrane/bounds.hpp"
#include "membrane/part_size.hpp"
#include "membrane/triangles.hpp"
#include "state/bearing_share.hpp"

namespace geodrop {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// Pressure of a fluid follows from its density, of a solid from the stress that it carries.
template <int Dim>
double pressure(const Newtonian& fluid, const Body<Dim>& body, std::size_t p) {
  const double y = body.x[vertical_axis<Dim>][p], split_off = body.unit_weight * (body.weightless_level - y);
  return fluid_pressure(fluid, body.J[p], body.gas_at(p), fluid.of_weight(y)) + split_off;
}
template <class Solid, int Dim>
double pressure(const Solid&, const Body<Dim>& body, std::size_t p) {
  const double skeleton = -(body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3.0;
  return bearing_share(body, p) * skeleton + (body.pore_pressure.empty() ? 0.0 : body.pore_pressure[p]);
}

template <int Dim>
struct BodySums {
  double mass = 0, square = 0;
  Vec<Dim> moment = Vec<Dim>::Zero(), momentum = Vec<Dim>::Zero(), initial_moment = Vec<Dim>::Zero();
  Vec<Dim> lower = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), upper = -lower;

  BodySums& operator+=(const BodySums& other) {
    mass += other.mass;
    square += other.square;
    moment += other.moment;
    momentum += other.momentum;
    initial_moment += other.initial_moment;
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
    return *this;
  }
};

template <int Dim>
BodySums<Dim> sum_body(const Body<Dim>& body) {
  return fixed_order_sum<BodySums<Dim>>(body.size(), [&](BodySums<Dim>& sums, std::size_t p) {
    const Vec<Dim> x = vector_at(body.x, p), v = vector_at(body.v, p);
    const double m = body.mass[p];
    sums.mass += m;
    sums.square += m * v.squaredNorm();
    sums.moment += m * x;
    sums.momentum += m * v;
    sums.initial_moment += m * vector_at(body.initial_x, body.id[p]);
    sums.lower = sums.lower.cwiseMin(x);
    sums.upper = sums.upper.cwiseMax(x);
  });
}

/// Sums about the centres of mass, now and at the start.
template <int Dim>
struct CentredSums {
  Eigen::Matrix<double, Dim, Dim> now_by_initial = Eigen::Matrix<double, Dim, Dim>::Zero();
  double volume = 0, pressure = 0;
  Vec<Dim> stress = Vec<Dim>::Zero();

  CentredSums& operator+=(const CentredSums& other) {
    now_by_initial += other.now_by_initial;
    volume += other.volume;
    pressure += other.pressure;
    stress += other.stress;
    return *this;
  }
};

/// The rotation R that makes sum m |x - R X|^2 least (Kabsch): in 2D a ratio of moments, in 3D from the singular
/// vectors of sum m x X^T.
Rotation<2> best_rotation(const Eigen::Matrix2d& now_by_initial) {
  return Rotation<2>(std::atan2(now_by_initial(1, 0) - now_by_initial(0, 1), now_by_initial.trace()));
}
Rotation<3> best_rotation(const Eigen::Matrix3d& now_by_initial) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(now_by_initial, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  sign[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

template <int Dim>
CentredSums<Dim> sum_about(const Body<Dim>& body, const Vec<Dim>& centre, const Vec<Dim>& initial_centre,
                           double radius) {
  return fixed_order_sum<CentredSums<Dim>>(body.size(), [&](CentredSums<Dim>& sums, std::size_t p) {
    const Vec<Dim> x = vector_at(body.x, p) - centre;
    const Vec<Dim> x0 = vector_at(body.initial_x, body.id[p]) - initial_centre;
    sums.now_by_initial += body.mass[p] * x * x0.transpose();
    if (x.squaredNorm() > radius * radius) return;
    const double volume = body.volume(p);
    const auto stress = total_stress(body, p);
    sums.volume += volume;
    sums.pressure += volume * mean_pressure(body, p);
    for (int a = 0; a < Dim; ++a) sums.stress[a] += volume * stress[a];
  });
}

void measure_gauge(const Membrane<3>& membrane, MembraneMeasures<3>& measures) {
  measures.gauge_peak = membrane.gauge.peak;
  measures.gauge_time = membrane.gauge.peak_time;
  measures.gauge_at = Vec<3>(membrane.gauge.peak_at.data());
  measures.utilisation_max = utilisation(membrane);
}

MembraneMeasures<3> measure_triangles(const Membrane<3>& membrane) {
  MembraneMeasures<3> measures;
  const MembraneTriangles<3>& triangles = membrane.triangles;
  MeanAndDeviation tension, cross;
  measures.tension_max = -1;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    tension.add(triangles.rest_area[t], membrane.tension[t]);
    cross.add(triangles.rest_area[t], triangles.cross_tension[t]);
    measures.area += size_of(membrane, t);
    const double larger = std::max(membrane.tension[t], triangles.cross_tension[t]);
    if (larger <= measures.tension_max) continue;
    measures.tension_max = larger;
    measures.tension_max_at = middle_of(membrane, t);
  }
  const Box<3> box = bounds(membrane, 0);
  measures.lower = box.lower;
  measures.upper = box.upper;
  measures.tension_mean = tension.mean();
  measures.tension_deviation = tension.deviation();
  measures.cross_tension_mean = cross.mean();
  measures.cross_tension_deviation = cross.deviation();
  measures.tension_p95 = percentile({membrane.tension.begin(), membrane.tension.end()}, 95);
  measures.volume = enclosed_volume(membrane);
  measures.length = not_there;
  measure_gauge(membrane, measures);
  return measures;
}

}  // namespace

template <int Dim>
double mean_pressure(const Body<Dim>& body, std::size_t p) {
  return std::visit([&](const auto& law) { return pressure(law, body, p); }, body.material);
}

template <int Dim>
std::array<double, stress_components<Dim>> total_stress(const Body<Dim>& body, std::size_t p) {
  std::array<double, stress_components<Dim>> stress{};
  const double bearing = bearing_share(body, p);
  for (int k = 0; k < stress_components<Dim>; ++k)
    stress[k] = body.stress[k].empty() ? 0.0 : bearing * body.stress[k][p];
  double isotropic = body.pore_pressure.empty() ? 0.0 : body.pore_pressure[p];
  if (const auto* fluid = std::get_if<Newtonian>(&body.material)) isotropic = pressure(*fluid, body, p);
  for (int k = 0; k < 3; ++k) stress[k] -= isotropic;
  return stress;
}

double percentile(std::vector<double> values, double percent) {
  if (values.empty()) return not_there;
  const double rank = percent / 100 * static_cast<double>(values.size() - 1), below = std::floor(rank);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  const double next = at + 1 == values.end() ? *at : *std::min_element(at + 1, values.end());
  return *at + (rank - below) * (next - *at);
}

template <int Dim>
BodyMeasures<Dim> measure(const Body<Dim>& body, double radius) {
  const BodySums<Dim> sums = sum_body(body);
  BodyMeasures<Dim> measures;
  measures.centre = sums.moment / sums.mass;
  measures.velocity = sums.momentum / sums.mass;
  measures.lower = sums.lower;
  measures.upper = sums.upper;
  measures.velocity_rms = std::sqrt(sums.square / sums.mass);
  const CentredSums<Dim> centred = sum_about<Dim>(body, measures.centre, sums.initial_moment / sums.mass, radius);
  measures.rotation = best_rotation(centred.now_by_initial);
  const double volume = centred.volume > 0 ? centred.volume : not_there;
  measures.pressure_centre = centred.pressure / volume;
  measures.stress_centre = centred.stress / volume;
  return measures;
}

template <int Dim>
MembraneMeasures<Dim> measure(const Membrane<Dim>& membrane) {
  if constexpr (Dim == 3) return measure_triangles(membrane);
  MembraneMeasures<Dim> measures;
  measures.tension_max = -1;  // a slack membrane still has a place of its largest tension
  double rest_length = 0, weighted = 0, squares = 0;
  const Box<Dim> box = bounds(membrane, 0);
  measures.lower = box.lower;
  measures.upper = box.upper;
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const Vec<Dim> a = vector_at(membrane.x, s), b = vector_at(membrane.x, (s + 1) % membrane.nodes());
    measures.length += (b - a).norm();
    rest_length += membrane.rest_length[s];
    weighted += membrane.rest_length[s] * membrane.tension[s];
    squares += membrane.rest_length[s] * membrane.tension[s] * membrane.tension[s];
    if (membrane.tension[s] <= measures.tension_max) continue;
    measures.tension_max = membrane.tension[s];
    measures.tension_max_at = (a + b) / 2;
  }
  measures.tension_mean = weighted / rest_length;
  const double variance = squares / rest_length - measures.tension_mean * measures.tension_mean;
  measures.tension_deviation = std::sqrt(std::max(0.0, variance));
  measures.tension_p95 = percentile({membrane.tension.begin(), membrane.tension.end()}, 95);
  measures.area = Dim == 2 && membrane.closed ? std::abs(signed_area(membrane.x[0], membrane.x[1])) : not_there;
  measures.gauge_peak = membrane.gauge.peak;
  measures.gauge_time = membrane.gauge.peak_time;
  measures.gauge_at = Vec<Dim>(membrane.gauge.peak_at.data());
  measures.utilisation_max = membrane.strength > 0 ? measures.gauge_peak / membrane.strength : not_there;
  return measures;
}

template double mean_pressure(const Body<2>&, std::size_t);
template double mean_pressure(const Body<3>&, std::size_t);
template std::array<double, 4> total_stress(const Body<2>&, std::size_t);
template std::array<double, 6> total_stress(const Body<3>&, std::size_t);
template BodyMeasures<2> measure(const Body<2>&, double);
template BodyMeasures<3> measure(const Body<3>&, double);
template MembraneMeasures<2> measure(const Membrane<2>&);
template MembraneMeasures<3> measure(const Membrane<3>&);

}  // namespace geodrop
