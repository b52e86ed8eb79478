// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "formats/regrid_fields.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rondel::formats {

FieldsOfSide fields_of_side(const FileName& in, std::vector<std::string>&& names,
                            const RegridSide& side) {
  auto [file, variable] = file_and_variable(in);
  std::vector<std::string> wanted = std::move(names);
  if (wanted.empty() && !variable.empty()) wanted.push_back(variable);
  FieldsOfSide opened;
  if (side.num_places() <= max_compared) opened.places = side.places();
  opened.file = std::make_unique<FieldFile>(
      file, wanted, side.num_places(), ReadOptions{}, side.shape(), WantedPlaces{opened.places},
      FieldExtras{.has_others = true, .has_positions = false});
  return opened;
}

std::vector<std::string> remarks_of(const RegridSide& source, const RegridSide& target,
                                    const FieldSet& fields) {
  std::vector<std::string> all;
  for (const auto& remarks : {source.remarks(), target.remarks(), fields.remarks}) {
    for (const std::string& remark : remarks) {
      if (std::ranges::count(all, remark) == 0) all.push_back(remark);
    }
  }
  return all;
}

void add_history(const std::string& line, FieldSet& fields) {
  if (line.empty()) return;
  for (auto& [name, text] : fields.attributes) {
    if (name != "history") continue;
    text.insert(0, line + "\n");
    return;
  }
  fields.attributes.emplace_back("history", line);
}

}  // namespace rondel::formats
