# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of peers' names (site/peers_api.toml) are what the peers that are here have."""

import importlib.util
import pathlib

import pytest

pytest.importorskip("tomllib")
ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def peers_api():
    spec = importlib.util.spec_from_file_location("peers_api", ROOT / "site/peers_api.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_each_peer_has_a_table(peers_api):
    assert set(peers_api.PEERS) == set(peers_api.table())


@pytest.mark.parametrize("peer", ["scipy", "xesmf", "d3", "cgal"])
def test_a_table_has_the_names_of_the_peer(peers_api, peer):
    try:
        missing, superfluous, unknown = peers_api.faults(peer)
    except peers_api.Missing as error:
        assert peer != "scipy"
        pytest.skip(f"{error} is not installed")
    assert (missing, superfluous, unknown) == ([], [], [])


def test_what_is_wrong_is_found(peers_api, monkeypatch, capsys):
    names = {"points": "`rondel.SphericalVoronoi`", "volume, regions": "`rondel.no_such_name`"}
    table = {"scipy": {"title": "", "version": "", "words": "", "names": names}}
    monkeypatch.setattr(peers_api, "table", lambda: table)
    missing, superfluous, unknown = peers_api.faults("scipy")
    assert "calculate_areas" in missing
    assert superfluous == ["volume"]
    assert unknown == ["rondel.no_such_name"]
    assert peers_api.check(["scipy"]) is None
    assert "no row for" in capsys.readouterr().err


def test_names_of_ours_are_looked_up(peers_api):
    assert peers_api.exists("rondel.SphericalVoronoi.calculate_areas")
    assert peers_api.exists("rondel.mesh.scvt")
    assert not peers_api.exists("rondel.SphericalVoronoi.volumes")
    assert not peers_api.exists("rondel.nothing.at_all")
