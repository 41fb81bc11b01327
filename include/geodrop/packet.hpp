// A packet: several points side by side in one register, one point a lane. Each function here also has a scalar
// overload, so that one template serves `double` and `Packet`.
//
// The plain GCC vector extension, no intrinsics: the same source serves the x86-64-v3 and the default clone of a
// kernel. Everything is always inlined, because a call would take the packet through memory and out of the clone.
#pragma once

#include <cmath>
#include <cstring>
#include <type_traits>

namespace geodrop {

/// Four lanes, one AVX2 register. Eight were tried: g++ 12 has no eight-lane select on AVX2 and takes each
/// comparison apart into scalars (8 vblendvpd on xmm for one select).
inline constexpr int packet_width = 4;
using Packet [[gnu::vector_size(packet_width * sizeof(double))]] = double;
/// What a comparison of packets gives: all bits set (true) or none, lane by lane.
using PacketMask = decltype(Packet{} < Packet{});

/// The same value in every lane.
template <class R>
[[gnu::always_inline]] inline R broadcast(double value) {
  if constexpr (std::is_same_v<R, double>) {
    return value;
  } else {
    return Packet{value, value, value, value};
  }
}

/// Reads packet_width doubles (one if R is double); no alignment is asked for.
template <class R>
[[gnu::always_inline]] inline R load(const double* from) {
  R lanes;
  std::memcpy(&lanes, from, sizeof(R));
  return lanes;
}

template <class R>
[[gnu::always_inline]] inline void store(double* to, const R& lanes) {
  std::memcpy(to, &lanes, sizeof(R));
}

[[gnu::always_inline]] inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
[[gnu::always_inline]] inline Packet select(PacketMask mask, Packet yes, Packet no) { return mask ? yes : no; }

/// True if the mask is true in at least one lane.
[[gnu::always_inline]] inline bool any(bool mask) { return mask; }
[[gnu::always_inline]] inline bool any(PacketMask mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }

[[gnu::always_inline]] inline double min(double a, double b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Packet min(Packet a, Packet b) { return a < b ? a : b; }
[[gnu::always_inline]] inline double max(double a, double b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Packet max(Packet a, Packet b) { return a > b ? a : b; }
[[gnu::always_inline]] inline double abs(double a) { return std::fabs(a); }
[[gnu::always_inline]] inline Packet abs(Packet a) { return a < 0.0 ? -a : a; }

[[gnu::always_inline]] inline double sqrt(double a) { return __builtin_sqrt(a); }
/// One vsqrtpd: g++ joins the lanes again, given -fno-math-errno.
[[gnu::always_inline]] inline Packet sqrt(Packet a) {
  return Packet{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3])};
}

}  // namespace geodrop
