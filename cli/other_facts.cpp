// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "other_facts.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <nlohmann/json.hpp>
#include <span>

#include "column_values.h"
#include "process.h"
#include "report.h"
#include "rondel/feature_cells.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

using FactsJson = nlohmann::ordered_json;

// How many features have a part of each kind. A feature may count several times.
struct FeatureKinds {
  std::size_t points = 0;
  std::size_t lines = 0;
  std::size_t polygons = 0;
};

FeatureKinds kinds_of(const FeatureTable& table) {
  FeatureKinds kinds;
  for (std::size_t i = 0; i < table.lines.size(); ++i) {
    bool has_point = false;
    bool has_line = false;
    for (std::uint64_t row = table.lines.offsets[i]; row < table.lines.offsets[i + 1]; ++row) {
      (table.lines.rows[row].size() == 1 ? has_point : has_line) = true;
    }
    kinds.points += has_point ? 1 : 0;
    kinds.lines += has_line ? 1 : 0;
    kinds.polygons += table.polygons.cells[i] < table.polygons.cells[i + 1] ? 1 : 0;
  }
  return kinds;
}

// Returns the object as text. Names that are not UTF-8 are mended by the replacement character.
std::string text_of_json(const FactsJson& json) {
  return json.dump(2, ' ', false, FactsJson::error_handler_t::replace) + '\n';
}

OtherFacts facts_of(const FeatureTable& table, const Seconds& seconds) {
  const FeatureKinds kinds = kinds_of(table);
  const std::size_t size = table.lines.size();
  const auto located = static_cast<std::size_t>(std::ranges::count(table.is_located, true));
  const auto invalid = static_cast<std::size_t>(std::ranges::count_if(
      table.facts.faults, [](const std::string& fault) { return !fault.empty(); }));
  const FactsJson json = {{"features", size},
                          {"points", kinds.points},
                          {"lines", kinds.lines},
                          {"polygons", kinds.polygons},
                          {"unlocated", size - located},
                          {"invalid", invalid},
                          {"columns", json_of_columns(table.facts.columns)},
                          {"seconds", {{"total", seconds.total}}},
                          {"peak_memory_bytes", peak_memory_bytes()}};
  std::string text = table.facts.name + ": " + count(size, "feature", "features") +
                     "\nwith points: " + std::to_string(kinds.points) +
                     "\nwith lines: " + std::to_string(kinds.lines) +
                     "\nwith polygons: " + std::to_string(kinds.polygons) +
                     "\nnot valid: " + std::to_string(invalid) + '\n';
  if (located < size) text += "without a place: " + std::to_string(size - located) + '\n';
  text += line_of_columns(table.facts.columns);
  text += "commands that take it: overlay, relate, buffer, simplify, triangulate";
  if (kinds.polygons > 0) text += ", repair";
  if (kinds.polygons > 0 && kinds.points + kinds.lines == 0) {
    text += ", regrid and remap as a target, regions --clip";
  }
  return {text_of_json(json), text + '\n'};
}

OtherFacts facts_of(const std::string& name, const WeightFile& file, const Seconds& seconds) {
  const Weights& weights = file.weights;
  const FactsJson json = {
      {"weights", weights.values.size()},        {"sources", weights.num_columns},
      {"targets", weights.num_rows()},           {"method", file.method},
      {"normalization", file.normalization},     {"seconds", {{"total", seconds.total}}},
      {"peak_memory_bytes", peak_memory_bytes()}};
  std::string text = name + ": " + count(weights.values.size(), "weight", "weights") + " from " +
                     count(weights.num_columns, "source", "sources") + " to " +
                     count(weights.num_rows(), "target", "targets") + '\n';
  if (!file.method.empty()) text += "method: " + file.method + '\n';
  text += "normalization: " + file.normalization + '\n';
  return {text_of_json(json), text + "commands that take it: apply, check-weights\n"};
}

// Calls `read`; returns nothing if the file is not what it reads.
template <class Read>
std::optional<OtherFacts> facts_if_read(const Read& read) {
  try {
    return read();
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

}  // namespace

nlohmann::ordered_json json_of_columns(const std::vector<Column>& columns) {
  FactsJson array = FactsJson::array();
  for (const Column& column : columns) {
    array.push_back({{"name", column.name}, {"kind", holds_numbers(column) ? "number" : "text"}});
  }
  return array;
}

std::string line_of_columns(const std::vector<Column>& columns) {
  if (columns.empty()) return {};
  std::string text = "columns:";
  for (const Column& column : columns) {
    text += (&column == columns.data() ? " " : ", ") + column.name +
            (holds_numbers(column) ? " (number)" : " (text)");
  }
  return text + '\n';
}

std::optional<OtherFacts> other_facts_of(const CommonOptions& common, Job& job) {
  const FileName file = common.source();
  if (common.input == "-") return std::nullopt;
  if (is_geojson(file) || is_of_gdal(file)) {
    return facts_if_read([&] {
      const PolygonOptions options = {.invalid = InvalidPolygons::repair};
      return facts_of(read_features(file, options, job.execution()), job.seconds());
    });
  }
  const auto read = [&] {
    const WeightFile weights = read_weights(file, {.are_checked = true});
    return facts_of(common.input, weights, job.seconds());
  };
  // Nothing but weights is read from .npz, so that what is wrong with them is the answer.
  if (format_of(file) == "npz") return read();
  return facts_if_read(read);
}

}  // namespace rondel::cli
