// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// One reader of triangles, named by RONDEL_FUZZED_READER: any bytes give triangles or a FileError
// of one line.
#include <string>

#include "fuzz/fuzz_input.h"
#include "io/bad_value.h"
#include "io/triangle_formats.h"
#include "rondel/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  if (size == 0) return 0;  // read_triangles() refuses it for all formats
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    io::in_file("name", [&] { return io::RONDEL_FUZZED_READER(bytes); });
  } catch (const FileError& error) {
    const std::string what = error.what();
    fuzz::require(what.starts_with("name:"), "a message starts with the file: " + what);
    fuzz::require(what.find('\n') == std::string::npos, "a message is one line: " + what);
  }
  return 0;
}
