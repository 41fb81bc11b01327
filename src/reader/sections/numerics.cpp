// The scheme, the course of a run in time, and its output.
#include "sections.hpp"

#include "measure/particle_columns.hpp"

namespace geodrop {
namespace {

constexpr Range courant_range{"> 0 and <= 1", [](double x) { return x > 0 && x <= 1; }};

/// Keys look at their words, which have to stay.
const std::string& about_fields() {
  static const std::string about = [] {
    std::string text =
        "what the VTU files tell of particles beside body, material, layer and number; empty: all that is known. Of ";
    const std::vector<std::string> columns = particle_columns();
    for (const std::string& name : columns) text += (&name == &columns.front() ? "" : ", ") + name;
    return text;
  }();
  return about;
}

}  // namespace

// clang-format off
SectionOf<SolverSpec> solver_section() {
  constexpr RowsOf<SolverSpec> key;
  return {
      "[solver]", "",
      "The scheme.",
      R"([solver]
transfer = "blend"
blend_rate = 10.0
courant = 0.3  # water splashes)", {
      key("transfer", &SolverSpec::transfer, {{"tpic", Transfer::tpic}, {"blend", Transfer::blend}, {"musl", Transfer::musl}}, required, "tpic: particle velocity and its gradient from the grid; blend: tpic that keeps part of the particle's own velocity; musl: like blend without the gradient, strains from the particles' new velocity (the only one on tri3, tet4). For soil, quasi-static loading and water at rest tpic; for dumping, waves and vortices blend (docs/verification.md)"),
      key("blend_rate", &SolverSpec::blend_rate, "1/s", required, not_negative, "lambda; particles keep exp(-lambda dt) of their own velocity each step; 0: all of it (FLIP)").only("transfer=blend|musl"),
      key("mass_matrix", &SolverSpec::mass_matrix, {{"lumped", MassMatrix::lumped}, {"consistent", MassMatrix::consistent}, {"consistent_at_membranes", MassMatrix::consistent_at_membranes}}, standard("\"lumped\""), "lumped: nodes move by their own mass; consistent: corrected for lumping, which lowers the frequency of waves by about (k h)^2 / 8 (bspline2 and linear only; not with sharp membranes); consistent_at_membranes: corrected for lumping beside sharp membranes, where lumping makes what moves in a fluid too heavy (docs/step.md, join_interfaces)"),
      key("courant", &SolverSpec::courant, "", standard("0.5"), courant_range, "C in dt = C h / (c + v); bspline2 is stable up to 0.577 whatever the particles do (docs/step.md)").in(2),
      key("courant", &SolverSpec::courant, "", standard("0.45"), courant_range, "C in dt = C h / (c + v); bspline2 is stable up to 0.471 whatever the particles do (docs/step.md)").in(3),
      key("weight", &SolverSpec::weight, {{"particle", Weight::particle}, {"cell", Weight::cell}}, standard("\"particle\""), "where all cells around a node are filled: the weight of the particles there, or of the volume of these cells. Pressure acts from cells, so that clumps of particles are heavier than the pressure carries and sink: water with particles at random that stands for more than about 10 s stays still by \"cell\" (docs/step.md). All bodies then have pressure = \"cell\"; beside sharp membranes and the surface it remains that of particles; where a fluid touches rigid bodies it is always that of the room"),
      key("even_out_volumes", &SolverSpec::even_out_volumes, standard("false"), "J of the particles of fluids moves towards the mean of their cell, at a tenth of the wave speed; in scenes with sharp membranes, or where fluids touch rigid bodies, always. For water that flows through soil by more than a cell: without it particles carry pressures from cell to cell as noise").in(2),
      key("damping_rate", &SolverSpec::damping_rate, "1/s", standard("0.0"), not_negative, "mass-proportional damping of particle velocity"),
  }};
}

