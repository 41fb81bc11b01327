#include "check_resumable.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/grid.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "setup/scene_stages.hpp"
#include "state/archive.hpp"

namespace geodrop {
namespace {

struct Fault {
  std::string text;
};

/// The part of the state that is looked at, for messages.
class Part {
 public:
  explicit Part(std::string name) : name_(std::move(name)) {}
  void require(bool good, const char* found) const {
    if (!good) throw Fault{name_ + ": " + found};
  }

 private:
  std::string name_;
};

/// Equal up to what another compiler may make of the same scene.
bool agree(double a, double b) {
  constexpr double rounding = 1e-9;
  return a == b || std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

template <class T>
bool agree(const T& a, const T& b) {
  return a == b;
}

/// An archive (see archive.hpp) that looks for numbers that are not finite.
struct FiniteCheck {
  bool finite = true;
  template <class T>
  void bytes(const T* first, std::size_t count) {
    if constexpr (std::is_same_v<T, double>)
      finite = finite && std::all_of(first, first + count, [](double x) { return std::isfinite(x); });
  }
  std::size_t length(std::size_t present, std::size_t) { return present; }
};

/// All numbers below a part but those of its law, of which some may be infinite.
template <class T>
bool all_finite(const T& part) {
  FiniteCheck check;
  const auto look = [&](const auto& member) {
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(member)>, Material>) walk(check, member);
  };
  std::apply([&](const auto&... member) { (look(member), ...); }, members(part));
  return check.finite;
}

/// An archive that collects what a law consists of.
struct LawNumbers {
  std::vector<double> numbers;
  template <class T>
  void bytes(const T* first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<double>(first[i]));
  }
};

bool same_law(const Material& a, const Material& b) {
  LawNumbers one, other;
  walk_material(one, a);
  walk_material(other, b);
  return std::equal(one.numbers.begin(), one.numbers.end(), other.numbers.begin(), other.numbers.end(),
                    [](double x, double y) { return agree(x, y); });
}

template <class T>
bool same_size(const Array<T>& a, const Array<T>& b) {
  return a.size() == b.size();
}
template <std::size_t n>
bool same_size(const std::array<Array<double>, n>& a, const std::array<Array<double>, n>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) { return x.size() == y.size(); });
}

/// Whether each of the listed members is alike in two parts: of lists their lengths, of others their values.
template <class T, class... Member>
bool alike(const T& a, const T& b, Member... member) {
  const auto one = [&](auto at) {
    if constexpr (requires { same_size(a.*at, b.*at); })
      return same_size(a.*at, b.*at);
    else
      return agree(a.*at, b.*at);
  };
  return (one(member) && ...);
}

template <int Dim>
bool in_domain(const GridLayout<Dim>& layout, const std::array<Array<double>, Dim>& x) {
  for (int a = 0; a < Dim; ++a)
    for (const double c : x[a])
      if (!(c >= layout.particle_lower[a] && c <= layout.particle_upper[a])) return false;
  return true;
}

/// Each number from 0 to n - 1 once.
bool is_permutation_of_all(const Array<std::uint32_t>& ids) {
  std::vector<bool> seen(ids.size(), false);
  for (const std::uint32_t id : ids) {
    if (id >= ids.size() || seen[id]) return false;
    seen[id] = true;
  }
  return true;
}

/// Particles of a slab are in it or have drifted by at most a cell since they were sorted.
template <int Dim>
bool in_their_slabs(const GridLayout<Dim>& layout, const Body<Dim>& body) {
  const auto& begin = body.slab_begin;
  if (begin.size() != static_cast<std::size_t>(layout.slab_count()) + 1) return false;
  if (begin.front() != 0 || begin.back() != body.size() || !std::is_sorted(begin.begin(), begin.end())) return false;
  for (int slab = 0; slab < layout.slab_count(); ++slab) {
    std::array<int, 3> place{0, slab % layout.slabs[1], slab / layout.slabs[1]};
    for (std::size_t p = begin[slab]; p < begin[slab + 1]; ++p)
      for (int a = 1; a < Dim; ++a) {
        const int cell = layout.base(a, layout.wrapped(a, body.x[a][p])), first = place[a] * slab_width<Dim>;
        const bool wraps = layout.periodic(a) && (cell <= 1 || cell >= layout.cells[a] - 1);
        if (!wraps && (cell < first - 1 || cell > first + slab_width<Dim>)) return false;
      }
  }
  return true;
}

