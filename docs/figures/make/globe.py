#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the figures of a page with the weather stations as a browser shows it: docs/figures/globe.png, and the
globe that turns, docs/figures/turning-globe.webp.

    docs/figures/make/globe.py build/release/bin/rondel
"""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
FIGURES = ROOT / "docs/figures"
sys.path.insert(0, str(ROOT / "tests/globe"))

from browser import Browser  # noqa: E402

NUM_FRAMES = 60
BERMUDA = (-64.68333, 32.36667)


def still(browser, path):
    page = browser.open(path, width=1100, height=700, dark=True)
    page.wait_until_drawn()
    lon, lat = BERMUDA
    page.run(f"rondelGlobe.camera.lookAt({lon} + 3, {lat} - 8, 0); rondelGlobe.redraw()")
    page.wait_until_drawn()
    page.run(f"rondelGlobe.choose(rondelGlobe.pick(rondelGlobe.directionOf({lon}, {lat})))")
    page.wait_until_drawn()
    page.picture(FIGURES / "globe.png")
    page.close()


def turning(browser, path, folder):
    page = browser.open(path, width=440, height=440, dark=True)
    page.wait_until_drawn()
    page.run("for (const part of document.querySelectorAll('body > *, main > *')) if (!part.contains(rondelGlobe.element)) part.style.display = 'none'")
    frames = []
    for i in range(NUM_FRAMES):
        page.run(f"rondelGlobe.camera.lookAt(-100 + {i} * 360 / {NUM_FRAMES}, 25, 0); rondelGlobe.redraw()")
        page.wait_until_drawn()
        frames.append(folder / f"{i:03}.png")
        page.picture(frames[-1])
    page.close()
    subprocess.run(
        ["img2webp", "-loop", "0", "-lossy", "-q", "40", "-m", "6", "-d", "100", *frames, "-o", FIGURES / "turning-globe.webp"],
        check=True,
        stdout=subprocess.DEVNULL,
    )


def main():
    with tempfile.TemporaryDirectory() as name, Browser("chromium") as browser:
        folder = pathlib.Path(name)
        path = folder / "stations.html"
        subprocess.run([sys.argv[1], "plot", ROOT / "data/stations.csv", "--quiet", "-o", path], check=True)
        still(browser, path)
        turning(browser, path, folder)


if __name__ == "__main__":
    main()
