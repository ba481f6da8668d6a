"""Coupled objects drawn at random, compared with finite elements, as a table in Markdown.

python benchmarks/figures.py coupled-draws      (needs scikit-fem)

The cases of `coupled`, with sizes, thicknesses, materials, contacts and sources drawn at random:

- two plates coupled at 1 to 5 points, many of them on edges and corners; a stack of three plates;
- a tray on rubber, felt or hard feet; a small plate near the corner of a large one;
- a plate on legs of any mass and material; an upright board.

With `--further` other families: two trays on one plate; a plate on legs whose feet range from rubber to steel; an
object on rubber feet along an edge; an upright board on a thin plate, or between two plates; two chains on one plate.

Contact tips have radii of 2 to 20 mm and preloads of 0.2 to 20 N, so that contact stiffness varies fifteenfold.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from coupled import GRID_M, UPRIGHT, Case, Triple, found_by, known, plate, points_on, truth

from scene2hap import Excitation, ModalPlate, Plate, Pose, RigidBody
from scene2hap.propagation.coupled.contact_stiffness import HARD_PLASTIC, ContactLaw
from scene2hap.propagation.domain import ThinPlateWarning

THICKNESSES_MM = {
    "oak": (12.0, 40.0),
    "steel": (1.5, 6.0),
    "glass": (4.0, 12.0),
    "plywood": (6.0, 25.0),
}
Rng = np.random.Generator


def drawn_plate(rng: Rng, longest_m: float, shortest_m: float = 0.25, feet: str | None = None) -> Plate:
    """Draw a plate whose sides are whole numbers of mesh cells."""
    name = str(rng.choice(list(THICKNESSES_MM)))
    width_m, length_m = (GRID_M * round(side / GRID_M) for side in np.sort(rng.uniform(shortest_m, longest_m, 2)))
    return plate(length_m, width_m, 1e-3 * round(float(rng.uniform(*THICKNESSES_MM[name])), 1), name, feet)


def place_on(rng: Rng, below: Plate, above: Plate, *, near_corner: bool = False) -> tuple[float, float]:
    """Draw the place of a plate's corner on a larger plate [m]: a node, with the upper plate within the lower one."""
    rooms = [(b - a) / GRID_M for a, b in ((above.length_m, below.length_m), (above.width_m, below.width_m))]
    cells = [0 if near_corner else int(rng.integers(0, round(room) + 1)) for room in rooms]
    return GRID_M * cells[0], GRID_M * cells[1]


def nodes(rng: Rng, body: Plate, n: int) -> list[tuple[float, float]]:
    """Draw n different nodes of a plate [m], a third of them corners and a third on edges, on average."""
    cells = round(body.length_m / GRID_M), round(body.width_m / GRID_M)
    found: set[tuple[int, int]] = set()
    while len(found) < n:
        kind, x, y = rng.integers(3), *(int(rng.integers(0, m + 1)) for m in cells)
        if kind == 0 or (kind == 1 and rng.random() < 0.5):
            x = cells[0] * int(rng.integers(2))
        if kind == 0:
            y = cells[1] * int(rng.integers(2))
        found.add((x, y))
    return [(GRID_M * x, GRID_M * y) for x, y in sorted(found)]


def moved(points: Sequence[tuple[float, float]], by: tuple[float, float]) -> list[Triple]:
    return [(x + by[0], y + by[1], 0.0) for x, y in points]


def source_of(rng: Rng) -> Excitation:
    return Excitation("source", 100.0, 100.0, round(float(10 ** rng.uniform(-1.0, 0.3)), 2))


def law_of(rng: Rng) -> ContactLaw:
    return ContactLaw(float(10 ** rng.uniform(-2.7, -1.7)), float(10 ** rng.uniform(-0.7, 1.3)))


def stacked(rng: Rng, plates: Sequence[Plate], n_points: int, felt: int = 0, *, near_corner: bool = False) -> Case:
    """Stack of plates, given from the lowest and largest up, with the source on the topmost."""
    names = ["lower", "middle", "upper"] if len(plates) == 3 else ["lower", "upper"]
    at, poses, touching = (0.0, 0.0), {names[0]: Pose()}, []
    for (one, below), (other, above) in pairwise(zip(names, plates, strict=True)):
        x, y = place_on(rng, below, above, near_corner=near_corner)
        at = at[0] + x, at[1] + y
        poses[other] = Pose((*at, 0.0))
        touching += [(one, other, point) for point in moved(nodes(rng, above, n_points), at)]
    touching.append((names[-1], "source", moved(nodes(rng, plates[-1], 1), at)[0]))
    return Case(dict(zip(names, plates, strict=True)), touching, source_of(rng), names[felt], poses, law=law_of(rng))


def two_plates(rng: Rng) -> Case:
    plates = drawn_plate(rng, 1.5, 0.6), drawn_plate(rng, 0.55)
    return stacked(rng, plates, int(rng.integers(1, 6)), int(rng.integers(2)))