template <int Dim>
void check_body(const GridLayout<Dim>& layout, const State<Dim>& state, const Body<Dim>& built, const Body<Dim>& body) {
  using B = Body<Dim>;
  const Part part("body '" + built.name + "'");
  part.require(alike(body, built, &B::name, &B::material_name) && same_law(body.material, built.material),
               "another name or material");
  part.require(alike(body, built, &B::field), "another velocity field");
  part.require(alike(body, built, &B::pressure, &B::shift, &B::shift_speed, &B::half_size, &B::enclosed,
                     &B::unit_weight, &B::weightless_level),
               "other settings");
  bool same = true;
  for_each_field<particle_role::per_particle | particle_role::by_id>(
      body, [&](const auto& entry, const auto& values) { same = same && same_size(values, built.*entry.values); });
  part.require(same, "another number of particles or of their quantities");
  part.require(is_permutation_of_all(body.id), "numbers of particles that are not each there once");
  part.require(all_finite(body), "a value of a particle that is not finite");
  part.require(in_domain<Dim>(layout, body.x), "a particle outside of the domain");
  const auto positive = [](double x) { return x > 0; };
  part.require(
      std::all_of(body.mass.begin(), body.mass.end(), positive) && std::all_of(body.J.begin(), body.J.end(), positive),
      "a particle without mass or volume");
  part.require(state.drift < 0 || in_their_slabs(layout, body), "particles that are not sorted");
}

template <int Dim>
void check_membrane(const GridLayout<Dim>& layout, const Membrane<Dim>& built, const Membrane<Dim>& membrane) {
  using M = Membrane<Dim>;
  const Part part("membrane '" + built.name + "'");
  part.require(alike(membrane, built, &M::name, &M::body, &M::bed), "another name, body or bed");
  part.require(alike(membrane, built, &M::field), "another velocity field");
  part.require(
      alike(membrane, built, &M::closed, &M::sharp, &M::axial_stiffness, &M::strength, &M::contents_friction,
            &M::gauge_length, &M::half_size, &M::bed_friction, &M::shear, &M::wall_friction, &M::roughness,
            &M::drag_coefficient, &M::fluid_density, &M::permeance, &M::permeance_strains, &M::permeance_factors),
      "other settings");
  part.require(alike(membrane, built, &M::x, &M::v, &M::mass, &M::rest_length, &M::strain, &M::tension, &M::load,
                     &M::caught, &M::share, &M::contents_pressure, &M::water_pressure, &M::water_shear, &M::bed_shear,
                     &M::bed_pressure, &M::pore_pressure, &M::seepage) &&
                   membrane.gauge.sums.size() == built.gauge.sums.size(),
               "another number of nodes or of their quantities");
  if constexpr (Dim == 3) {
    using T = MembraneTriangles<3>;
    part.require(alike(membrane.triangles, built.triangles, &T::fabric, &T::poisson_ratio, &T::weft_stiffness,
                       &T::weft_strength, &T::mass_per_area, &T::gauge_pressure, &T::inverse_rest, &T::rest_area,
                       &T::water_shear, &T::cross_tension) &&
                     membrane.triangles.corner == built.triangles.corner &&
                     membrane.triangles.open_edge == built.triangles.open_edge,
                 "other triangles");
  }
  part.require(all_finite(membrane), "a value of a node that is not finite");
  part.require(in_domain<Dim>(layout, membrane.x), "a node outside of the domain");
}

template <int Dim>
void check_rigid(const RigidBody<Dim>& built, const RigidBody<Dim>& rigid) {
  using R = RigidBody<Dim>;
  const Part part("rigid body '" + built.name + "'");
  part.require(alike(rigid, built, &R::name, &R::half_plane, &R::radius, &R::corners), "another name or shape");
  part.require(all_finite(rigid), "a value that is not finite");
}

