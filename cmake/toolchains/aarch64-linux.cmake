# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
set(machine aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
