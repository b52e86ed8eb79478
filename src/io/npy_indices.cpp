// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/atomic_file.h"
#include "io/npy_header.h"
#include "rondel/io.h"

namespace rondel {

void write_indices(const std::string& path, std::span<const Index> values,
                   std::span<const std::uint64_t> shape) {
  io::AtomicFile file(path);
  file.write(io::make_npy_header("<u4", shape));
  file.write(io::NumberBytes(values));
  file.commit();
}

void write_numbers(const std::string& path, std::span<const double> values,
                   std::span<const std::uint64_t> shape) {
  io::AtomicFile file(path);
  const std::array<std::uint64_t, 1> size = {values.size()};
  file.write(io::make_npy_header("<f8", shape.empty() ? size : shape));
  file.write(io::NumberBytes(values));
  file.commit();
}

}  // namespace rondel
