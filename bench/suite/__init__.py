# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Runs Rondel and its peers in turns, and turns what they print into tables and plots."""
