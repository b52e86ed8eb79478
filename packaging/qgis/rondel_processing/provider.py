# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The provider: the list of the algorithms."""

from qgis.core import QgsProcessingProvider

from .algorithms import Contours, Delaunay, Dissolve, Interpolate, Voronoi


class RondelProvider(QgsProcessingProvider):
    """The algorithms of rondel."""

    def id(self):
        return "rondel"

    def name(self):
        return "Rondel (sphere)"

    def loadAlgorithms(self):
        for algorithm in (Delaunay, Voronoi, Dissolve, Interpolate, Contours):
            self.addAlgorithm(algorithm())
