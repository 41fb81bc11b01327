#include "key_table.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace geodrop {
namespace {

using enum Kind;

constexpr Need required{Need::How::required};
constexpr Need standard(std::string_view toml) { return {Need::How::standard, toml}; }
constexpr Need instead_of(std::string_view other) { return {Need::How::instead_of, other}; }

constexpr Range any{"any finite number", [](double) { return true; }};
constexpr Range positive{"> 0", [](double x) { return x > 0; }};
constexpr Range not_negative{">= 0", [](double x) { return x >= 0; }};
constexpr Range not_zero{"not 0", [](double x) { return x != 0; }};
constexpr Range fraction{"> 0 and < 1", [](double x) { return x > 0 && x < 1; }};
constexpr Range half{">= 0 and <= 0.5", [](double x) { return x >= 0 && x <= 0.5; }};
constexpr Range poisson{"> -1 and < 0.5", [](double x) { return x > -1 && x < 0.5; }};
constexpr Range angle{">= 0 and < 90", [](double x) { return x >= 0 && x < 90; }};
constexpr Range courant_range{"> 0 and <= 1", [](double x) { return x > 0 && x <= 1; }};
constexpr Range percent{">= 0 and <= 100", [](double x) { return x >= 0 && x <= 100; }};
constexpr Range share{">= 0 and <= 1", [](double x) { return x >= 0 && x <= 1; }};
constexpr Range two_or_three{"2 or 3", [](double x) { return x == 2 || x == 3; }};
constexpr Range per_axis{"1 to 8", [](double x) { return x >= 1 && x <= 8; }};
constexpr Range bands{"1 to 255", [](double x) { return x >= 1 && x <= 255; }};
constexpr Range window{"0 to 64", [](double x) { return x >= 0 && x <= 64; }};
constexpr Range penalty_range{"> 0 and <= 4 (stiffer contacts gain energy)", [](double x) { return x > 0 && x <= 4; }};
constexpr Range dense{"from 2 (fluid leaks between nodes that are farther apart) to 64",
                      [](double x) { return x >= 2 && x <= 64; }};
constexpr Range end_range{"> 0; inf is the end of the run", [](double x) { return x > 0; }, true};
constexpr Range depth_range{"> 0; inf: no spring", [](double x) { return x > 0; }, true};
constexpr Range suction_range{">= 0; inf: any tension", [](double x) { return x >= 0; }, true};
constexpr Range rest_range{"> 0; inf: never", [](double x) { return x > 0; }, true};
constexpr Range beyond_range{"> 0; inf: it stands still", [](double x) { return x > 0; }, true};
constexpr Range slack_range{"> -1", [](double x) { return x > -1; }};
constexpr Range filled{"not empty", [](double length) { return length > 0; }};
constexpr Range free_text{"any text", [](double) { return true; }};
constexpr Range growth_range{"> 1 and <= 1.5", [](double x) { return x > 1 && x <= 1.5; }};
constexpr Range some{"at least one", [](double length) { return length > 0; }};
constexpr Range maybe_none{"may be empty", [](double) { return true; }};
constexpr Range one_table{"a table", [](double) { return true; }};
constexpr Range identifier{"letters, digits and '_', beginning with a letter", nullptr};
constexpr Range reference{"the name of one in the scene", nullptr};
constexpr Range yes_no{"true or false", nullptr};
constexpr Range words(std::string_view choices) { return {choices}; }
constexpr Range wall_kinds = words("slip|no_slip|periodic");
constexpr Range axes_2d = words("x|y"), axes_3d = words("x|y|z");

constexpr Section sections[] = {
    {"", "Top level", "", "What the scene is about, and its tables."},
    {"grid", "[grid]", "", "The domain and its cells. Walls stand on the domain's edges, which are grid lines."},
    {"grid.refine", "[[grid.refine]]", "axis",
     "Finer cells along an axis, at most one zone each, with basis = \"bspline2\" only. Outside of the zone cells grow "
     "by `growth` from one to the next until they are `spacing` of the grid wide; all are scaled down a little, so "
     "that a whole number of them fits. Where they stand then is no concern of bodies: cells that an outline cuts get "
     "particles of their share. The time step is that of the finest cell, and membranes have nodes that suit it."},
    {"walls", "[walls]", "",
     "How the four sides of the domain (3D: six) hold what touches them. The last axis is the vertical one, so bottom "
     "and top are the ends of y in 2D and of z in 3D. Walls never let go: no_slip holds material in all directions, "
     "slip in the normal one, also where it would pull away (there is no separation). Of two opposite walls both or "
     "neither are periodic: what leaves on one side comes in at the other. Such an axis has at least 5 cells, and the "
     "scene no membranes. Between two sorts particles may be up to a cell beyond a periodic wall; positions of tracers "
     "run on across it."},
    {"solver", "[solver]", "", "The scheme."},
    {"time", "[time]", "", "How long to run."},
    {"output", "[output]", "", "What is written, how often."},
    {"materials", "[materials.NAME]", "", "One table for each material; NAME is what bodies refer to."},
    {"bodies", "[[bodies]]", "name", "One table for each body: a shape filled with particles of one material."},
    {"bodies.shape", "shape of a body", "", "An inline table; `type` says which keys it has."},
    {"bodies.initial_velocity", "initial_velocity of a body", "", "An inline table; `type` says which keys it has."},
    {"bodies.initial_stress", "initial_stress of a body", "", "An inline table; `type` says which keys it has."},
    {"membranes", "[[membranes]]", "name",
     "Tension-only geotextiles on the outline of a body; in two dimensions only. Without stiffness and mass a membrane "
     "is "
     "a skin, which marks the outline that contacts act on."},
    {"relaxation", "[relaxation]", "",
     "Dynamic relaxation to a state at rest; both ratios have to hold over three cycles of kinetic damping in a row."},
    {"rigid", "[[rigid]]", "name", "Rigid ground, walls and hulls; only what `contacts` names notices them."},
    {"rigid.shape", "shape of a rigid body", "",
     "An inline table; `type` says which keys it has. What comes beside the segment of a capsule stays on the side on "
     "which it came, down to twice the radius deep."},
    {"rigid.motion", "motion of a rigid body", "", "An inline table; `type` says which keys it has."},
    {"contacts", "[[contacts]]", "",
     "Surface contact of a membrane's nodes, or of the particles of a body without membrane, with a rigid body, and of "
     "membranes with each other or their own folds: penalty normal to the surface, Coulomb friction along it."},
    {"still_fluids", "[[still_fluids]]", "membrane",
     "Still water in a basin so large that a tube does not move it: its pressure, gamma times depth, acts on a closed "
     "membrane from outside, also where that lies on the ground. A body of water that moves is one of `bodies`."},
    {"stages", "[[stages]]", "name",
     "Parts of a run in time order; each lasts until the next one begins, the last until time.end. A body that a stage "
     "`places` is not there before."},
    {"viscous_boundaries", "[[viscous_boundaries]]", "name",
     "Edges of the ground that let waves out (Lysmer & Kuhlemeyer 1969): dashpots of rho c_p along the normal, rho c_s "
     "across it, and along the normal a spring that keeps the edge in place. They take up the stress of the start, so "
     "that ground at rest stays at rest. The edge is free otherwise: there are at least 4 cells of empty grid beyond "
     "it. Waves that meet it at right angles leave, oblique ones in part."},
    {"silent_sides", "[[silent_sides]]", "name",
     "Sides of the domain through which waves in water at rest leave: in a layer beside the wall pressure fades to "
     "that "
     "of the still fluid, and the velocity across to that of the water beyond, both at the same rate, so that waves "
     "meet no change of impedance. Water that comes or goes is mass of the particles there. Levels and slow flows: "
     "`water_beyond`."},
    {"pumps", "[[pumps]]", "body",
     "Pumps: each particle of a body of newtonian material gains mass at the same relative rate."},
    {"exact", "[[exact]]", "body",
     "Exact solutions that bodies follow; the formulas stand in include/geodrop/exact.hpp. `axis_aligned_mms`, "
     "`generalized_vortex` and `oscillating_drop` come with the body force that they need."},
    {"probes", "[[probes]]", "name", "What is measured beside the standard columns of history.csv."},
    {"results", "[[results]]", "name", "Numbers that a run ends with: a column of history.csv reduced to one value."},
    {"expect", "[[expect]]", "result", "What a result should be, and says who; a run prints both side by side."},
    {"verify", "[[verify]]", "result",
     "What `geodrop verify` judges the scene by: a result beside its reference. The error is |value - expected| over "
     "`scale`."},
    {"variants", "[[variants]]", "",
     "The runs that `geodrop verify` makes of the scene, from coarse to fine; none: one, of the scene as it stands. "
     "The last one that is no control has to meet the targets."},
};

// Columns: section, key, kind, unit, condition, need, allowed, meaning, and the dimension that a row is for if it is
// for one only. A key that decides about others (type, model, drainage) stands before them.
// clang-format off
constexpr Key keys[] = {
    {"", "title", text, "", "", required, filled, "what the scene shows, in a few words"},
    {"", "question", text, "", "", standard("\"\""), free_text, "what this case asks"},
    {"", "dimension", integer, "", "", standard("2"), two_or_three, "2: plane strain in x and y, per metre of depth; 3: space. The last axis is the vertical one"},
    {"", "gravity", point, "m/s2", "", required, any, "acceleration of gravity"},
    {"", "grid", table, "", "", required, one_table, "the domain and its cells"},
    {"", "walls", table, "", "", required, one_table, "the sides of the domain"},
    {"", "solver", table, "", "", required, one_table, "the scheme"},
    {"", "relaxation", table, "", "", standard("{ damping = \"none\" }"), one_table, "how the run comes to rest"},
    {"", "time", table, "", "", required, one_table, "how long to run"},
    {"", "output", table, "", "", required, one_table, "what is written"},
    {"", "materials", named_tables, "", "", required, some, "the materials by name"},
    {"", "bodies", table_list, "", "", required, some, "what fills the domain"},
    {"", "membranes", table_list, "", "", standard("[]"), maybe_none, "geotextiles", 2},
    {"", "rigid", table_list, "", "", standard("[]"), maybe_none, "rigid ground and walls", 2},
    {"", "contacts", table_list, "", "", standard("[]"), maybe_none, "what touches what", 2},
    {"", "still_fluids", table_list, "", "", standard("[]"), maybe_none, "still water around membranes", 2},
    {"", "stages", table_list, "", "", standard("[]"), maybe_none, "the parts of a run in time"},
    {"", "viscous_boundaries", table_list, "", "", standard("[]"), maybe_none, "edges of the ground that let waves out", 2},
    {"", "silent_sides", table_list, "", "", standard("[]"), maybe_none, "sides through which waves in water leave", 2},
    {"", "pumps", table_list, "", "", standard("[]"), maybe_none, "fluid that is pumped in"},
    {"", "exact", table_list, "", "", standard("[]"), maybe_none, "exact solutions that bodies follow"},
    {"", "probes", table_list, "", "", standard("[]"), maybe_none, "additional measurements"},
    {"", "results", table_list, "", "", standard("[]"), maybe_none, "numbers that the run ends with"},
    {"", "expect", table_list, "", "", standard("[]"), maybe_none, "what the results should be"},
    {"", "verify", table_list, "", "", standard("[]"), maybe_none, "targets of `geodrop verify`"},
    {"", "variants", table_list, "", "", standard("[]"), maybe_none, "runs of `geodrop verify`"},

    {"grid", "lower", point, "m", "", required, any, "lower corner of the domain"},
    {"grid", "upper", point, "m", "", required, any, "upper corner of the domain"},
    {"grid", "spacing", real, "m", "", required, positive, "cell size h; it divides the domain (along axes that are not refined)"},
    {"grid", "basis", choice, "", "", standard("\"bspline2\""), words("bspline2|gimp|linear|tri3|tet4"), "shape functions: quadratic B-splines; hat functions averaged over the particles' domains (uGIMP); hat functions; cells split into linear triangles (2D) or tetrahedra (3D)"},
    {"grid", "refine", table_list, "", "", standard("[]"), maybe_none, "zones of finer cells"},

    {"grid.refine", "axis", choice, "", "", required, axes_2d, "along which cells are finer", 2},
    {"grid.refine", "axis", choice, "", "", required, axes_3d, "along which cells are finer", 3},
    {"grid.refine", "from", real, "m", "", required, any, "where the zone begins"},
    {"grid.refine", "to", real, "m", "", required, any, "where it ends"},
    {"grid.refine", "spacing", real, "m", "", required, positive, "width of the cells in the zone, below that of the grid"},
    {"grid.refine", "growth", real, "", "", standard("1.1"), growth_range, "width of a cell over that of the next finer one, outside of the zone"},

    {"walls", "left", choice, "", "", required, wall_kinds, "wall at the lower x; never lets go"},
    {"walls", "right", choice, "", "", required, wall_kinds, "wall at the upper x; never lets go"},
    {"walls", "front", choice, "", "", required, wall_kinds, "wall at the lower y; never lets go", 3},
    {"walls", "back", choice, "", "", required, wall_kinds, "wall at the upper y; never lets go", 3},
    {"walls", "bottom", choice, "", "", required, wall_kinds, "wall at the lower y (3D: z); never lets go"},
    {"walls", "top", choice, "", "", required, wall_kinds, "wall at the upper y (3D: z); never lets go"},

    {"solver", "transfer", choice, "", "", required, words("tpic|blend|musl"), "tpic: particle velocity and its gradient from the grid; blend: tpic that keeps part of the particle's own velocity; musl: like blend without the gradient, strains from the particles' new velocity (the only one on tri3, tet4). For soil, quasi-static loading and water at rest tpic; for dumping, waves and vortices blend (docs/verification.md)"},
    {"solver", "blend_rate", real, "1/s", "transfer=blend|musl", required, not_negative, "lambda; particles keep exp(-lambda dt) of their own velocity each step; 0: all of it (FLIP)"},
    {"solver", "mass_matrix", choice, "", "", standard("\"lumped\""), words("lumped|consistent"), "lumped: nodes move by their own mass; consistent: corrected for lumping, which lowers the frequency of waves by about (k h)^2 / 8 (bspline2 and linear only)"},
    {"solver", "courant", real, "", "", standard("0.5"), courant_range, "C in dt = C h / (c + v); 0.3 where water splashes or falls on walls (docs/verification.md)"},
    {"solver", "damping_rate", real, "1/s", "", standard("0.0"), not_negative, "mass-proportional damping of particle velocity"},

    {"relaxation", "damping", choice, "", "", required, words("none|kinetic"), "kinetic: all velocities are set to zero at each peak of the kinetic energy, and the run ends once both ratios are met"},
    {"relaxation", "kinetic_ratio", real, "", "damping=kinetic", required, positive, "kinetic energy over the work done by gravity, or against it, to be reached"},
    {"relaxation", "out_of_balance_ratio", real, "", "damping=kinetic", required, positive, "norm of the forces out of balance over that of the weight, to be reached"},

    {"time", "end", real, "s", "", required, positive, "simulated time; the run ends with the first step that reaches it, up to one step later (no step is shortened)"},

    {"output", "frame_interval", real, "s", "", required, positive, "time between pictures (VTU frames), at least 1e-9 of time.end; one is written at the first step at or after each multiple"},
    {"output", "history_interval", real, "s", "", required, positive, "time between rows of history.csv, likewise"},
    {"output", "compress", boolean, "", "", standard("false"), yes_no, "compress the VTU files"},
    {"output", "checkpoint_interval", real, "s", "", standard("300.0"), not_negative, "wall time between checkpoints, from which a run that was killed goes on; 0: none by wall time. The last two are kept"},
    {"output", "checkpoint_every", real, "s", "", standard("0.0"), not_negative, "simulated time between checkpoints, besides those by wall time; 0: none"},

    {"materials", "model", choice, "", "", required, words("newtonian|linear_elastic|mohr_coulomb|neo_hookean"), "constitutive law"},
    {"materials", "density", real, "kg/m3", "model=newtonian|linear_elastic|neo_hookean", required, positive, "of a fluid: at zero pressure; neo_hookean: unstrained"},
    {"materials", "density", real, "kg/m3", "model=mohr_coulomb", instead_of("grain_density"), positive, "of the mixture of grains and what fills the pores, at the start"},
    {"materials", "grain_density", real, "kg/m3", "model=mohr_coulomb", instead_of("density"), positive, "rho_s of the grains: the mixture has (1 - n) rho_s + n S rho_f"},
    {"materials", "bulk_modulus", real, "Pa", "model=newtonian", instead_of("sound_speed"), positive, "K in p = K (rho / rho0 - 1)"},
    {"materials", "sound_speed", real, "m/s", "model=newtonian", instead_of("bulk_modulus"), positive, "c, gives K = rho0 c^2; may be reduced where its error is known"},
    {"materials", "viscosity", real, "Pa s", "model=newtonian", required, not_negative, "dynamic viscosity"},
    {"materials", "mixing_length", real, "m", "model=newtonian", standard("0.0"), not_negative, "l of eddies that the grid does not resolve: they add rho l^2 sqrt(2 D:D) to the viscosity; 0: none. A length of the flow, not of the grid"},
    {"materials", "tension_cutoff", real, "Pa", "model=newtonian", standard("inf"), suction_range, "largest suction that the fluid bears, p >= -tension_cutoff: beyond it voids open, which close again without a loss of volume; inf: it is never torn. Not for bodies with pressure = \"enclosed\", a silent side, or beside a sharp interface"},
    {"materials", "youngs_modulus", real, "Pa", "model=linear_elastic|mohr_coulomb|neo_hookean", required, positive, "Young's modulus (of the skeleton; neo_hookean: at small strain)"},
    {"materials", "poissons_ratio", real, "", "model=linear_elastic|mohr_coulomb|neo_hookean", required, poisson, "Poisson's ratio (of the skeleton)"},
    {"materials", "cohesion", real, "Pa", "model=mohr_coulomb", required, not_negative, "c"},
    {"materials", "friction_angle_deg", real, "degree", "model=mohr_coulomb", required, angle, "phi"},
    {"materials", "dilatancy_angle_deg", real, "degree", "model=mohr_coulomb", required, angle, "psi, at most phi"},
    {"materials", "tension_cutoff", real, "Pa", "model=mohr_coulomb", required, not_negative, "largest principal effective stress, at most c cot(phi)"},
    {"materials", "void_memory", boolean, "", "model=mohr_coulomb", standard("false"), yes_no, "the volume by which the soil opens at the apex or the tension cut-off is kept, and closes again without stress; to be used where soil is torn apart and falls together again (any bag that falls and lands), or it grows; with dilatancy_angle_deg = 0 only"},
    {"materials", "drainage", choice, "", "model=mohr_coulomb", required, words("drained|undrained"), "undrained: pore water moves with the skeleton; drained: there is none, so that under water the pressure of the water is part of the effective stress (`geodrop check` names such bodies and says by how much)"},
    {"materials", "porosity", real, "", "drainage=undrained", required, fraction, "n"},
    {"materials", "porosity", real, "", "grain_density&drainage=drained", required, fraction, "n, for the density of the mixture"},
    {"materials", "saturation", real, "", "grain_density", required, share, "S, share of the pores that water fills (0: dry); the rest is gas"},
    {"materials", "saturation", real, "", "density&drainage=undrained", instead_of("fluid_bulk_modulus"), share, "S, share of the pores that water fills; the rest is gas. The density is as given"},
    {"materials", "fluid_density", real, "kg/m3", "grain_density", required, positive, "rho_f of the water in the pores"},
    {"materials", "fluid_bulk_modulus", real, "Pa", "density&drainage=undrained", instead_of("saturation"), positive, "K_f of the pore fluid; K_f / n is at least 20 times the bulk modulus of the skeleton"},
    {"materials", "water_bulk_modulus", real, "Pa", "saturation&drainage=undrained", required, positive, "K_w of the water in the pores: 1 / K_f = S / K_w + (1 - S) / gas_pressure (Verruijt 1969)"},
    {"materials", "gas_pressure", real, "Pa", "saturation&drainage=undrained", required, positive, "absolute pressure at which the gas has its share of the pores; K_f is that of small changes around it (isothermal, nothing dissolves) and stays"},

    {"bodies", "name", name, "", "", required, identifier, "heads the body's columns in history.csv"},
    {"bodies", "material", name, "", "", required, reference, "a name in materials"},
    {"bodies", "shape", table, "", "", required, one_table, "where the body is at the start"},
    {"bodies", "minus", names, "", "", standard("[]"), reference, "bodies whose shapes are cut out of this one"},
    {"bodies", "particles_per_cell_axis", integer, "", "", standard("2"), per_axis, "particles per cell along each axis"},
    {"bodies", "jitter", real, "", "", standard("0.0"), half, "random offset of the particles, as a fraction of their spacing"},
    {"bodies", "jitter_seed", integer, "", "", standard("0"), not_negative, "seed of the random offsets"},
    {"bodies", "initial_velocity", table, "", "", standard("{ type = \"rest\" }"), one_table, "velocity at the start"},
    {"bodies", "initial_stress", table, "", "", required, one_table, "stress at the start"},
    {"bodies", "pressure", choice, "", "", standard("\"cell\""), words("cell|particle|nodal|enclosed"), "where the mean stress acts from: the average of the cell (not on tri3, tet4), each particle, (only on tri3, tet4) the average at the nodes, or, for a fluid that fills a closed membrane (2D, bspline2), the average of cells that the membrane cuts exactly"},
    {"bodies", "layers", integer, "", "", standard("1"), bands, "horizontal bands that colour the picture"},
    {"bodies", "shift", boolean, "", "", standard("false"), yes_no, "move particles out of clumps and into voids (fluids only)"},
    {"bodies", "shift_speed", real, "m/s", "", standard("0.0"), not_negative, "v0, shifting of a particle at rest"},

    {"bodies.shape", "type", choice, "", "", required, words("box|ellipse|polygon|half_plane"), "which shape", 2},
    {"bodies.shape", "type", choice, "", "", required, words("box|ellipsoid|half_space"), "which shape", 3},
    {"bodies.shape", "lower", point, "m", "type=box", required, any, "lower corner"},
    {"bodies.shape", "upper", point, "m", "type=box", required, any, "upper corner"},
    {"bodies.shape", "centre", point, "m", "type=ellipse|ellipsoid", required, any, "centre"},
    {"bodies.shape", "semi_axes", point, "m", "type=ellipse|ellipsoid", required, positive, "half lengths of the axes; those of an ellipsoid lie along x, y, z"},
    {"bodies.shape", "tilt_deg", real, "degree", "type=ellipse", standard("0.0"), any, "anticlockwise rotation of the axes"},
    {"bodies.shape", "points", points, "m", "type=polygon", required, any, "at least 3 corners of a polygon that does not cross itself, in either sense"},
    {"bodies.shape", "point", point, "m", "type=half_plane|half_space", required, any, "a point of the boundary"},
    {"bodies.shape", "normal", point, "", "type=half_plane|half_space", required, any, "points out of the body; of any length"},

    {"bodies.initial_velocity", "type", choice, "", "", required, words("rest|uniform|bar_first_mode|linear|exact"), "which field; linear: v = gradient (x - centre); exact: of the solution that the body follows"},
    {"bodies.initial_velocity", "value", point, "m/s", "type=uniform", required, any, "velocity of all particles"},
    {"bodies.initial_velocity", "amplitude", real, "m/s", "type=bar_first_mode", required, any, "velocity of the free end: v = amplitude sin(pi x / (2 length))"},
    {"bodies.initial_velocity", "gradient", points, "1/s", "type=linear", required, any, "as many rows as dimension, dv_a/dx_b"},
    {"bodies.initial_velocity", "centre", point, "m", "type=linear", required, any, "where the velocity is 0"},
    {"bodies.initial_velocity", "axis", choice, "", "type=bar_first_mode", required, axes_2d, "along the bar", 2},
    {"bodies.initial_velocity", "axis", choice, "", "type=bar_first_mode", required, axes_3d, "along the bar", 3},
    {"bodies.initial_velocity", "length", real, "m", "type=bar_first_mode", required, positive, "of the bar, which is fixed at coordinate 0"},

    {"bodies.initial_stress", "type", choice, "", "", required, words("zero|hydrostatic|k0|fluid_pressure|exact"), "hydrostatic: a still fluid; k0: soil at rest; fluid_pressure: the isotropic pressure of a still fluid around, in drained soil as effective stress; exact: of the solution that the body follows"},
    {"bodies.initial_stress", "fluid", name, "", "type=hydrostatic|fluid_pressure", required, reference, "the newtonian material of the still fluid"},
    {"bodies.initial_stress", "surface", real, "m", "type=hydrostatic|fluid_pressure", required, any, "level of the fluid's free surface"},
    {"bodies.initial_stress", "surface", real, "m", "type=k0", required, any, "level of the soil's surface"},
    {"bodies.initial_stress", "k0", real, "", "type=k0", required, not_negative, "horizontal over vertical effective stress"},
    {"bodies.initial_stress", "under", choice, "", "type=k0", required, words("air|fluid"), "what lies on the soil"},
    {"bodies.initial_stress", "fluid", name, "", "under=fluid", required, reference, "the newtonian material over the soil and in its pores"},
    {"bodies.initial_stress", "fluid_surface", real, "m", "under=fluid", required, any, "level of the fluid's free surface"},

    {"membranes", "name", name, "", "", required, identifier, "heads the membrane's columns in history.csv"},
    {"membranes", "body", name, "", "", required, reference, "the body on whose outline it lies"},
    {"membranes", "points", points, "m", "", standard("[]"), any, "the polyline, each point on the body's outline; empty: the whole outline"},
    {"membranes", "closed", boolean, "", "", standard("true"), yes_no, "the last point joins the first"},
    {"membranes", "axial_stiffness", real, "N/m", "", required, not_negative, "J, tension per strain; 0 with mass_per_area = 0: a skin that only carries contact"},
    {"membranes", "mass_per_area", real, "kg/m2", "", required, not_negative, "mass per area"},
    {"membranes", "strength", real, "N/m", "", standard("0.0"), not_negative, "tension at which it would tear, > 0; may be left out if axial_stiffness is 0"},
    {"membranes", "slack", real, "", "", required, slack_range, "rest length / drawn length - 1; below 0 it is under tension from the start"},
    {"membranes", "segments_per_cell", real, "", "", standard("4.0"), dense, "nodes are h / segments_per_cell apart"},
    {"membranes", "interface", choice, "", "", standard("\"mixture\""), words("mixture|sharp"), "mixture: its body and what is around it move with one velocity field and stick to each other; sharp: each has its own, they slip along the membrane as far as `shear` lets them and share the cells that it cuts exactly", 2},
    {"membranes", "shear", choice, "", "interface=sharp", required, words("none|wall_law|no_slip"), "what hinders the fluid around that slips along it: nothing; tau = 1/2 rho wall_friction u^2 at a velocity of slipping u; it sticks"},
    {"membranes", "wall_friction", real, "", "shear=wall_law", required, not_negative, "C_f of the wall law"},
    {"membranes", "drag_coefficient", real, "", "interface=sharp", standard("0.0"), not_negative, "C_d of a model drag 1/2 rho C_d W v^2 on the width W across the body's motion, in place of the wake that a flow without friction lacks; the fluid does not feel it"},
    {"membranes", "bed", text, "", "", standard("\"\""), any, "with interface = sharp: a body of soil around it on which it rubs and from which it parts rather than pull; it does not part from anything else"},
    {"membranes", "bed_friction", real, "", "", standard("0.0"), not_negative, "coefficient of friction on the bed; given with bed only"},
    {"membranes", "averaging_segments", integer, "", "", standard("2"), window, "half width of the running mean of strain and force"},

    {"rigid", "name", name, "", "", required, identifier, "what contacts refer to"},
    {"rigid", "shape", table, "", "", required, one_table, "where it is"},

    {"rigid", "motion", table, "", "", standard("{ type = \"none\" }"), one_table, "how it moves"},

    {"rigid.shape", "type", choice, "", "", required, words("half_plane|capsule"), "which shape; capsule: a segment with rounded ends"},
    {"rigid.shape", "point", point, "m", "type=half_plane", required, any, "a point of the boundary"},
    {"rigid.shape", "normal", point, "", "type=half_plane", required, any, "points out of the rigid body; of any length"},
    {"rigid.shape", "from", point, "m", "type=capsule", required, any, "one end of the segment"},
    {"rigid.shape", "to", point, "m", "type=capsule", required, any, "its other end; the same point: a disc"},
    {"rigid.shape", "radius", real, "m", "type=capsule", required, positive, "of the ends, half the thickness"},

    {"rigid.motion", "type", choice, "", "", required, words("none|hinge|translation|table"), "hinge: rotation at a constant rate; translation: at a constant velocity; table: either, piecewise linear in time"},
    {"rigid.motion", "rate", real, "rad/s", "type=hinge", required, not_zero, "anticlockwise"},
    {"rigid.motion", "stop_angle_deg", real, "degree", "type=hinge", required, positive, "how far it turns, in either sense"},
    {"rigid.motion", "velocity", point, "m/s", "type=translation", required, any, "of all its points"},
    {"rigid.motion", "of", choice, "", "type=table", required, words("angle|displacement"), "what the table lists"},
    {"rigid.motion", "times", reals, "s", "type=table", required, not_negative, "ascending; it is at rest before the first and after the last"},
    {"rigid.motion", "angles_deg", reals, "degree", "of=angle", required, any, "one for each time, anticlockwise from the start"},
    {"rigid.motion", "displacements", points, "m", "of=displacement", required, any, "one for each time, from the start"},
    {"rigid.motion", "centre", point, "m", "type=hinge", required, any, "of the rotation"},
    {"rigid.motion", "centre", point, "m", "of=angle", required, any, "of the rotation"},

    {"contacts", "between", names, "", "", required, reference, "in any order a membrane, or a body without one, and a rigid body; two membranes; or one membrane twice for its own folds"},
    {"contacts", "friction", real, "", "", required, not_negative, "coefficient of Coulomb friction"},
    {"contacts", "stiffness", real, "", "", standard("1.0"), penalty_range, "of the penalty: pressure per penetration over P / h, with P the modulus of compression waves of the body that touches, h the cell. The step is at most h / (c sqrt(2 stiffness))"},
    {"contacts", "damping", real, "", "", standard("1.0"), share, "of the penalty: pressure per normal velocity over the impedance rho c of the body that touches (of two membranes: of both bodies in series); 1 absorbs what its own waves bring"},

    {"still_fluids", "membrane", name, "", "", required, reference, "the closed membrane that it presses on"},
    {"still_fluids", "fluid", name, "", "", required, reference, "the newtonian material of the fluid"},
    {"still_fluids", "surface", real, "m", "", required, any, "level of its surface"},

    {"stages", "name", name, "", "", required, identifier, "what happens in it"},
    {"stages", "from", real, "s", "", required, not_negative, "when it begins; the first one at 0"},
    {"stages", "damping_rate", real, "1/s", "", standard("0.0"), not_negative, "mass-proportional damping of velocity in this stage; never damp an impact"},
    {"stages", "damping_ramp", real, "s", "", standard("0.0"), not_negative, "time over which the damping rises to that"},
    {"stages", "places", names, "", "", standard("[]"), reference, "bodies that come in, with their membranes"},
    {"stages", "moves", names, "", "", standard("[]"), reference, "rigid bodies whose motion goes on in this stage; all others stand still"},
    {"stages", "removes", names, "", "", standard("[]"), reference, "rigid bodies that are taken away"},

    {"viscous_boundaries", "name", name, "", "", required, identifier, "what messages call it"},
    {"viscous_boundaries", "body", name, "", "", required, reference, "the solid body whose edge it is"},
    {"viscous_boundaries", "from", point, "m", "", required, any, "one end of the edge, on the body's outline"},
    {"viscous_boundaries", "to", point, "m", "", required, any, "its other end; the outline runs straight between them"},
    {"viscous_boundaries", "spring_depth", real, "m", "", required, depth_range, "thickness of the layer of the same ground, on rock, that the spring stands for: its stiffness is rho c_p^2 / spring_depth"},

    {"silent_sides", "name", name, "", "", required, identifier, "what messages call it"},
    {"silent_sides", "body", name, "", "", required, reference, "the newtonian body, at rest at the start with initial_stress \"hydrostatic\", which is the pressure that stays"},
    {"silent_sides", "side", choice, "", "", required, words("left|right"), "which wall of the domain the layer lies at"},
    {"silent_sides", "width", real, "m", "", required, positive, "of the layer; at least 4 cells"},
    {"silent_sides", "water_beyond", real, "m", "", required, beyond_range, "L: the water beyond flows by dv/dt = (p - p_still)/(rho L), as a column of that length would; about the distance from what moves to the wall, or 2/pi of the depth where that is less. Waves longer than 4 pi L come back. inf: none flows, for waves alone"},
    {"silent_sides", "rest_time", real, "s", "", required, rest_range, "T: what the pressure of a row keeps over p_still for longer than that is no wave and stays, and the water beyond comes to rest with this time constant; longer than what shall pass, as a fall. inf: p_still for ever; the error of a grid at rest then drives a slow circulation"},

    {"pumps", "body", name, "", "", required, reference, "which body grows"},
    {"pumps", "rate", real, "m3/s", "", required, positive, "volume at zero pressure per time (2D: per metre of depth, m2/s)"},
    {"pumps", "from", real, "s", "", required, not_negative, "when it starts"},
    {"pumps", "to", real, "s", "", required, positive, "when it ends; a relaxation does not end before"},

    {"exact", "body", name, "", "", required, reference, "the body that follows the solution"},
    {"exact", "type", choice, "", "", required, words("axis_aligned_mms|taylor_green|uniform_motion|bar_first_mode|generalized_vortex|oscillating_drop"), "axis_aligned_mms: a neo-Hookean block that swings along each axis; generalized_vortex: a neo-Hookean one with a ring that turns to and fro; taylor_green: decaying vortices of water; oscillating_drop: a round drop of water about the origin that a central force draws together (2D); uniform_motion: a stretched solid that drifts unchanged; bar_first_mode: a linear elastic bar, fixed at coordinate 0"},
    {"exact", "amplitude", real, "m", "type=axis_aligned_mms", required, positive, "A of u = A sin(2 pi X / length); 2 pi A / length is below 1"},
    {"exact", "amplitude", real, "m/s", "type=bar_first_mode", required, not_zero, "velocity of the free end"},
    {"exact", "speed", real, "m/s", "type=taylor_green", required, positive, "U of u = U sin(2 pi x / length) cos(2 pi y / length)"},
    {"exact", "length", real, "m", "type=axis_aligned_mms|taylor_green|bar_first_mode", required, positive, "of a wave; of the bar"},
    {"exact", "angle", real, "rad", "type=generalized_vortex", required, positive, "G, by which the ring turns at most: alpha = G sin(frequency t) (1 - s^2)^2, s = (R - radius) / half_width, about the origin"},
    {"exact", "radius", real, "m", "type=generalized_vortex|oscillating_drop", required, positive, "of the circle that turns most; of the drop"},
    {"exact", "half_width", real, "m", "type=generalized_vortex", required, positive, "of the ring; less than radius"},
    {"exact", "frequency", real, "rad/s", "type=generalized_vortex|oscillating_drop", required, positive, "angular frequency of the swing; B of the force -B^2 x per mass"},
    {"exact", "rate", real, "1/s", "type=oscillating_drop", required, not_zero, "A0 of the velocity A0 (x, -y) at the start"},
    {"exact", "axis", choice, "", "type=bar_first_mode", required, axes_2d, "along the bar", 2},
    {"exact", "axis", choice, "", "type=bar_first_mode", required, axes_3d, "along the bar", 3},
    {"exact", "velocity", point, "m/s", "type=uniform_motion", required, any, "of the drift"},
    {"exact", "stretch", point, "", "type=uniform_motion", required, positive, "present over unstrained length along each axis; the body's shape, a box, is the stretched one, and the lattice of its particles is stretched with it"},

    {"probes", "name", name, "", "", required, identifier, "heads the probe's columns in history.csv"},
    {"probes", "type", choice, "", "", required, words("tracer|hydrostatic|exact|geotube|section|span|stress|front|extremes"), "tracer: a point that moves with the material; section: horizontal forces over an upright section; front: how far a heap reaches to both sides, lone particles left out; span: tension of a part of a membrane; stress: how the vertical stress spreads over the particles; extremes: least and largest volume ratio J and pressure, largest principal stress (effective in soil) of all particles; hydrostatic: rms pressure error of a fluid at rest; exact: errors against the solution that the body follows; geotube: shape and pressures of a closed membrane full of fluid beside those of the closed form"},
    {"probes", "position", point, "m", "type=tracer", required, any, "where the point starts"},
    {"probes", "body", name, "", "type=hydrostatic|exact|section|stress|front|extremes", required, reference, "whose particles are compared, or cut, or heaped"},
    {"probes", "from", point, "m", "type=span", required, any, "one end of the part, on the membrane as drawn"},
    {"probes", "to", point, "m", "type=span", required, any, "its other end; round a closed membrane the shorter way"},
    {"probes", "thickness", real, "m", "type=front", required, positive, "of a heap at its front: volume in an upright column of cells over its width"},
    {"probes", "x", real, "m", "type=section", required, any, "where the section is"},
    {"probes", "membrane", name, "", "type=geotube|span", required, reference, "the membrane; of a geotube a closed one"},
    {"probes", "outside", choice, "", "type=geotube", standard("\"air\""), words("air|water"), "what stands around the tube of the closed form"},
    {"probes", "water", name, "", "outside=water", required, reference, "the newtonian material of that water"},
    {"probes", "water_level", real, "m", "outside=water", required, positive, "its level over the ground"},
    {"probes", "fluid", name, "", "type=hydrostatic", required, reference, "the newtonian material of the still fluid"},
    {"probes", "surface", real, "m", "type=hydrostatic", required, any, "level of the fluid's free surface"},
    {"probes", "tips_of", text, "", "type=hydrostatic", standard("\"\""), any, "a membrane: what is within 2 h (of the finest cell) of its lowest or highest node counts apart in the 99.9th percentile"},

    {"results", "name", name, "", "", required, identifier, "ends in its unit, e.g. fall_velocity_max_m_s"},
    {"results", "column", text, "", "", required, filled, "a column of history.csv, e.g. container.velocity_y_m_s"},
    {"results", "reduce", choice, "", "", required, words("last|min|max|mean|rms|percentile|period|first_time_below|rms_difference|r_squared|slope"), "how the column becomes one number; slope: change per second of the straight line that fits best"},
    {"results", "from", real, "s", "", standard("0.0"), not_negative, "rows before are left out"},
    {"results", "to", real, "s", "", standard("inf"), end_range, "rows after are left out"},
    {"results", "after", text, "", "", standard("\"\""), any, "a first_time_below further up: rows before that time are left out, all rows if it never came"},
    {"results", "before", text, "", "", standard("\"\""), any, "likewise: rows after that time are left out, none if it never came"},
    {"results", "scale", real, "", "", standard("1.0"), not_zero, "factor on the number"},
    {"results", "percentile", real, "", "reduce=percentile", required, percent, "which percentile"},
    {"results", "level", real, "", "reduce=first_time_below", required, any, "the level, in the unit of the column"},
    {"results", "against", text, "", "reduce=r_squared", required, filled, "the column that is compared with"},
    {"results", "times", reals, "s", "reduce=rms_difference", required, not_negative, "when to compare"},
    {"results", "values", reals, "", "reduce=rms_difference", required, any, "reference values at these times, in the unit of the column"},

    {"expect", "result", name, "", "", required, reference, "a name in results"},
    {"expect", "expected", real, "", "", required, any, "in the unit of the result"},
    {"expect", "tolerance", real, "", "", required, not_negative, "met if |value - expected| <= tolerance"},
    {"expect", "source", text, "", "", required, filled, "who says so"},

    {"verify", "result", name, "", "", required, reference, "a name in results"},
    {"verify", "over", text, "", "", standard("\"\""), any, "another result that this one is divided by first, e.g. the wave that comes in; empty: none"},
    {"verify", "what", text, "", "", required, filled, "what the error is of, in words"},
    {"verify", "expected", real, "", "", required, any, "in the unit of the result"},
    {"verify", "kind", choice, "", "", standard("\"reference\""), words("reference|regression"), "regression: a result of the code itself, which can only show that something has changed; counted apart"},
    {"verify", "scale", real, "", "", standard("0.0"), not_negative, "what the difference is divided by; 0: |expected|"},
    {"verify", "target", real, "", "", required, positive, "met if the error of the last variant is at most this"},
    {"verify", "quick_target", real, "", "", standard("0.0"), not_negative, "holds with `--quick`, which stops at a coarser grid; a row that only this one admits counts as coarse, not as met; 0: none"},
    {"verify", "least_order", real, "", "", standard("0.0"), not_negative, "least order in the grid spacing that the errors of all variants show; not judged by `--quick` if its runs have one spacing; 0: none is asked for"},
    {"verify", "source", text, "", "", required, filled, "who says so"},
    {"verify", "shortfall", text, "", "", standard("\"\""), free_text, "why the target is known to be missed: the row says so, but the command does not fail by it as long as the guard holds"},
    {"verify", "guard", real, "", "", standard("0.0"), not_negative, "largest error that a known miss may have; needed beside `shortfall`. With `--quick` a `quick_target` takes its place"},
    {"verify", "loose", text, "", "", standard("\"\""), free_text, "why the target is more than three times the error that is measured"},

    {"variants", "name", text, "", "", required, filled, "e.g. h = 0.1 m"},
    {"variants", "set", texts, "", "", standard("[]"), free_text, "overrides, each as after --set: \"grid.spacing=0.1\""},
    {"variants", "in", choice, "", "", standard("\"both\""), words("quick|full|both"), "which of `geodrop verify --quick` and `--full` makes this run"},
    {"variants", "control", boolean, "", "", standard("false"), yes_no, "broken on purpose: it has to miss the target of the row that it belongs to"},
    {"variants", "of", texts, "", "", standard("[]"), free_text, "results whose targets a control has to miss, each; needed where there are several [[verify]]"},
    {"variants", "breaks", text, "", "", standard("\"\""), free_text, "part of the message that a control has to break with; empty: it has to run to its end, with an error above the target"},
};
// clang-format on

}  // namespace

std::span<const Key> key_table() { return keys; }
std::span<const Section> section_table() { return sections; }

const Section& find_section(std::string_view path) {
  for (const Section& section : sections) {
    if (section.path == path) return section;
  }
  assert(false && "every table key has a section");
  return sections[0];
}

std::vector<const Key*> keys_of(std::string_view section) {
  std::vector<const Key*> found;
  for (const Key& key : keys) {
    if (key.section == section) found.push_back(&key);
  }
  return found;
}

std::string join_path(std::string_view parent, std::string_view child) {
  std::string path(parent);
  if (!path.empty()) path += '.';
  return path.append(child);
}

std::string word_of(std::string_view section, std::string_view name, std::size_t enumerator) {
  for (const Key* key : keys_of(section))
    if (key->name == name) return split(key->allowed.text, '|').at(enumerator);
  throw std::logic_error("no such choice");
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

}  // namespace geodrop
