// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>

#include "order/spatial_order.h"
#include "system/hash.h"

namespace rondel::order {
namespace {

std::uint64_t hash_of(const Point& p, std::uint64_t seed) {
  return system::hash_of(p, seed) * 0xff51afd7ed558ccdU;
}

class Bits {
 public:
  explicit Bits(int log_size) : shift_(64 - log_size), words_((std::size_t{1} << log_size) / 64) {}

  [[nodiscard]] bool test(std::uint64_t hash) const {
    return (words_[hash >> shift_ >> 6] >> (hash >> shift_ & 63) & 1) != 0;
  }
  void set(std::uint64_t hash) {
    words_[hash >> shift_ >> 6] |= std::uint64_t{1} << (hash >> shift_ & 63);
  }

 private:
  int shift_;
  std::vector<std::uint64_t> words_;
};

// The sites that share their bit of the hash with another one: one set of bits tells which
// values were seen, another which were seen twice.
std::vector<Index> sharing_a_bit(std::span<const Point> sites, std::span<const Index> listed,
                                 std::uint64_t seed) {
  // 8 to 16 bits for each site: 6 to 12 % of them share one by chance.
  const int log_size = std::max(6, static_cast<int>(std::bit_width(listed.size())) + 3);
  Bits seen(log_size);
  Bits twice(log_size);
  for (const Index i : listed) {
    const std::uint64_t hash = hash_of(sites[i], seed);
    if (seen.test(hash)) twice.set(hash);
    seen.set(hash);
  }
  std::vector<Index> result;
  for (const Index i : listed) {
    if (twice.test(hash_of(sites[i], seed))) result.push_back(i);
  }
  return result;
}

}  // namespace

// Few sites share bits of two hashes by chance; these are sorted.
std::vector<Duplicate> find_duplicates(std::span<const Point> sites,
                                       std::span<const Index> listed) {
  auto suspects = sharing_a_bit(sites, sharing_a_bit(sites, listed, 0), 1);
  std::ranges::sort(suspects, [&](Index i, Index j) {
    const Point& p = sites[i];
    const Point& q = sites[j];
    return std::tie(p.x, p.y, p.z, i) < std::tie(q.x, q.y, q.z, j);
  });
  std::vector<Duplicate> duplicates;
  for (std::size_t i = 1, first = 0; i < suspects.size(); ++i) {
    if (sites[suspects[i]] == sites[suspects[first]]) {
      duplicates.push_back({suspects[i], suspects[first]});
    } else {
      first = i;
    }
  }
  std::ranges::sort(duplicates, {}, &Duplicate::site);
  return duplicates;
}

}  // namespace rondel::order
