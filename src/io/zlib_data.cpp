// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/zlib_data.h"

#include <zlib.h>

#include <cstddef>
#include <memory>

#include "system/dynamic_library.h"

namespace rondel::io {
namespace {

// Functions of libdeflate's C interface, whose binary form is the same since 1.0.
struct Libdeflate {
  void* (*compressor)(int level);
  void (*free_compressor)(void*);
  std::size_t (*bound)(void* compressor, std::size_t size);
  std::size_t (*compress)(void* compressor, const void* in, std::size_t size, void* out,
                          std::size_t room);
  void* (*decompressor)();
  void (*free_decompressor)(void*);
  int (*decompress)(void* decompressor, const void* in, std::size_t size, void* out,
                    std::size_t room, std::size_t* written);
};

bool load_libdeflate(Libdeflate& deflate) {
  void* const library = system::find_library(
      {.variable = "RONDEL_LIBDEFLATE",
       .soname = "libdeflate.so.",
       .newest = 0,
       .oldest = 0,
       .others = {"libdeflate.so", "libdeflate.dylib", "/opt/homebrew/lib/libdeflate.dylib",
                  "/usr/local/lib/libdeflate.dylib", "libdeflate.dll", "deflate.dll"}});
  if (library == nullptr) return false;
  system::SymbolLoader from(library);
  from.get(deflate.compressor, "libdeflate_alloc_compressor");
  from.get(deflate.free_compressor, "libdeflate_free_compressor");
  from.get(deflate.bound, "libdeflate_zlib_compress_bound");
  from.get(deflate.compress, "libdeflate_zlib_compress");
  from.get(deflate.decompressor, "libdeflate_alloc_decompressor");
  from.get(deflate.free_decompressor, "libdeflate_free_decompressor");
  from.get(deflate.decompress, "libdeflate_zlib_decompress");
  return from.has_all();
}

// Returns the library; null if there is none.
const Libdeflate* libdeflate() {
  static Libdeflate deflate{};
  static const bool is_loaded = load_libdeflate(deflate);
  return is_loaded ? &deflate : nullptr;
}

}  // namespace

std::vector<unsigned char> zlib_compressed(std::span<const unsigned char> bytes, int level) {
  std::vector<unsigned char> result;
  if (const Libdeflate* const deflate = libdeflate()) {
    const std::unique_ptr<void, void (*)(void*)> compressor(deflate->compressor(level),
                                                            deflate->free_compressor);
    if (compressor == nullptr) return {};
    result.resize(deflate->bound(compressor.get(), bytes.size()));
    result.resize(deflate->compress(compressor.get(), bytes.data(), bytes.size(), result.data(),
                                    result.size()));
    return result;
  }
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  result.resize(length);
  if (compress2(result.data(), &length, bytes.data(), static_cast<uLong>(bytes.size()), level) !=
      Z_OK) {
    return {};
  }
  result.resize(length);
  return result;
}

bool zlib_uncompress(std::span<const unsigned char> data, std::span<unsigned char> bytes) {
  if (const Libdeflate* const deflate = libdeflate()) {
    const std::unique_ptr<void, void (*)(void*)> decompressor(deflate->decompressor(),
                                                              deflate->free_decompressor);
    // Without a place for the number of bytes, it must be that of the room.
    return decompressor != nullptr &&
           deflate->decompress(decompressor.get(), data.data(), data.size(), bytes.data(),
                               bytes.size(), nullptr) == 0;
  }
  uLongf size = bytes.size();
  return uncompress(bytes.data(), &size, data.data(), static_cast<uLong>(data.size())) == Z_OK &&
         size == bytes.size();
}

}  // namespace rondel::io