def tray(rng: Rng) -> Case:
    above = drawn_plate(rng, 0.6, feet=str(rng.choice(["rubber", "felt", "plastic"])))
    above = Plate(*above.extent_m, above.thickness_m, above.material, feet=above.feet, object_mass_kg=above.mass_kg)
    case = stacked(rng, (drawn_plate(rng, 1.5, 0.65), above), 4)
    corners = [(x, y) for x in (0.0, above.length_m) for y in (0.0, above.width_m)]
    own = case.poses["upper"].position_m
    touching = [("lower", "upper", at) for at in moved(corners, (own[0], own[1]))]
    case.touching[:] = [*touching, case.touching[-1]]
    return case


def small_near_corner(rng: Rng) -> Case:
    plates = drawn_plate(rng, 1.5, 0.6), drawn_plate(rng, 0.25, 0.1)
    return stacked(rng, plates, int(rng.integers(3, 5)), int(rng.integers(2)), near_corner=True)


def on_legs(rng: Rng) -> Case:
    top = drawn_plate(rng, 1.4, 0.5)
    floor = plate(top.length_m + 0.4, top.width_m + 0.4, 0.022, "plywood")
    legs = nodes(rng, top, int(rng.integers(3, 6)))
    kinds = [known("oak"), known("steel"), known("rubber"), HARD_PLASTIC]
    kind = kinds[int(rng.integers(4))]
    masses = 10 ** rng.uniform(-1.0, 0.7, len(legs))
    feet = {f"leg_{k}": RigidBody(float(masses[k]), material=kind) for k in range(len(legs))}
    places = moved(legs, (0.0, 0.0))
    touching = [(body, f"leg_{k}", at) for k, at in enumerate(places) for body in ("top", "floor")]
    touching.append(("top", "source", moved(nodes(rng, top, 1), (0.0, 0.0))[0]))
    poses = {"top": Pose(), "floor": Pose((-0.2, -0.2, 0.0))}
    felt_on = str(rng.choice(["top", "floor"]))
    return Case({"top": top, "floor": floor, **feet}, touching, source_of(rng), felt_on, poses, law=law_of(rng))


def upright(rng: Rng) -> Case:
    lower, board = drawn_plate(rng, 1.5, 0.6), drawn_plate(rng, 0.6, 0.3)
    x, y = place_on(rng, lower, plate(board.length_m, GRID_M, 0.01, "oak"))
    cells = round(board.length_m / GRID_M)
    feet = sorted({0, cells, int(rng.integers(1, cells))})
    touching = [("lower", "board", (x + GRID_M * k, y, 0.0)) for k in feet]
    touching.append(("lower", "source", moved(nodes(rng, lower, 1), (0.0, 0.0))[0]))
    poses = {"lower": Pose(), "board": Pose((x, y, 0.0), UPRIGHT)}
    felt_on = str(rng.choice(["lower", "board"]))
    return Case({"lower": lower, "board": board}, touching, source_of(rng), felt_on, poses, ("board",), law=law_of(rng))


def chain(rng: Rng) -> Case:
    plates = drawn_plate(rng, 1.5, 0.9), drawn_plate(rng, 0.85, 0.5), drawn_plate(rng, 0.45)
    return stacked(rng, plates, int(rng.integers(3, 5)), int(rng.integers(3)))


FAMILIES: dict[str, Callable[[Rng], Case]] = {
    "two plates": two_plates,
    "tray on feet": tray,
    "small near a corner": small_near_corner,
    "plate on legs": on_legs,
    "upright board": upright,
    "three in a chain": chain,
}


def two_trays(rng: Rng) -> Case:
    lower = drawn_plate(rng, 1.5, 0.8)
    bodies, touching, poses = {"lower": lower}, [], {"lower": Pose()}
    for name in ("first", "second"):
        tray_ = drawn_plate(rng, 0.4, feet=str(rng.choice(["rubber", "felt", "plastic"])))
        x, y = place_on(rng, lower, tray_)
        corners = moved([(a, b) for a in (0.0, tray_.length_m) for b in (0.0, tray_.width_m)], (x, y))
        # A mass lets it rest on its feet; it is that of the plate, so that the finite elements are the same body.
        bodies[name] = replace(tray_, object_mass_kg=tray_.mass_kg)
        poses[name] = Pose((x, y, 0.0))
        touching += [("lower", name, at) for at in corners]
    at = moved(nodes(rng, bodies["first"], 1), poses["first"].position_m[:2])[0]
    touching.append(("first", "source", at))
    felt_on = str(rng.choice(["lower", "second"]))
    return Case({**bodies}, touching, source_of(rng), felt_on, poses, law=law_of(rng))


def unlike_legs(rng: Rng) -> Case:
    case = on_legs(rng)
    kinds = [known("rubber"), known("steel"), HARD_PLASTIC, known("felt"), known("oak")]
    for k, key in enumerate([key for key in case.bodies if key.startswith("leg_")]):
        case.bodies[key] = RigidBody(float(10 ** rng.uniform(-1.5, 0.7)), material=kinds[k])
    return case


