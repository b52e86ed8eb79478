// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Loads a plugin, asks it, unloads it, and that twice.

#include <dlfcn.h>

#include <cstdio>

int main(int argc, char** argv) {
  for (int round = 0; round < 2; ++round) {
    void* const plugin = dlopen(argv[argc - 1], RTLD_NOW | RTLD_LOCAL);
    if (plugin == nullptr) {
      std::printf("%s\n", dlerror());
      return 1;
    }
    const auto client = reinterpret_cast<int (*)()>(dlsym(plugin, "rondel_client"));
    if (client == nullptr || client() != 0 || dlclose(plugin) != 0) return 1;
  }
  return 0;
}
