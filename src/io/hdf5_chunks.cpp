// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_chunks.h"

#include <algorithm>
#include <bit>
#include <mutex>
#include <new>
#include <type_traits>
#include <utility>

#include "io/array_rows.h"
#include "io/hdf5_library.h"
#include "io/zlib_data.h"
#include "system/checked_product.h"

namespace rondel::io {
namespace {

// An HDF5 that cannot visit all chunks finds one by its number by looking at all before it, so that
// variables with more are left to netCDF-C then.
constexpr unsigned long long most_chunks = 1ULL << 10U;

// A chunk that claims to be larger is left to netCDF-C.
constexpr std::uint64_t largest_chunk = std::uint64_t{1} << 30U;

// How the bytes of a chunk's values are arranged: byte b of value i is at i * value + b * byte.
struct ByteOrder {
  std::size_t value;
  std::size_t byte;
  bool is_big_endian;
};

// The unsigned integers with as many bits as a number.
template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

// Returns the bits of a number from its bytes, which are `step` apart, the least significant one first.
template <class Bits, class Step>
Bits gathered(const unsigned char* bytes, Step step) {
  Bits bits = 0;
  for (std::size_t b = 0; b < sizeof(Bits); ++b, bytes += step) {
    bits = static_cast<Bits>(bits | static_cast<Bits>(static_cast<Bits>(*bytes) << (8 * b)));
  }
  return bits;
}

// Copies a row of consecutive values to places that are `step` apart.
template <class T>
void copy_row(const unsigned char* from, const ByteOrder& order, std::size_t count, double* to,
              std::size_t step) {
  using Bits = BitsOf<T>;
  const auto copy = [&](const auto& bits_at) {
    if (step == 1) {  // a loop of its own, which compilers make vectors of
      for (std::size_t i = 0; i < count; ++i) {
        to[i] = static_cast<double>(std::bit_cast<T>(bits_at(i)));
      }
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      to[i * step] = static_cast<double>(std::bit_cast<T>(bits_at(i)));
    }
  };
  const auto byte = static_cast<std::ptrdiff_t>(order.byte);
  if (order.is_big_endian) {
    const unsigned char* const least = from + (sizeof(Bits) - 1) * order.byte;
    copy([&](std::size_t i) { return gathered<Bits>(least + i * order.value, -byte); });
  } else if (order.byte == 1) {
    constexpr std::integral_constant<std::ptrdiff_t, 1> next;
    copy([&](std::size_t i) { return gathered<Bits>(from + i * sizeof(Bits), next); });
  } else {
    copy([&](std::size_t i) { return gathered<Bits>(from + i, byte); });
  }
}

using RowCopier = void (*)(const unsigned char*, const ByteOrder&, std::size_t, double*,
                           std::size_t);

// Returns the function for values of a type; null if they are not read.
RowCopier row_copier(NetcdfType type) {
  switch (type) {
    case NetcdfType::int8:
      return copy_row<std::int8_t>;
    case NetcdfType::uint8:
      return copy_row<std::uint8_t>;
    case NetcdfType::int16:
      return copy_row<std::int16_t>;
    case NetcdfType::uint16:
      return copy_row<std::uint16_t>;
    case NetcdfType::int32:
      return copy_row<std::int32_t>;
    case NetcdfType::uint32:
      return copy_row<std::uint32_t>;
    case NetcdfType::float32:
      return copy_row<float>;
    case NetcdfType::float64:
      return copy_row<double>;
    default:
      return nullptr;
  }
}

}  // namespace

LargeVector<unsigned char> ChunkMemory::take(std::size_t size) {
  {
    const std::scoped_lock guard(lock_);
    if (!free_.empty() && free_.back().size() != size) free_.clear();
    if (!free_.empty()) {
      LargeVector<unsigned char> bytes = std::move(free_.back());
      free_.pop_back();
      return bytes;
    }
  }
  return LargeVector<unsigned char>(size);
}

void ChunkMemory::give_back(LargeVector<unsigned char> bytes) noexcept {
  const std::scoped_lock guard(lock_);
  if (!free_.empty() && free_.back().size() != bytes.size()) free_.clear();
  try {
    free_.push_back(std::move(bytes));
  } catch (const std::bad_alloc&) {  // then the next chunk gets new memory
  }
}

// Files may have numbers of fewer bits than their bytes, or with another exponent, which HDF5 converts.
bool Hdf5Chunks::take_type(Hdf5Id array, const VariableInFile& variable) {
  const Hdf5Library& hdf5 = *hdf5_library();
  const Hdf5Object type(hdf5.type(array), hdf5.close_type);
  if (!type.is_open()) return false;
  const int order = hdf5.type_order(type.id());
  type_ = variable.type;
  value_size_ = size_of(variable.type);
  is_big_endian_ = order == hdf5_big_endian;
  if (order != hdf5_little_endian && !is_big_endian_) return false;
  const Hdf5Object native(hdf5.native_type(type.id(), 0), hdf5.close_type);
  const Hdf5Object copy(hdf5.copy_type(type.id()), hdf5.close_type);
  constexpr int own =
      std::endian::native == std::endian::big ? hdf5_big_endian : hdf5_little_endian;
  return native.is_open() && copy.is_open() && hdf5.set_type_order(copy.id(), own) >= 0 &&
         hdf5.is_same_type(copy.id(), native.id()) > 0;
}

bool Hdf5Chunks::take_filters(Hdf5Id properties) {
  const Hdf5Library& hdf5 = *hdf5_library();
  const int count = hdf5.num_filters(properties);
  if (count < 0) return false;
  for (unsigned f = 0; f < static_cast<unsigned>(count); ++f) {
    unsigned flags = 0;
    unsigned config = 0;
    std::size_t num_values = 0;
    const int filter =
        hdf5.filter(properties, f, &flags, &num_values, nullptr, 0, nullptr, &config);
    if (filter == hdf5_deflate) {
      filters_.push_back(Filter::deflate);
    } else if (filter == hdf5_shuffle) {
      filters_.push_back(Filter::shuffle);
    } else {
      return false;
    }
  }
  // Every writer shuffles bytes first, and compresses them then.
  return std::ranges::is_sorted(filters_) && std::ranges::adjacent_find(filters_) == filters_.end();
}

bool Hdf5Chunks::take_places(Hdf5Id array) {
  const Hdf5Library& hdf5 = *hdf5_library();
  if (lengths_of(hdf5, array) != shape_) return false;
  const Hdf5Object space(hdf5.space(array), hdf5.close_space);
  if (!space.is_open()) return false;
  std::uint64_t wanted = 1;
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    if (!system::multiply_checked(wanted, num_along(d), wanted)) return false;
  }
  unsigned long long count = 0;
  if (hdf5.num_chunks(array, space.id(), &count) < 0 || count != wanted) return false;
  places_.assign(static_cast<std::size_t>(count), {});
  // Some versions visit chunks with other numbers than indices of values, which take_place() refuses.
  const auto visit = [](const unsigned long long* begin, unsigned left_out, std::uint64_t place,
                        unsigned long long size, void* chunks) noexcept {
    return static_cast<Hdf5Chunks*>(chunks)->take_place(begin, {place, size, left_out}) ? 0 : -1;
  };
  const bool is_known =
      hdf5.for_each_chunk != nullptr && hdf5.for_each_chunk(array, hdf5_default, visit, this) >= 0;
  if (!is_known && count > most_chunks) return false;
  std::vector<unsigned long long> begin(shape_.size());
  for (unsigned long long k = 0; !is_known && k < count; ++k) {
    StoredChunk chunk{};
    unsigned long long size = 0;
    if (hdf5.chunk_place(array, space.id(), k, begin.data(), &chunk.filters_left_out, &chunk.offset,
                         &size) < 0) {
      return false;
    }
    chunk.size = size;
    if (!take_place(begin.data(), chunk)) return false;
  }
  return std::ranges::none_of(places_, [](const StoredChunk& chunk) { return chunk.size == 0; });
}

