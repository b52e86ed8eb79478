# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of Hypothesis: the same examples every time, few of them, and no clock."""

import hypothesis

hypothesis.settings.register_profile(
    "rondel", derandomize=True, deadline=None, max_examples=40, database=None
)
hypothesis.settings.load_profile("rondel")