SectionOf<RelaxationSpec> relaxation_section() {
  constexpr RowsOf<RelaxationSpec> key;
  return {
      "[relaxation]", "",
      "Dynamic relaxation to a state at rest; both ratios have to hold over three cycles of kinetic damping in a "
      "row.",
      R"([relaxation]
damping = "kinetic"
kinetic_ratio = 0.01
out_of_balance_ratio = 0.02)", {
      key("damping", &RelaxationSpec::damping, {{"none", RelaxationSpec::Damping::none}, {"kinetic", RelaxationSpec::Damping::kinetic}}, required, "kinetic: all velocities are set to zero at each peak of the kinetic energy, and the run ends once both ratios are met"),
      key("kinetic_ratio", &RelaxationSpec::kinetic_ratio, "", required, positive, "kinetic energy over the work done by gravity, or against it, to be reached").only("damping=kinetic"),
      key("out_of_balance_ratio", &RelaxationSpec::out_of_balance_ratio, "", required, positive, "norm of the forces out of balance over that of the weight, to be reached").only("damping=kinetic"),
  }};
}

SectionOf<TimeSpec> time_section() {
  constexpr RowsOf<TimeSpec> key;
  return {
      "[time]", "",
      "How long to run.",
      R"([time]
end = 4.0)", {
      key("end", &TimeSpec::end, "s", required, positive, "simulated time; the run ends with the first step that reaches it, up to one step later (no step is shortened)"),
  }};
}

SectionOf<Scene> output_section() {
  constexpr RowsOf<Scene> key;
  return {
      "[output]", "",
      "What is written, how often.",
      R"([output]
frame_interval = 0.1
history_interval = 0.01
fields = ["velocity", "stress"])", {
      key("frame_interval", [](Scene& scene, double interval) { scene.output.frame_interval = interval; }, "s", required, positive, "time between pictures (VTU frames), at least 1e-9 of time.end; one is written at the first step at or after each multiple"),
      key("history_interval", [](Scene& scene, double interval) { scene.output.history_interval = interval; }, "s", required, positive, "time between rows of history.csv, likewise"),
      key("compress", [](Scene& scene, bool compress) { scene.output.compress = compress; }, standard("true"), "compress the files of frames (LZ4): 0.4 to 0.7 of the bytes"),
      key("fields", [](Scene& scene, const std::vector<std::string>& fields) { scene.output.fields = fields; }, standard("[]"), free_text, about_fields()),
      key("checkpoint_interval", [](Scene& scene, double interval) { scene.checkpoints.interval = interval; }, "s", standard("300.0"), not_negative, "wall time between checkpoints, from which a run that was killed goes on; 0: none by wall time. The last two are kept"),
      key("checkpoint_every", [](Scene& scene, double interval) { scene.checkpoints.every = interval; }, "s", standard("0.0"), not_negative, "simulated time between checkpoints, besides those by wall time; 0: none"),
  }};
}

SectionOf<StageSpec> stages_section() {
  constexpr RowsOf<StageSpec> key;
  return {
      "[[stages]]", "name",
      "Parts of a run in time order; each lasts until the next one begins, the last until time.end. A body that a "
      "stage `places` is not there before.",
      R"([[stages]]
name = "settle"
from = 0.0
damping_rate = 8.0

[[stages]]
name = "drop"
from = 0.5
places = ["bag"])", {
      key("name", &StageSpec::name, required, identifier, "what happens in it"),
      key("from", &StageSpec::from, "s", required, not_negative, "when it begins; the first one at 0"),
      key("damping_rate", &StageSpec::damping_rate, "1/s", standard("0.0"), not_negative, "mass-proportional damping of velocity in this stage; never damp an impact"),
      key("damping_ramp", &StageSpec::damping_ramp, "s", standard("0.0"), not_negative, "time over which the damping rises to that"),
      key("places", &StageSpec::places, standard("[]"), reference, "bodies that come in, with their membranes"),
      key("moves", &StageSpec::moves, standard("[]"), reference, "rigid bodies whose motion goes on in this stage; all others stand still"),
      key("removes", &StageSpec::removes, standard("[]"), reference, "rigid bodies that are taken away"),
  }};
}
// clang-format on

}  // namespace geodrop
