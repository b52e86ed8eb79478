# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the files that examples of help pages and documents name, where an example needs them."""

import json
import math
import random
import shutil
import subprocess


def stations(path):
    """300 places with the columns that examples name."""
    generator = random.Random(1)
    with open(path, "w", encoding="utf-8") as file:
        file.write("name,country,lon,lat,east,north,temperature,t,depth\n")
        for k in range(300):
            lon = round(generator.uniform(-180, 180), 3)
            lat = round(math.degrees(math.asin(generator.uniform(-1, 1))), 3)
            warmth = round(30 * math.cos(math.radians(lat)) - 5, 2)
            depth = round(generator.uniform(-500, 4000), 1)
            country = "ABCD"[int((lon + 180) // 90) % 4]
            file.write(f"station {k},{country},{lon},{lat},{lon},{lat},{warmth},{warmth},{depth}\n")


def table(header, rows):
    def make(path):
        path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")

    return make


def features(*geometries):
    """A maker of a GeoJSON file with a feature a geometry, (type, coordinates)."""

    def make(path):
        path.write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": f"feature {k}", "NAME": f"feature {k}"},
             "geometry": {"type": kind, "coordinates": coordinates}}
            for k, (kind, coordinates) in enumerate(geometries)]}), encoding="utf-8")

    return make


def box(west, south, east, north):
    return "Polygon", [[[west, south], [east, south], [east, north], [west, north], [west, south]]]


def by_rondel(command):
    """A maker that runs the tool in the folder of the file."""

    def make(path):
        subprocess.run(["sh", "-c", f"rondel {command} -o {path.name} --quiet"], cwd=path.parent, check=True)

    return make


def netcdf(text):
    """A maker of a classic netCDF file from the text that ncgen reads."""

    def make(path):
        source = path.with_suffix(".cdl")
        source.write_text(text, encoding="utf-8")
        subprocess.run(["ncgen", "-k", "classic", "-o", path.name, source.name], cwd=path.parent, check=True)
        source.unlink()

    return make


def grid(variable, attributes, function):
    """The text of a grid of 36 by 18 cells with one variable, a function of longitude and latitude in degrees."""
    lons = [5 + 10 * i for i in range(36)]
    lats = [-85 + 10 * j for j in range(18)]
    values = ", ".join(f"{function(lon, lat):.4f}" for lat in lats for lon in lons)
    return f"""netcdf grid {{
dimensions: lat = 18 ; lon = 36 ; nv = 2 ;
variables:
  double lat(lat) ; lat:units = "degrees_north" ; lat:bounds = "lat_bnds" ;
  double lon(lon) ; lon:units = "degrees_east" ; lon:bounds = "lon_bnds" ;
  double lat_bnds(lat, nv) ; double lon_bnds(lon, nv) ;
  double {variable}(lat, lon) ; {attributes}
data:
  lat = {", ".join(map(str, lats))} ;
  lon = {", ".join(map(str, lons))} ;
  lat_bnds = {", ".join(f"{lat - 5}, {lat + 5}" for lat in lats)} ;
  lon_bnds = {", ".join(f"{lon - 5}, {lon + 5}" for lon in lons)} ;
  {variable} = {values} ;
}}
"""


def winds():
    """The text of a grid with both components of a wind."""
    text = grid("u10", 'u10:units = "m s-1" ;', lambda lon, lat: 10 - abs(lat) / 9)
    text = text.replace("double u10(lat, lon) ;", "double u10(lat, lon) ; double v10(lat, lon) ;")
    return text.replace("\n}\n", "\n  v10 = " + ", ".join(["1"] * 648) + " ;\n}\n")


def model():
    """The text of such a grid with temperatures at three times."""
    text = grid("tas", 'tas:units = "K" ;', lambda lon, lat: 300 - abs(lat) + lon / 360)
    values = text.partition(" tas = ")[2].partition(" ;")[0]
    return (text.replace("nv = 2 ;", "nv = 2 ; time = 3 ;").replace("tas(lat, lon)", "tas(time, lat, lon)")
            .replace("double tas", 'double time(time) ; time:units = "days since 2000-01-01" ;\n  double tas')
            .replace(" tas = ", f" time = 15, 46, 75 ;\n  tas = {values}, {values}, "))


def icon():
    """The text of an ICON grid in radians: the eight faces of an octahedron."""
    corners = []
    centers = []
    for k in range(4):
        for pole in (90, -90):
            corners.append([(90 * k, 0), (90 * k + 90, 0), (90 * k + 45, pole)][:: 1 if pole > 0 else -1])
            centers.append((90 * k + 45, math.copysign(35.2643896828, pole)))

    def radians(numbers):
        return ", ".join(repr(math.radians(number)) for number in numbers)

    return f"""netcdf icon {{
dimensions: cell = 8 ; nv = 3 ;
variables:
  double clon(cell) ; clon:units = "radian" ; clon:bounds = "clon_vertices" ;
  double clat(cell) ; clat:units = "radian" ; clat:bounds = "clat_vertices" ;
  double clon_vertices(cell, nv) ; clon_vertices:units = "radian" ;
  double clat_vertices(cell, nv) ; clat_vertices:units = "radian" ;
data:
  clon = {radians(lon for lon, _ in centers)} ;
  clat = {radians(lat for _, lat in centers)} ;
  clon_vertices = {radians(lon for cell in corners for lon, _ in cell)} ;
  clat_vertices = {radians(lat for cell in corners for _, lat in cell)} ;
}}
"""


