# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The samples that come with the package, and the command beside it."""

import csv
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import rondel
import rondel.__main__ as runner
import rondel.data

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
NAMES = ["README.md", "countries-110m.geojson", "land-110m.geojson", "stations.csv"]


def test_the_samples_are_the_files_of_the_repository():
    assert sorted(path.name for path in rondel.data.FOLDER.iterdir()) == NAMES
    for name in NAMES:
        assert rondel.data.path(name).read_bytes() == (DATA / name).read_bytes()


def test_stations_are_the_rows_of_the_table():
    with (DATA / "stations.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))[1:]
    found = rondel.data.stations()
    assert len(rows) == 5634
    assert [list(row[:2]) for row in zip(found.id, found.name, strict=True)] == [
        row[:2] for row in rows
    ]
    assert np.array_equal(found.lon, [float(row[2]) for row in rows])
    assert np.array_equal(found.lat, [float(row[3]) for row in rows])
    at_the_pole = found.id[found.lat == -90]
    assert at_the_pole.tolist() == ["NZSP"]


def test_land_and_countries_are_geojson():
    land, countries = rondel.data.land(), rondel.data.countries()
    assert land == json.loads((DATA / "land-110m.geojson").read_text("utf-8"))
    assert len(countries["features"]) == 177
    names = [feature["properties"]["name"] for feature in countries["features"]]
    assert len(set(names)) == 177
    place = {"type": "Point", "coordinates": [2.35, 48.86]}
    around = rondel.contains(countries["features"], place)
    assert [name for name, has in zip(names, around, strict=True) if has] == ["France"]
    assert rondel.contains(land, place).tolist() == [True]


@pytest.mark.parametrize("name", ["cities.csv", "../data.py", "", "/etc/passwd"])
def test_what_is_no_sample_is_named(name):
    with pytest.raises(FileNotFoundError, match=r"there is no sample .*stations\.csv"):
        rondel.data.path(name)


def run(arguments, folder, **environment):
    return subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env={
            **os.environ,
            "PYTHONPATH": str(pathlib.Path(rondel.__file__).parents[1]),
            **environment,
        },
    )


def test_copies_lie_where_the_guide_looks_for_them(tmp_path):
    for _ in range(2):  # the same files once more are no error
        ended = run(["rondel.data"], tmp_path)
        assert ended.returncode == 0, ended.stderr
        assert ended.stderr == ""
        assert sorted(path.name for path in (tmp_path / "data").iterdir()) == NAMES
    (tmp_path / "data/stations.csv").write_text("mine\n")
    (tmp_path / "data/README.md").unlink()
    ended = run(["rondel.data", "data"], tmp_path)
    assert ended.returncode == 1
    assert "another content" in ended.stderr
    assert (tmp_path / "data/stations.csv").read_text() == "mine\n"
    assert not (tmp_path / "data/README.md").exists()
    assert run(["rondel.data", "a", "b"], tmp_path).returncode == 2


def test_the_module_runs_the_command(tmp_path):
    tool = os.environ.get("RONDEL")
    if tool is None:
        pytest.skip("no RONDEL")
    path = f"{pathlib.Path(tool).parent}{os.pathsep}{os.environ['PATH']}"
    sample = str(rondel.data.path("stations.csv"))
    ended = run(["rondel", "info", sample], tmp_path, PATH=path)
    expected = subprocess.run([tool, "info", sample], capture_output=True, text=True)
    assert ended.returncode == expected.returncode == 0
    assert "5,634" in ended.stdout.replace("5634", "5,634")
    assert ended.stdout == expected.stdout
    assert run(["rondel", "no-command"], tmp_path, PATH=path).returncode == 2


def test_a_command_of_another_version_is_not_run(tmp_path, monkeypatch):
    other = tmp_path / "rondel"
    other.write_text("#!/bin/sh\necho rondel 99.0\n")
    other.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(runner, "installed_files", list)
    assert runner.command() is None
    other.write_text(f"#!/bin/sh\necho rondel {rondel.__version__}\n")
    assert runner.command() == str(other)
    monkeypatch.setattr(runner, "installed_files", lambda: [pathlib.Path("a"), other])
    monkeypatch.setenv("PATH", "")
    assert runner.command() == str(other)
