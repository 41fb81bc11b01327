// One list of all members of a state, walked by the checkpoint's writer, its reader and the hash.
//
// Fields of particles follow from their list (fields.hpp). Other members are named by structured bindings: a member
// that is added to the state and not here does not compile. What numbers or counts something is judged in
// step/check_resumable as well.
//
// An archive has `bytes(pointer, count)` for plain data, and `length(n, bytes)`, which is told the present length of a
// list and the least that each item takes, and answers the length that the list shall have. One that reads also has
// `refuse(text)`, which throws.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <geodrop/state/state.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>

namespace geodrop {

template <class T>
inline constexpr bool is_body = false;
template <int Dim>
inline constexpr bool is_body<Body<Dim>> = true;
template <class T>
inline constexpr bool is_membrane = false;
template <int Dim>
inline constexpr bool is_membrane<Membrane<Dim>> = true;
template <class T>
inline constexpr bool is_membrane_triangles = false;
template <int Dim>
inline constexpr bool is_membrane_triangles<MembraneTriangles<Dim>> = true;
template <class T>
inline constexpr bool is_tension_gauge = false;
template <int Dim>
inline constexpr bool is_tension_gauge<TensionGauge<Dim>> = true;
template <class T>
inline constexpr bool is_rigid_body = false;
template <int Dim>
inline constexpr bool is_rigid_body<RigidBody<Dim>> = true;
template <class T>
inline constexpr bool is_rigid_contact = false;
template <int Dim>
inline constexpr bool is_rigid_contact<RigidContact<Dim>> = true;
template <class T>
inline constexpr bool is_membrane_contact = false;
template <int Dim>
inline constexpr bool is_membrane_contact<MembraneContact<Dim>> = true;
template <class T>
inline constexpr bool is_anchor = false;
template <int Dim>
inline constexpr bool is_anchor<Anchor<Dim>> = true;
template <class T>
inline constexpr bool is_rare_list = false;
template <class T>
inline constexpr bool is_rare_list<RareList<T>> = true;
template <class T>
inline constexpr bool is_viscous_boundary = false;
template <int Dim>
inline constexpr bool is_viscous_boundary<ViscousBoundary<Dim>> = true;
template <class T>
inline constexpr bool is_tracer = false;
template <int Dim>
inline constexpr bool is_tracer<Tracer<Dim>> = true;

/// References to the listed fields of an owner, const if it is.
template <class Owner>
auto listed_fields(Owner& owner) {
  return std::apply([&](const auto&... entry) { return std::tie(owner.*entry.values...); }, fields_of(owner));
}

template <class Triangles>
auto triangle_members(Triangles& triangles) {
  if constexpr (std::is_same_v<std::remove_const_t<Triangles>, MembraneTriangles<2>>) {
    return std::tie();
  } else {
    auto& [fabric, poisson_ratio, weft_stiffness, weft_strength, mass_per_area, gauge_pressure, corner, inverse_rest,
           rest_area, water_shear, cross_tension, open_edge] = triangles;
    return std::tie(fabric, poisson_ratio, weft_stiffness, weft_strength, mass_per_area, gauge_pressure, corner,
                    inverse_rest, rest_area, water_shear, cross_tension, open_edge);
  }
}

/// References to all members of a part of the state, const if the part is.
template <class Part>
auto members(Part& part) {
  using Plain = std::remove_const_t<Part>;
  if constexpr (is_body<Plain>) {
    using Settings = std::conditional_t<std::is_const_v<Part>, const BodySettings, BodySettings>;
    return std::tuple_cat(members<Settings>(part), listed_fields(part));
  } else if constexpr (std::is_same_v<Plain, BodySettings>) {
    auto& [name, material_name, material, field, pressure, implicit_pores, shift, shift_speed, half_size, enclosed,
           unit_weight, weightless_level] = part;
    return std::tie(name, material_name, material, field, pressure, implicit_pores, shift, shift_speed, half_size,
                    enclosed, unit_weight, weightless_level);
  } else if constexpr (requires { fields_of(part); }) {
    return listed_fields(part);
  } else if constexpr (is_membrane<Plain>) {
    auto& [name, body, field, closed, sharp, axial_stiffness, strength, contents_friction, gauge_length, half_size, x,
           v, mass, rest_length, strain, tension, gauge, load, share, contents_pressure, bed, bed_friction, shear,
           wall_friction, roughness, drag_coefficient, fluid_density, caught, water_pressure, water_shear, bed_shear,
           bed_pressure, permeance, permeance_strains, permeance_factors, pore_pressure, seepage, triangles] = part;
    return std::tie(name, body, field, closed, sharp, axial_stiffness, strength, contents_friction, gauge_length,
                    half_size, x, v, mass, rest_length, strain, tension, gauge, load, share, contents_pressure, bed,
                    bed_friction, shear, wall_friction, roughness, drag_coefficient, fluid_density, caught,
                    water_pressure, water_shear, bed_shear, bed_pressure, permeance, permeance_strains,
                    permeance_factors, pore_pressure, seepage, triangles);
  } else if constexpr (is_membrane_triangles<Plain>) {
    return triangle_members(part);
  } else if constexpr (is_tension_gauge<Plain>) {
    auto& [windows, sums, now, now_at, peak, peak_time, peak_at] = part;
    return std::tie(windows, sums, now, now_at, peak, peak_time, peak_at);
  } else if constexpr (is_rigid_body<Plain>) {
    auto& [name, half_plane, from, to, normal, radius, centre, moving, present, moved, angle, displacement, angle_rate,
           velocity, corners] = part;
    return std::tie(name, half_plane, from, to, normal, radius, centre, moving, present, moved, angle, displacement,
                    angle_rate, velocity, corners);
  } else if constexpr (is_anchor<Plain>) {
    auto& [name, membrane, node, line, to, compliance, length, stretch, force] = part;
    return std::tie(name, membrane, node, line, to, compliance, length, stretch, force);
  } else if constexpr (is_rigid_contact<Plain>) {
    auto& [touching, rigid, bare, friction, stiffness, damping, reach, half_width, points, slip, side, normal_force,
           friction_force, normal_sum, friction_sum, friction_work, damping_work, driving_work, piece, pressed_in] =
        part;
    return std::tie(touching, rigid, bare, friction, stiffness, damping, reach, half_width, points, slip, side,
                    normal_force, friction_force, normal_sum, friction_sum, friction_work, damping_work, driving_work,
                    piece, pressed_in);
  } else if constexpr (is_membrane_contact<Plain>) {
    auto& [between, outward, friction, stiffness, damping, reach, slip, force, normal_force] = part;
    return std::tie(between, outward, friction, stiffness, damping, reach, slip, force, normal_force);
  } else if constexpr (std::is_same_v<Plain, Relaxation>) {
    auto& [kinetic, kinetic_largest, out_of_balance_largest, initial_potential, kinetic_ratio, out_of_balance_ratio,
           steps, cycles, cycles_at_rest] = part;
    return std::tie(kinetic, kinetic_largest, out_of_balance_largest, initial_potential, kinetic_ratio,
                    out_of_balance_ratio, steps, cycles, cycles_at_rest);
  } else if constexpr (std::is_same_v<Plain, EnergyBudget>) {
    auto& [begun, stages, t, held, potential, fallen, driven] = part;
    return std::tie(begun, stages, t, held, potential, fallen, driven);
  } else if constexpr (is_viscous_boundary<Plain>) {
    auto& [name, field, normal, length, half_size, inwards, impedance_p, impedance_s, spring, x, v, moved, at_start] =
        part;
    return std::tie(name, field, normal, length, half_size, inwards, impedance_p, impedance_s, spring, x, v, moved,
                    at_start);
  } else if constexpr (std::is_same_v<Plain, SilentSide>) {
    auto& [name, body, outward, begin, width, rate, surface, gravity, water_beyond, rest_time, lasting, flow] = part;
    return std::tie(name, body, outward, begin, width, rate, surface, gravity, water_beyond, rest_time, lasting, flow);
  } else if constexpr (is_tracer<Plain>) {
    auto& [name, x, v, initial_x, field, body] = part;
    return std::tie(name, x, v, initial_x, field, body);
  } else {
    auto& [t, step, drift, v_max, damping_rate, stages_entered, bodies, membranes, rigid, rigid_contacts,
           membrane_contacts, viscous_boundaries, silent_sides, anchors, tracers, relaxation, energy_budget,
           of_this_process] = part;
    return std::tie(t, step, drift, v_max, damping_rate, stages_entered, bodies, membranes, rigid, rigid_contacts,
                    membrane_contacts, viscous_boundaries, silent_sides, anchors, tracers, relaxation, energy_budget);
  }
}

template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<std::remove_const_t<T>> || std::is_enum_v<std::remove_const_t<T>>;
template <class T>
inline constexpr bool is_fixed_array = false;
template <class T, std::size_t n>
inline constexpr bool is_fixed_array<std::array<T, n>> = true;
template <class T>
concept List = requires(T& list) {
  list.size();
  list.begin();
};

template <class Archive, class T>
void walk(Archive& archive, T& value);

/// The law's index, then its constants.
template <class Archive>
void walk_material(Archive& archive, const Material& material) {
  const std::uint32_t index = static_cast<std::uint32_t>(material.index());
  archive.bytes(&index, 1);
  std::visit([&](const auto& law) { archive.bytes(constants_of(law).data(), constants_of(law).size()); }, material);
}
template <class Archive>
void walk_material(Archive& archive, Material& material) {
  std::uint32_t index = 0;
  archive.bytes(&index, 1);
  if (index >= std::variant_size_v<Material>)
    return archive.refuse("a material of law number " + std::to_string(index));
  material = blank_law(index);
  const auto read = [&]<class Law>(Law& law) {
    auto constants = constants_of(law);
    archive.bytes(constants.data(), constants.size());
    law = std::bit_cast<Law>(constants);
  };
  std::visit(read, material);
}

/// Items that are lists themselves are read one after the other: a length that a damaged file claims then takes no more
/// memory than the file has items.
template <class Archive, class T>
void walk_list(Archive& archive, T& list) {
  if constexpr (is_rare_list<std::remove_const_t<T>> && requires { Archive::passes_over_empty; })
    if (list.empty()) return;
  using Item = typename T::value_type;
  constexpr std::size_t least_bytes = is_plain<Item> ? sizeof(Item) : sizeof(std::size_t);
  const std::size_t length = archive.length(list.size(), least_bytes);
  if constexpr (is_plain<Item>) {
    if constexpr (!std::is_const_v<T>) list.resize(length);
    archive.bytes(list.data(), length);
  } else if constexpr (std::is_const_v<T>) {
    for (auto& item : list) walk(archive, item);
  } else {
    list.clear();
    for (std::size_t i = 0; i < length; ++i) walk(archive, list.emplace_back());
  }
}

/// Hands every value below `value` to the archive, in a fixed order.
template <class Archive, class T>
void walk(Archive& archive, T& value) {
  using Plain = std::remove_const_t<T>;
  if constexpr (is_plain<T>) {
    archive.bytes(&value, 1);
  } else if constexpr (std::is_same_v<Plain, Material>) {
    walk_material(archive, value);
  } else if constexpr (is_fixed_array<Plain>) {
    for (auto& item : value) walk(archive, item);
  } else if constexpr (List<T>) {
    walk_list(archive, value);
  } else {
    std::apply([&](auto&... member) { (walk(archive, member), ...); }, members(value));
  }
}

}  // namespace geodrop
