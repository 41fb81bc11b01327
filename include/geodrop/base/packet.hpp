// A packet: several points side by side, one point a lane. Each function here also has a scalar overload, so that
// one template serves `double` and `Packet`.
//
// The plain GCC vector extension, no intrinsics: the same source serves the x86-64-v3 and the default clone of a
// kernel. Everything is always inlined, because a call would take the packet through memory and out of the clone.
#pragma once

#include <cmath>
#include <cstring>
#include <type_traits>

namespace geodrop {

/// Two AVX2 registers of four lanes. The material laws are long chains of dependent operations; two chains side by
/// side fill the pipelines: Mohr-Coulomb, all points plastic, 7.1 ns a point in 2D and 22.5 in 3D against 9.0 and
/// 29.0 with one register (Zen 4). One vector of 64 bytes was tried: g++ 12 has no select that wide on AVX2 and
/// takes each comparison apart into scalars.
inline constexpr int packet_width = 8;

struct Packet {
  using Half [[gnu::vector_size(32)]] = double;
  Half low, high;

  Packet() = default;
  [[gnu::always_inline]] Packet(Half low_half, Half high_half) : low(low_half), high(high_half) {}
  /// The same value in every lane; implicit, so that `2.0 * packet` reads as it does for double.
  [[gnu::always_inline]] Packet(double value)
      : low(Half{value, value, value, value}), high(Half{value, value, value, value}) {}
};

/// What a comparison of packets gives: all bits set (true) or none, lane by lane.
struct PacketMask {
  using Half = decltype(Packet::Half{} < Packet::Half{});
  Half low, high;
};

[[gnu::always_inline]] inline Packet operator+(Packet a, Packet b) { return {a.low + b.low, a.high + b.high}; }
[[gnu::always_inline]] inline Packet operator-(Packet a, Packet b) { return {a.low - b.low, a.high - b.high}; }
[[gnu::always_inline]] inline Packet operator*(Packet a, Packet b) { return {a.low * b.low, a.high * b.high}; }
[[gnu::always_inline]] inline Packet operator/(Packet a, Packet b) { return {a.low / b.low, a.high / b.high}; }
[[gnu::always_inline]] inline Packet operator-(Packet a) { return {-a.low, -a.high}; }
[[gnu::always_inline]] inline Packet& operator+=(Packet& a, Packet b) { return a = a + b; }
[[gnu::always_inline]] inline Packet& operator*=(Packet& a, Packet b) { return a = a * b; }

[[gnu::always_inline]] inline PacketMask operator<(Packet a, Packet b) { return {a.low < b.low, a.high < b.high}; }
[[gnu::always_inline]] inline PacketMask operator>(Packet a, Packet b) { return {a.low > b.low, a.high > b.high}; }
[[gnu::always_inline]] inline PacketMask operator<=(Packet a, Packet b) { return {a.low <= b.low, a.high <= b.high}; }
[[gnu::always_inline]] inline PacketMask operator>=(Packet a, Packet b) { return {a.low >= b.low, a.high >= b.high}; }
[[gnu::always_inline]] inline PacketMask operator&(PacketMask a, PacketMask b) {
  return {a.low & b.low, a.high & b.high};
}
[[gnu::always_inline]] inline PacketMask operator|(PacketMask a, PacketMask b) {
  return {a.low | b.low, a.high | b.high};
}

/// Reads packet_width doubles (one if R is double); no alignment is asked for.
template <class R>
[[gnu::always_inline]] inline R load(const double* from) {
  if constexpr (std::is_same_v<R, double>) {
    return *from;
  } else {
    // By halves: as one block of 64 bytes g++ copies it over the stack, 2 ns a point.
    Packet::Half low, high;
    std::memcpy(&low, from, sizeof(low));
    std::memcpy(&high, from + packet_width / 2, sizeof(high));
    return {low, high};
  }
}

[[gnu::always_inline]] inline void store(double* to, double value) { *to = value; }
[[gnu::always_inline]] inline void store(double* to, const Packet& lanes) {
  std::memcpy(to, &lanes.low, sizeof(lanes.low));
  std::memcpy(to + packet_width / 2, &lanes.high, sizeof(lanes.high));
}

[[gnu::always_inline]] inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
[[gnu::always_inline]] inline Packet select(PacketMask mask, Packet yes, Packet no) {
  return {mask.low ? yes.low : no.low, mask.high ? yes.high : no.high};
}

/// True if the mask is true in at least one lane.
[[gnu::always_inline]] inline bool any_lane(bool mask) { return mask; }
[[gnu::always_inline]] inline bool any_lane(PacketMask mask) {
  const PacketMask::Half either = mask.low | mask.high;
  return (either[0] | either[1] | either[2] | either[3]) != 0;
}

[[gnu::always_inline]] inline double min(double a, double b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Packet min(Packet a, Packet b) { return select(a < b, a, b); }
[[gnu::always_inline]] inline double max(double a, double b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Packet max(Packet a, Packet b) { return select(a > b, a, b); }
[[gnu::always_inline]] inline double abs(double a) { return std::fabs(a); }
[[gnu::always_inline]] inline Packet abs(Packet a) { return select(a < 0.0, -a, a); }

[[gnu::always_inline]] inline double sqrt(double a) { return __builtin_sqrt(a); }
/// Lane by lane in the source; g++ makes one vsqrtpd of each half, given -fno-math-errno.
[[gnu::always_inline]] inline Packet sqrt(Packet a) {
  const auto root = [](Packet::Half h) __attribute__((always_inline)) {
    return Packet::Half{__builtin_sqrt(h[0]), __builtin_sqrt(h[1]), __builtin_sqrt(h[2]), __builtin_sqrt(h[3])};
  };
  return {root(a.low), root(a.high)};
}

/// Natural logarithm; NaN where `a` is not positive. Packets to 2 units in the last place of the larger of 1 and the
/// result.
[[gnu::always_inline]] inline double log(double a) { return a > 0 ? __builtin_log(a) : __builtin_nan(""); }
[[gnu::always_inline]] inline Packet::Half log(Packet::Half a) {
  using Bits [[gnu::vector_size(32)]] = long long;
  const Bits bits = __builtin_bit_cast(Bits, a);
  // a = 2^e m: the exponent becomes a double through the lower bits of 2^52, m lies in [1, 2), then in [0.7, 1.42).
  const Bits shifted = ((bits >> 52) & 0x7ff) | 0x4330000000000000;
  const Bits fraction = (bits & 0xfffffffffffff) | 0x3ff0000000000000;
  constexpr double two_52 = 4503599627370496.0, bias = 1023, root_2 = 1.4142135623730951;
  Packet::Half e = __builtin_bit_cast(Packet::Half, shifted) - (two_52 + bias);
  Packet::Half m = __builtin_bit_cast(Packet::Half, fraction);
  const auto high = m > root_2;
  m = high ? 0.5 * m : m;
  e = high ? e + 1.0 : e;
  // ln m = 2 artanh s, |s| < 0.172: the first term left out is 2 s^21 / 21 < 1e-17.
  const Packet::Half s = (m - 1.0) / (m + 1.0), q = s * s;
  Packet::Half series = q * (1.0 / 19) + 1.0 / 17;
  series = series * q + 1.0 / 15;
  series = series * q + 1.0 / 13;
  series = series * q + 1.0 / 11;
  series = series * q + 1.0 / 9;
  series = series * q + 1.0 / 7;
  series = series * q + 1.0 / 5;
  series = series * q + 1.0 / 3;
  constexpr double ln_2 = 0.6931471805599453;
  const Packet::Half result = e * ln_2 + (2.0 * s + 2.0 * s * q * series);
  const Packet::Half nothing = {__builtin_nan(""), __builtin_nan(""), __builtin_nan(""), __builtin_nan("")};
  return a > 0.0 ? result : nothing;
}
[[gnu::always_inline]] inline Packet log(Packet a) { return {log(a.low), log(a.high)}; }

}  // namespace geodrop
