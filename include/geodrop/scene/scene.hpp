// The scene: plain values in SI units, as the user wrote them and as `check_scene` accepted them.
// Nobody writes to it after it was read. Vectors have as many entries as the scene has dimensions.
// `==` compares every value, the positions in the file included.
#pragma once

#include <geodrop/geometry/shape.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/bodies.hpp>
#include <geodrop/scene/contacts.hpp>
#include <geodrop/scene/initial.hpp>
#include <geodrop/scene/loads.hpp>
#include <geodrop/scene/measurements.hpp>
#include <geodrop/scene/numerics.hpp>

#include <string>
#include <vector>

namespace geodrop {

struct ProbeSpec;

struct Scene {
  // In measure/probes, beside the list of probes, which few files know.
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();
  bool operator==(const Scene&) const;

  std::string file;  ///< path that it was read from
  std::string title;
  std::string question;    ///< what this case asks
  std::string start_from;  ///< directory of a run whose end bodies and membranes start from; empty: none
  int dimension = 2;
  GridSpec grid;
  WallsSpec walls;
  Point gravity;  ///< [m/s2]
  SolverSpec solver;
  RelaxationSpec relaxation;
  TimeSpec time;
  std::vector<StageSpec> stages;
  OutputSpec output;
  std::vector<MaterialSpec> materials;
  std::vector<BodySpec> bodies;
  std::vector<MembraneSpec> membranes;
  std::vector<RigidSpec> rigid;
  std::vector<ContactSpec> contacts;
  std::vector<StillFluidSpec> still_fluids;
  std::vector<AnchorSpec> anchors;
  std::vector<ViscousBoundarySpec> viscous_boundaries;
  std::vector<SilentSideSpec> silent_sides;
  std::vector<PumpSpec> pumps;
  std::vector<ExactSpec> exact;
  std::vector<ProbeSpec> probes;
  std::vector<ResultSpec> results;
  std::vector<ExpectSpec> expect;
  std::vector<VerifySpec> verify;
  std::vector<VariantSpec> variants;
  std::string as_run;  ///< the scene as TOML with overrides applied and all defaults filled in
  CheckpointSpec checkpoints;
  std::vector<std::string> notes;  ///< of the reader: former words that the file still has
};

/// Null if the scene has none of this name.
const MaterialSpec* find_material(const Scene& scene, const std::string& name);
const BodySpec* find_body(const Scene& scene, const std::string& name);
/// The exact solution that a body follows; null if it follows none.
const ExactSpec* find_exact(const Scene& scene, const std::string& body);

bool has_sharp_interface(const Scene& scene);

/// What the two names of a contact stand for.
struct ContactPair {
  enum class Kind { none, membrane_on_rigid, body_on_rigid, membranes } kind = Kind::none;
  std::string touching;  ///< the membrane or the body
  std::string other;     ///< what it touches; of own folds the same membrane
};
/// Kind::none if the two cannot touch, or one of them is not there.
ContactPair contact_pair(const Scene& scene, const ContactSpec& contact);

}  // namespace geodrop
