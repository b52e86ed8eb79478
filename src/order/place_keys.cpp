// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Keys of many sites, by loops without branches: the sites come in any order, so which face of the
// cube is next, or which quadrant, cannot be predicted; and loops without branches become vector
// code.
#include "order/place_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "order/cube_position.h"
#include "system/wide_vectors.h"

namespace rondel::order {
namespace {

using system::choose;
using system::mask;

constexpr std::size_t batch_size = 128;
constexpr std::uint32_t levels = (std::uint32_t{1} << high_levels) - 1;  // one bit each

// Positions on the cube, by their bits for the levels of the high key.
struct Positions {
  alignas(64) std::array<std::uint32_t, batch_size> face;
  alignas(64) std::array<std::uint32_t, batch_size> u;
  alignas(64) std::array<std::uint32_t, batch_size> v;
  alignas(64) std::array<std::uint32_t, batch_size> low_u;  // the same for the low key
  alignas(64) std::array<std::uint32_t, batch_size> low_v;
  alignas(
      64) std::array<std::uint32_t, batch_size> is_unsure;  // not 0: rounding may have changed it
};

// Rounded differences from a center would give sites on one ray different keys.
bool is_rounding_harmless(Model model, const Point& center) {
  return model == Model::weighted || center == Point{};
}

// Signed, as most machines convert no other integers quickly.
RONDEL_ALWAYS_INLINE inline std::int32_t truncate(double value) {
  return static_cast<std::int32_t>(value);
}

// cube_position() for a batch, its table of faces turned into choices.
//
// Unsure: with exact differences, x/length + 1 would be off by at most 5 * 2^-53 (two differences,
// the quotient, the sum, whose value is at most 2), so its integer part in units of 2^-27 is right
// unless a whole number is within 5 * 2^-26; and the longest coordinate is the same unless another
// one is within a factor 1 - 2^-52 of it.
template <bool finds_unsure>
RONDEL_ALWAYS_INLINE inline void set_positions(const Point* sites, const Point& center,
                                               std::size_t size, Positions& positions) {
  constexpr double largest = std::numeric_limits<double>::max();
  constexpr double half_range = 0x1p27;      // high_levels - 1
  constexpr double low_range = 0x1p24;       // low_levels
  constexpr double last = 0x1p28 - 0x1p-24;  // what position_bits hold
  constexpr double margin = 0x1p-23;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = sites[i].x - center.x;
    const double y = sites[i].y - center.y;
    const double z = sites[i].z - center.z;
    const std::uint64_t along_y = mask(std::abs(x) < std::abs(y));
    const double longer = choose(along_y, std::abs(y), std::abs(x));
    const double shorter = choose(along_y, std::abs(x), std::abs(y));
    const std::uint64_t along_z = mask(longer < std::abs(z));
    const double longest = choose(along_z, std::abs(z), longer);
    const std::uint64_t back = mask(choose(along_z, z, choose(along_y, y, x)) < 0);
    const std::uint64_t is_valid = mask(longest > 0) & mask(longest <= largest);

    const double length = choose(is_valid, longest, 1);
    const double face = choose(along_z, choose(back, 1, 5),
                               choose(along_y, choose(back, 0, 3), choose(back, 4, 2)));
    const double across_u = choose(along_z, x, choose(along_y, -x, choose(back, z, y)));
    const double across_v =
        choose(along_z, choose(back, y, -y), choose(along_y, z, choose(back, -y, z)));
    const double u = (choose(is_valid, across_u, -1) / length + 1) * half_range;
    const double v = (choose(is_valid, across_v, -1) / length + 1) * half_range;
    const double cut_u = choose(mask(u < last), u, last);
    const double cut_v = choose(mask(v < last), v, last);
    const std::int32_t whole_u = truncate(cut_u);
    const std::int32_t whole_v = truncate(cut_v);
    positions.face[i] = static_cast<std::uint32_t>(truncate(choose(is_valid, face, 0)));
    positions.u[i] = static_cast<std::uint32_t>(whole_u);
    positions.v[i] = static_cast<std::uint32_t>(whole_v);
    positions.low_u[i] = static_cast<std::uint32_t>(truncate((cut_u - whole_u) * low_range));
    positions.low_v[i] = static_cast<std::uint32_t>(truncate((cut_v - whole_v) * low_range));
    if constexpr (!finds_unsure) continue;

    const double from_u = std::abs(u - whole_u - 0.5);
    const double from_v = std::abs(v - whole_v - 0.5);
    const double near = longest * (1 - 0x1p-50);
    const std::uint64_t is_sure = mask(from_u < 0.5 - margin) & mask(from_v < 0.5 - margin) &
                                  mask(shorter < near) & is_valid &
                                  (mask(longer < near) ^ mask(std::abs(z) < near));
    positions.is_unsure[i] = static_cast<std::uint32_t>(~is_sure);
  }
}

// Does the same with a table of faces, which is faster than choices by masks if vectors are narrow.
// The keys are the same for vectors of any width.
void set_positions_by_table(std::span<const Point> sites, const Point& center,
                            Positions& positions) {
  constexpr std::uint64_t low_bits = (std::uint64_t{1} << low_levels) - 1;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const CubePosition p = cube_position(sites[i], center);
    positions.face[i] = p.face;
    positions.u[i] = static_cast<std::uint32_t>(p.u >> low_levels);
    positions.v[i] = static_cast<std::uint32_t>(p.v >> low_levels);
    positions.low_u[i] = static_cast<std::uint32_t>(p.u & low_bits);
    positions.low_v[i] = static_cast<std::uint32_t>(p.v & low_bits);
  }
}

