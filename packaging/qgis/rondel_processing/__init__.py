# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Processing algorithms for QGIS that call the tool rondel."""


def classFactory(iface):
    """Returns the plugin; QGIS calls this."""
    from .plugin import RondelPlugin

    return RondelPlugin(iface)
