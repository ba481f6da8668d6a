"""Lattices of plates that are not rectangles: error relative to finite elements, and time relative to `ModalPlate`.

python benchmarks/figures.py outlines outlines-order      (needs scikit-fem)
python benchmarks/outlines.py [--order]

Plates: discs with and without a hole, an ellipse, a hexagon, a T, a U, Ls, a top with a cut-out for a sink, and
straight and slanted slots as thin as 5 mm, of oak, glass and steel, at 20-400 Hz. Reference: Argyris triangles
(tests/support/plate_fe.py), smaller around corners that point inwards. Errors are those of levels [dB] at 12 points,
the driven point included. Times are processor times with empty caches, the least of five; `ModalPlate` solves the
rectangle of equal area. `--order` prints how natural frequencies converge with the resolution instead.
"""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from plate_fe import fe_receptance_within, outline_mesh, refined_at
from scene2hap import ModalPlate, Outline, Plate, materials
from scene2hap.propagation.bodies.lattice_body import lattice_body
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.propagation.lattice.bending_lattice import aligned, bending_lattice, lines_of, of_size_one, outline_of
from scene2hap.propagation.lattice.lattice_modes import _modes_up_to
from scene2hap.propagation.mass_spring_damper import MassSpringDamper

FREQUENCIES_HZ = np.geomspace(20.0, 400.0, 60)
LOSS, N_POINTS, SEED = 0.02, 12, 1
MATERIALS = {"oak": 0.018, "glass": 0.006, "steel": 0.002}
SIDE_M = 0.07
"""Side of the triangles of curved and slanted shapes [m]."""
Corners = tuple[tuple[float, float], ...]


def rectangle(x0: float, y0: float, x1: float, y1: float) -> Corners:
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


def inside(x0: float, y0: float, x1: float, y1: float) -> Callable[[Any, Any], Any]:
    return lambda x, y: (x > x0) & (x < x1) & (y > y0) & (y < y1)


def lines(step_m: float, *through_m: float) -> NDArray[np.float64]:
    """Positions of grid lines [m] through the given ones, at most `step_m` apart."""
    parts = [np.linspace(a, b, int(np.ceil((b - a) / step_m - 1e-9)) + 1) for a, b in pairwise(through_m)]
    return np.concatenate(parts)


def circle(radius_m: float, middle_m: tuple[float, float] = (0.0, 0.0), n: int = 64, wide: float = 1.0) -> Corners:
    turn = np.arange(n) * 2 * np.pi / n
    x, y = middle_m[0] + radius_m * wide * np.cos(turn), middle_m[1] + radius_m * np.sin(turn)
    return tuple(zip(x.tolist(), y.tolist(), strict=True))


def turned(corners: Corners, degrees: float, middle_m: tuple[float, float] = (0.0, 0.0)) -> Corners:
    turn = np.exp(1j * np.radians(degrees))
    places = np.array(corners) @ (1.0, 1.0j) * turn + complex(*middle_m)
    return tuple(zip(places.real.tolist(), places.imag.tolist(), strict=True))


def triangulated(*rings: Corners, tips: Corners = (), least_m: float = SIDE_M) -> tuple[Outline, Any]:
    """Outline with its lower corner at (0, 0), and a mesh of triangles of `SIDE_M`, of `least_m` around the `tips`."""
    import skfem
    from scipy.spatial import Delaunay

    low = np.concatenate(rings).min(axis=0)
    outline = Outline(tuple(tuple(map(tuple, (np.array(ring) - low).tolist())) for ring in rings))
    fine_at = np.array(tips).reshape(-1, 2) - low

    def side_m(points: NDArray[np.float64]) -> NDArray[np.float64]:
        away = np.hypot(*(points[:, None] - fine_at).transpose(2, 0, 1)).min(axis=1, initial=np.inf)
        return np.asarray(np.minimum(SIDE_M, least_m + 0.4 * away))

    rim, parts = [], np.linspace(0.0, 1.0, 401)
    for ring in outline.rings_m:
        for a, b in pairwise(np.array([*ring, ring[0]])):
            length = np.hypot(*(b - a)) / (len(parts) - 1)
            sides = np.cumsum(length / side_m(a + (b - a) * ((parts[1:] + parts[:-1]) / 2)[:, None]))
            n = int(np.ceil(sides[-1] - 1e-9))
            at = np.interp(np.arange(n) / n * sides[-1], [0.0, *sides], parts)
            rim.append(a + (b - a) * at[:, None])
    edge = np.concatenate(rim)
    inner, step = [], SIDE_M
    while step > least_m / 2:
        x, y = (np.arange(0.0, side, step) for side, step in zip(outline.extent_m, (step, 0.866 * step), strict=True))
        grid = np.stack(
            [x[:, None] + step / 2 * (np.arange(len(y)) % 2), np.broadcast_to(y, (len(x), len(y)))], axis=-1
        )
        points = grid.reshape(-1, 2)
        points = points[outline.holds(points)]
        wanted = side_m(points)
        away = np.hypot(*(points[:, None] - edge).transpose(2, 0, 1)).min(axis=1)
        inner.append(points[(away > 0.6 * wanted) & (step / 2 * (1 + 1e-9) < wanted) & (wanted <= step * (1 + 1e-9))])
        step /= 2
    points = np.concatenate([edge, *inner])
    triangles = Delaunay(points).simplices
    corners = points[triangles]
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    is_in = outline.holds(corners.mean(axis=1)) & (np.abs(ax * by - ay * bx) > 1e-9)
    used, number = np.unique(triangles[is_in], return_inverse=True)
    return outline, skfem.MeshTri(points[used].T.copy(), number.reshape(-1, 3).T.copy())


