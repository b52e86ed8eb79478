// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Files by the numbers that a process has for those it opened. What fails returns -1 and leaves the
// reason in errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rondel::system {

inline constexpr int standard_input = 0;
inline constexpr int standard_output = 1;

// From now on no byte of a standard stream is changed on its way, as none of other files is: where the
// system ends lines in its own way, text would be.
void keep_bytes(int standard_stream) noexcept;

// Of a path in the encoding of the system; UTF-8 on Windows. No directory can be opened.
int open_to_read(const std::string& path) noexcept;

// 0 where the system does not know it: of pipes and devices.
std::uint64_t size_of(int descriptor) noexcept;

// Returns the number of bytes that were read, 0 at the end.
std::ptrdiff_t read(int descriptor, char* bytes, std::size_t size) noexcept;

// Returns the number of bytes that were written, which may be fewer than there are.
std::ptrdiff_t write(int descriptor, std::string_view bytes) noexcept;

int close(int descriptor) noexcept;

// The process that has them.
std::uint64_t process_number() noexcept;

}  // namespace rondel::system
