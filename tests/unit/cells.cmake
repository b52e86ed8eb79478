# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(cells_polygon_test cells_polygon_test.cpp LIBS rondel_io)
