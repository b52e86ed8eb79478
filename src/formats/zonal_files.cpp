// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Fields are read slice by slice. A file of fields has the statistics one after the other, so those of
// all fields of an array are kept until they are written, as many statistics as there is room for.
#include "formats/zonal_files.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/regrid_fields.h"
#include "formats/regrid_output.h"
#include "formats/regrid_plan.h"
#include "formats/regrid_side.h"
#include "io/bad_value.h"
#include "io/number.h"
#include "rondel/conventions.h"
#include "rondel/error.h"
#include "rondel/fields.h"
#include "rondel/names.h"
#include "rondel/zonal_statistics.h"
#include "system/job.h"

namespace rondel {
namespace formats {
namespace {

// Returns the number that a text is; -1 if it is none.
double share_of(std::string_view text) {
  try {
    return io::parse_number(text, "quantile");
  } catch (const io::BadValue&) {
    return -1;
  }
}

// Returns the statistic that a word names. Throws InvalidInput if there is none.
ZonalStatistic statistic_named(std::string_view word) {
  constexpr std::string_view quantile = "quantile:";
  if (word == "std") return {ZonalOperation::stdev};
  if (word == "mode") return {ZonalOperation::majority};
  if (const auto known = from_name<ZonalOperation>(word);
      known && *known != ZonalOperation::quantile) {
    return {*known};
  }
  if (word.starts_with(quantile)) {
    const double value = share_of(word.substr(quantile.size()));
    if (value >= 0 && value <= 1) return {ZonalOperation::quantile, value};
  }
  std::string names;
  for (const std::string_view name : rondel::names_of<ZonalOperation>()) {
    names += (names.empty() ? "" : ", ") + std::string(name == "quantile" ? "quantile:Q" : name);
  }
  throw InvalidInput("'" + std::string(word) + "' is no statistic; there are " + names +
                     " (Q from 0 to 1)");
}

// Returns the word of CF's cell_methods (appendix E) for an operation; empty if there is none.
std::string_view word_of_cf(ZonalOperation operation) {
  switch (operation) {
    case ZonalOperation::mean:
      return "mean";
    case ZonalOperation::sum:
      return "sum";
    case ZonalOperation::min:
      return "minimum";
    case ZonalOperation::max:
      return "maximum";
    case ZonalOperation::variance:
      return "variance";
    case ZonalOperation::stdev:
      return "standard_deviation";
    case ZonalOperation::median:
      return "median";
    case ZonalOperation::majority:
      return "mode";
    default:
      return {};
  }
}

bool has_values_of_cells(ZonalOperation operation) {
  return operation == ZonalOperation::min || operation == ZonalOperation::max ||
         operation == ZonalOperation::majority || operation == ZonalOperation::minority;
}

// Returns the square of a unit in UDUNITS's notation. An empty text stands for none.
std::string squared(const std::string& units) {
  if (units.empty()) return units;
  const bool is_word = std::ranges::all_of(
      units, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
  return is_word ? units + '2' : '(' + units + ")2";
}

// Returns a variable for a statistic of an array, with the attributes that hold for it.
FieldArray array_of_statistic(const FieldArray& array, const ZonalStatistic& statistic) {
  FieldArray made = array;
  made.name += '_' + statistic.name();
  if (!has_values_of_cells(statistic.operation)) remove_flags(made);
  if (statistic.operation == ZonalOperation::count ||
      statistic.operation == ZonalOperation::fraction ||
      statistic.operation == ZonalOperation::variety) {
    made.numbers.clear();
    made.attributes = {{"long_name", statistic.name() + " of " + array.name}, {"units", "1"}};
    made.is_single = false;
    return made;
  }
  if (statistic.operation == ZonalOperation::variance) {
    for (auto& [name, text] : made.attributes) {
      if (name == "units") text = squared(text);
    }
  }
  const std::string_view word = word_of_cf(statistic.operation);
  if (word.empty()) return made;
  const std::string method = "area: " + std::string(word);
  const auto known = std::ranges::find_if(made.attributes,
                                          [](const auto& a) { return a.first == "cell_methods"; });
  if (known == made.attributes.end()) {
    made.attributes.emplace_back("cell_methods", method);
  } else {
    known->second += (known->second.empty() ? "" : " ") + method;
  }
  return made;
}

// Removes the names of fields from attributes such as `coordinates`: no variable of the output is one
// of these fields, also where a statistic or the mapping of a grid has the name of one.
void leave_out_names_of(std::span<const FieldArray> fields, FieldSet& written) {
  const auto name_of_kept = [&](const std::string& name) {
    return std::ranges::count(fields, name, &FieldArray::name) == 0 ? name : std::string();
  };
  const auto rename = [&](auto& attribute) {
    auto& [name, text] = attribute;
    // The attribute `compress` names dimensions.
    if (!is_attribute_of_names(name) || name == "compress") return false;
    text = with_names(name, text, name_of_kept);
    return text.empty();
  };
  std::erase_if(written.attributes, rename);
  for (std::vector<FieldArray>* const arrays : {&written.arrays, &written.axes, &written.others}) {
    for (FieldArray& array : *arrays) std::erase_if(array.attributes, rename);
  }
}

class ZonalJob {
 public:
  ZonalJob(const FileName& in, const FileName& target, const RegridFileOptions& options,
           const Execution& execution)
      : options_(options),
        execution_(execution),
        source_(options.source.value_or(file_and_variable(in).first), "source", options.cells, true,
                execution,
                options.source ? std::vector<std::string>() : wanted_variables(in, options.names)),
        target_(target, "target", options.cells, true, execution),
        fields_(open_fields(in, wanted_variables(in, options.names), source_)) {
    report_.remarks =
        remarks_of(source_, target_, file_and_variable(in).first.path, fields_->fields());
    report_.sources = source_.num_places();
    report_.targets = target_.num_places();
    RemapOptions rules;
    rules.overlap = options.overlap;
    pieces_ = remap(source_.cells(execution), target_.cells(execution), rules, execution);
  }

  RegridFileReport run(const FileName& out) {
    const FieldSet& in = fields_->fields();
    std::vector<FieldArray> arrays;
    for (const FieldArray& array : in.arrays) {
      for (const ZonalStatistic& statistic : options_.statistics) {
        arrays.push_back(array_of_statistic(array, statistic));
      }
    }
    FieldSet written = fields_at_targets(in, std::move(arrays), source_, target_, options_.history);
    leave_out_names_of(in.arrays, written);
    const WeightSide side = target_.description(is_netcdf_file(out), execution_);
    RegridOutput output(out, written, side, options_.netcdf, execution_);
    for (std::size_t a = 0; a < in.arrays.size(); ++a) {
      compute(a, output);
      report_.fields += in.arrays[a].num_fields();
    }
    report_.missing = output.num_missing();
    std::ranges::move(output.remarks(), std::back_inserter(report_.remarks));
    output.finish();
    return std::move(report_);
  }

 private:
  // Computes and writes the statistics of an array. Where those of all fields have no room for one
  // statistic, they are written slice by slice.
  void compute(std::size_t array, RegridOutput& output) {
    const std::span<const ZonalStatistic> all = options_.statistics;
    const std::size_t num_fields = fields_->fields().arrays[array].num_fields();
    const std::size_t size = num_fields * report_.targets;  // of one statistic
    const std::uint64_t room = options_.memory / 2 / sizeof(double);
    const std::size_t at_once =
        std::clamp<std::uint64_t>(room / std::max<std::size_t>(size, 1), 1, all.size());
    for (std::size_t first = 0; first < all.size(); first += at_once) {
      const auto group = all.subspan(first, std::min(at_once, all.size() - first));
      std::vector<double> kept(group.size() > 1 ? group.size() * size : 0);
      for_each_slice(array, group, [&](std::size_t begin, std::span<const double> numbers) {
        if (kept.empty()) return output.write(numbers);
        const std::size_t of_slice = numbers.size() / group.size();
        for (std::size_t s = 0; s < group.size(); ++s) {
          std::ranges::copy(
              numbers.subspan(s * of_slice, of_slice),
              kept.begin() + static_cast<std::ptrdiff_t>(s * size + begin * report_.targets));
        }
      });
      if (!kept.empty()) output.write(kept);
    }
  }

  // Calls take(first field, numbers) for the statistics of some fields of an array in turn.
  template <class Take>
  void for_each_slice(std::size_t array, std::span<const ZonalStatistic> group, const Take& take) {
    const std::size_t num_fields = fields_->fields().arrays[array].num_fields();
    const std::size_t largest = std::max(report_.sources, report_.targets * group.size());
    const std::size_t of_slice =
        std::max<std::size_t>(values_per_slice / std::max<std::size_t>(largest, 1), 1);
    const ZonalOptions rules{options_.statistic_weights, options_.max_missing};
    std::vector<double> values;
    std::vector<double> numbers;
    for (std::size_t first = 0; first < num_fields; first += of_slice) {
      const std::size_t count = std::min(of_slice, num_fields - first);
      values.resize(count * report_.sources);
      numbers.resize(group.size() * count * report_.targets);
      fields_->read(array, first, values, execution_);
      zonal_statistics(pieces_, group, values, numbers, count, rules, execution_);
      take(first, std::span<const double>(numbers));
      system::announce(execution_, "regrid", first + count, num_fields);
    }
  }

  const RegridFileOptions& options_;
  const Execution& execution_;
  RegridSide source_;
  RegridSide target_;
  std::unique_ptr<FieldFile> fields_;
  Remap pieces_;
  RegridFileReport report_;
};

}  // namespace

RegridFileReport write_zonal_statistics(const FileName& in, const FileName& target,
                                        const FileName& out, const RegridFileOptions& options,
                                        const Execution& execution) {
  if (options.method) {
    throw InvalidInput("statistics are of the cells in a target: they have no method");
  }
  return ZonalJob(in, target, options, execution).run(out);
}

}  // namespace formats

std::vector<ZonalStatistic> zonal_statistics_of(std::string_view list) {
  std::vector<ZonalStatistic> statistics;
  std::set<std::string> names;
  while (true) {
    const std::size_t comma = list.find(',');
    statistics.push_back(formats::statistic_named(list.substr(0, comma)));
    const std::string name = statistics.back().name();
    if (!names.insert(name).second) throw InvalidInput("the statistic " + name + " stands twice");
    if (comma == std::string_view::npos) return statistics;
    list.remove_prefix(comma + 1);
  }
}

}  // namespace rondel
