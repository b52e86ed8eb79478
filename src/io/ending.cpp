// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/ending.h"

#include <algorithm>
#include <utility>

#include "rondel/error.h"
#include "system/message_text.h"

namespace rondel {

FileName FileName::in_memory(std::string& content, std::string format_name, std::string name) {
  FileName file(std::move(name), std::move(format_name));
  file.bytes = &content;
  return file;
}

}  // namespace rondel

namespace rondel::io {

std::string ending(const FileName& file) {
  std::string_view name = file.path;
  while (name.ends_with('/')) name.remove_suffix(1);  // at the end of a folder
  name.remove_prefix(name.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  std::string result;
  if (!file.format.empty()) {
    result = (file.format.front() == '.' ? "" : ".") + file.format;
  } else if (dot < name.size() - 1) {
    result = name.substr(dot);
  }
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string format_of_text(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{' ? "geojson" : "csv";
}

bool has_netcdf_ending(const FileName& file) {
  return std::ranges::find(netcdf_endings, ending(file)) != netcdf_endings.end();
}

// A format such as "mpas" says what is in the file; then the ending of the path says which kind of
// netCDF it is.
NetcdfOptions with_kind(NetcdfOptions options, const FileName& file) {
  constexpr std::string_view netcdf4 = ".nc4";
  const bool is_netcdf4 = ending(file) == netcdf4 || ending(file.path) == netcdf4;
  if (options.kind == NetcdfKind::by_name && is_netcdf4) options.kind = NetcdfKind::netcdf4;
  return options;
}

// The message lists all endings that are known, so that the user can choose one.
void throw_unknown_ending(const FileName& file, std::string_view what,
                          std::span<const std::string_view> known) {
  const std::string found = ending(file);
  std::string message = file.path + ": ";
  if (!file.format.empty()) {
    message += "unknown format \"" + file.format + "\"";
  } else {
    message += found.empty() ? "the name has no ending" : "unknown ending \"" + found + "\"";
  }
  message += "; ";
  message += what;
  for (const std::string_view format : known) (message += ' ') += format;
  throw FileError(message);
}

}  // namespace rondel::io

namespace rondel {

std::string format_of(const FileName& file) {
  const std::string found = io::ending(file);
  return found.empty() ? found : found.substr(1);
}

std::string_view name_of(NetcdfKind kind) noexcept {
  return system::name_in({"by_name", "cdf2", "cdf5", "nc4"}, kind);
}

}  // namespace rondel
