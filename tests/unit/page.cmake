# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
find_package(nlohmann_json 3.11 REQUIRED)
find_package(ZLIB REQUIRED)

rondel_add_test(page_test
  page/globe_test.cpp
  page/packed_test.cpp
  LIBS rondel_geo nlohmann_json::nlohmann_json ZLIB::ZLIB)
