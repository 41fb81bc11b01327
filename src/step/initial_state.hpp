// The state that a run begins with: as the scene draws it, or as another run left it.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// build_state, with bodies and membranes of the newest checkpoint of the run in `start_from`. Throws SceneError if
/// there is none, if that file is damaged (the one before is another state: it is named, not taken), or it is not one
/// of that run's scene.
template <int Dim>
State<Dim> initial_state(const Scene& scene);

}  // namespace geodrop
