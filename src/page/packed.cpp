// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "page/packed.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

#include "system/parallel.h"

namespace rondel::page {
namespace {

// A deflate stream refers back to at most 32 KiB. A piece cannot refer to the piece before it,
// which hardly matters for pieces of 1 MiB.
constexpr std::size_t piece_size = 1 << 20;

// Returns a piece of a deflate stream (RFC 1951). All pieces but the last end with an empty block,
// so that they end at a byte.
std::string deflated(std::string_view piece, bool is_last) {
  z_stream stream{};
  constexpr int raw = -15;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, raw, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
  constexpr std::size_t flush_block = 16;
  std::string out(deflateBound(&stream, piece.size()) + flush_block, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
  stream.avail_in = static_cast<uInt>(piece.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace

std::string in_planes(std::string_view bytes, std::size_t width) {
  const std::size_t count = bytes.size() / width;
  std::string planes(bytes.size(), '\0');
  for (std::size_t plane = 0; plane < width; ++plane) {
    for (std::size_t i = 0; i < count; ++i) planes[plane * count + i] = bytes[i * width + plane];
  }
  return planes;
}

std::string zlib_stream(std::string_view bytes, unsigned threads) {
  const std::size_t count = std::max<std::size_t>(1, system::num_pieces(bytes.size(), piece_size));
  std::vector<std::string> pieces(count);
  system::parallel_for(threads, count, 1, [&](std::size_t i, std::size_t) {
    pieces[i] = deflated(bytes.substr(i * piece_size, piece_size), i + 1 == count);
  });
  std::string stream = "\x78\x9c";  // header: deflate, window of 32 KiB, default effort
  for (const std::string& piece : pieces) stream += piece;
  const uLong checksum = adler32_z(adler32_z(0, nullptr, 0),
                                   reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  for (int shift = 24; shift >= 0; shift -= 8) {
    stream += static_cast<char>(checksum >> static_cast<unsigned>(shift) & 0xffU);
  }
  return stream;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8U | (k < there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= there ? digits[word >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

}  // namespace rondel::page
