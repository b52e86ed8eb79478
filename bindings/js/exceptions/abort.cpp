// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How the C++ runtime ends a program that broke its contract: by a trap, which JavaScript sees as a
// WebAssembly.RuntimeError. The runtime's own versions print a message first; there is nobody to read it.

#include <cstdint>
#include <version>

extern "C" {

[[noreturn]] void abort_message(const char* /*format*/, ...) { __builtin_trap(); }

// For clang's stack protector, which Debian's compiler runtime is built with.
std::uintptr_t __stack_chk_guard = 0x5bd1'e995;
[[noreturn]] void __stack_chk_fail() { __builtin_trap(); }
}

_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char* /*format*/, ...) { __builtin_trap(); }
_LIBCPP_END_NAMESPACE_STD