def waves():
    """The text of a mesh of two triangles around a place, with heights at its nodes."""
    return """netcdf waves {
dimensions: node = 4 ; face = 2 ; three = 3 ;
variables:
  int mesh ; mesh:cf_role = "mesh_topology" ; mesh:topology_dimension = 2 ; mesh:node_coordinates = "x y" ;
  mesh:face_node_connectivity = "faces" ;
  double x(node) ; x:units = "degrees_east" ; double y(node) ; y:units = "degrees_north" ;
  int faces(face, three) ; faces:start_index = 0 ;
  double height(node) ; height:units = "m" ; height:mesh = "mesh" ; height:location = "node" ;
data:
  x = 0, 10, 10, 0 ; y = 50, 50, 60, 60 ; faces = 0, 1, 2, 0, 2, 3 ; height = 1, 2, 3, 2 ;
}
"""


def run():
    """The text of values on the 642 cells of mesh.nc, without places, as a model writes them that keeps its mesh apart."""
    values = ", ".join(f"{(7 * k % 642) / 200:.3f}" for k in range(2 * 642))
    return f"""netcdf run {{
dimensions: Time = 2 ; nCells = 642 ;
variables:
  double ssh(Time, nCells) ; ssh:units = "m" ;
data:
  ssh = {values} ;
}}
"""


def curvilinear():
    """The text of a small grid in coordinates of two dimensions, as WRF has it."""
    places = [(10 + 0.2 * i - 0.05 * j, 45 + 0.05 * i + 0.2 * j) for j in range(5) for i in range(6)]
    return f"""netcdf wrf {{
dimensions: south_north = 5 ; west_east = 6 ;
variables:
  float XLONG(south_north, west_east) ; XLONG:units = "degrees_east" ;
  float XLAT(south_north, west_east) ; XLAT:units = "degrees_north" ;
  float T2(south_north, west_east) ; T2:units = "K" ; T2:coordinates = "XLONG XLAT" ;
data:
  XLONG = {", ".join(f"{lon:.2f}" for lon, _ in places)} ;
  XLAT = {", ".join(f"{lat:.2f}" for _, lat in places)} ;
  T2 = {", ".join(str(280 + k) for k in range(30))} ;
}}
"""


def copy(root, name):
    return lambda path: shutil.copy(root / name, path)


triangles = table("a square", ["2 4", "1 0 0 9", "2 1 0 8", "3 1 1 7", "4 0 1 6", "1 3 1 2 3", "2 3 1 3 4"])


def makers(root):
    """Makers of the files, by name."""
    return {
        "stations.csv": stations,
        "soundings.csv": stations,
        "dikes.csv": table("from,to", ["0,1"]),
        "ships.csv": table("name,lon,lat", ["Fram,12.5,81", "Beagle,-70.25,-54.5", "Vega,178.9,66.1"]),
        "cities.csv": table("name,lon,lat,population",
                            ["Lagos,3.4,6.5,15", "Lima,-77,-12,11", "Delhi,77.2,28.6,33", "Paris,2.3,48.9,11"]),
        "rivers.geojson": features(("LineString", [[0, 0], [5, 3], [9, 9]]), ("LineString", [[20, -5], [24, 2]])),
        "sections.geojson": features(("LineString", [[-60, 50], [-10, 40]]), ("LineString", [[-70, 10], [-20, 10]])),
        "islands.geojson": features(box(-10, -10, 5, 8), box(100, 40, 130, 60), box(-80, -60, -50, -30)),
        "basins.geojson": features(box(-10, -20, 30, 20), box(20, 0, 60, 30), box(-70, -40, -50, 0)),
        "roads.geojson": features(("LineString", [[0, 4], [10, 0]]), ("LineString", [[20, 0], [30, 0]])),
        "sea.geojson": features(box(-10, 40, 20, 60)),
        "fort.14": triangles,
        "hgrid.gr3": triangles,
        "lakes.geojson": features(box(31, -3, 34, 1), box(50, 37, 54, 47), box(-80, 43, -76, 44)),
        "parcels.geojson": features(("Polygon", [[[0, 0], [10, 10], [10, 0], [0, 10], [0, 0]]]), box(32, -2, 40, 6)),
        "region.geojson": features(box(-30, -20, 40, 50)),
        "land.geojson": copy(root, "data/land-110m.geojson"),
        "coast.geojson": features(box(-10, 40, 20, 60)),
        "countries.geojson": features(box(-20, -35, 50, 37), box(50, 5, 150, 60), box(-130, -50, -40, 55)),
        "faults.csv": table("from,to", ["0,1", "1,2"]),
        "circles.csv": by_rondel("generate circles -n 300"),
        "sites.csv": by_rondel("generate uniform -n 500 --seed 2"),
        "sites.npy": by_rondel("generate uniform -n 20000 --seed 3"),
        "huge.npy": by_rondel("generate uniform -n 20000 --seed 4"),
        "points.npy": by_rondel("generate ball -n 500"),
        "points.xyz": by_rondel("generate ball -n 500 --seed 5"),
        "scan.xyz": by_rondel("generate ball -n 500 --seed 6"),
        "ocean.nc": netcdf(grid("salinity", 'salinity:units = "1e-3" ;', lambda lon, lat: 35 - abs(lat) / 30)),
        "grid.nc": netcdf(grid("orography", 'orography:units = "m" ;', lambda lon, lat: lon + lat)),
        "mesh.nc": by_rondel("mesh icosahedral 3"),
        "icon.nc": netcdf(icon()),
        "model.nc": netcdf(model()),
        "run.nc": netcdf(run()),
        "temperature.nc": netcdf(grid("tas", 'tas:units = "K" ;', lambda lon, lat: 300 - abs(lat) + lon / 360)),
        "waves.nc": netcdf(waves()),
        "winds.nc": netcdf(winds()),
        "wrf.nc": netcdf(curvilinear()),
        "spacing.nc": netcdf(grid("h", 'h:units = "km" ;', lambda lon, lat: 400 + 2 * abs(lat))),
    }