// Moves the lower 16 bits to the even places.
RONDEL_ALWAYS_INLINE inline std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 8) & 0x00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f;
  bits = (bits | bits << 2) & 0x33333333;
  return (bits | bits << 1) & 0x55555555;
}

// The states (s, t) of hilbert_table, s for exchanged and t for turned around, at all levels of a
// position at once: bit k is the state before the level of bit k.
//
// With x = u ^ v at a level, its rank has the bits a = u ^ s x ^ t and x, and the table's change of
// state comes to maps that are affine over the field of two elements:
//
//     x = 1:  s' = t + u,        t' = s + u
//     x = 0:  s' = s + t + !u,   t' = t
//
// Let (p, q) be (s, t) before every other level, from the first one on, and (t, s) before the rest.
// Then x = 1 adds (u, u), and x = 0 multiplies by w or by w^2 = 1 + w and adds (0, !u) or (!u, 0),
// where w (p, q) = (q, p + q): the multiplication of the field of four elements. So a run of levels
// is a map z -> (a + b w) z + (p, q), and runs are composed in any grouping: doubling the runs five
// times gives all levels their prefix.
struct Runs {
  std::uint32_t a, b, p, q;
};

RONDEL_ALWAYS_INLINE inline void prepend(Runs& runs, int length) {
  const Runs before = {(runs.a >> length) | (levels ^ (levels >> length)), runs.b >> length,
                       runs.p >> length, runs.q >> length};
  const Runs after = runs;
  runs.p ^= (after.a & before.p) ^ (after.b & before.q);
  runs.q ^= (after.a & before.q) ^ (after.b & (before.p ^ before.q));
  runs.a = (after.a & before.a) ^ (after.b & before.b);
  runs.b = (after.a & before.b) ^ (after.b & (before.a ^ before.b));
}

constexpr std::uint32_t even_levels = 0x0aaaaaaa;  // the first level, bit 27, and every other one

RONDEL_ALWAYS_INLINE inline Runs runs_of(std::uint32_t u, std::uint32_t x) {
  const std::uint32_t not_x = ~x & levels;
  Runs runs = {x | (not_x & ~even_levels), not_x, (x & u) | (not_x & ~u & ~even_levels),
               (x & u) | (not_x & ~u & even_levels)};
  prepend(runs, 1);
  prepend(runs, 2);
  prepend(runs, 4);
  prepend(runs, 8);
  prepend(runs, 16);
  return runs;
}

