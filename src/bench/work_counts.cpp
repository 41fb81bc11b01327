#include "work_counts.hpp"

#include <cmath>

namespace geodrop {
namespace {

/// Node records are four lanes wide; the idle one of 3 + 1 in 2D is counted, because it is executed.
constexpr double lanes = 4;

/// Operations and particle data of a material law, beside position, velocity, affine rate, mass and volume ratio.
struct LawCost {
  double carried_2d, carried_3d;  ///< flops of the stress that a particle carries to the grid
  double update_2d, update_3d;    ///< flops of the law; Mohr-Coulomb yields on its shear plane, or at rest nowhere
  int stresses;                   ///< tensors kept: 0 or 1
  int strains, pores;             ///< accumulated strain, pore pressure: 0 or 1
  int deformations;               ///< deformation gradients: 0 or 1
};

//    carried  volume 2; fluid V p 5, viscous two a component; solid mean 5, four a component; pore 2
//    update   J 2; viscous: deviator 7 | 12 and its factor 5 | 7;
//             elastic: rotation 28 | 126, deviator 7 | 12, increment 12 | 16;
//             neo-Hookean: F 16 | 54, J 3 | 14, b 9 | 30, logarithm 20 and stress 16 | 20;
//             Mohr-Coulomb on top of elastic: 2D principal stresses and return 49, strain 10;
//             3D deviator and cone 37, axis 83, plane across it 34, return 45, sum 21, strain 15; pore 2;
//             at rest 2D principal stresses 22, strain 10; 3D deviator and cone 37, strain 15
LawCost cost_of(const WorkKind& kind) {
  switch (kind.material) {
    case BenchMaterial::water:
      return {7, 7, 2, 2, 0, 0, 0, 0};
    case BenchMaterial::viscous:
      return {13, 19, 14, 21, 1, 0, 0, 0};
    case BenchMaterial::elastic:
      return {19, 31, 49, 156, 1, 0, 0, 0};
    case BenchMaterial::rubber:
      return {19, 31, 64, 138, 1, 0, 0, 1};
    case BenchMaterial::soil:
      if (kind.at_rest) return {19, 31, 81, 208, 1, 1, 0, 0};
      return {19, 31, 108, 391, 1, 1, 0, 0};
    case BenchMaterial::undrained:
      return {21, 33, 110, 393, 1, 1, 1, 0};
  }
  return {};
}

/// Flops of the transfers of a basis that is a product over the axes.
struct ProductBasis {
  int support;   ///< nodes per axis
  double shape;  ///< operations of N and its slope along one axis
  bool graded = false;

  double weights(int d) const { return d * (7 + support + shape); }  // position, cell, reach 7; slopes over h

  /// Rows of nodes; a node: value 2, force 3, its sum 1, next value 1 (times the lanes).
  double scatter(int d) const {
    const double row = (d == 2 ? 2 : 4) * lanes + (d == 2 ? lanes : 3 * lanes + 3) + 3 * lanes;
    const double rows = d == 2 ? support : support * support;
    return rows * (row + support * (graded ? 8 : 7) * lanes);  // graded: next value is a product and a sum
  }

