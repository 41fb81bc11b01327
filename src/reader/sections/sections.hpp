// The sections of a scene, a file for each subject: its tables with their rows.
#pragma once

#include <geodrop/scene/scene.hpp>

#include "keys/rows.hpp"

namespace geodrop {

struct ProbeSpec;

SectionOf<Scene> top_level();
SectionOf<RefineSpec> grid_refine_section();
SectionOf<GridSpec> grid_section();
SectionOf<WallsSpec> walls_section();
SectionOf<SolverSpec> solver_section();
SectionOf<RelaxationSpec> relaxation_section();
SectionOf<TimeSpec> time_section();
SectionOf<Scene> output_section();
SectionOf<StageSpec> stages_section();
SectionOf<MaterialSpec> materials_section();
SectionOf<Shape> shape_section();
SectionOf<BodySpec> bodies_section();
SectionOf<InitialVelocity> initial_velocity_section();
SectionOf<InitialStress> initial_stress_section();
SectionOf<ExactSpec> exact_section();
SectionOf<SurfaceSpec> surface_section();
SectionOf<MembraneSpec> membranes_section();
SectionOf<RigidShape> rigid_shape_section();
SectionOf<RigidMotion> rigid_motion_section();
SectionOf<RigidSpec> rigid_section();
SectionOf<ContactSpec> contacts_section();
SectionOf<StillFluidSpec> still_fluids_section();
SectionOf<AnchorSpec> anchors_section();
SectionOf<ViscousBoundarySpec> viscous_boundaries_section();
SectionOf<SilentSideSpec> absorbing_layers_section();
SectionOf<PumpSpec> pumps_section();
SectionOf<ProbeSpec> probes_section();
SectionOf<ResultSpec> results_section();
SectionOf<ExpectSpec> expect_section();
SectionOf<VerifySpec> verify_section();
SectionOf<VariantSpec> variants_section();

}  // namespace geodrop
