// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights as ESMF's offline regridding writes them: "Regrid Interpolation File Format" in
// https://earthsystemmodeling.org/docs/release/latest/ESMF_refdoc/node3.html
//
// Entry k carries `S`(k) times the value of source `col`(k) to target `row`(k), both counted from
// 1; `_a` marks sources, `_b` targets.
#include "formats/cf_reader.h"
#include "formats/weight_formats.h"

namespace rondel::formats {
namespace {

using io::NetcdfType;

// Returns the names of the source's variables.
const SideNames& source_names() {
  static const SideNames names = {"xc_a",          "yc_a", "area_a", "frac_a", "mask_a",
                                  "src_grid_dims", "nv_a", "xv_a",   "yv_a",   true};
  return names;
}
// Returns the names of the target's variables.
const SideNames& target_names() {
  static const SideNames names = {"xc_b",          "yc_b", "area_b", "frac_b", "mask_b",
                                  "dst_grid_dims", "nv_b", "xv_b",   "yv_b",   true};
  return names;
}

// Writes `col` and `row`.
template <typename T>
void write_entries(io::NetcdfWriter& out, const Weights& weights) {
  out.write_values<T>(weights.columns.size(),
                      [&](std::size_t k) { return static_cast<T>(weights.columns[k]) + 1; });
  write_row_numbers<T>(out, weights);
}

}  // namespace

void write_esmf(io::AtomicFile& file, const WeightsToWrite& job) {
  const WeightFile& content = job.content;
  const Weights& weights = content.weights;
  const std::size_t num_sources = weights.num_columns;
  const std::size_t num_targets = weights.num_rows();
  io::NetcdfWriter out(file);
  const std::size_t n_a = out.add_dimension("n_a", num_sources);
  const std::size_t n_b = out.add_dimension("n_b", num_targets);
  const std::size_t n_s = out.add_dimension("n_s", weights.columns.size());
  const std::size_t src_rank =
      out.add_dimension("src_grid_rank", shape_or(content.source, num_sources).size());
  const std::size_t dst_rank =
      out.add_dimension("dst_grid_rank", shape_or(content.target, num_targets).size());
  out.add_attribute("title", "Weights that carry values from sources to targets");
  out.add_attribute("normalization",
                    content.normalization.empty() ? "none" : content.normalization);
  out.add_attribute("map_method", content.method.empty() ? "unknown" : content.method);
  out.add_attribute("conventions", "NCAR-CSM");
  add_own_attributes(out, content);
  add_side(out, source_names(), content.source, num_sources, n_a, src_rank);
  add_side(out, target_names(), content.target, num_targets, n_b, dst_rank);
  // Both lists have one type, which has to count the longer side.
  const NetcdfType index = index_type(std::max(num_sources, num_targets));
  for (const char* name : {"col", "row"}) {
    io::NetcdfVariable entries = variable(name, index, {n_s});
    // Without it UXarray guesses it from the greatest entry, wrongly if the last point has no
    // weight.
    entries.attributes.push_back({"start_index", NetcdfType::int32, {}, {1}});
    out.add_variable(std::move(entries));
  }
  out.add_variable(variable("S", NetcdfType::float64, {n_s}));
  out.begin(job.netcdf);
  write_side(out, source_names(), content.source, num_sources, [](std::size_t) { return 0.0; });
  write_side(out, target_names(), content.target, num_targets,
             [&](std::size_t row) { return fraction_of(weights, row); });
  if (index == NetcdfType::int32) {
    write_entries<std::int32_t>(out, weights);
  } else {
    write_entries<std::int64_t>(out, weights);
  }
  out.write(std::span<const double>(weights.values));
  out.finish();
}

WeightFile read_esmf(const io::NetcdfReader& file, const WeightReadOptions& options) {
  WeightFile content;
  const std::size_t num_sources = dimension_of(file, "n_a");
  const std::size_t num_targets = dimension_of(file, "n_b");
  read_side(file, source_names(), num_sources, content.source);
  read_side(file, target_names(), num_targets, content.target);
  set_entries({file.integers(file.require("row")), file.integers(file.require("col")),
               meant_numbers(file, file.require("S"))},
              num_targets, num_sources, options, content);
  read_own_attributes(file, content);
  return content;
}

}  // namespace rondel::formats