template <int Dim>
void check_rigid_contact(const State<Dim>& state, const RigidContact<Dim>& built, const RigidContact<Dim>& contact) {
  using C = RigidContact<Dim>;
  const Part part("contact of '" + built.touching + "' with '" + built.rigid + "'");
  part.require(alike(contact, built, &C::touching, &C::rigid, &C::bare, &C::friction, &C::stiffness, &C::damping,
                     &C::reach, &C::pressed_in),
               "another pair or other settings");
  constexpr std::size_t slips = Dim == 2 ? 1 : 3;
  part.require(contact.slip.size() == slips * contact.points.size() && contact.side.size() == contact.points.size(),
               "another number of points than of what is known of them");
  part.require(contact.half_width.size() == contact.reach.size(), "another number of half widths than of particles");
  std::size_t points = contact.reach.size();
  for (const Membrane<Dim>& membrane : state.membranes)
    if (!contact.bare && membrane.name == contact.touching) points = membrane.nodes();
  const auto& ids = contact.points;
  const auto& pieces = contact.piece;
  part.require(pieces.empty() || pieces.size() == ids.size(), "another number of points than of their faces");
  const auto follows = [&](std::size_t i) {
    return ids[i] > ids[i - 1] || (!pieces.empty() && ids[i] == ids[i - 1] && pieces[i] > pieces[i - 1]);
  };
  bool ascending = true;
  for (std::size_t i = 1; i < ids.size(); ++i) ascending = ascending && follows(i);
  part.require(ascending && (ids.empty() || ids.back() < points), "points that are out of order or not there");
  part.require(std::all_of(contact.side.begin(), contact.side.end(), [](int s) { return s >= -1 && s <= 1; }),
               "a point on no side");
  part.require(all_finite(contact), "a value that is not finite");
}

template <int Dim>
void check_anchor(const State<Dim>& state, const Anchor<Dim>& built, const Anchor<Dim>& anchor) {
  using A = Anchor<Dim>;
  const Part part("anchor '" + built.name + "'");
  part.require(alike(anchor, built, &A::name, &A::membrane, &A::line, &A::compliance, &A::length),
               "another membrane or line");
  part.require(anchor.node < find_named(state.membranes, anchor.membrane).nodes(), "a node that is not there");
  part.require(all_finite(anchor), "a value that is not finite");
}

template <int Dim>
void check_membrane_contact(const MembraneContact<Dim>& built, const MembraneContact<Dim>& contact) {
  using C = MembraneContact<Dim>;
  const Part part("contact of '" + built.between[0] + "' with '" + built.between[1] + "'");
  part.require(
      alike(contact, built, &C::between, &C::outward, &C::friction, &C::stiffness, &C::damping, &C::reach, &C::slip),
      "another pair or other settings");
  part.require(all_finite(contact), "a value that is not finite");
}

template <int Dim>
void check_viscous_boundary(const GridLayout<Dim>& layout, const ViscousBoundary<Dim>& built,
                            const ViscousBoundary<Dim>& boundary) {
  using V = ViscousBoundary<Dim>;
  const Part part("viscous boundary '" + built.name + "'");
  part.require(alike(boundary, built, &V::name, &V::field, &V::length, &V::half_size, &V::inwards, &V::impedance_p,
                     &V::impedance_s, &V::spring, &V::x, &V::v, &V::moved, &V::at_start),
               "another name, field, number of points or other settings");
  part.require(all_finite(boundary) && in_domain<Dim>(layout, boundary.x), "a point that is not in the domain");
  for (int a = 0; a < Dim; ++a) part.require(agree(boundary.normal[a], built.normal[a]), "another normal");
}

template <int Dim>
void check_silent_side(const GridLayout<Dim>& layout, const SilentSide& built, const SilentSide& side) {
  using S = SilentSide;
  const Part part("silent side '" + built.name + "'");
  part.require(alike(side, built, &S::name, &S::body, &S::outward, &S::begin, &S::width, &S::rate, &S::surface,
                     &S::gravity, &S::water_beyond, &S::rest_time),
               "another name or other settings");
  const auto rows = static_cast<std::size_t>(layout.stored[1]);
  for (const Array<double>* list : {&side.lasting, &side.flow}) {
    part.require(list->empty() || list->size() == rows, "another number of rows");
    part.require(std::all_of(list->begin(), list->end(), [](double x) { return std::isfinite(x); }),
                 "a value that is not finite");
  }
}