bool Hdf5Chunks::take_place(const unsigned long long* begin, const StoredChunk& chunk) {
  if (chunk.size == 0 || chunk.size > 2 * largest_chunk) return false;
  std::vector<std::size_t> start(shape_.size());
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    if (begin[d] >= shape_[d]) return false;
    start[d] = static_cast<std::size_t>(begin[d]);
  }
  if (!is_begin(start)) return false;
  places_[number_of(start)] = chunk;
  return true;
}

std::unique_ptr<const Hdf5Chunks> Hdf5Chunks::find(const std::string& path,
                                                   const VariableInFile& variable,
                                                   std::shared_ptr<ChunkMemory> memory) {
  const Hdf5Library* const hdf5 = hdf5_library();
  if (hdf5 == nullptr || variable.shape.empty() || row_copier(variable.type) == nullptr) return {};
  const Hdf5Object array(open_hdf5_array(*hdf5, path, variable.name), hdf5->close_array);
  if (!array.is_open()) return {};
  const Hdf5Object properties(hdf5->properties(array.id()), hdf5->close_properties);
  if (!properties.is_open()) return {};
  std::unique_ptr<Hdf5Chunks> made(new Hdf5Chunks);
  made->memory_ = std::move(memory);
  made->shape_ = variable.shape;
  const std::size_t rank = variable.shape.size();
  std::vector<unsigned long long> lengths(rank, 0);
  // It fails for an array that is not in chunks.
  if (hdf5->chunk(properties.id(), static_cast<int>(rank), lengths.data()) !=
      static_cast<int>(rank)) {
    return {};
  }
  std::uint64_t size = size_of(variable.type);
  for (const unsigned long long length : lengths) {
    if (length == 0 || !system::multiply_checked(size, length, size)) return {};
    made->chunk_.push_back(length);
  }
  if (size > largest_chunk) return {};
  made->values_per_chunk_ = static_cast<std::size_t>(size / size_of(variable.type));
  if (!made->take_type(array.id(), variable) || !made->take_filters(properties.id()) ||
      !made->take_places(array.id())) {
    return {};
  }
  return made;
}

