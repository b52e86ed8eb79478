// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Libraries that are loaded while a program runs.
#pragma once

#include <cstring>
#include <string>

namespace rondel::system {

// A library that the system finds by its name or path; nullptr if there is none, or where programs cannot load
// libraries. It stays loaded, and its symbols are not visible to other libraries.
void* open_library(const std::string& name) noexcept;

// The address of a symbol of the library; nullptr if it has none of this name.
void* symbol_of(void* library, const char* name) noexcept;

// Sets pointers to functions of a library, and remembers whether all of them were found.
class SymbolLoader {
 public:
  explicit SymbolLoader(void* library) : library_(library) {}

  template <class Function>
  void get(Function& function, const char* name) {
    void* const address = symbol_of(library_, name);
    has_all_ = has_all_ && address != nullptr;
    std::memcpy(&function, &address, sizeof function);
  }
  [[nodiscard]] bool has_all() const { return has_all_; }

 private:
  void* library_;
  bool has_all_ = true;
};

}  // namespace rondel::system
