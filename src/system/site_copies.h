// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Copies of sites, in memory that something else will need later.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "rondel/types.h"

namespace rondel::system {

class SiteCopies {
 public:
  // Without memory: there are no copies.
  SiteCopies() = default;
  // In the memory of these elements, or none if there are none.
  template <class T>
  explicit SiteCopies(std::span<T> elements) : memory_(std::as_writable_bytes(elements)) {}

  [[nodiscard]] bool is_empty() const { return memory_.empty(); }

  // Bytes are copied, as the memory may have been made for other objects.
  void set(std::size_t i, const Point& site) const {
    std::memcpy(memory_.data() + i * bytes_of_site, &site, bytes_of_site);
  }
  // Copies the sites first, first + 1, ...
  void get(std::size_t first, std::span<Point> sites) const {
    std::memcpy(sites.data(), memory_.data() + first * bytes_of_site, sites.size() * bytes_of_site);
  }
  // The sites from ... from+size-1 become the sites to ... to+size-1.
  void move(std::size_t from, std::size_t size, std::size_t to) const {
    std::memmove(memory_.data() + to * bytes_of_site, memory_.data() + from * bytes_of_site,
                 size * bytes_of_site);
  }
  // The copies of sites first, first + 1, ... as copies 0, 1, ...
  [[nodiscard]] SiteCopies from(std::size_t first) const {
    return is_empty() ? *this : SiteCopies(memory_.subspan(first * bytes_of_site));
  }

 private:
  static constexpr std::size_t bytes_of_site = sizeof(Point);

  std::span<std::byte> memory_;
};

}  // namespace rondel::system
