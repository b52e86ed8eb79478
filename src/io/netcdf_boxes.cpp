// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_boxes.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/array_rows.h"
#include "io/netcdf4_file.h"
#include "io/netcdf_slabs.h"
#include "io/wide_integers.h"
#include "system/parallel.h"

namespace rondel::io {
namespace {

// Returns the number of values in a box.
std::size_t num_values_of(const BoxLengths& count) {
  std::size_t product = 1;
  for (const std::size_t length : count) product *= length;
  return product;
}

// Returns the lengths of pieces: a chunk, extended from the fastest dimension on as far as there is
// room.
BoxLengths lengths_of_pieces(const BoxLengths& count, std::span<const std::uint64_t> chunk,
                             std::size_t max_per_piece) {
  BoxLengths lengths(count.size());
  for (std::size_t d = 0; d < count.size(); ++d) {
    lengths[d] = static_cast<std::size_t>(std::min<std::uint64_t>(count[d], chunk[d]));
  }
  std::size_t size = num_values_of(lengths);
  for (std::size_t d = count.size(); d-- > 0;) {
    const std::size_t number = std::max<std::size_t>(max_per_piece / size, 1);
    size /= lengths[d];
    lengths[d] = std::min(count[d], lengths[d] * number);
    size *= lengths[d];
    if (lengths[d] < count[d]) break;
  }
  return lengths;
}

// The pieces of a box, numbered with the last dimension varying fastest.
class BoxPieces {
 public:
  // The first piece along each dimension is shorter by `skipped`, as a part of a chunk may be.
  BoxPieces(const NetcdfBox& box, BoxLengths lengths, BoxLengths skipped)
      : box_(box), lengths_(std::move(lengths)), skipped_(std::move(skipped)) {
    for (std::size_t d = 0; d < lengths_.size(); ++d) {
      along_.push_back((skipped_[d] + box.count[d] + lengths_[d] - 1) / lengths_[d]);
      size_ *= along_[d];
    }
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] NetcdfBox piece(std::size_t number) const {
    NetcdfBox piece{box_.start, box_.count};
    for (std::size_t d = lengths_.size(); d-- > 0;) {
      const std::size_t place = number % along_[d] * lengths_[d];
      number /= along_[d];
      const std::size_t begin = place - std::min(place, skipped_[d]);
      piece.start[d] += begin;
      piece.count[d] = std::min(place + lengths_[d] - skipped_[d], box_.count[d]) - begin;
    }
    return piece;
  }

 private:
  const NetcdfBox& box_;
  BoxLengths lengths_;
  BoxLengths skipped_;
  BoxLengths along_;  // the number of pieces along each dimension
  std::size_t size_ = 1;
};

// Returns the pieces in which a box is read: parts of chunks where these are read one by one, or
// else what fits.
BoxPieces pieces_of(const NetcdfReader& file, const VariableInFile& variable, const NetcdfBox& box,
                    std::size_t max_per_piece) {
  const std::vector<std::uint64_t> chunk = file.chunk_of(variable);
  BoxLengths skipped(chunk.size(), 0);
  if (!file.has_chunks(variable)) {
    return {box, lengths_of_pieces(box.count, chunk, max_per_piece), std::move(skipped)};
  }
  for (std::size_t d = 0; d < chunk.size(); ++d) {
    skipped[d] = static_cast<std::size_t>(box.start[d] % chunk[d]);
  }
  return {box, {chunk.begin(), chunk.end()}, std::move(skipped)};
}

}  // namespace

void read_in_order(const NetcdfReader& file, const VariableInFile& variable, const NetcdfBox& box,
                   std::span<const std::size_t> order, std::span<double> out, unsigned threads,
                   std::size_t max_per_piece) {
  const std::size_t rank = order.size();
  if (rank == 0 || out.empty()) {
    file.read_numbers(variable, 0, out);
    return;
  }
  BoxLengths ordered(rank);
  for (std::size_t w = 0; w < rank; ++w) ordered[w] = box.count[order[w]];
  const BoxLengths steps_in_order = steps_of(ordered);
  BoxLengths out_steps(rank);
  for (std::size_t w = 0; w < rank; ++w) out_steps[order[w]] = steps_in_order[w];
  const BoxPieces pieces = pieces_of(file, variable, box, max_per_piece);
  const auto read = [&](const NetcdfBox& piece) {
    double* begin = out.data();
    for (std::size_t d = 0; d < rank; ++d) begin += (piece.start[d] - box.start[d]) * out_steps[d];
    if (file.read_chunk(variable, piece, {begin, out_steps})) return;
    std::vector<double> values(num_values_of(piece.count));
    file.read_box(variable, piece, values);
    const BoxLengths steps = steps_of(piece.count);
    const std::size_t step = steps[order.back()];
    const std::size_t length = piece.count[order.back()];
    for_each_row(piece.count, order, steps, out_steps, [&](std::size_t from, std::size_t to) {
      double* const row = begin + to;
      for (std::size_t i = 0; i < length; ++i) row[i] = values[from + i * step];
    });
  };
  system::parallel_for(threads, pieces.size(), 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) read(pieces.piece(k));
  });
}

