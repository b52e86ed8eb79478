# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A plug-in of pytest that runs xarray-regrid's own tests with the methods of examples/clients.

PYTHONPATH=examples/clients:tests/clients pytest -p xarray_regrid_plugin XARRAY_REGRID/tests
"""

import xarray_regrid_rondel

xarray_regrid_rondel.use_by_default()
