// What depends on the list of probes.
#include "probes.hpp"

#include <algorithm>

#include "scene/needs.hpp"

namespace geodrop {

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;
bool Scene::operator==(const Scene&) const = default;

bool any_tracer(const Scene& scene) {
  return std::any_of(scene.probes.begin(), scene.probes.end(),
                     [](const ProbeSpec& p) { return std::holds_alternative<TracerSpec>(p.probe); });
}

}  // namespace geodrop
