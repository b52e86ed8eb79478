# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A plug-in of pytest that runs UXarray's own tests with the backend of examples/clients.

PYTHONPATH=examples/clients:tests/clients pytest -p uxarray_plugin UXARRAY/test/test_remap.py
"""

import uxarray_remap

uxarray_remap.use_by_default()
