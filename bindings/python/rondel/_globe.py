# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Pages of HTML with a globe to turn, zoom and point at, for browsers and notebooks."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from ._arrays import as_colors, as_name, require_finite_or_nan
from ._geo import Path
from ._properties import checked_properties, json_cells
from ._types import ArrayLike

if TYPE_CHECKING:
    import IPython.display

    from ._contours import Isolines

Show = Literal["delaunay", "voronoi", "both"]


class Globes:
    """Pages with a globe: methods of triangulations and diagrams."""

    def save_html(
        self: Any,
        path: Path,
        values: ArrayLike | None = None,
        *,
        name: str = "Value",
        isolines: Isolines | None = None,
        properties: Mapping[str, Any] | None = None,
        title: str = "Globe",
        show: Show | None = None,
        sites: bool = True,
        circles: bool = False,
        view: tuple[float, float] | None = None,
    ) -> None:
        """Writes an HTML page with an interactive globe, one file for any browser.

        The page needs neither a server nor a network: it contains the triangulation, its diagram,
        areas, values and properties.

        Parameters
        ----------
        path : path-like
            The file to write. It appears when it is complete, and replaces an existing one.
        values : array_like, shape (n,), optional
            A number for each site, shown as the color of its cell, with a color bar; NaN has no
            color.
        name : str, optional
            The name of the values.
        isolines : Isolines, optional
            Lines of `SphericalDelaunay.isolines`, which are drawn over the cells.
        properties : mapping of str to sequence, optional
            Properties of sites, which the page shows for a selected site and can search: for each
            name a value for every site.
        title : str, optional
            The title of the page.
        show : {'delaunay', 'voronoi', 'both'}, optional
            The lines that the page shows at first; by default the cells of diagrams and if there
            are values, otherwise the triangles.
        sites, circles : bool, optional
            Whether the page shows the sites, and the circles of weighted sites, at first.
        view : (float, float), optional
            Longitude and latitude of the middle of the picture in degrees; by default the sites are
            in view.

        Raises
        ------
        OSError
            If the file cannot be written; then nothing is left of it.
        ValueError
            If the number of values is not n, a value is infinite, or `view` is no place.

        Examples
        --------
        >>> import pathlib, rondel, tempfile
        >>> lon, lat = [2.35, -74.01, 139.69, 151.21], [48.86, 40.71, 35.69, -33.87]
        >>> tri = rondel.delaunay_lonlat(lon, lat)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page = pathlib.Path(folder, "cities.html")
        ...     tri.save_html(page, properties={"city": ["Paris", "New York", "Tokyo", "Sydney"]})
        ...     page.read_text()[:15]
        '<!doctype html>'

        """
        text = _page(self, values, name, isolines, properties, title, show, sites, circles, view)
        _core.write_file(as_name(path), text)

    def view(
        self: Any,
        values: ArrayLike | None = None,
        *,
        name: str = "Value",
        isolines: Isolines | None = None,
        properties: Mapping[str, Any] | None = None,
        title: str = "Globe",
        show: Show | None = None,
        sites: bool = True,
        circles: bool = False,
        view: tuple[float, float] | None = None,
        height: int = 600,
    ) -> IPython.display.HTML:
        """Shows the globe of `save_html` in a frame of a notebook.

        Parameters
        ----------
        values, name, isolines, properties, title, show, sites, circles, view
            As in `save_html`.
        height : int, optional
            The height of the frame in pixels.

        Returns
        -------
        IPython.display.HTML
            The frame.

        Raises
        ------
        ImportError
            If IPython is not installed.

        """
        from IPython.display import HTML

        text = _page(self, values, name, isolines, properties, title, show, sites, circles, view)
        style = f"width: 100%; height: {int(height)}px; border: 0"
        srcdoc, label = html.escape(text.decode()), html.escape(title)
        frame = f'<iframe srcdoc="{srcdoc}" title="{label}" style="{style}"></iframe>'
        return HTML(f"<div>{frame}</div>")


def _page(
    self: Any,
    values: ArrayLike | None,
    name: str,
    isolines: Isolines | None,
    properties: Mapping[str, Any] | None,
    title: str,
    show: Show | None,
    sites: bool,
    circles: bool,
    view: tuple[float, float] | None,
) -> bytes:
    """The page, in UTF-8."""
    is_diagram = hasattr(self, "delaunay")
    triangulation = (self.delaunay if is_diagram else self)._triangulation
    diagram = self._diagram if is_diagram else _core.diagram(triangulation)
    numbers = None if values is None else as_colors(values, "values", len(self.points))
    if numbers is not None:
        require_finite_or_nan(numbers, "values")
    if show is None:
        show = "voronoi" if is_diagram or numbers is not None else "delaunay"
    if show not in ("delaunay", "voronoi", "both"):
        raise ValueError(f"show must be 'delaunay', 'voronoi' or 'both', not {show!r}")
    given = checked_properties(properties, (), len(self.points), as_json=True)
    columns = [(key, [_text(cell) for cell in json_cells(cells)]) for key, cells in given.items()]
    place = None if view is None else (float(view[0]), float(view[1]))
    if place is not None and not (np.isfinite(place[0]) and abs(place[1]) <= 90):
        raise ValueError(f"view must be a longitude and a latitude in degrees, not {view}")
    return _core.globe_page(
        triangulation,
        self.points,
        diagram,
        columns,
        values=numbers,
        isolines=None if isolines is None else isolines._found,
        name=str(name),
        title=str(title),
        show=show,
        sites=bool(sites),
        circles=bool(circles),
        view=place,
    )


def _text(cell: str) -> str:
    """What JSON says, for people."""
    return json.loads(cell) if cell.startswith('"') else cell
