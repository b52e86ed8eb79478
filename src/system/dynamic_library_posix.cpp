// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "system/dynamic_library.h"

#if !defined(__wasi__)
#include <dlfcn.h>
#endif

namespace rondel::system {

#if defined(__wasi__)

void* open_library(const std::string& /*name*/) noexcept { return nullptr; }
void* symbol_of(void* /*library*/, const char* /*name*/) noexcept { return nullptr; }

#else

void* open_library(const std::string& name) noexcept {
  return ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
}
void* symbol_of(void* library, const char* name) noexcept { return ::dlsym(library, name); }

#endif

}  // namespace rondel::system