bool Hdf5Chunks::is_begin(std::span<const std::size_t> start) const {
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    if (start[d] % chunk_[d] != 0) return false;
  }
  return true;
}

bool Hdf5Chunks::is_in_chunk(const NetcdfBox& box) const {
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    if (box.start[d] % chunk_[d] + box.count[d] > chunk_[d]) return false;
  }
  return true;
}

bool Hdf5Chunks::has_last(const NetcdfBox& box) const {
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    const std::uint64_t begin = box.start[d] - box.start[d] % chunk_[d];
    if (box.start[d] + box.count[d] < std::min(begin + chunk_[d], shape_[d])) return false;
  }
  return true;
}

void Hdf5Chunks::set_room(std::size_t bytes) const {
  const std::scoped_lock guard(lock_);
  room_ = bytes - std::min(bytes, kept_.size() * values_per_chunk_ * value_size_);
}

std::size_t Hdf5Chunks::number_of(std::span<const std::size_t> start) const {
  std::size_t number = 0;
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    number = static_cast<std::size_t>(number * num_along(d) + start[d] / chunk_[d]);
  }
  return number;
}

Hdf5Chunks::ChunkValues Hdf5Chunks::values_of(const FileBytes& file,
                                              const StoredChunk& place) const {
  const auto is_applied = [&](Filter filter) {
    const auto at = std::ranges::find(filters_, filter);
    return at != filters_.end() && (place.filters_left_out >> (at - filters_.begin()) & 1U) == 0;
  };
  const bool is_deflated = is_applied(Filter::deflate);
  const std::size_t wanted = values_per_chunk_ * value_size_;
  const std::uint64_t end = file.claimed_size();
  if (place.size > end || place.offset > end - place.size) return {};
  if (!is_deflated && place.size != wanted) return {};
  ChunkValues values{memory_->take(wanted), is_applied(Filter::shuffle)};
  LargeVector<unsigned char> deflated;
  if (is_deflated) deflated.resize(static_cast<std::size_t>(place.size));
  LargeVector<unsigned char>& stored = is_deflated ? deflated : values.bytes;
  file.read_at(place.offset, reinterpret_cast<char*>(stored.data()), stored.size());
  if (is_deflated && !zlib_uncompress(deflated, values.bytes)) return {};
  return values;
}

std::shared_ptr<const Hdf5Chunks::ChunkValues> Hdf5Chunks::shared_values_of(
    const FileBytes& file, const StoredChunk& place) const {
  auto values = std::make_unique<ChunkValues>(values_of(file, place));
  return {values.release(), [memory = memory_](ChunkValues* done) {
            if (!done->bytes.empty()) memory->give_back(std::move(done->bytes));
            delete done;
          }};
}

std::shared_ptr<const Hdf5Chunks::ChunkValues> Hdf5Chunks::chunk_of(const FileBytes& file,
                                                                    const NetcdfBox& box) const {
  const std::size_t number = number_of(box.start);
  const std::size_t size = values_per_chunk_ * value_size_;
  const bool is_last = has_last(box);
  if (!is_begin(box.start)) {
    const std::scoped_lock guard(lock_);
    const auto known = kept_.find(number);
    if (known != kept_.end()) {
      const std::shared_ptr<const ChunkValues> values = known->second;
      if (is_last) {
        kept_.erase(known);
        room_ += size;
      }
      return values;
    }
  }
  std::shared_ptr<const ChunkValues> values = shared_values_of(file, places_[number]);
  if (is_last || values->bytes.empty()) return values;
  const std::scoped_lock guard(lock_);
  if (room_ >= size && kept_.try_emplace(number, values).second) room_ -= size;
  return values;
}

bool Hdf5Chunks::read(const FileBytes& file, const NetcdfBox& box, const BoxPlace& out) const {
  const std::shared_ptr<const ChunkValues> values = chunk_of(file, box);
  if (values->bytes.empty()) return false;
  const ByteOrder order{values->are_shuffled ? 1 : value_size_,
                        values->are_shuffled ? values_per_chunk_ : 1, is_big_endian_};
  const RowCopier copy = row_copier(type_);
  const BoxLengths dimensions = own_order(shape_.size());
  const BoxLengths steps = steps_of(chunk_);
  std::size_t first = 0;
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    first += static_cast<std::size_t>(box.start[d] % chunk_[d]) * steps[d];
  }
  for_each_row(box.count, dimensions, steps, out.steps, [&](std::size_t from, std::size_t to) {
    copy(values->bytes.data() + (first + from) * order.value, order, box.count.back(),
         out.begin + to, out.steps.back());
  });
  return true;
}

}  // namespace rondel::io
