// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files by the numbers that a process has for those it opened. What fails returns -1 and leaves the
// reason in errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondel/export.h"

namespace rondel::system {

inline constexpr int standard_input = 0;
inline constexpr int standard_output = 1;

// From now on no byte of a standard stream is changed on its way, as none of other files is: where the
// system ends lines in its own way, text would be.
void keep_bytes(int standard_stream) noexcept;

// Opens a file, whose path is in the encoding of the system (UTF-8 on Windows). A directory cannot
// be opened.
int open_to_read(const std::string& path) noexcept;

// 0 where the system does not know it: of pipes and devices.
RONDEL_API std::uint64_t size_of(int descriptor) noexcept;

// Returns the number of bytes that were read, 0 at the end.
std::ptrdiff_t read(int descriptor, char* bytes, std::size_t size) noexcept;

// Returns the number of bytes that were written, which may be fewer than there are.
std::ptrdiff_t write(int descriptor, std::string_view bytes) noexcept;

// A file to read and to write at any place, which is made if it is not there.
RONDEL_API int open_to_change(const std::string& path) noexcept;

// These do what read() and write() do, at a place of the file. On Windows one thread at a time may
// use a file.
RONDEL_API std::ptrdiff_t read_at(int descriptor, std::uint64_t place, char* bytes,
                                  std::size_t size) noexcept;
RONDEL_API std::ptrdiff_t write_at(int descriptor, std::uint64_t place,
                                   std::string_view bytes) noexcept;

// Makes the file at least so long, with room on the disk for all of it; what is in it stays. Returns 0.
RONDEL_API int reserve(int descriptor, std::uint64_t size) noexcept;
// Reserves room if the system can do so at once, and does nothing otherwise: on Linux, writing to
// reserved room is several times as fast. Returns 0, also where it cannot.
RONDEL_API int prepare(int descriptor, std::uint64_t size) noexcept;
// Room on the disk for so many bytes from the start of the file, which keeps its length: writing there does not fail for want of
// room. Returns 0, also where the system cannot promise it.
RONDEL_API int allocate(int descriptor, std::uint64_t size) noexcept;
// Cuts the file, or makes it longer. Returns 0.
RONDEL_API int resize(int descriptor, std::uint64_t size) noexcept;

// Nobody else can lock the file as long as it is open. Returns whether nobody else has.
RONDEL_API bool lock(int descriptor) noexcept;

RONDEL_API int close(int descriptor) noexcept;

// The process that has them.
std::uint64_t process_number() noexcept;

}  // namespace rondel::system
