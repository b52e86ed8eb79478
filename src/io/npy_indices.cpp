// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/atomic_file.h"
#include "io/npy_header.h"
#include "rondel/io.h"

namespace rondel {

void write_indices(const FileName& name, std::span<const Index> values,
                   std::span<const std::uint64_t> shape) {
  io::AtomicFile file(name);
  file.write(io::make_npy_header("<u4", shape));
  file.write(io::NumberBytes(values));
  file.commit();
}

void write_numbers(const FileName& name, std::span<const double> values,
                   std::span<const std::uint64_t> shape) {
  io::AtomicFile file(name);
  const std::array<std::uint64_t, 1> size = {values.size()};
  file.write(io::make_npy_header("<f8", shape.empty() ? size : shape));
  file.write(io::NumberBytes(values));
  file.commit();
}

}  // namespace rondel
