#include <geodrop/setup/setup.hpp>

#include <algorithm>

namespace geodrop {

template <int Dim>
bool is_over(const Scene& scene, const State<Dim>& state) {
  const bool pumping =
      std::any_of(scene.pumps.begin(), scene.pumps.end(), [&](const PumpSpec& pump) { return state.t < pump.to; });
  const bool staged = state.stages_entered < scene.stages.size();
  return state.t >= scene.time.end || (state.relaxation.cycles_at_rest >= cycles_to_rest && !pumping && !staged);
}

template bool is_over<2>(const Scene&, const State<2>&);
template bool is_over<3>(const Scene&, const State<3>&);

}  // namespace geodrop
