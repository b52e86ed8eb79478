// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Ends a program that breaks a contract of the C++ runtime by a trap, which JavaScript sees as a
// WebAssembly.RuntimeError. The runtime's own versions print a message first, which nobody would
// read.

#include <cstdint>
#include <version>

extern "C" {

[[noreturn]] void abort_message(const char* /*format*/, ...) { __builtin_trap(); }

// Clang's stack protector needs these, since Debian's compiler runtime is built with it.
std::uintptr_t __stack_chk_guard = 0x5bd1'e995;
[[noreturn]] void __stack_chk_fail() { __builtin_trap(); }
}

_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char* /*format*/, ...) { __builtin_trap(); }
_LIBCPP_END_NAMESPACE_STD
