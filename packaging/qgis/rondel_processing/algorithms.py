# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The algorithms. Each writes its inputs as GeoJSON in WGS 84, calls the tool, and hands its output on."""

import pathlib
import tempfile

from osgeo import gdal
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsFeatureSink,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingException,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterNumber,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterString,
    QgsSettings,
    QgsVectorLayer,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

from . import tool

WGS84 = "EPSG:4326"


def geometry_of(geometry, transform):
    """GeoJSON of points and polygons, with all digits of their coordinates; None without a place."""
    if geometry.isNull() or geometry.isEmpty():
        return None
    geometry.transform(transform)
    kind = QgsWkbTypes.geometryType(geometry.wkbType())
    is_multi = geometry.isMultipart()
    pair = lambda point: [point.x(), point.y()]  # noqa: E731
    rings = lambda polygon: [[pair(point) for point in ring] for ring in polygon]  # noqa: E731
    if kind == QgsWkbTypes.PointGeometry and is_multi:
        return {"type": "MultiPoint", "coordinates": [pair(point) for point in geometry.asMultiPoint()]}
    if kind == QgsWkbTypes.PointGeometry:
        return {"type": "Point", "coordinates": pair(geometry.asPoint())}
    if is_multi:
        return {"type": "MultiPolygon", "coordinates": [rings(polygon) for polygon in geometry.asMultiPolygon()]}
    return {"type": "Polygon", "coordinates": rings(geometry.asPolygon())}


def value_of(value):
    """A value of an attribute as JSON has it."""
    if value is None or (isinstance(value, QVariant) and value.isNull()):
        return None
    if isinstance(value, float) and value != value:
        return None
    return value if isinstance(value, (bool, int, float, str)) else str(value)


class RondelAlgorithm(QgsProcessingAlgorithm):
    """What the algorithms share: sites in, a run of the tool, features out."""

    INPUT, OUTPUT = "INPUT", "OUTPUT"
    NAME = TITLE = HELP = ""
    RESULT = QgsProcessing.TypeVectorPolygon

    def name(self):
        return self.NAME

    def displayName(self):
        return self.TITLE

    def shortHelpString(self):
        return self.HELP

    def createInstance(self):
        return type(self)()

    def initAlgorithm(self, configuration=None):
        self.addParameter(QgsProcessingParameterFeatureSource(self.INPUT, "Sites", [QgsProcessing.TypeVectorPoint]))
        self.add_options()
        self.add_output()

    def add_options(self):
        """Adds parameters beside input and output."""

    def add_output(self):
        self.addParameter(QgsProcessingParameterFeatureSink(self.OUTPUT, self.TITLE, self.RESULT))

    def arguments(self, sites, output, parameters, context, folder):
        """The arguments of the tool."""
        raise NotImplementedError

    def export(self, name, path, parameters, context):
        """Writes a layer for the tool; None if the parameter is not set."""
        source = self.parameterAsSource(parameters, name, context)
        if source is None:
            return None
        transform = QgsCoordinateTransform(
            source.sourceCrs(), QgsCoordinateReferenceSystem(WGS84), context.transformContext()
        )
        names = source.fields().names()
        tool.write_features(
            path,
            (
                (geometry_of(feature.geometry(), transform), dict(zip(names, map(value_of, feature.attributes()))))
                for feature in source.getFeatures()
            ),
        )
        return path

    def call(self, folder, ending, parameters, context, feedback):
        """Runs the tool, and returns the file that it made."""
        sites = self.export(self.INPUT, folder / "sites.geojson", parameters, context)
        if sites is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, self.INPUT))
        output = folder / f"output{ending}"
        try:
            program = tool.find_tool(QgsSettings().value("rondel/tool", "") or "")
            arguments = self.arguments(sites, output, parameters, context, folder)
            tool.run_tool(program, arguments, feedback.isCanceled, feedback.pushInfo)
        except tool.ToolError as error:
            raise QgsProcessingException(str(error)) from error
        return output

    def processAlgorithm(self, parameters, context, feedback):
        with tempfile.TemporaryDirectory() as name:
            made = self.call(pathlib.Path(name), ".geojson", parameters, context, feedback)
            layer = QgsVectorLayer(str(made), "output", "ogr")
            kind = layer.wkbType() if layer.featureCount() else QgsWkbTypes.MultiPolygon
            crs = QgsCoordinateReferenceSystem(WGS84)
            sink, identifier = self.parameterAsSink(
                parameters, self.OUTPUT, context, layer.fields(), QgsWkbTypes.multiType(kind), crs
            )
            if sink is None:
                raise QgsProcessingException(self.invalidSinkError(parameters, self.OUTPUT))
            for feature in layer.getFeatures():
                geometry = feature.geometry()
                geometry.convertToMultiType()
                feature.setGeometry(geometry)
                sink.addFeature(feature, QgsFeatureSink.FastInsert)
            del sink
        return {self.OUTPUT: identifier}