  /// Each sum of records is two operations a lane.
  double gather(int d, bool blend) const {
    const double change = blend ? 1 : 0;
    const double node = 2 * lanes * (2 + change);
    const double row = 2 * lanes * (3 + change);
    const double plane = 2 * lanes * (3 + change) + (d == 3 ? 2 * lanes : 0);
    const double planes = d == 2 ? 1 : support;
    return planes * (support * (row + support * node) + plane);
  }
};

/// Flops of the transfers, by basis.
struct TransferCost {
  double weights, scatter, gather;
};

TransferCost product_cost(const ProductBasis& basis, int d, bool blend) {
  return {basis.weights(d), basis.scatter(d), basis.gather(d, blend)};
}

/// d + 1 nodes; each: N 1; difference, scale, value 2, sum, next value; gathered value and gradient 2 each.
TransferCost simplex_cost(int d, bool blend) {
  const double nodes = d + 1;
  return {5.0 * d + nodes, nodes * 6 * lanes, nodes * (blend ? 6 : 4) * lanes};
}

/// Graded axes: span 4, weights and slopes 14, nodes 5.
TransferCost graded_cost(int d, bool blend) {
  const ProductBasis basis{3, 13, true};
  return product_cost(basis, d, blend);
}

TransferCost transfer_cost(Basis basis, int d, bool blend) {
  switch (basis) {
    case Basis::bspline2:
      return product_cost({3, 9}, d, blend);
    case Basis::gimp:
      return product_cost({3, 17}, d, blend);
    case Basis::linear:
      return product_cost({2, 1}, d, blend);
    case Basis::tri3:
    case Basis::tet4:
      return simplex_cost(d, blend);
  }
  return {};
}

/// What the average of the pressure adds: cell 3 an axis, volume, pressure and sums 10; nodes: weights twice more, the
/// gradient again, sums and means of two fields.
double pressure_flops(PressureSupport pressure, int d, const TransferCost& transfer) {
  if (pressure == PressureSupport::cell) return 3 * d + 10;
  if (pressure == PressureSupport::nodal) return 2 * transfer.weights + transfer.gather + 11 * (d + 1) + 15;
  return 0;
}

/// MUSL gives the new velocity back to the grid before the gradient is taken: weights twice more, the velocity
/// gathered, momentum 4 lanes a node.
double remap_flops(Basis basis, int d, const TransferCost& transfer) {
  const double nodes = is_simplex(basis) ? d + 1 : std::pow(basis == Basis::linear ? 2 : 3, d);
  return 2 * transfer.weights + transfer.gather + nodes * 4 * lanes;
}

double flops_of(const WorkKind& kind, const LawCost& law) {
  const int d = kind.dimension, acting = d == 2 ? 3 : 6;
  const bool blend = kind.transfer == Transfer::blend;
  const TransferCost transfer = kind.graded ? graded_cost(d, blend) : transfer_cost(kind.basis, d, blend);
  double flops = 2 * transfer.weights + transfer.scatter + transfer.gather;  // weights for scatter and for gather
  flops += d + d * (3 * lanes + d) + (blend ? 0 : acting);                   // make_record; stress times dt
  flops += d * (2 * lanes + 1 + 3 + (blend ? 5 : 0) + 4);                    // store_sums, move_chunk, finish_chunk
  flops += (d == 2 ? law.carried_2d : law.carried_3d) + (d == 2 ? law.update_2d : law.update_3d);
  if (kind.transfer == Transfer::musl) flops += remap_flops(kind.basis, d, transfer);
  return flops + pressure_flops(kind.pressure, d, transfer);
}

/// Doubles of a particle that the stages read and write in a step.
double doubles_moved(const WorkKind& kind, const LawCost& law) {
  constexpr double steps_per_sort = 16;
  const int d = kind.dimension, components = d == 2 ? 4 : 6;
  const double stress = law.stresses * components, deformation = law.deformations * d * d;
  // Scatter reads position, velocity, affine rate, mass, J, stress; in 2D ZZ is read for the mean only.
  const double scatter = 2 * d + d * d + 2 + stress + law.pores;
  // Gather renews position, J, stress, strain, pore pressure, F; writes velocity and affine rate. Viscous and
  // neo-Hookean stress is written only, but counted as renewed: less than 5 %.
  const double velocity = kind.transfer == Transfer::blend ? 2 : 1;
  const double gather = 2 * d + velocity * d + d * d + 2 + 2 * (stress + law.strains + law.pores + deformation);
  const double volume_and_pressure = d + 2 + 3 * law.stresses + law.pores;
  const double average = kind.pressure == PressureSupport::cell    ? volume_and_pressure
                         : kind.pressure == PressureSupport::nodal ? volume_and_pressure + d + 2
                                                                   : 0;
  // Positions twice, velocity and affine rate written and read, mass.
  const double remap = kind.transfer == Transfer::musl ? 2 * d + 2 * (d + d * d) + 1 : 0;
  const double kept = 2 * d + d * d + 2 + stress + law.strains + law.pores + deformation;
  return scatter + gather + average + remap + 2 * kept / steps_per_sort;
}

/// Bytes per node: record cleared 1, scattered 2, updated 2, gathered 1; blend has force 5 and change 2 more; cells and
/// nodal averages 14 or 15 numbers.
double node_bytes(const WorkKind& kind) {
  constexpr double record = lanes * sizeof(double);
  const double records = 6 + (kind.transfer == Transfer::blend ? 7 : 0);
  const double numbers = kind.pressure == PressureSupport::cell ? 14 : kind.pressure == PressureSupport::nodal ? 15 : 0;
  return records * record + numbers * sizeof(double);
}

}  // namespace

WorkCount work_of(const WorkKind& kind) {
  const double particles_per_node = kind.dimension == 2 ? 4 : 8;
  const LawCost law = cost_of(kind);
  return {flops_of(kind, law), sizeof(double) * doubles_moved(kind, law) + node_bytes(kind) / particles_per_node};
}

}  // namespace geodrop
