// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Libraries that are loaded while a program runs.
#pragma once

#include <bit>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace rondel::system {

// A library that the system finds by its name or path; nullptr if there is none, or where programs cannot load
// libraries. It stays loaded, and its symbols are not visible to other libraries.
void* open_library(const std::string& name) noexcept;

// Where a library may be found whose interface has a number.
struct LibraryNames {
  const char* variable;                       // of the environment; its value is tried alone
  const char* soname;                         // "libNAME.so."; versions come behind it
  int newest;                                 // versions in the future may have the same interface
  int oldest;                                 // the first version that has it
  std::initializer_list<const char*> others;  // names without a version
  std::string preferred = {};                 // a name that is tried before the versions
};

// Returns the library that the environment names, or else the preferred one, the newest version
// that the system finds, or one of the other names; nullptr if there is none.
inline void* find_library(const LibraryNames& names) {
  if (const char* const name = std::getenv(names.variable); name != nullptr && *name != '\0') {
    return open_library(name);
  }
  if (!names.preferred.empty()) {
    if (void* const library = open_library(names.preferred)) return library;
  }
  for (int version = names.newest; version >= names.oldest; --version) {
    if (void* const library = open_library(names.soname + std::to_string(version))) return library;
  }
  for (const char* const name : names.others) {
    if (void* const library = open_library(name)) return library;
  }
  return nullptr;
}

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
    function = std::bit_cast<Function>(address);
  }
  [[nodiscard]] bool has_all() const { return has_all_; }

 private:
  void* library_;
  bool has_all_ = true;
};

}  // namespace rondel::system
