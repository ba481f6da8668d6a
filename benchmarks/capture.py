"""Pictures per second of a whole scene, with sharing and culling, all rendered at once by worker processes.

    python benchmarks/capture.py SCENE [--unit-m 0.01] [--renderer embree] [--workers 2] [--size 512] [--antialias]

Prints machine, versions, pictures, unique objects u and context classes c (pictures = 4 + 8 u + 8 c), pictures per
second with the start of the workers, and the peak memory of this process and of its largest worker. With --visible it
also prints the visible share of each target's silhouette in its context images.
"""

from __future__ import annotations

import argparse
import os
import platform
import resource
import time
from importlib.metadata import PackageNotFoundError, version

import numpy as np

from scene2hap import load_scene
from scene2hap.scene.capture import capture_images, render_all
from scene2hap.scene.capture.lazy_pictures import LazyPictures
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.shot_rendering import ShotRenderer
from scene2hap.scene.snapshot import SceneSnapshot


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--unit-m", type=float)
    parser.add_argument("--renderer", default="embree")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--antialias", action="store_true")
    parser.add_argument("--visible", action="store_true", help="also measure visibility in context images")
    options = parser.parse_args()

    scene = load_scene(options.scene, unit_m=options.unit_m)
    print(
        f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, {options.workers} workers"
    )
    print(", ".join(f"{package} {version_of(package)}" for package in ("numpy", "pillow", "embreex", "panda3d")))
    triangles = sum(len(item.geometry.mesh.faces) for item in scene.objects)
    looks = sum(item.appearance is not None for item in scene.objects)
    print(f"{scene.name}: {len(scene.objects)} objects ({looks} with looks), {triangles} triangles")
    measure(scene, options)


def measure(scene: SceneSnapshot, options: argparse.Namespace) -> None:
    settings = {"antialias": options.antialias}
    captured = capture_images(scene, size_px=options.size, renderer=options.renderer, config=settings)
    before_s = time.process_time()
    begin = time.perf_counter()
    stats = render_all(captured, options.workers)
    seconds = time.perf_counter() - begin
    assert captured.images is not None
    assert isinstance(captured.images.source, LazyPictures)
    pictures = captured.images.source
    unique, classes = set(pictures.copies.isolated.values()), set(pictures.copies.context.values())
    print(f"n = {stats.rendered} pictures, u = {len(unique)}, c = {len(classes)}, {stats.from_memory} from memory")
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    cpu_s = sum(one.ru_utime + one.ru_stime for one in usage) - before_s
    print(f"{seconds:.1f} s, {stats.rendered / seconds:.1f} pictures/s at {options.size} px; on a busy machine rather")
    print(f"compare processor time: {1e3 * cpu_s / stats.rendered:.0f} ms a picture, start of the workers included")
    peaks = [one.ru_maxrss / 1024 for one in usage]
    print(f"peak memory: {peaks[0]:.0f} MB here, {peaks[1]:.0f} MB in the largest worker")
    begin = time.perf_counter()
    render_all(capture_images(scene, size_px=options.size, renderer=options.renderer, config=settings), 0)
    print(f"again, from memory: {time.perf_counter() - begin:.2f} s")
    if options.visible:
        show_visibility(pictures, sorted(classes))


def show_visibility(pictures: LazyPictures, subjects: list[str]) -> None:
    """Print the share of each silhouette in isolated images that is visible in context images."""
    config = pictures.config.model_copy(update={"size_px": 192})
    photographer = ShotRenderer(
        pictures.render_scene, pictures.factory(pictures.render_scene, False), config, pictures.below
    )
    good_views = []
    for subject in subjects:
        number = pictures.render_scene.index[subject]
        shares = []
        for shot in config.object_shots("context", subject):
            camera, selection = photographer.aim(shot)
            alone = photographer.renderer.identify(camera, Selection(frozenset({number}))) == number
            seen = photographer.renderer.identify(camera, selection) == number
            shares.append((seen & alone).sum() / max(alone.sum(), 1))
        good_views.append(sum(share >= 0.6 for share in shares))
        if good_views[-1] < 8:
            print(f"  {subject}: visible {', '.join(f'{share:.2f}' for share in shares)}")
    print(f"60 % visible in at least 4 of 8 views: {np.mean(np.array(good_views) >= 4):.1%} of {len(subjects)} classes")


def version_of(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "absent"


if __name__ == "__main__":
    main()