def along_an_edge(rng: Rng) -> Case:
    lower, above = drawn_plate(rng, 1.5, 0.6), drawn_plate(rng, 0.4, feet="rubber")
    above = replace(above, object_mass_kg=above.mass_kg)
    x = GRID_M * int(rng.integers(0, round((lower.length_m - above.length_m) / GRID_M) + 1))
    corners = moved([(a, b) for a in (0.0, above.length_m) for b in (0.0, above.width_m)], (x, 0.0))
    touching = [("lower", "upper", at) for at in corners]
    touching.append(("upper", "source", moved(nodes(rng, above, 1), (x, 0.0))[0]))
    poses = {"lower": Pose(), "upper": Pose((x, 0.0, 0.0))}
    felt_on = str(rng.choice(["lower", "upper"]))
    return Case({"lower": lower, "upper": above}, touching, source_of(rng), felt_on, poses, law=law_of(rng))


def upright_on_thin(rng: Rng) -> Case:
    case = upright(rng)
    lower = case.bodies["lower"]
    assert isinstance(lower, Plate)
    case.bodies["lower"] = plate(lower.length_m, lower.width_m, float(rng.uniform(0.003, 0.006)), "plywood")
    return case


def between_two(rng: Rng) -> Case:
    """A shelf on an upright board on a plate."""
    case = upright(rng)
    board, (x, y, _) = case.bodies["board"], case.poses["board"].position_m
    assert isinstance(board, Plate)
    shelf = drawn_plate(rng, 0.6, 0.3)
    long = min(board.length_m, shelf.length_m)
    height_m = board.width_m
    edge = [(x + a, y, height_m) for a in (0.0, GRID_M * round(long / 2 / GRID_M), GRID_M * round(long / GRID_M))]
    case.bodies["shelf"] = shelf
    case.poses["shelf"] = Pose((x, y - GRID_M * round(shelf.width_m / 2 / GRID_M), height_m))
    case.touching.extend(("board", "shelf", at) for at in edge)
    return replace(case, felt_on=str(rng.choice(["lower", "shelf", "board"])))


def two_chains(rng: Rng) -> Case:
    lower = drawn_plate(rng, 1.5, 0.9)
    bodies, touching, poses = {"lower": lower}, [], {"lower": Pose()}
    for side in ("a", "b"):
        below, at = "lower", (0.0, 0.0)
        for level, longest in (("middle", 0.5), ("upper", 0.25)):
            name, one = f"{level} {side}", drawn_plate(rng, longest, longest / 2)
            on = bodies[below]
            x, y = place_on(rng, on, one)
            at = at[0] + x, at[1] + y
            bodies[name], poses[name] = one, Pose((*at, 0.0))
            touching += [(below, name, point) for point in moved(nodes(rng, one, 3), at)]
            below = name
    touching.append(("upper a", "source", moved(nodes(rng, bodies["upper a"], 1), poses["upper a"].position_m[:2])[0]))
    return Case({**bodies}, touching, source_of(rng), str(rng.choice(["lower", "upper b"])), poses, law=law_of(rng))


FURTHER: dict[str, Callable[[Rng], Case]] = {
    "two trays": two_trays,
    "unlike legs": unlike_legs,
    "along an edge": along_an_edge,
    "upright on a thin plate": upright_on_thin,
    "upright between two": between_two,
    "two chains": two_chains,
}


def described(case: Case) -> str:
    """Describe the plates, the number of contacts and the touched object of a case."""
    plates = [
        f"{body.length_m:.3g} x {body.width_m:.3g} m {body.material.name} {1e3 * body.thickness_m:g} mm"
        for body in case.bodies.values()
        if isinstance(body, Plate)
    ]
    return f"{', '.join(plates)}; {len(case.touching)} contacts; felt on {case.felt_on}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("draws", nargs="?", type=int, default=18)
    parser.add_argument("--first", type=int, default=0, help="seed of the first draw")
    parser.add_argument("--further", action="store_true", help="draw of the further families")
    given = parser.parse_args()
    families = FURTHER if given.further else FAMILIES
    warnings.simplefilter("ignore", ThinPlateWarning)
    print("| family | draw | objects | median [dB] | 95th percentile [dB] | worst [dB] |")
    print("|---|---|---|---|---|---|")
    every, worst = [], (0.0, -1)
    for seed in range(given.first, given.first + given.draws):
        name = list(families)[seed % len(families)]
        case = families[name](np.random.default_rng(seed))
        points_m = points_on(case)
        own = found_by(ModalPlate(loss_floor=0.0, contact=case.law), case, points_m)
        errors = np.abs(20 * np.log10(own / truth(case, points_m)))
        every.append(errors.ravel())
        p95 = float(np.percentile(errors, 95))
        worst = max(worst, (p95, seed))
        cells = f"{np.median(errors):.3f} | {p95:.2f} | {errors.max():.2f}"
        print(f"| {name} | {seed} | {described(case)} | {cells} |", flush=True)
    errors = np.concatenate(every)
    cells = f"{np.median(errors):.3f} | {np.percentile(errors, 95):.2f} | {errors.max():.2f}"
    print(f"| all | | | {cells} |")
    print(f"\nWorst 95th percentile: {worst[0]:.2f} dB, draw {worst[1]}.")


if __name__ == "__main__":
    main()
