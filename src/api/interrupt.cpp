// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/interrupt.h"

#include "system/parallel.h"

namespace rondel {

void call_interruptible(const std::atomic<bool>& stop, const std::function<void()>& work) {
  const system::StopScope scope(&stop);
  work();
}

}  // namespace rondel
