// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include <windows.h>

#include "system/dynamic_library.h"
#include "system/wide_path.h"

namespace rondel::system {

// Libraries that a library needs are looked for beside it if it is named by its whole path.
void* open_library(const std::string& name) noexcept {
  const bool is_path = name.find_first_of("/\\") != std::string::npos;
  return ::LoadLibraryExW(wide_path(name).c_str(), nullptr,
                          is_path ? LOAD_WITH_ALTERED_SEARCH_PATH : 0);
}
void* symbol_of(void* library, const char* name) noexcept {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

}  // namespace rondel::system
