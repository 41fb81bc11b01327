#include "bind_scene.hpp"
#include "check_value.hpp"
#include "key_table.hpp"

#include <geodrop/materials.hpp>

#include <algorithm>

namespace geodrop {
namespace {

/// Typed access to a complete table; what is not there reads as zero or empty.
class Fields {
 public:
  Fields(const toml::table* table, std::string_view section)
      : table_(table ? *table : toml::table{}), section_(section) {}

  double real(std::string_view name) const { return has(name) ? to_number(*table_.get(name)) : 0.0; }
  int integer(std::string_view name) const { return static_cast<int>(table_[name].value_or(std::int64_t{0})); }
  std::uint64_t count(std::string_view name) const {
    return static_cast<std::uint64_t>(table_[name].value_or(std::int64_t{0}));
  }
  bool boolean(std::string_view name) const { return table_[name].value_or(false); }
  std::string text(std::string_view name) const { return table_[name].value_or(std::string()); }
  bool has(std::string_view name) const { return table_.contains(name); }

  std::vector<double> reals(std::string_view name) const { return numbers(table_[name].as_array()); }
  Point point(std::string_view name) const { return reals(name); }
  std::vector<Point> points(std::string_view name) const {
    std::vector<Point> list;
    for_each(name, [&](const toml::node& node) { list.push_back(numbers(node.as_array())); });
    return list;
  }
  std::vector<std::string> names(std::string_view name) const {
    std::vector<std::string> list;
    for_each(name, [&](const toml::node& node) { list.push_back(node.value_or(std::string())); });
    return list;
  }

  /// The enumerators stand in the order of the words in the table of keys.
  template <class Enum>
  Enum choice(std::string_view name) const {
    for (const Key* key : keys_of(section_)) {
      if (key->name != name) continue;
      const std::vector<std::string> words = split(key->allowed.text, '|');
      const auto word = std::find(words.begin(), words.end(), text(name));
      if (word != words.end()) return static_cast<Enum>(word - words.begin());
    }
    return Enum{};
  }

  Fields sub(std::string_view name) const { return {table_[name].as_table(), join_path(section_, name)}; }

 private:
  static std::vector<double> numbers(const toml::array* list) {
    std::vector<double> values;
    for (std::size_t i = 0; list && i < list->size(); ++i) values.push_back(to_number(*list->get(i)));
    return values;
  }
  template <class Visit>
  void for_each(std::string_view name, Visit visit) const {
    const toml::array* list = table_[name].as_array();
    for (std::size_t i = 0; list && i < list->size(); ++i) visit(*list->get(i));
  }

