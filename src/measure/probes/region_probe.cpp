#include "region_probe.hpp"

#include "base/fixed_order_sum.hpp"

namespace geodrop {

RegionSums& RegionSums::operator+=(const RegionSums& other) {
  volume += other.volume;
  pressure += other.pressure;
  vertical_stress += other.vertical_stress;
  for (std::size_t a = 0; a < flow.size(); ++a) flow[a] += other.flow[a];
  return *this;
}

template <int Dim>
RegionSums region_sums(const Scene& scene, const RegionProbeSpec& probe, const State<Dim>& state) {
  RegionSums all;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    if (scene.bodies[b].material != probe.material) continue;
    const Body<Dim>& body = state.bodies[b];
    all += fixed_order_sum<RegionSums>(body.size(), [&](RegionSums& sums, std::size_t p) {
      for (int a = 0; a < Dim; ++a)
        if (body.x[a][p] < probe.lower[a] || body.x[a][p] >= probe.upper[a]) return;
      const double volume = body.volume(p);
      RegionSums one{volume, volume * mean_pressure(body, p), volume * total_stress(body, p)[vertical_axis<Dim>]};
      for (int a = 0; a < Dim; ++a) one.flow[a] = volume * body.v[a][p];
      sums += one;
    });
  }
  return all;
}

template RegionSums region_sums(const Scene&, const RegionProbeSpec&, const State<2>&);
template RegionSums region_sums(const Scene&, const RegionProbeSpec&, const State<3>&);

}  // namespace geodrop