template <int Dim>
void check_tracer(const GridLayout<Dim>& layout, const Tracer<Dim>& built, const Tracer<Dim>& tracer) {
  using T = Tracer<Dim>;
  const Part part("tracer '" + built.name + "'");
  part.require(alike(tracer, built, &T::name, &T::field, &T::body), "another name, body or velocity field");
  part.require(all_finite(tracer), "a value that is not finite");
  for (int a = 0; a < Dim; ++a)  // positions run on across periodic walls
    part.require(
        layout.periodic(a) || (tracer.x[a] >= layout.particle_lower[a] && tracer.x[a] <= layout.particle_upper[a]),
        "a place outside of the domain");
}

/// Bodies are placed by stages that have been entered.
template <int Dim>
void enter_stages(const Scene& scene, const State<Dim>& state, State<Dim>& built) {
  const Part part("stages");
  const std::uint64_t entered = state.stages_entered;
  part.require(entered <= scene.stages.size() && entered >= built.stages_entered, "a stage that the scene has not");
  if (entered == 0) return;
  built.t = scene.stages[entered - 1].from;
  part.require(built.t <= state.t, "a stage that has not begun");
  enter_due_stages(SceneStages(scene), built);
}

template <class List, class Check>
void check_each(const char* name, const List& built, const List& list, Check check) {
  Part(name).require(built.size() == list.size(), "another number than in the scene");
  for (std::size_t i = 0; i < list.size(); ++i) check(built[i], list[i]);
}

template <int Dim>
void check_all(const Scene& scene, State<Dim>& built, const State<Dim>& state) {
  const Part clock("clock");
  clock.require(std::isfinite(state.t) && state.t >= 0, "a time that is not >= 0 and finite");
  clock.require(std::isfinite(state.drift) && std::isfinite(state.damping_rate), "a value that is not finite");
  clock.require(std::isfinite(state.v_max) && state.v_max >= 0, "a largest speed that is not >= 0 and finite");
  enter_stages(scene, state, built);
  const GridLayout<Dim> layout(scene.grid, scene.walls);
  check_each("bodies", built.bodies, state.bodies,
             [&](const auto& a, const auto& b) { check_body(layout, state, a, b); });
  check_each("membranes", built.membranes, state.membranes,
             [&](const auto& a, const auto& b) { check_membrane(layout, a, b); });
  check_each("rigid bodies", built.rigid, state.rigid, check_rigid<Dim>);
  check_each("contacts", built.rigid_contacts, state.rigid_contacts,
             [&](const auto& a, const auto& b) { check_rigid_contact(state, a, b); });
  check_each("contacts", built.membrane_contacts, state.membrane_contacts, check_membrane_contact<Dim>);
  check_each("viscous boundaries", built.viscous_boundaries, state.viscous_boundaries,
             [&](const auto& a, const auto& b) { check_viscous_boundary(layout, a, b); });
  check_each("silent sides", built.silent_sides, state.silent_sides,
             [&](const auto& a, const auto& b) { check_silent_side(layout, a, b); });
  check_each("anchors", built.anchors, state.anchors, [&](const auto& a, const auto& b) { check_anchor(state, a, b); });
  check_each("tracers", built.tracers, state.tracers,
             [&](const auto& a, const auto& b) { check_tracer(layout, a, b); });
}

}  // namespace

template <int Dim>
std::string fault_in_state(const Scene& scene, State<Dim> built, const State<Dim>& state) {
  try {
    check_all(scene, built, state);
  } catch (const Fault& fault) {
    return fault.text;
  }
  return "";
}

template std::string fault_in_state(const Scene&, State<2>, const State<2>&);
template std::string fault_in_state(const Scene&, State<3>, const State<3>&);

}  // namespace geodrop
