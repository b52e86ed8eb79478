// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/netcdf_groups.h"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string_view>

#include "io/bad_value.h"
#include "io/number.h"

namespace rondel::io {
namespace {

using VariableNames = std::set<std::string, std::less<>>;

// True if words of the attribute are names of variables; others end with a colon.
bool names_variables(std::string_view attribute) {
  constexpr std::array<std::string_view, 7> names = {
      "bounds",        "climatology",         "coordinates",  "mesh",
      "formula_terms", "ancillary_variables", "cell_measures"};
  return std::ranges::find(names, attribute) != names.end() ||
         attribute.ends_with("_coordinates") || attribute.ends_with("_connectivity");
}

// Returns "a/b/" for "a/b/name", and an empty text for a name without groups.
std::string group_of(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  return std::string(slash == std::string_view::npos ? "" : name.substr(0, slash + 1));
}

// Returns "a/" for "a/b/".
std::string group_above(const std::string& group) {
  return group.empty() ? group : group_of(std::string_view(group).substr(0, group.size() - 1));
}

// Returns the full name of the variable that a word in a group means, or the word.
std::string looked_up(const std::string& word, std::string group, const VariableNames& names) {
  if (word.starts_with('/')) return names.contains(word.substr(1)) ? word.substr(1) : word;
  std::string_view rest = word;
  for (constexpr std::string_view up = "../"; rest.starts_with(up); rest.remove_prefix(up.size())) {
    group = group_above(group);
  }
  while (true) {
    std::string name = group + std::string(rest);
    if (names.contains(name)) return name;
    if (group.empty()) return word;
    group = group_above(group);
  }
}

}  // namespace

void resolve_names(NetcdfHeader& header) {
  VariableNames names;
  for (const VariableInFile& variable : header.variables) names.insert(variable.name);
  for (VariableInFile& variable : header.variables) {
    const std::string group = group_of(variable.name);
    for (NetcdfAttribute& attribute : variable.attributes) {
      const bool has_paths = !group.empty() || attribute.text.find('/') != std::string::npos;
      if (!has_paths || !names_variables(attribute.name)) continue;
      std::istringstream words(attribute.text);
      std::string text;
      for (std::string word; words >> word;) {
        text += (text.empty() ? "" : " ") + looked_up(word, group, names);
      }
      attribute.text = text;
    }
  }
}

std::string full_name(std::span<const VariableInFile> variables, const std::string& name) {
  const auto has = [&](std::string_view wanted) {
    return std::ranges::count(variables, wanted, &VariableInFile::name) != 0;
  };
  std::string whole = name.starts_with('/') ? name.substr(1) : name;
  const std::string wanted = whole.substr(0, whole.find('['));
  if (wanted.empty() || has(wanted)) return whole;
  std::string found;
  for (const VariableInFile& variable : variables) {
    if (!variable.name.ends_with("/" + wanted)) continue;
    if (!found.empty()) return name;  // several groups have one
    found = variable.name;
  }
  return found.empty() ? whole : found + whole.substr(wanted.size());
}

void require_one_group(std::span<const VariableInFile> variables, std::string_view name) {
  const std::string ending = "/" + std::string(name.substr(0, name.find('[')));
  std::string found;
  std::size_t count = 0;
  for (const VariableInFile& variable : variables) {
    if (!variable.name.ends_with(ending)) continue;
    found += (found.empty() ? "" : ", ") + in_quotes(variable.name);
    ++count;
  }
  if (count > 1) {
    throw BadValue("several groups have a variable " + in_quotes(ending.substr(1)) + ": " + found);
  }
}

}  // namespace rondel::io
