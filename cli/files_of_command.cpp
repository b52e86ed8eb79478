// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "files_of_command.h"

#include <filesystem>
#include <string_view>
#include <system_error>

#include "command.h"
#include "rondel/error.h"

namespace rondel::cli {
namespace {

namespace fs = std::filesystem;

// Returns true if an output of this name replaces a file: standard output, devices and pipes do
// not.
bool is_file_name(const std::string& path) {
  std::error_code error;
  return !path.empty() && path != "-" && !fs::is_other(path, error);
}

// Follows the links of a path, also where no file is there yet.
fs::path resolved(fs::path path) {
  constexpr int max_links = 40;  // as many as Linux follows
  std::error_code error;
  for (int k = 0; k < max_links && fs::is_symlink(path, error); ++k) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) return path.lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // of a folder with a slash behind it
}

// Returns the files that an input may be: FILE:NAME is FILE, and so is FILE:KM, unless there is a
// file of the whole name.
std::vector<std::string> readings(const std::string& input) {
  std::error_code error;
  if (!is_file_name(input)) return {};
  std::vector<std::string> files = {input};
  if (fs::exists(input, error)) return files;
  for (std::size_t colon = input.find(':'); colon != std::string::npos;
       colon = input.find(':', colon + 1)) {
    if (fs::exists(input.substr(0, colon), error)) files.push_back(input.substr(0, colon));
  }
  return files;
}

// The names of standard output, which no two outputs may have.
bool is_standard_output(const std::string& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

// Throws FileError if the folder of a file is not there, so that no other output is written before
// that is noticed.
void require_folder(const std::string& path) {
  std::error_code error;
  const fs::path folder = resolved(path).parent_path();
  if (folder.empty() || fs::is_directory(folder, error)) return;
  const bool is_there = fs::exists(folder, error);
  throw FileError(path + ": " + (is_there ? "Not a directory" : "No such file or directory"));
}

}  // namespace

bool are_one_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) || resolved(a) == resolved(b);
}

void require_separate_files(const std::vector<NamedFile>& inputs,
                            const std::vector<NamedFile>& outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const NamedFile& output = outputs[k];
    if (is_standard_output(output.path) && std::string_view(output.option) != "--output") {
      throw UsageError(std::string(output.option) +
                       ": only --output may be standard output; name a file");
    }
    if (!is_file_name(output.path)) continue;
    const std::string what = std::string(output.option) + ": '" + output.path + "' is the ";
    for (const NamedFile& input : inputs) {
      for (const std::string& file : readings(input.path)) {
        if (!are_one_file(file, output.path)) continue;
        if (std::string_view(input.option) == "INPUT") throw UsageError(what + "input");
        throw UsageError(what + "file of " + input.option);
      }
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (!is_file_name(outputs[other].path)) continue;
      if (!are_one_file(outputs[other].path, output.path)) continue;
      throw UsageError(what + "file of " + outputs[other].option);
    }
  }
  for (const NamedFile& output : outputs) {
    if (is_file_name(output.path)) require_folder(output.path);
  }
}

std::pair<std::string, std::string> split_at_colon(const std::string& text) {
  const std::size_t at = text.rfind(':');
  std::error_code error;
  const bool is_file = std::filesystem::exists(text, error);  // such as wrfout_d01_12:00:00
  if (at == std::string::npos || at < 2 || is_file) return {text, {}};
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace rondel::cli
