// Membranes of triangles in space: tension-only cloth without bending, in energies per area of the cloth at rest.
//
//   F     3 x 2, from the cloth at rest (warp, weft) to space, constant on a triangle
//   yarns       W = J_w <l_w - 1>^2 / 2 + J_f <l_f - 1>^2 / 2,  l_w = |F e_w|,  l_f = |F e_f|,  <e> = max(0, e)
//   isotropic   of the principal stretches l_1 >= l_2, e = l - 1 (the relaxed energy of a tension field, Pipkin 1986):
//               slack, e_1 <= 0:            W = 0
//               wrinkled, e_2 <= -nu e_1:   W = J e_1^2 / 2
//               taut:                       W = J (e_1^2 + e_2^2 + 2 nu e_1 e_2) / (2 (1 - nu^2))
//   rubber      incompressible and neo-Hookean (Treloar 1943), relaxed likewise; J its stiffness in uniaxial tension:
//               slack, l_1 <= 1:                W = 0
//               wrinkled, l_2 <= l_1^(-1/2):    W = J (l_1^2 + 2 / l_1 - 3) / 6
//               taut:                           W = J (l_1^2 + l_2^2 + 1 / (l_1 l_2)^2 - 3) / 6
//
// All have a continuous tension T = dW/dl, per width at rest as a strip test gives it; the first two are convex in the
// stretches.
#pragma once

#include <geodrop/state/state.hpp>

#include <Eigen/Core>

#include <array>

namespace geodrop {

/// What the cloth of a triangle bears.
struct ClothState {
  double strain = 0;                                 ///< l - 1 of the larger principal stretch, or of the warp [-]
  double tension = 0;                                ///< along it, per width at rest [N/m]
  double cross_tension = 0;                          ///< across it, or of the weft [N/m]
  double energy = 0;                                 ///< W [J/m2]
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();  ///< S = 2 dW/d(F^T F) [N/m]
};

/// `right_cauchy_green`: C = F^T F.
ClothState cloth_state(const Membrane<3>& membrane, const Eigen::Matrix2d& right_cauchy_green);

/// Corner k of a triangle now [m].
Eigen::Vector3d corner_of(const Membrane<3>& membrane, std::size_t triangle, std::size_t k);
inline std::array<Eigen::Vector3d, 3> corners_of(const Membrane<3>& membrane, std::size_t triangle) {
  return {corner_of(membrane, triangle, 0), corner_of(membrane, triangle, 1), corner_of(membrane, triangle, 2)};
}

/// F of a triangle.
Eigen::Matrix<double, 3, 2> deformation(const Membrane<3>& membrane, std::size_t triangle);

/// The edges from corner 0 of a triangle at rest, in warp and weft (columns), from its corners in space. What of `warp`
/// lies in its plane is the first axis; the first edge where nothing does.
Eigen::Matrix2d rest_edges(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& warp);

/// The same of a triangle of a membrane.
Eigen::Matrix2d rest_edges(const Membrane<3>& membrane, std::size_t triangle);

/// Middle of a triangle now [m], and twice its area times its outward normal [m2].
Eigen::Vector3d middle_of(const Membrane<3>& membrane, std::size_t triangle);
Eigen::Vector3d normal_of(const Membrane<3>& membrane, std::size_t triangle);

/// What is enclosed, by walls too at which the surface ends [m3].
double enclosed_volume(const Membrane<3>& membrane);

/// The first axis across which the surface ends at no wall: the divergence theorem holds along it.
int axis_without_ends(const Membrane<3>& membrane);

/// Fills strain, tension and cross_tension.
void update_triangles(Membrane<3>& membrane);

/// -dU/dx of U = sum A W, dim-major [N].
std::array<Array<double>, 3> triangle_forces(const Membrane<3>& membrane);

/// U [J].
double cloth_energy(const Membrane<3>& membrane);

/// Largest share of the strength that any triangle bears now, by yarn [-]; NaN without strength.
double utilisation(const Membrane<3>& membrane);

}  // namespace geodrop