@cache
def shapes() -> dict[str, tuple[Outline, Any, Corners]]:
    """Outline, mesh, and corners where curvature grows without bound, of each shape by name."""
    import skfem

    disc = skfem.MeshTri.init_circle(4).scaled(0.4).translated((0.4, 0.4))
    rim = disc.p[:, np.unique(disc.facets[:, disc.boundary_facets()])].T - 0.4
    ring = rim[np.argsort(np.arctan2(rim[:, 1], rim[:, 0]))] + 0.4
    found: dict[str, tuple[Outline, Any, Corners]] = {
        "disc of 0.8 m": (Outline((ring.tolist(),)), disc, ((9.0, 9.0),)),
        "L of 1.2 m, arms of 0.6 m": (
            Outline((((0, 0), (1.2, 0), (1.2, 0.6), (0.6, 0.6), (0.6, 1.2), (0, 1.2)),)),
            outline_mesh(lines(0.08, 0, 0.6, 1.2), lines(0.08, 0, 0.6, 1.2), inside(0.6, 0.6, 9, 9)),
            ((0.6, 0.6),),
        ),
    }
    cuts = {
        "1.2 x 0.6 m, sink of 0.4 x 0.3 m": (1.2, 0.6, (0.3, 0.15, 0.7, 0.45)),
        "1.0 x 0.6 m, slot of 400 x 50 mm": (1.0, 0.6, (0.3, 0.3, 0.7, 0.35)),
        "1.0 x 0.6 m, slot of 400 x 20 mm": (1.0, 0.6, (0.29, 0.29, 0.69, 0.31)),
        "0.8 x 0.5 m, open slot of 500 x 20 mm": (0.8, 0.5, (0.0, 0.24, 0.5, 0.26)),
    }
    for name, (length, width, cut) in cuts.items():
        x0, y0, x1, y1 = cut
        mesh = outline_mesh(
            lines(0.07, 0, x0, x1, length) if x0 else lines(0.07, 0, x1, length),
            lines(0.07, 0, y0, y1, width),
            inside(*cut),
        )
        if x0:
            rings: tuple[Corners, ...] = (rectangle(0, 0, length, width), rectangle(*cut))
            tips: Corners = rectangle(*cut)
        else:
            rings = (((0, 0), (length, 0), (length, width), (0, width), (0, y1), (x1, y1), (x1, y0), (0, y0)),)
            tips = ((x1, y0), (x1, y1))
        found[name] = (Outline(rings), mesh, tips)
    slanted = turned(rectangle(-0.2, -0.01, 0.2, 0.01), 30.0, (0.5, 0.3))
    quarter = (*circle(0.8, n=92)[:23], (0.0, 0.8), (0.0, 0.0))
    rings_of: dict[str, tuple[tuple[Corners, ...], Corners]] = {
        "ellipse of 1.2 x 0.7 m": ((circle(0.35, wide=12 / 7),), ()),
        "hexagon of 0.9 m": ((circle(0.45, n=6),), ()),
        "quarter of a disc of 1.6 m": ((quarter,), ()),
        "ring of 0.9 m, hole of 0.4 m": ((circle(0.45), circle(0.2, n=32)), ()),
        "disc of 0.9 m, hole of 0.24 m beside its middle": ((circle(0.45), circle(0.12, (0.2, 0.05), 24)), ()),
        "T of 1.1 m": (
            (((0, 0.7), (0.4, 0.7), (0.4, 0), (0.7, 0), (0.7, 0.7), (1.1, 0.7), (1.1, 0.9), (0, 0.9)),),
            ((0.4, 0.7), (0.7, 0.7)),
        ),
        "U of 1.0 x 0.8 m": (
            (((0, 0), (1, 0), (1, 0.8), (0.7, 0.8), (0.7, 0.3), (0.3, 0.3), (0.3, 0.8), (0, 0.8)),),
            ((0.7, 0.3), (0.3, 0.3)),
        ),
        "L of 1.4 x 0.9 m, arms of 0.35 and 0.5 m": (
            (((0, 0), (1.4, 0), (1.4, 0.35), (0.5, 0.35), (0.5, 0.9), (0, 0.9)),),
            ((0.5, 0.35),),
        ),
        "1.0 x 0.6 m, slot of 400 x 20 mm at 30 degrees": ((rectangle(0, 0, 1, 0.6), slanted), slanted),
    }
    for name, (rings, tips) in rings_of.items():
        found[name] = (*triangulated(*rings), tips or ((9.0, 9.0),))
    # The few triangles across the end of a thin slot are small from the start, since their halves would be slivers.
    slot = ((0, 0), (0.8, 0), (0.8, 0.5), (0, 0.5), (0, 0.255), (0.5, 0.255), (0.5, 0.25), (0, 0.25))
    for name, degrees in (("", 0.0), (", at 30 degrees", 30.0)):
        ring, tips = turned(slot, degrees), turned(((0.5, 0.25), (0.5, 0.255)), degrees)
        both = triangulated(ring, tips=tips, least_m=0.005)
        found[f"0.8 x 0.5 m, open slot of 500 x 5 mm{name}"] = (*both, ((9.0, 9.0),))
    return found