class Delaunay(RondelAlgorithm):
    NAME, TITLE = "delaunay", "Delaunay triangulation on the sphere"
    HELP = "Triangles of sites, over the poles and across the antimeridian; the field sites has the numbers of corners."

    def arguments(self, sites, output, parameters, context, folder):
        return tool.delaunay(sites, output)


class Voronoi(RondelAlgorithm):
    NAME, TITLE = "voronoi", "Voronoi cells on the sphere"
    HELP = "The cell of each site, in great circles, cut by the polygons of a layer if there is one, as of land."
    CLIP = "CLIP"

    def add_options(self):
        polygons = [QgsProcessing.TypeVectorPolygon]
        self.addParameter(QgsProcessingParameterFeatureSource(self.CLIP, "Clip to", polygons, optional=True))

    def arguments(self, sites, output, parameters, context, folder):
        return tool.voronoi(sites, output, self.export(self.CLIP, folder / "clip.geojson", parameters, context))


class Dissolve(Voronoi):
    NAME, TITLE = "dissolve", "Voronoi cells joined by a field"
    HELP = "The union of the cells of all sites with the same text in a field; sites without one are left out."
    FIELD = "FIELD"

    def add_options(self):
        self.addParameter(QgsProcessingParameterField(self.FIELD, "Field", None, self.INPUT))
        super().add_options()

    def arguments(self, sites, output, parameters, context, folder):
        clip = self.export(self.CLIP, folder / "clip.geojson", parameters, context)
        return tool.voronoi(sites, output, clip, self.parameterAsString(parameters, self.FIELD, context))


class Interpolate(RondelAlgorithm):
    NAME, TITLE = "interpolate", "Interpolation on the sphere"
    HELP = "A raster of the globe in degrees from values at sites: Sibson's natural neighbours, linear, cubic ..."
    FIELD, DEGREES, METHOD = "FIELD", "DEGREES", "METHOD"

    def add_options(self):
        numeric = QgsProcessingParameterField.Numeric
        number = QgsProcessingParameterNumber.Double
        self.addParameter(QgsProcessingParameterField(self.FIELD, "Values", None, self.INPUT, numeric))
        self.addParameter(
            QgsProcessingParameterNumber(self.DEGREES, "Cell size in degrees, which divides 180", number, 1, False, 0.001, 90)
        )
        self.addParameter(QgsProcessingParameterEnum(self.METHOD, "Method", tool.METHODS, defaultValue=0))

    def add_output(self):
        self.addParameter(QgsProcessingParameterRasterDestination(self.OUTPUT, self.TITLE))

    def arguments(self, sites, output, parameters, context, folder):
        return tool.interpolate(
            sites,
            output,
            self.parameterAsString(parameters, self.FIELD, context),
            self.parameterAsDouble(parameters, self.DEGREES, context),
            tool.METHODS[self.parameterAsEnum(parameters, self.METHOD, context)],
        )

    def processAlgorithm(self, parameters, context, feedback):
        path = self.parameterAsOutputLayer(parameters, self.OUTPUT, context)
        with tempfile.TemporaryDirectory() as name:
            made = self.call(pathlib.Path(name), ".nc", parameters, context, feedback)
            if gdal.Translate(path, str(made), outputSRS=WGS84) is None:
                raise QgsProcessingException(gdal.GetLastErrorMsg())
        return {self.OUTPUT: path}


class Contours(RondelAlgorithm):
    NAME, TITLE = "contours", "Isolines or bands on the sphere"
    HELP = "Lines of equal value, or the regions between them, of values that are linear in each triangle."
    FIELD, STEP, LEVELS, BANDS = "FIELD", "STEP", "LEVELS", "BANDS"
    RESULT = QgsProcessing.TypeVectorAnyGeometry

    def add_options(self):
        numeric = QgsProcessingParameterField.Numeric
        number = QgsProcessingParameterNumber.Double
        self.addParameter(QgsProcessingParameterField(self.FIELD, "Values", None, self.INPUT, numeric))
        self.addParameter(QgsProcessingParameterNumber(self.STEP, "Distance of levels", number, 10, False, 1e-300))
        self.addParameter(
            QgsProcessingParameterString(self.LEVELS, "Levels, with commas between them, in place of the distance", "", False, True)
        )
        self.addParameter(QgsProcessingParameterBoolean(self.BANDS, "Regions between levels", False))

    def arguments(self, sites, output, parameters, context, folder):
        text = self.parameterAsString(parameters, self.LEVELS, context)
        try:
            levels = [float(part) for part in text.split(",")] if text.strip() else []
        except ValueError as error:
            raise QgsProcessingException(f"levels: {error}") from error
        return tool.contours(
            sites,
            output,
            self.parameterAsString(parameters, self.FIELD, context),
            self.parameterAsDouble(parameters, self.STEP, context),
            levels,
            self.parameterAsBoolean(parameters, self.BANDS, context),
        )
