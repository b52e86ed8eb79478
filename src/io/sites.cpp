// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What is done with tables of sites, and write_file().
#include <string>

#include "io/atomic_file.h"
#include "rondel/io.h"

namespace rondel {

std::string SiteTable::where(std::size_t site) const {
  const std::uint64_t line = lines.empty() ? first_line + site : lines[site];
  const std::string place = name + (first_line != 0 ? ":" : ": row ") + std::to_string(line);
  return features.empty() ? place : place + ": feature " + std::to_string(features[site]);
}

SiteTable SiteTable::selection(const std::vector<bool>& keep) const {
  SiteTable selected;
  selected.name = name;
  selected.first_line = first_line;
  selected.num_unlocated = num_unlocated;
  for (const Column& column : columns) selected.columns.push_back(column.empty_copy());
  selected.ids = ids.empty_copy();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    selected.sites.push_back(sites[i]);
    if (!positions.empty()) selected.positions.push_back(positions[i]);
    if (!radii_deg.empty()) selected.radii_deg.push_back(radii_deg[i]);
    if (!features.empty()) selected.features.push_back(features[i]);
    selected.lines.push_back(lines.empty() ? first_line + i : lines[i]);
    for (std::size_t c = 0; c < columns.size(); ++c) selected.columns[c].add(columns[c], i);
    if (!ids.ends.empty()) selected.ids.add(ids, i);
  }
  return selected;
}

void write_file(const FileName& name, std::string_view bytes) {
  io::AtomicFile file(name);
  file.write(bytes);
  file.commit();
}

}  // namespace rondel
