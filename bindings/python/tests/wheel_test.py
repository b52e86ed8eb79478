# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""What pip builds: tags that are true, and errors that say what to install."""

import importlib.metadata
import json
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import rondel

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture
def configure(tmp_path):
    """Configures the project as pip does, with more definitions; what was said, and whether."""
    if shutil.which("cmake") is None or shutil.which("ninja") is None:
        pytest.skip("needs CMake and Ninja")

    def run(*definitions, env=None):
        query = tmp_path / ".cmake/api/v1/query"
        query.mkdir(parents=True, exist_ok=True)
        (query / "codemodel-v2").touch()
        settings = {
            "CMAKE_BUILD_TYPE": "Release",
            "Python_EXECUTABLE": sys.executable,
            "RONDEL_BUILD_PYTHON": "ON",
            "RONDEL_BUILD_PLOT": "OFF",
            "RONDEL_BUILD_TOOL": "ON",
        }
        defined = [f"-D{name}={value}" for name, value in settings.items()]
        ended = subprocess.run(
            ["cmake", "-G", "Ninja", "-S", ROOT, "-B", tmp_path, *defined, *definitions],
            capture_output=True,
            text=True,
            env=env,
        )
        return ended.returncode == 0, " ".join(ended.stderr.split())

    return run


def module_of(build):
    """The file name of the extension module, as CMake says."""
    for path in build.glob(".cmake/api/v1/reply/target-rondel_python-*.json"):
        return pathlib.Path(json.loads(path.read_text("utf-8"))["artifacts"][0]["path"]).name
    raise AssertionError("CMake says nothing of the target rondel_python")


def is_for_one_python(module):
    return re.fullmatch(r"_core\.cpython-\d+t?-.*", module) is not None


def test_a_wheel_for_one_python_has_its_module(configure, tmp_path):
    done, said = configure()
    assert done, said
    assert is_for_one_python(module_of(tmp_path))


def test_a_wheel_with_the_tag_abi3_has_such_a_module_or_none(configure, tmp_path):
    done, said = configure(
        "-DSKBUILD_SABI_COMPONENT=Development.SABIModule", "-DSKBUILD_SABI_VERSION=3.12"
    )
    if done:
        assert module_of(tmp_path) == "_core.abi3.so"
    else:
        assert "would have the tag abi3" in said
        assert "needs CMake 3.26 and Python 3.12" in said


def test_an_installed_wheel_has_the_module_of_its_tag():
    try:
        files = importlib.metadata.distribution("rondel").files or []
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("rondel is not installed from a wheel")
    (tags,) = (f.read_text() for f in files if f.name == "WHEEL")
    (module,) = (f.name for f in files if f.name.startswith("_core.") and f.suffix == ".so")
    assert ("-abi3-" in tags) == (module == "_core.abi3.so")


def test_what_is_imported_has_all_modules():
    """Built or installed: what CMake links, and what is in the wheel, is what there is."""
    sources = ROOT / "bindings/python/rondel"
    modules = {path.name for path in pathlib.Path(rondel.__file__).parent.glob("*.py")}
    assert {"out_of_core.py", "distributed.py"} <= modules
    assert modules == {path.name for path in sources.glob("*.py")}


@pytest.mark.parametrize(
    ("package", "debian"),
    [
        ("CLI11", "libcli11-dev"),
        ("FastFloat", "libfast-float-dev"),
        ("nlohmann_json", "nlohmann-json3-dev"),
        ("ZLIB", "zlib1g-dev"),
    ],
)
def test_what_is_missing_is_said(configure, package, debian):
    done, said = configure(f"-DCMAKE_DISABLE_FIND_PACKAGE_{package}=ON")
    assert not done
    assert f"Rondel needs {package}" in said
    assert f"apt install {debian}" in said


def test_a_missing_compiler_is_said(configure, tmp_path):
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("cmake", "ninja"):
        (tools / name).symlink_to(shutil.which(name))
    for env in ({"PATH": str(tools)}, {"PATH": str(tools), "CXX": "g++ -pthread"}):
        done, said = configure(env=env)
        assert not done
        assert "There is no C++ compiler" in said
        assert "apt install g++" in said


def test_the_source_distribution_has_what_messages_name():
    """The folders and files that sdist.exclude leaves out are named by no message."""
    tomllib = pytest.importorskip("tomllib")
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    sdist = settings["tool"]["scikit-build"]["sdist"]
    said = "".join(
        path.read_text("utf-8")
        for path in (ROOT / "cmake/RondelFind.cmake", *(ROOT / "bindings").rglob("*.cmake"))
    ) + (ROOT / "bindings/python/CMakeLists.txt").read_text("utf-8")
    named = set(re.findall(r"\bscripts/[\w/.-]*\w", said))
    assert named
    for name in named:
        assert (ROOT / name).exists()
        assert any(name == kept or name.startswith(kept + "/") for kept in sdist["include"]), name
