// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each list of areas is sorted by row when it is added; write() merges the lists, so that no more
// than a part of each is in memory.

#include "distributed/area_results.h"

#include <algorithm>

#include "distributed/merge_by_row.h"
#include "io/binary.h"

namespace rondel::distributed {

AreaResults::AreaResults(const std::string& path, const std::string& scratch)
    : array_(path), scratch_(scratch) {}

void AreaResults::reserve(std::uint64_t num_sites) {
  array_.reserve(sizeof(double) * num_sites);
  scratch_.reserve(sizeof(AreaRow) * num_sites);
}

void AreaResults::add(std::span<const std::uint64_t> rows, std::span<const double> areas) {
  std::vector<AreaRow> list;
  list.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) list.push_back({rows[i], areas[i]});
  std::ranges::sort(list, {}, &AreaRow::row);
  scratch_.write(sizeof(AreaRow) * begin_.back(), std::span<const AreaRow>(list));
  begin_.push_back(begin_.back() + list.size());
}

void AreaResults::write(std::uint64_t num_sites, std::uint64_t first_row) {
  array_.begin(real_number, {num_sites});
  std::vector<double> buffer;
  std::uint64_t next_row = first_row;
  const auto put = [&](double area) {
    buffer.push_back(area);
    ++next_row;
    if (buffer.size() < std::size_t{1} << 16U) return;
    array_.write(io::NumberBytes(buffer));
    buffer.clear();
  };
  std::vector<std::uint64_t> sizes;
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i) sizes.push_back(begin_[i + 1] - begin_[i]);
  const auto read = [&](std::size_t list, std::uint64_t first, std::span<AreaRow> areas) {
    scratch_.read(sizeof(AreaRow) * (begin_[list] + first), areas);
  };
  merge_by_row<AreaRow>(sizes, read, [&](const AreaRow& area) {
    while (next_row < area.row) put(0);
    put(area.area);
  });
  while (next_row < first_row + num_sites) put(0);
  array_.write(io::NumberBytes(buffer));
}

}  // namespace rondel::distributed
