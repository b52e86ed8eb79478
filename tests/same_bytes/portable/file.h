// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files by the C library: a C++ library without a file system has no streams of them.
#pragma once

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace rondel::test {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

inline File open_file(const std::string& path, const char* mode) {
  File file(std::fopen(path.c_str(), mode));
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  return file;
}

}  // namespace rondel::test
