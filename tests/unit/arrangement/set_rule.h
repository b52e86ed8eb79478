// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which places a result of a set operation has.
#pragma once

#include "rondel/set_operations.h"

namespace rondel::test {

// Returns whether the result has a place that the first operand has (a), or the second (b).
inline bool result_of(SetOperation operation, bool a, bool b) {
  switch (operation) {
    case SetOperation::unite:
      return a || b;
    case SetOperation::intersection:
      return a && b;
    case SetOperation::difference:
      return a && !b;
    case SetOperation::symmetric_difference:
      return a != b;
    case SetOperation::identity:
      break;
  }
  return a;
}

}  // namespace rondel::test
