#include "work_counts.hpp"

namespace geodrop {
namespace {

/// A tensor-product basis: nodes per axis, operations for the weights of one axis, and whether C takes moments of the
/// velocity (APIC) or its gradient (TPIC).
struct BasisCost {
  int support;
  double weights_per_axis;
  bool moments;
};

//                      position, cell, reach 7; slopes over h, one a node; the shape functions themselves
BasisCost cost_of(Basis basis) {
  switch (basis) {
    case Basis::bspline2:
      return {3, 7 + 3 + 9, true};
    case Basis::gimp:
      return {3, 7 + 3 + 17, false};
    case Basis::linear:
      return {2, 7 + 2 + 1, false};
  }
  return {};
}

/// Operations and particle data of a material law, beside position, velocity, affine rate, mass and volume ratio.
struct LawCost {
  double carried_2d, carried_3d;  ///< flops of the stress that a particle carries to the grid
  double update_2d, update_3d;    ///< flops of the law; Mohr-Coulomb yields on its shear plane
  int tensors;                    ///< stresses kept [-]
  int scalars;                    ///< accumulated strain, pore pressure
};

//                      carried: volume 2; fluid V p 5, viscous two a component; solid mean 5, four a component; pore 2
//                      update:  J 2; viscous: deviator 7 | 12 and its factor 5 | 7; rotation 28 | 126, deviator 7 | 12,
//                      elastic increment 12 | 16;
//                               Mohr-Coulomb 2D principal stresses and return 75, strain 10;
//                               3D eigenvector 80, reflections 119, return 71, sum 6, strain 15; pore 2
LawCost cost_of(BenchMaterial material) {
  switch (material) {
    case BenchMaterial::water:
      return {7, 7, 2, 2, 0, 0};
    case BenchMaterial::viscous:
      return {13, 19, 14, 21, 1, 0};
    case BenchMaterial::elastic:
      return {19, 31, 49, 156, 1, 0};
    case BenchMaterial::soil:
      return {19, 31, 134, 447, 1, 1};
    case BenchMaterial::undrained:
      return {21, 33, 136, 449, 1, 2};
  }
  return {};
}

/// Node records are four lanes wide; the idle one of 3 + 1 in 2D is counted, because it is executed.
constexpr double lanes = 4;

/// make_record, then add_row for each row of nodes.
double scatter_flops(int d, double support, double acting) {
  const double record = d + d * (3 * lanes + d);
  const double row = (d == 2 ? 2 : 4) * lanes + (d == 2 ? lanes : 3 * lanes + 3) + 3 * lanes;
  const double node = 7 * lanes;  // value 2, force 3, its sum 1, next value 1
  const double rows = d == 2 ? support : support * support;
  return record + rows * (row + support * node) + acting;  // acting: times dt
}

/// gather_sums by rows and planes, store_sums, move_chunk, finish_chunk. Each sum of records is two operations a lane.
double gather_flops(int d, const BasisCost& basis, bool blend) {
  const double moments = basis.moments ? 1 : 0, change = blend ? 1 : 0;
  const double node = 2 * lanes * (2 + moments + change);
  const double row = 2 * lanes * (3 + 2 * moments + change) + 3 * moments;
  const double plane = 2 * lanes * (3 + 2 * moments + change) + (d == 3 ? 2 * lanes * (1 + moments) + 3 * moments : 0);
  const double planes = d == 2 ? 1 : basis.support;
  const double per_axis = 2 * lanes + 1 + 3 + 5 * change + 4;
  return 3 * moments * basis.support + planes * (basis.support * (row + basis.support * node) + plane) + d * per_axis;
}

/// Doubles of a particle that stages read and write; stress components that act on the grid.
struct Traffic {
  double scatter, gather, cells, kept;
};
Traffic doubles_moved(const WorkKind& kind, const LawCost& law) {
  const int d = kind.dimension, components = d == 2 ? 4 : 6;
  const double stress = law.tensors * components, acting = law.tensors * (d == 2 ? 3 : 6);
  const double solid_mean = law.tensors * (d == 2 ? 1 : 0);  // ZZ, for the mean only
  Traffic t;
  t.scatter = 2 * d + d * d + 2 + acting + solid_mean + (law.scalars > 1 ? 1 : 0);
  t.gather = 2 * d + (kind.blend ? 2 : 1) * d + d * d + 2 + 2 * stress + 2 * law.scalars;
  t.cells = kind.cell_pressure ? d + 2 + 3 * law.tensors + (law.scalars > 1 ? 1 : 0) : 0;
  t.kept = 2 * d + d * d + 2 + stress + law.scalars;
  return t;
}

/// Bytes per node: cleared, scattered to and from, updated, gathered; blend has two records more, cells 6 numbers.
double node_bytes(const WorkKind& kind) {
  constexpr double record = lanes * sizeof(double);
  const double records = 1 + 2 + 2 + 1 + (kind.blend ? 1 + 2 + 1 + 1 + 1 : 0);
  const double cell_numbers = kind.cell_pressure ? 2 + 4 + 5 + 1 + 2 : 0;
  return records * record + cell_numbers * sizeof(double);
}

}  // namespace

WorkCount work_of(const WorkKind& kind) {
  constexpr double steps_per_sort = 16;
  const int d = kind.dimension;
  const double particles_per_node = d == 2 ? 4 : 8;
  const BasisCost basis = cost_of(kind.basis);
  const LawCost law = cost_of(kind.material);
  WorkCount work;
  work.flops = 2 * d * basis.weights_per_axis;  // for the scatter and again for the gather
  work.flops += (d == 2 ? law.carried_2d : law.carried_3d) + (d == 2 ? law.update_2d : law.update_3d);
  work.flops += scatter_flops(d, basis.support, kind.blend ? 0 : (d == 2 ? 3 : 6));
  work.flops += gather_flops(d, basis, kind.blend);
  if (kind.cell_pressure) work.flops += 3 * d + 10;  // cell 3 an axis; volume, pressure, sums

  const Traffic doubles = doubles_moved(kind, law);
  work.bytes = sizeof(double) * (doubles.scatter + doubles.gather + doubles.cells);
  work.bytes += 2 * sizeof(double) * doubles.kept / steps_per_sort;
  work.bytes += node_bytes(kind) / particles_per_node;
  return work;
}

}  // namespace geodrop