// The ranks of all levels, from the states (p, q) before them.
RONDEL_ALWAYS_INLINE inline std::uint64_t ranks(std::uint32_t u, std::uint32_t x, std::uint32_t p,
                                                std::uint32_t q) {
  constexpr int half = high_levels / 2;
  constexpr std::uint32_t lower_half = (std::uint32_t{1} << half) - 1;
  const std::uint32_t exchange = (p ^ q) & ~even_levels;
  const std::uint32_t a = u ^ ((p ^ exchange) & x) ^ q ^ exchange;
  const std::uint32_t upper = spread(a >> half) << 1 | spread(x >> half);
  const std::uint32_t lower = spread(a & lower_half) << 1 | spread(x & lower_half);
  return std::uint64_t{upper} << high_levels | lower;
}

// hilbert_key() of the positions. The low levels are treated as upper ones of another position,
// except that they begin where the high levels end.
template <bool has_low>
RONDEL_ALWAYS_INLINE inline void set_keys(const Positions& positions, std::size_t size,
                                          std::uint64_t* keys, std::uint64_t* low_keys) {
  constexpr int unused = high_levels - low_levels;
  constexpr std::uint32_t first_level = std::uint32_t{1} << (high_levels - 1);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t u = positions.u[i];
    const std::uint32_t x = u ^ positions.v[i];
    const Runs high = runs_of(u, x);
    keys[i] = std::uint64_t{positions.face[i]} << (2 * high_levels) |
              ranks(u, x, high.p >> 1, high.q >> 1);
    if constexpr (!has_low) continue;

    const std::uint32_t low_u = positions.low_u[i] << unused;
    const std::uint32_t low_x = low_u ^ (positions.low_v[i] << unused);
    const Runs low = runs_of(low_u, low_x);
    const std::uint32_t s = 0 - (high.p & 1);
    const std::uint32_t t = 0 - (high.q & 1);
    const std::uint32_t p = low.p ^ (low.a & s) ^ (low.b & t);
    const std::uint32_t q = low.q ^ (low.a & t) ^ (low.b & (s ^ t));
    low_keys[i] =
        ranks(low_u, low_x, p >> 1 | (s & first_level), q >> 1 | (t & first_level)) >> (2 * unused);
  }
}

}  // namespace

CubePosition place_position(const Point& p, Model model, const Point& center) {
  return is_rounding_harmless(model, center) ? cube_position(p, center)
                                             : exact_cube_position(p, center);
}

HilbertKey place_key(const Point& p, Model model, const Point& center) {
  return hilbert_key(place_position(p, model, center));
}

namespace {

// low_keys may be nullptr.
using KeysOfBatch = void (*)(std::span<const Point> sites, const Point& center, std::uint64_t* keys,
                             std::uint64_t* low_keys);

void keys_of_rounded(std::span<const Point> sites, const Point& center, std::uint64_t* keys,
                     std::uint64_t* low_keys) {
  Positions positions;
  const bool is_wide = system::has_wide_vectors();
  if (!is_wide) set_positions_by_table(sites, center, positions);
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    if (is_wide) set_positions<false>(sites.data(), center, sites.size(), positions);
    if (low_keys == nullptr) {
      set_keys<false>(positions, sites.size(), keys, nullptr);
    } else {
      set_keys<true>(positions, sites.size(), keys, low_keys);
    }
  });
}

void keys_of_exact(std::span<const Point> sites, const Point& center, std::uint64_t* keys,
                   std::uint64_t* low_keys) {
  Positions positions;
  system::with_wide_vectors([&]() RONDEL_ALWAYS_INLINE {
    set_positions<true>(sites.data(), center, sites.size(), positions);
    set_keys<false>(positions, sites.size(), keys, nullptr);
  });
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (positions.is_unsure[i] == 0 && low_keys == nullptr) continue;
    const HilbertKey key = hilbert_key(exact_cube_position(sites[i], center));
    keys[i] = key.high;
    if (low_keys != nullptr) low_keys[i] = key.low;
  }
}

}  // namespace

void place_keys(std::span<const Point> sites, Model model, const Point& center,
                std::span<std::uint64_t> keys, std::span<std::uint64_t> low_keys) {
  const KeysOfBatch work = is_rounding_harmless(model, center) ? keys_of_rounded : keys_of_exact;
  for (std::size_t i = 0; i < sites.size(); i += batch_size) {
    work(sites.subspan(i, std::min(batch_size, sites.size() - i)), center, keys.data() + i,
         low_keys.empty() ? nullptr : low_keys.data() + i);
  }
}

}  // namespace rondel::order
