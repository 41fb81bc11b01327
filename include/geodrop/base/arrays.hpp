// Structures of arrays: an array for each number of a point, and the lists of fields that go with them. A field stands
// once, as a member of its owner and as an entry of the owner's list, which fields_of(owner) gives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <tuple>
#include <type_traits>
#include <vector>

namespace geodrop {

/// Number of stored components of a symmetric tensor; plane strain keeps ZZ.
template <int Dim>
inline constexpr int stress_components = Dim == 2 ? 4 : 6;

/// Arrays that kernels stream through start on a cache line.
template <class T>
struct CacheAlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  CacheAlignedAllocator() = default;
  template <class U>
  CacheAlignedAllocator(const CacheAlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const CacheAlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using Array = std::vector<T, CacheAlignedAllocator<T>>;

/// A field of an owner: an Array, or one Array for each component.
template <unsigned field_roles, class Owner, class Values>
struct FieldEntry {
  static constexpr unsigned roles = field_roles;
  const char* name;
  const char* unit;
  Values Owner::*values;
};

template <unsigned roles, class Owner, class Values>
constexpr FieldEntry<roles, Owner, Values> field(const char* name, const char* unit, Values Owner::*values) {
  return {name, unit, values};
}

/// All fields, whatever their roles.
inline constexpr unsigned any_role = ~0U;

/// Calls f(entry, values) for the fields of an owner that have one of the roles, in the order of its list.
template <unsigned roles, class Owner, class F>
[[gnu::always_inline]] inline void for_each_field(Owner& owner, F&& f) {
  const auto one = [&](const auto& entry) {
    if constexpr ((std::remove_cvref_t<decltype(entry)>::roles & roles) != 0) f(entry, owner.*entry.values);
  };
  std::apply([&](const auto&... entry) { (one(entry), ...); }, fields_of(owner));
}

/// Calls f(array) for a field, or for each of its components.
template <class Values, class F>
[[gnu::always_inline]] inline void for_each_component(Values& values, F&& f) {
  if constexpr (requires { values.front().size(); })
    for (auto& component : values) f(component);
  else
    f(values);
}

/// Calls f(array) for each array of the fields that have one of the roles.
template <unsigned roles, class Owner, class F>
[[gnu::always_inline]] inline void for_each_array(Owner& owner, F&& f) {
  for_each_field<roles>(owner, [&](const auto&, auto& values) { for_each_component(values, f); });
}

/// Number of arrays of the fields of a list that have one of the roles.
template <unsigned roles, class... Owner, class... Values, unsigned... entry_roles>
constexpr std::size_t count_arrays(const std::tuple<FieldEntry<entry_roles, Owner, Values>...>&) {
  return (((entry_roles & roles) != 0 ? sizeof(Values) / sizeof(Array<double>) : 0) + ... + 0);  // NOLINT: of vectors
}

/// What a particle's field takes part in.
namespace particle_role {
enum : unsigned {
  per_particle = 1,    ///< an entry for each particle, in their present order
  by_id = 2,           ///< likewise, in the order of the start: never sorted
  by_slab = 4,         ///< written by sort_particles
  rate = 8,            ///< zero at rest
  scattered = 16,      ///< read by particles_to_grid
  gathered = 32,       ///< read by grid_to_particles or, but for the affine rate that it streams, written
  shown = 64,          ///< in frames as it is; of bodies without it: 0
  shown_if_any = 128,  ///< likewise, if any body has it
  every_body = 256     ///< whatever its law
};
}  // namespace particle_role

}  // namespace geodrop