  toml::table table_;
  std::string section_;
};

Shape bind_shape(const Fields& f) {
  const std::string type = f.text("type");
  if (type == "ellipse" || type == "ellipsoid")
    return EllipseShape{f.point("centre"), f.point("semi_axes"), f.real("tilt_deg")};
  if (type == "polygon") return PolygonShape{f.points("points")};
  if (type == "half_plane" || type == "half_space") return HalfPlaneShape{f.point("point"), f.point("normal")};
  return BoxShape{f.point("lower"), f.point("upper")};
}

InitialVelocity bind_velocity(const Fields& f, std::size_t dimension) {
  const std::string type = f.text("type");
  if (type == "bar_first_mode") return BarFirstModeSpec{f.real("amplitude"), f.choice<int>("axis"), f.real("length")};
  if (type == "exact") return FromExactSpec{};
  if (type == "linear") return LinearVelocitySpec{f.points("gradient"), f.point("centre")};
  if (type == "uniform") return UniformVelocitySpec{f.point("value")};
  return UniformVelocitySpec{Point(dimension, 0.0)};
}

InitialStress bind_stress(const Fields& f) {
  const std::string type = f.text("type");
  const HydrostaticSpec still{f.text("fluid"), f.real(type == "k0" ? "fluid_surface" : "surface")};
  if (type == "hydrostatic") return still;
  if (type == "fluid_pressure") return FluidPressureSpec{still};
  if (type == "exact") return FromExactSpec{};
  if (type != "k0") return ZeroStressSpec{};
  K0StressSpec k0{f.real("surface"), f.real("k0"), std::nullopt};
  if (f.text("under") == "fluid") k0.fluid = still;
  return k0;
}

NewtonianSpec bind_newtonian(const Fields& f) {
  const double density = f.real("density");
  const double c = f.real("sound_speed");
  return {density, f.has("sound_speed") ? density * c * c : f.real("bulk_modulus"), f.real("viscosity"),
          f.real("mixing_length"), f.real("tension_cutoff")};
}

UndrainedSpec bind_pores(const Fields& f) {
  const double porosity = f.real("porosity"), saturation = f.real("saturation");
  if (!f.has("saturation")) return {porosity, f.real("fluid_bulk_modulus")};
  const PoreFluid fluid{saturation, f.real("water_bulk_modulus"), f.real("gas_pressure")};
  return {porosity, pore_fluid_bulk_modulus(fluid), saturation};
}

MohrCoulombSpec bind_mohr_coulomb(const Fields& f) {
  MohrCoulombSpec soil;
  const GrainsAndWater content{f.real("grain_density"), f.real("porosity"), f.real("saturation"),
                               f.real("fluid_density")};
  soil.density = f.has("grain_density") ? mixture_density(content) : f.real("density");
  soil.youngs_modulus = f.real("youngs_modulus");
  soil.poissons_ratio = f.real("poissons_ratio");
  soil.cohesion = f.real("cohesion");
  soil.friction_angle_deg = f.real("friction_angle_deg");
  soil.dilatancy_angle_deg = f.real("dilatancy_angle_deg");
  soil.tension_cutoff = f.real("tension_cutoff");
  soil.void_memory = f.boolean("void_memory");
  if (f.text("drainage") == "undrained") soil.undrained = bind_pores(f);
  return soil;
}

MaterialSpec bind_material(const std::string& name, const Fields& f, SourceRef at) {
  MaterialSpec material{name, NewtonianSpec{}, at};
  const std::string model = f.text("model");
  if (model == "newtonian") material.model = bind_newtonian(f);
  if (model == "mohr_coulomb") material.model = bind_mohr_coulomb(f);
  if (model == "neo_hookean")
    material.model = NeoHookeanSpec{f.real("density"), f.real("youngs_modulus"), f.real("poissons_ratio")};
  if (model == "linear_elastic") {
    material.model = LinearElasticSpec{f.real("density"), f.real("youngs_modulus"), f.real("poissons_ratio")};
  }
  return material;
}

BodySpec bind_body(const Fields& f, std::size_t dimension, SourceRef at) {
  BodySpec body;
  body.name = f.text("name");
  body.material = f.text("material");
  body.shape = bind_shape(f.sub("shape"));
  body.minus = f.names("minus");
  body.particles_per_cell_axis = f.integer("particles_per_cell_axis");
  body.jitter = f.real("jitter");
  body.jitter_seed = f.count("jitter_seed");
  body.initial_velocity = bind_velocity(f.sub("initial_velocity"), dimension);
  body.initial_stress = bind_stress(f.sub("initial_stress"));
  body.pressure = f.choice<PressureSupport>("pressure");
  body.layers = f.integer("layers");
  body.shift_speed = f.real("shift_speed");
  body.shift = f.boolean("shift");
  body.at = at;
  return body;
}

MembraneSpec bind_membrane(const Fields& f, SourceRef at) {
  MembraneSpec membrane;
  membrane.name = f.text("name");
  membrane.body = f.text("body");
  membrane.points = f.points("points");
  membrane.closed = f.boolean("closed");
  membrane.axial_stiffness = f.real("axial_stiffness");
  membrane.mass_per_area = f.real("mass_per_area");
  membrane.strength = f.real("strength");
  membrane.slack = f.real("slack");
  membrane.segments_per_cell = f.real("segments_per_cell");
  membrane.averaging_segments = f.integer("averaging_segments");
  membrane.interface = f.choice<Interface>("interface");
  membrane.shear = f.choice<Shear>("shear");
  membrane.wall_friction = f.real("wall_friction");
  membrane.drag_coefficient = f.real("drag_coefficient");
  membrane.bed = f.text("bed");
  membrane.bed_friction = f.real("bed_friction");
  membrane.at = at;
  return membrane;
}

RigidShape bind_rigid_shape(const Fields& f) {
  if (f.text("type") == "capsule") return CapsuleShape{f.point("from"), f.point("to"), f.real("radius")};
  return HalfPlaneShape{f.point("point"), f.point("normal")};
}

RigidMotion bind_rigid_motion(const Fields& f) {
  const std::string type = f.text("type");
  if (type == "hinge") return HingeMotionSpec{f.point("centre"), f.real("rate"), f.real("stop_angle_deg")};
  if (type == "translation") return TranslationMotionSpec{f.point("velocity")};
  if (type == "table")
    return TableMotionSpec{f.reals("times"), f.point("centre"), f.reals("angles_deg"), f.points("displacements")};
  return std::monostate{};
}

RigidSpec bind_rigid(const Fields& f, SourceRef at) {
  return {f.text("name"), bind_rigid_shape(f.sub("shape")), bind_rigid_motion(f.sub("motion")), at};
}

ContactSpec bind_contact(const Fields& f, SourceRef at) {
  std::vector<std::string> between = f.names("between");
  if (between.size() != 2) between.assign(2, "");  // check_contacts refuses that
  return {{between[0], between[1]}, f.real("friction"), f.real("stiffness"), f.real("damping"), at};
}

StillFluidSpec bind_still_fluid(const Fields& f, SourceRef at) {
  return {f.text("membrane"), f.text("fluid"), f.real("surface"), at};
}

ViscousBoundarySpec bind_viscous_boundary(const Fields& f, SourceRef at) {
  return {f.text("name"), f.text("body"), f.point("from"), f.point("to"), f.real("spring_depth"), at};
}

SilentSideSpec bind_silent_side(const Fields& f, SourceRef at) {
  return {f.text("name"),
          f.text("body"),
          f.choice<SilentSideSpec::Side>("side"),
          f.real("width"),
          f.real("water_beyond"),
          f.real("rest_time"),
          at};
}

PumpSpec bind_pump(const Fields& f, SourceRef at) {
  return {f.text("body"), f.real("rate"), f.real("from"), f.real("to"), at};
}

StageSpec bind_stage(const Fields& f, SourceRef at) {
  return {f.text("name"),    f.real("from"),   f.real("damping_rate"), f.real("damping_ramp"),
          f.names("places"), f.names("moves"), f.names("removes"),     at};
}

ExactSpec bind_exact(const Fields& f, SourceRef at) {
  const std::string type = f.text("type"), body = f.text("body");
  if (type == "taylor_green") return {body, TaylorGreenSpec{f.real("speed"), f.real("length")}, at};
  if (type == "uniform_motion") return {body, UniformMotionSpec{f.point("velocity"), f.point("stretch")}, at};
  if (type == "bar_first_mode")
    return {body, BarFirstModeSpec{f.real("amplitude"), f.choice<int>("axis"), f.real("length")}, at};
  if (type == "generalized_vortex") {
    return {body, GeneralizedVortexSpec{f.real("angle"), f.real("radius"), f.real("half_width"), f.real("frequency")},
            at};
  }
  if (type == "oscillating_drop")
    return {body, OscillatingDropSpec{f.real("rate"), f.real("frequency"), f.real("radius")}, at};
  return {body, AxisAlignedMmsSpec{f.real("amplitude"), f.real("length")}, at};
}

ProbeSpec bind_probe(const Fields& f, SourceRef at) {
  if (f.text("type") == "exact") return {ExactProbeSpec{f.text("name"), f.text("body")}, at};
  if (f.text("type") == "hydrostatic") {
    return {
        HydrostaticProbeSpec{f.text("name"), f.text("body"), {f.text("fluid"), f.real("surface")}, f.text("tips_of")},
        at};
  }
  if (f.text("type") == "span")
    return {SpanProbeSpec{f.text("name"), f.text("membrane"), f.point("from"), f.point("to")}, at};
  if (f.text("type") == "stress") return {StressProbeSpec{f.text("name"), f.text("body")}, at};
  if (f.text("type") == "front") return {FrontProbeSpec{f.text("name"), f.text("body"), f.real("thickness")}, at};
  if (f.text("type") == "extremes") return {ExtremesProbeSpec{f.text("name"), f.text("body")}, at};
  if (f.text("type") == "section") return {SectionProbeSpec{f.text("name"), f.text("body"), f.real("x")}, at};
  if (f.text("type") == "geotube")
    return {GeotubeProbeSpec{f.text("name"), f.text("membrane"), f.text("water"), f.real("water_level")}, at};
  return {TracerSpec{f.text("name"), f.point("position")}, at};
}

ResultSpec bind_result(const Fields& f, SourceRef at) {
  ResultSpec result;
  result.name = f.text("name");
  result.column = f.text("column");
  result.reduce = f.choice<Reduction>("reduce");
  result.from = f.real("from");
  result.to = f.real("to");
  result.after = f.text("after");
  result.before = f.text("before");
  result.scale = f.real("scale");
  result.percentile = f.real("percentile");
  result.level = f.real("level");
  result.against = f.text("against");
  result.times = f.reals("times");
  result.values = f.reals("values");
  result.at = at;
  return result;
}

ExpectSpec bind_expect(const Fields& f, SourceRef at) {
  return {f.text("result"), f.real("expected"), f.real("tolerance"), f.text("source"), at};
}

VerifySpec bind_verify(const Fields& f, SourceRef at) {
  VerifySpec verify;
  verify.result = f.text("result");
  verify.over = f.text("over");
  verify.what = f.text("what");
  verify.expected = f.real("expected");
  verify.kind = f.choice<ReferenceKind>("kind");
  verify.scale = f.real("scale");
  verify.target = f.real("target");
  verify.quick_target = f.real("quick_target");
  verify.least_order = f.real("least_order");
  verify.source = f.text("source");
  verify.shortfall = f.text("shortfall");
  verify.guard = f.real("guard");
  verify.loose = f.text("loose");
  verify.at = at;
  return verify;
}

VariantSpec bind_variant(const Fields& f, SourceRef at) {
  return {f.text("name"),
          f.names("set"),
          f.choice<VerifyMode>("in"),
          f.boolean("control"),
          f.names("of"),
          f.text("breaks"),
          at};
}

RefineSpec bind_zone(const Fields& f, SourceRef at) {
  return {f.choice<int>("axis"), f.real("from"), f.real("to"), f.real("spacing"), f.real("growth"), at};
}

void bind_numerics(const Fields& root, Scene& scene) {
  const Fields grid = root.sub("grid"), walls = root.sub("walls"), solver = root.sub("solver"),
               output = root.sub("output");
  scene.grid = {grid.point("lower"), grid.point("upper"), grid.real("spacing"), grid.choice<Basis>("basis"), {}};
  const auto along_axes = [&](const char* x, const char* y_in_space, const char* vertical) {
    std::vector<WallKind> kinds{walls.choice<WallKind>(x)};
    if (scene.dimension == 3) kinds.push_back(walls.choice<WallKind>(y_in_space));
    kinds.push_back(walls.choice<WallKind>(vertical));
    return kinds;
  };
  scene.walls.lower = along_axes("left", "front", "bottom");
  scene.walls.upper = along_axes("right", "back", "top");
  scene.solver.transfer = solver.choice<Transfer>("transfer");
  scene.solver.blend_rate = solver.real("blend_rate");
  scene.solver.mass_matrix = solver.choice<MassMatrix>("mass_matrix");
  scene.solver.courant = solver.real("courant");
  scene.solver.damping_rate = solver.real("damping_rate");
  const Fields relaxation = root.sub("relaxation");
  scene.relaxation = {relaxation.choice<RelaxationSpec::Damping>("damping"), relaxation.real("kinetic_ratio"),
                      relaxation.real("out_of_balance_ratio")};
  scene.time.end = root.sub("time").real("end");
  scene.output = {output.real("frame_interval"), output.real("history_interval"), output.boolean("compress")};
  scene.checkpoints = {output.real("checkpoint_interval"), output.real("checkpoint_every")};
}

/// Binds each element of a list of tables with `bind(fields, at)`.
template <class Bind>
auto bind_list(const toml::table& complete, const Report& report, const std::string& name, Bind bind) {
  std::vector<decltype(bind(Fields(nullptr, name), SourceRef{}))> list;
  const toml::array* tables = complete.at_path(name).as_array();
  for (std::size_t i = 0; tables && i < tables->size(); ++i) {
    list.push_back(bind(Fields(tables->get(i)->as_table(), name), report.where(report.element(name, i))));
  }
  return list;
}

}  // namespace

Scene bind_scene(const toml::table& complete, const Report& report) {
  Scene scene;
  const Fields root(&complete, "");
  scene.title = root.text("title");
  scene.question = root.text("question");
  scene.gravity = root.point("gravity");
  if (root.has("dimension")) scene.dimension = root.integer("dimension");
  bind_numerics(root, scene);
  scene.grid.refine = bind_list(complete, report, "grid.refine", bind_zone);
  if (const toml::table* materials = complete["materials"].as_table()) {
    for (const auto& [name, node] : *materials) {
      const std::string word(name.str());
      scene.materials.push_back(bind_material(word, {node.as_table(), "materials"}, report.where("materials." + word)));
    }
  }
  const auto body = [&](const Fields& f, SourceRef at) {
    return bind_body(f, static_cast<std::size_t>(scene.dimension), at);
  };
  scene.bodies = bind_list(complete, report, "bodies", body);
  scene.membranes = bind_list(complete, report, "membranes", bind_membrane);
  scene.rigid = bind_list(complete, report, "rigid", bind_rigid);
  scene.contacts = bind_list(complete, report, "contacts", bind_contact);
  scene.still_fluids = bind_list(complete, report, "still_fluids", bind_still_fluid);
  scene.viscous_boundaries = bind_list(complete, report, "viscous_boundaries", bind_viscous_boundary);
  scene.silent_sides = bind_list(complete, report, "silent_sides", bind_silent_side);
  scene.pumps = bind_list(complete, report, "pumps", bind_pump);
  scene.stages = bind_list(complete, report, "stages", bind_stage);
  scene.exact = bind_list(complete, report, "exact", bind_exact);
  scene.probes = bind_list(complete, report, "probes", bind_probe);
  scene.results = bind_list(complete, report, "results", bind_result);
  scene.expect = bind_list(complete, report, "expect", bind_expect);
  scene.verify = bind_list(complete, report, "verify", bind_verify);
  scene.variants = bind_list(complete, report, "variants", bind_variant);
  return scene;
}

}  // namespace geodrop
