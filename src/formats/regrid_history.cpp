// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The line of the attribute `history` that repeats a regridding: the command `rondel regrid` with the
// options that change values, in the order of its help. What is as by default is left out, and so is
// what changes nothing but the time, the memory and the format of the output.
#include <algorithm>
#include <string>
#include <vector>

#include "rondel/regrid_files.h"
#include "system/message_text.h"

namespace rondel {
namespace {

// Returns an argument as a shell takes it: in quotes if a character has a meaning there.
std::string quoted(const std::string& argument) {
  if (argument.find_first_of(" \t\"'$`\\*?[](){}<>|&;!#~") == std::string::npos) return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + '\'';
}

// Collects the words of a command.
class CommandLine {
 public:
  void add(const std::string& argument) { text_ += ' ' + quoted(argument); }
  void add(const char* option, const std::string& argument) {
    text_.append(" ").append(option);
    add(argument);
  }
  // Adds the word of a value, with hyphens.
  template <class Value>
  void add_word(const char* option, Value value) {
    std::string word(name_of(value));
    std::ranges::replace(word, '_', '-');
    add(option, word);
  }
  // Adds it unless it is the usual one.
  template <class Value>
  void add_word(const char* option, Value value, Value usual) {
    if (value != usual) add_word(option, value);
  }
  template <class Number>
  void add_number(const char* option, Number number, Number usual) {
    if (number != usual) add(option, system::shortest_text(static_cast<double>(number)));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_ = "rondel regrid";
};

void add_extrapolation(const ExtrapolationOptions& options, CommandLine& line) {
  const ExtrapolationOptions usual;
  line.add_word("--extrapolate", options.method);
  if (options.max_distance_km) {
    line.add("--extrapolate-distance", system::shortest_text(*options.max_distance_km));
  }
  line.add_number("--extrapolate-sources", options.neighbors, usual.neighbors);
  line.add_number("--extrapolate-exponent", options.exponent, usual.exponent);
  line.add_number("--extrapolate-levels", options.levels, usual.levels);
}

// Returns the list that zonal_statistics_of() reads.
std::string list_of(const std::vector<ZonalStatistic>& statistics) {
  std::string list;
  for (const ZonalStatistic& statistic : statistics) {
    list.append(list.empty() ? "" : ",").append(name_of(statistic.operation));
    if (statistic.operation == ZonalOperation::quantile) {
      list += ':' + system::shortest_text(statistic.quantile);
    }
  }
  return list;
}

}  // namespace

std::string regrid_command(const std::string& in, const std::string& target,
                           const RegridFileOptions& options) {
  const RegridFileOptions usual;
  CommandLine line;
  line.add(in);
  line.add(target);
  for (const std::string& name : options.names) line.add("--value", name);
  if (options.source) line.add("--source", options.source->path);
  if (options.method) line.add_word("--method", *options.method);
  line.add_word("--norm", options.norm, usual.norm);
  line.add_number("--max-missing", options.max_missing, usual.max_missing);
  line.add_word("--overlap", options.overlap, usual.overlap);
  if (options.limiter != RemapLimiter::none) {
    line.add("--limiter", std::string(name_of(options.limiter)));
  }
  for (const auto& [east, north] : options.vectors) {
    std::string pair = east;
    line.add("--vector", pair.append(",").append(north));
  }
  if (options.extrapolation) add_extrapolation(*options.extrapolation, line);
  line.add_word("--sides", options.cells.sides, usual.cells.sides);
  line.add_word("--edges", options.cells.edges, usual.cells.edges);
  line.add_word("--invalid", options.cells.invalid, usual.cells.invalid);
  line.add_word("--corners", options.cells.corners, usual.cells.corners);
  if (!options.statistics.empty()) line.add("--statistics", list_of(options.statistics));
  line.add_word("--weigh-by", options.statistic_weights, usual.statistic_weights);
  return line.text();
}

}  // namespace rondel
