// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights as SCRIP wrote them (Jones 1999), one weight a link: what CDO reads. Link k carries
// `remap_matrix`(k, 1) times the value of source `src_address`(k) to target `dst_address`(k), both
// counted from 1. Files with more weights a link (second order) are refused.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/weight_formats.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "system/message_text.h"

namespace rondel::formats {
namespace {

// Returns the names of the variables of a side; `grid` is "src" or "dst".
SideNames names_of(const std::string& grid) {
  const std::string start = grid + "_grid_";
  return {start + "center_lon", start + "center_lat",
          start + "area",       start + "frac",
          start + "imask",      start + "dims",
          start + "corners",    start + "corner_lon",
          start + "corner_lat", false};
}

// Returns one of the methods that programs know by name; they treat all others as weighted means.
std::string known_method(const std::string& method) {
  for (const char* known : {"Conservative", "Bilinear", "Bicubic", "Distance", "Largest"}) {
    if (method.starts_with(known)) return method;
  }
  return method == "conservative" ? "Conservative remapping"
                                  : "Distance weighted avg of nearest neighbors";
}

// Sets content.normalization to lower case, since programs write both cases. Throws BadValue if it
// is none of SCRIP's, and adds a remark if it is missing.
void require_normalization(WeightFile& content) {
  if (content.normalization.empty()) {
    content.remarks.emplace_back(
        "there is no attribute normalization: the weights are taken for those of means");
    return;
  }
  const std::string word = lower_case(without_blanks(content.normalization));
  if (word != "none" && word != "destarea" && word != "fracarea") {
    throw io::BadValue("the attribute normalization is " + io::in_quotes(content.normalization) +
                       R"( where "none", "destarea" or "fracarea" says what the weights are)");
  }
  content.normalization = word;
}

// Turns areas into shares: SCRIP's weights of the normalization "none" are the areas of the pieces
// (Jones, SCRIP Users' Guide 1.5, sections 2.2.3 and 3). Throws BadValue if the area of a target
// with weights is missing.
void divide_by_areas(const io::NetcdfReader& file, WeightFile& content) {
  const bool is_conservative = lower_case(content.method).find("conserv") != std::string::npos;
  if (!is_conservative || has_own_method(file)) return;
  require_normalization(content);
  if (content.normalization != "none") return;
  const std::string area = names_of("dst").area;
  const std::vector<double>& areas = content.target.areas;
  Weights& weights = content.weights;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    if (weights.offsets[r] == weights.offsets[r + 1]) continue;
    const double divisor = areas.empty() ? 0 : areas[r];
    if (!(divisor > 0 && std::isfinite(divisor))) {
      throw io::BadValue("the normalization is \"none\", so remap_matrix has areas, but " +
                         (areas.empty()
                              ? "there are no areas of targets, " + area + ","
                              : "the area of target " + std::to_string(r) + " in " + area + " is " +
                                    system::shortest_text(divisor) + ",") +
                         " to divide them by");
    }
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      weights.values[k] /= divisor;
    }
  }
  content.normalization = "destarea";
  content.remarks.push_back(
      "the normalization is \"none\": its weights, which are areas, are divided by those of the "
      "targets, " +
      area);
}

}  // namespace

void write_scrip(io::AtomicFile& file, const WeightsToWrite& job) {
  const WeightFile& content = job.content;
  const Weights& weights = content.weights;
  const std::size_t num_sources = weights.num_columns;
  const std::size_t num_targets = weights.num_rows();
  io::NetcdfWriter out(file);
  const std::size_t src_size = out.add_dimension("src_grid_size", num_sources);
  const std::size_t dst_size = out.add_dimension("dst_grid_size", num_targets);
  const std::size_t src_rank =
      out.add_dimension("src_grid_rank", shape_or(content.source, num_sources).size());
  const std::size_t dst_rank =
      out.add_dimension("dst_grid_rank", shape_or(content.target, num_targets).size());
  const std::size_t links = out.add_dimension("num_links", weights.columns.size());
  const std::size_t wgts = out.add_dimension("num_wgts", 1);
  out.add_attribute("title", "Weights that carry values from sources to targets");
  out.add_attribute("normalization",
                    content.normalization.empty() ? "none" : content.normalization);
  out.add_attribute("map_method", known_method(content.method));
  out.add_attribute("conventions", "SCRIP");
  out.add_attribute("source_grid", "source");
  out.add_attribute("dest_grid", "target");
  add_own_attributes(out, content);
  add_side(out, names_of("src"), content.source, num_sources, src_size, src_rank);
  add_side(out, names_of("dst"), content.target, num_targets, dst_size, dst_rank);
  // These are of SCRIP's integer type, since CDO refuses others.
  out.add_variable(variable("src_address", index_type(num_sources), {links}));
  out.add_variable(variable("dst_address", index_type(num_targets), {links}));
  out.add_variable(variable("remap_matrix", io::NetcdfType::float64, {links, wgts}));
  out.begin(job.netcdf);
  write_side(out, names_of("src"), content.source, num_sources, [](std::size_t) { return 0.0; });
  write_side(out, names_of("dst"), content.target, num_targets,
             [&](std::size_t row) { return fraction_of(weights, row); });
  const auto column = [&](std::size_t k) { return std::int64_t{weights.columns[k]} + 1; };
  if (index_type(num_sources) == io::NetcdfType::int32) {
    out.write_values<std::int32_t>(weights.columns.size(), column);
  } else {
    out.write_values<std::int64_t>(weights.columns.size(), column);
  }
  if (index_type(num_targets) == io::NetcdfType::int32) {
    write_row_numbers<std::int32_t>(out, weights);
  } else {
    write_row_numbers<std::int64_t>(out, weights);
  }
  out.write(std::span<const double>(weights.values));
  out.finish();
}

WeightFile read_scrip(const io::NetcdfReader& file, const WeightReadOptions& options) {
  WeightFile content;
  const std::size_t num_sources = dimension_of(file, "src_grid_size");
  const std::size_t num_targets = dimension_of(file, "dst_grid_size");
  read_side(file, names_of("src"), num_sources, content.source);
  read_side(file, names_of("dst"), num_targets, content.target);
  const io::VariableInFile& matrix = file.require("remap_matrix");
  // The further weights of a link multiply gradients of the source field.
  const std::size_t of_link = matrix.shape.size() == 2 ? matrix.shape[1] : 1;
  if (of_link != 1 && !(options.are_checked && of_link > 1)) {
    throw io::BadValue("remap_matrix has " + std::to_string(of_link) +
                       " weights a link, of which all but the first need gradients");
  }
  std::vector<double> values = meant_numbers(file, matrix);
  if (of_link > 1) {
    for (std::size_t k = 0; k * of_link < values.size(); ++k) values[k] = values[k * of_link];
    values.resize(values.size() / of_link);
    content.remarks.push_back("remap_matrix has " + std::to_string(of_link) +
                              " weights a link: all but the first, which multiply gradients, are "
                              "left out");
  }
  set_entries({file.integers(file.require("dst_address")),
               file.integers(file.require("src_address")), std::move(values)},
              num_targets, num_sources, options, content);
  read_own_attributes(file, content);
  divide_by_areas(file, content);
  return content;
}

}  // namespace rondel::formats