void read_run(const NetcdfReader& file, const VariableInFile& variable, std::uint64_t begin,
              std::span<double> out, unsigned threads) {
  const std::size_t rank = variable.shape.size();
  const std::vector<std::uint64_t> chunk = file.chunk_of(variable);
  if (std::ranges::all_of(chunk, [](std::uint64_t length) { return length == 1; })) {
    file.read_numbers(variable, begin, out);
    return;
  }
  const BoxLengths order = own_order(rank);
  for_each_slab(
      variable.shape, begin, out.size(),
      [&](const auto& start, const auto& count, std::size_t offset, std::size_t size) {
        read_in_order(file, variable, {start, count}, order, out.subspan(offset, size), threads);
      });
}

namespace {

// Reads boxes of files whose values are in their order: one contiguous run at a time, or many at
// once if the runs and the gaps between them are short.
class RunReader {
 public:
  RunReader(const NetcdfReader& file, const VariableInFile& variable, const NetcdfBox& box)
      : file_(file), variable_(variable), box_(box), steps_(steps_of(variable.shape)) {
    // The values of dimensions that are wanted as a whole, and of the dimension before these, are
    // contiguous.
    first_of_run_ = box.count.size();
    while (first_of_run_ > 0) {
      run_ *= box.count[--first_of_run_];
      if (box.count[first_of_run_] != variable.shape[first_of_run_]) break;
    }
  }

  // Reads the values at one index of the dimensions before d; `begin` is the number of the first of
  // them.
  void read(std::size_t d, std::uint64_t begin, std::span<double> out) {
    if (d >= first_of_run_) {
      file_.read_numbers(variable_, begin + offset_after(d), out);
      return;
    }
    constexpr std::size_t short_run = 512;
    const bool is_dense = run_ < short_run && steps_[d] <= 2 * short_run;
    const std::size_t together = is_dense ? usual_piece / steps_[d] : 1;
    const std::size_t row_size = out.size() / box_.count[d];
    for (std::size_t i = 0; i < box_.count[d]; i += together) {
      const std::size_t number = std::min(together, box_.count[d] - i);
      const std::uint64_t at = begin + (box_.start[d] + i) * steps_[d];
      const std::span<double> part = out.subspan(i * row_size, number * row_size);
      if (is_dense) {
        read_dense(d, number, at + offset_after(d + 1), part);
      } else {
        read(d + 1, at, part);
      }
    }
  }

 private:
  // Returns how far the box begins behind the first value, by dimensions d and later.
  [[nodiscard]] std::uint64_t offset_after(std::size_t d) const {
    std::uint64_t offset = 0;
    for (; d < steps_.size(); ++d) offset += box_.start[d] * steps_[d];
    return offset;
  }

  // Reads `number` indices along d, with everything between them.
  void read_dense(std::size_t d, std::size_t number, std::uint64_t first, std::span<double> out) {
    const auto from_d = static_cast<std::ptrdiff_t>(d);
    BoxLengths count(box_.count.begin() + from_d, box_.count.end());
    count.front() = number;
    const BoxLengths steps(steps_.begin() + from_d, steps_.end());
    BoxLengths order(count.size());
    std::size_t size = 1;
    for (std::size_t e = 0; e < count.size(); ++e) {
      order[e] = e;
      size += (count[e] - 1) * steps[e];
    }
    values_.resize(size);
    file_.read_numbers(variable_, first, values_);
    for_each_row(count, order, steps, steps_of(count), [&](std::size_t from, std::size_t to) {
      std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(from), count.back(),
                  out.begin() + static_cast<std::ptrdiff_t>(to));
    });
  }

  const NetcdfReader& file_;
  const VariableInFile& variable_;
  const NetcdfBox& box_;
  BoxLengths steps_;
  std::size_t first_of_run_ =
      0;  // the first dimension along which values of the box are contiguous
  std::size_t run_ = 1;
  std::vector<double> values_;
};

}  // namespace

void NetcdfReader::read_box(const VariableInFile& variable, const NetcdfBox& box,
                            std::span<double> out) const {
  if (netcdf4_ != nullptr) {
    require_numbers(variable);
    if (is_wide(variable.type)) {
      std::vector<std::int64_t> wide(out.size());
      netcdf4_->read_box(variable, box, std::span(wide));
      to_doubles(variable, wide, out);
      return;
    }
    netcdf4_->read_box(variable, box, out);
  } else {
    RunReader(*this, variable, box).read(0, 0, out);
  }
}

}  // namespace rondel::io
