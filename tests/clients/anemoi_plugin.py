# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A plug-in of pytest that runs anemoi-graphs' own tests on the classes of examples/clients.

PYTHONPATH=examples/clients:tests/clients pytest -p anemoi_plugin ANEMOI/tests/nodes
"""

import anemoi_graphs
from anemoi.graphs.nodes import attributes

for theirs, ours in (
    ("SphericalAreaWeights", anemoi_graphs.AreaWeights),
    ("PlanarAreaWeights", anemoi_graphs.RegionalAreaWeights),
    ("MaskedPlanarAreaWeights", anemoi_graphs.MaskedRegionalAreaWeights),
):
    setattr(attributes, theirs, ours)
    setattr(attributes, ours.__name__, ours)  # configurations name classes