def print_order() -> None:
    """Print the largest error of the first 13 natural frequencies at three resolutions, relative to resolution 32."""
    print("| plate | error at 4 | at 8 | at 16 | order, 4 to 8 | 8 to 16 |")
    print("|---|---|---|---|---|---|")
    for name, (outline, _, _) in shapes().items():
        plate = Plate.of_outline(outline, MATERIALS["glass"], materials.lookup("glass"))
        exact, *found = (MassSpringDamper(n).natural_frequencies_hz(plate, 16)[3:] for n in (32, 4, 8, 16))
        errors = [float(np.abs(one / exact - 1).max()) for one in found]
        orders = [np.log2(one / other) for one, other in pairwise(errors)]
        cells = " | ".join([*(f"{100 * one:.3f} %" for one in errors), *(f"{one:.1f}" for one in orders)])
        print(f"| {name} | {cells} |", flush=True)


def cold_s(query: Callable[[float], object]) -> float:
    """Least processor time [s] of five queries with empty caches, each of a slightly different plate."""
    taken = []
    for k in range(5):
        for kept in (aligned, bending_lattice, lines_of, _modes_up_to, lattice_body, of_size_one, outline_of):
            kept.cache_clear()
        begin = time.process_time()
        query(1 + 1e-5 * (k + 1))
        taken.append(time.process_time() - begin)
    return min(taken)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--refined", type=int, default=3, help="times that the reference is refined at notches")
    parser.add_argument("--order", action="store_true", help="order of convergence of natural frequencies")
    given = parser.parse_args()
    if given.order:
        print_order()
        return
    warnings.simplefilter("ignore", ThinPlateWarning)
    print("| plate | material | nodes | median [dB] | p95 [dB] | time [ms] | times `ModalPlate` |")
    print("|---|---|---|---|---|---|---|")
    model = MassSpringDamper()
    for name, (outline, mesh, tips) in shapes().items():
        middles = mesh.p[:, mesh.t].mean(axis=1).T
        points = middles[np.random.default_rng(SEED).choice(len(middles), N_POINTS, replace=False)]
        for kind, thickness_m in MATERIALS.items():
            material = replace(materials.lookup(kind), loss_factor=LOSS)
            plate = Plate.of_outline(outline, thickness_m, material)
            truth = fe_receptance_within(
                plate, refined_at(mesh, tips, given.refined), points[0], points, FREQUENCIES_HZ, LOSS
            )
            found = model.plate_receptance(plate, points[0], points, FREQUENCIES_HZ)
            error = np.abs(20 * np.log10(np.abs(found / truth)))
            resolution = model._fine_enough(plate, FREQUENCIES_HZ)
            n_nodes = bending_lattice(plate, resolution).n_nodes
            side_m = (plate.area_m2 * plate.length_m / plate.width_m) ** 0.5

            def query_lattice(scale: float, plate: Plate = plate, at: Any = points) -> object:
                other = replace(plate, thickness_m=plate.thickness_m * scale)
                return model.plate_receptance(other, at[0], at, FREQUENCIES_HZ)

            def query_modal(scale: float, plate: Plate = plate, side_m: float = side_m) -> object:
                other = Plate(side_m * scale, plate.area_m2 / side_m, plate.thickness_m, plate.material)
                at = np.linspace(0.1, 0.3, 2 * N_POINTS).reshape(-1, 2)
                return ModalPlate().plate_receptance(other, at[0], at, FREQUENCIES_HZ)

            taken_s, modal_s = cold_s(query_lattice), cold_s(query_modal)
            print(
                f"| {name} | {kind} | {n_nodes} | {np.median(error):.3f} | {np.quantile(error, 0.95):.2f} | "
                f"{1e3 * taken_s:.0f} | {taken_s / modal_s:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
