"""Size, building time and first paint of report pages, and error of the felt map relative to a session, as a table.

python benchmarks/report_pages.py

Scenes are the demo kitchen and, if they are beside the project, three by other authors. The objects of
`messy_japanese_room` have no usable names; there one table hums, and all objects are of oak. Building time is that of
`write_report` for a bundle in memory, the least of three. First paint and first picture of the scene are medians of
five loads from a file, in headless Chromium with software rendering; they need playwright and chromium. The felt map is
compared with a session's gains at 200 points of all patches, where the level is within the page's range.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from others import SCENES
from scene2hap import HapticBundle, HapticSession, Touch, bake, load_scene, rebake
from scene2hap.demo import kitchen_path
from scene2hap.report import write_report
from scene2hap.report.document import level_bytes
from scene2hap.report.felt_map import ALL_BANDS, felt_map

N_BUILDS, N_LOADS, N_POINTS = 3, 5, 200
LOW_DB, HIGH_DB = -20.0, 50.0
ROOMS = {
    "aws_house_living": ("aws_house_living.glb", None),
    "composed_kitchen_kaykit": ("composed_kitchen_kaykit.glb", None),
    "messy_japanese_room": ("room.glb", 0.1),
}
FLAGS = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def baked(path: Path, unit_m: float | None) -> HapticBundle:
    bundle = bake(load_scene(path, unit_m=unit_m))
    if bundle.loops:
        return bundle
    for object_id in bundle.objects:
        bundle = bundle.override(object_id, material="oak")
    return rebake(bundle.override("Object_12", vibrates=True))


def built(bundle: HapticBundle, path: Path) -> float:
    """Write the page `N_BUILDS` times. Returns the least time [s]."""
    times = []
    for _ in range(N_BUILDS):
        begun = time.perf_counter()
        write_report(bundle, path)
        times.append(time.perf_counter() - begun)
    return min(times)


def off_db(bundle: HapticBundle) -> tuple[float, int]:
    """Largest difference [dB] between stored levels of a page and a session's levels, and the number of levels."""
    felt = felt_map(bundle)
    session = HapticSession(bundle)
    places = [(patch.object_id, point) for patch in felt.patches for point in patch.points_m.tolist()]
    found = []
    for place in np.random.default_rng(5).choice(len(places), N_POINTS, replace=False).tolist():
        object_id, (x, y, z) = places[place]
        frame = session.update(touches=[Touch("left", object_id, (x, y, z))])
        for source, loops in bundle.loops.items():
            gain, loop = frame.gain("left", source), next(iter(loops.values()))
            expected = 20.0 * np.log10(max(gain, 1e-12)) + (loop.felt.level_db if loop.felt is not None else 0.0)
            if LOW_DB < expected < HIGH_DB:
                level = felt.levels_db["exponential_plate"][source][ALL_BANDS][place]
                (stored,) = np.frombuffer(level_bytes(np.array([level], np.float32)), "<u2")
                found.append(abs((int(stored) - 1) / 65_534 * (HIGH_DB - LOW_DB) + LOW_DB - expected))
    return max(found, default=0.0), len(found)


def painted(pages: list[Path]) -> list[tuple[str, str]]:
    """Times of first paint and first picture of the scene [ms] of each page, "-" without a browser."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        return [("-", "-")] * len(pages)
    browser_path = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser_path is None:
        return [("-", "-")] * len(pages)
    rows = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path, headless=True, args=FLAGS)
        for page in pages:
            paints, pictures = [], []
            for _ in range(N_LOADS):
                tab = browser.new_page(viewport={"width": 1280, "height": 800})
                # The page sets this attribute when its first frame is drawn.
                tab.add_init_script(
                    "new MutationObserver(() => { window.drawn ??= performance.now(); })"
                    ".observe(document, {attributes: true, subtree: true, attributeFilter: ['data-ready']});"
                )
                tab.goto(page.as_uri())
                tab.wait_for_selector("html[data-ready='1']")
                paints.append(tab.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime"))
                pictures.append(tab.evaluate("window.drawn"))
                tab.close()
            rows.append((f"{statistics.median(paints):.0f}", f"{statistics.median(pictures):.0f}"))
        browser.close()
    return rows


def main() -> None:
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    scenes: dict[str, tuple[Path, float | None]] = {"demo kitchen": (kitchen_path(), None)}
    scenes |= {name: (SCENES / name / file, unit_m) for name, (file, unit_m) in ROOMS.items()}
    there = {name: given for name, given in scenes.items() if given[0].exists()}
    rows, pages = [], []
    with tempfile.TemporaryDirectory() as place:
        for name, (path, unit_m) in there.items():
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                bundle = baked(path, unit_m)
                page = Path(place) / f"{path.stem}.html"
                seconds = built(bundle, page)
                off, n_levels = off_db(bundle)
            n_faces = sum(len(item.geometry.mesh.faces) for item in bundle.snapshot.objects)
            rows.append(
                f"| {name} | {len(bundle.objects)} | {n_faces:,} | {len(bundle.loops)} | "
                f"{page.stat().st_size / 1e6:.2f} | {seconds:.2f} | {{}} | {{}} | {off:.4f} | {n_levels} |"
            )
            pages.append(page)
        seen = painted(pages)
    print(
        "| scene | objects | triangles | sources | page [MB] | built in [s] | first paint [ms] | first picture [ms] | "
        "largest error of the felt map [dB] | levels compared |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    for row, times in zip(rows, seen, strict=True):
        print(row.format(*times))
    absent = [name for name in scenes if name not in there]
    if absent:
        print(f"\nNot measured, since their files are not there: {', '.join(absent)}.")


if __name__ == "__main__":
    main()
