# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
rondel_add_test(distributed_test
  distributed_bad_files_test.cpp
  distributed_files_test.cpp
  distributed_resume_test.cpp
  LIBS rondel_distributed rondel_test_support)
rondel_add_test(ranks_test
  distributed_failures_test.cpp
  distributed_ranks_test.cpp
  LIBS rondel_simulated_ranks rondel_test_support)
