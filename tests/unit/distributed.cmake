# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(distributed_test
  distributed/bad_files_test.cpp
  distributed/buckets_test.cpp
  distributed/files_test.cpp
  distributed/resume_test.cpp
  LIBS rondel_distributed rondel_test_support)
rondel_add_test(ranks_test
  distributed/failures_test.cpp
  distributed/ranks_test.cpp
  distributed/regrid_ranks_test.cpp
  LIBS rondel_simulated_ranks rondel_test_support)
