// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights as YAC writes them (its attribute `version` is "yac weight file 1.0"): links as in SCRIP,
// but neither a description of the places nor their number, which the caller has to know.
#include <string>

#include "formats/cf_reader.h"
#include "formats/weight_formats.h"
#include "io/bad_value.h"

namespace rondel::formats {

bool is_of_yac(const io::NetcdfReader& file) {
  return io::netcdf_text(file.attributes(), "version").starts_with("yac weight file");
}

WeightFile read_yac(const io::NetcdfReader& file, const WeightReadOptions& options) {
  if (options.num_sources == 0 || options.num_targets == 0) {
    throw io::BadValue(
        "a file of weights of YAC does not say how many sources and targets there are: the grids "
        "are needed as well");
  }
  WeightFile content;
  WeightEntries entries;
  if (const auto* const matrix = file.find("remap_matrix")) {
    if (matrix->shape.size() == 2 && matrix->shape[1] != 1) {
      throw io::BadValue("remap_matrix has " + std::to_string(matrix->shape[1]) +
                         " weights a link where one is needed");
    }
    const auto* const of_fields = file.find("num_links_per_src_field");
    if (of_fields != nullptr && of_fields->shape.size() == 1 && of_fields->shape[0] > 1) {
      throw io::BadValue("the links are of " + std::to_string(of_fields->shape[0]) +
                         " fields of sources where those of one are needed");
    }
    entries = {file.integers(file.require("dst_address")),
               file.integers(file.require("src_address")), meant_numbers(file, *matrix)};
  }
  set_entries(entries, options.num_targets, options.num_sources, options, content);
  if (file.find("fixed_values") != nullptr) {
    content.remarks.emplace_back("targets with fixed values are left out: they have no weights");
  }
  return content;
}

}  // namespace rondel::formats
