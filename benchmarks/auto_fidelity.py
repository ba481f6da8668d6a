"""AutoFidelity compared with ModalPlate on random furniture, as a table in Markdown.

The latest figures: docs/figures/propagation.md.

OPENBLAS_NUM_THREADS=1 python benchmarks/auto_fidelity.py [--draws 2000] [--tolerance 1.0] [--at-edges]
OPENBLAS_NUM_THREADS=1 python benchmarks/auto_fidelity.py --calibrate --draws 600

A draw is a plate of usual furniture with a source of 0.05-5 kg, a touch, and bands. The source stands on one, three or
four feet; source and touch are anywhere on the plate. The bands are third octaves from 10 to 1000 Hz in one draw of
three, otherwise some consecutive ones. The error of a draw is that of its worst band; both gains are at least -40 dB re
the source. Times are processor times of one preparation and one touch, with empty caches. `--calibrate` prints the
errors of every rung, on other seeds; the bounds of `auto_rungs` were taken from these errors.
"""

from __future__ import annotations

import argparse
import platform
import sys
import time
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import Bands, Contact, ContactNetwork, Excitation, Plate, Pose, PropagationField, materials
from scene2hap.propagation.auto import AutoFidelity, AutoField
from scene2hap.propagation.auto_rungs import FINENESS, FLOOR_DB, MODAL_DB, PlateCase, body_of
from scene2hap.propagation.bodies import idealisation, infinite_body, lattice_body, modal_body
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.substructuring import CoupledField, assemble
from scene2hap.propagation.lattice import bending_lattice, lattice_modes
from scene2hap.propagation.modal import estimates, modes

REPORTED, CALIBRATING = 0, 100_000
"""First seed of the reported draws, and first seed of the draws for the bounds."""
LOSS_FLOOR = 0.01

Range = tuple[float, float]
# Materials; length, width and thickness [m]; boundaries.
KINDS: dict[str, tuple[tuple[str, ...], Range, Range, Range, tuple[str, ...]]] = {
    "table": (
        ("oak", "beech", "pine", "plywood", "mdf", "chipboard"),
        (0.6, 2.0),
        (0.4, 1.0),
        (0.015, 0.04),
        ("free",),
    ),
    "shelf": (
        ("plywood", "chipboard", "pine", "glass"),
        (0.4, 1.2),
        (0.2, 0.4),
        (0.006, 0.025),
        ("SSFF", "free", "SSSF"),
    ),
    "glass top": (("glass",), (0.4, 1.4), (0.4, 0.8), (0.004, 0.012), ("free",)),
    "sheet": (
        ("steel", "aluminium"),
        (0.2, 0.7),
        (0.15, 0.5),
        (0.0008, 0.003),
        ("free", "clamped", "simply-supported", "CFFF", "CFFS"),
    ),
    "board": (
        ("plastic", "plexiglass", "bamboo", "oak", "cardboard"),
        (0.2, 0.6),
        (0.15, 0.4),
        (0.003, 0.02),
        ("free",),
    ),
    "stone": (("marble", "granite", "ceramic"), (0.3, 2.4), (0.2, 0.7), (0.01, 0.04), ("free",)),
    "floor": (("concrete",), (2.5, 6.0), (2.5, 5.0), (0.1, 0.25), ("simply-supported", "clamped")),
    "panel": (
        ("plywood", "mdf", "gypsum", "glass"),
        (0.6, 2.2),
        (0.4, 1.2),
        (0.006, 0.022),
        ("simply-supported", "SSFF", "CFFF", "free"),
    ),
    "mat": (
        ("rubber", "cork", "felt", "carpet", "leather", "foam"),
        (0.2, 0.7),
        (0.15, 0.45),
        (0.004, 0.03),
        ("free",),
    ),
    "small": (
        ("plastic", "abs", "paper", "polypropylene", "ceramic"),
        (0.08, 0.3),
        (0.06, 0.2),
        (0.004, 0.04),
        ("free",),
    ),
}


@dataclass(frozen=True)
class Draw:
    """A plate with a source on it and a touch."""

    kind: str
    plate: Plate
    network: ContactNetwork
    excitations: tuple[Excitation, ...]
    bands: Bands
    touch_m: tuple[float, float, float]


def draw(seed: int, *, at_edges: bool = False) -> Draw:
    """Draw a plate, a source and a touch; with `at_edges` source and touch are at edges and corners."""
    rng = np.random.default_rng(seed)
    kind = list(KINDS)[rng.integers(len(KINDS))]
    names, lengths, widths, thicknesses, boundaries = KINDS[kind]
    one, other = (float(np.exp(rng.uniform(*np.log(span)))) for span in (lengths, widths))
    thickness = float(np.exp(rng.uniform(*np.log(thicknesses))))
    material = materials.lookup(names[rng.integers(len(names))])
    plate = Plate(max(one, other), min(one, other), thickness, material, boundaries[rng.integers(len(boundaries))])
    size = np.array([plate.length_m, plate.width_m])
    n_feet = int(rng.choice([1, 3, 4]))
    apart = np.minimum(rng.uniform(0.03, 0.25, 2), 0.5 * size)
    corner = rng.uniform(0.02 * size, 0.98 * size - apart * (n_feet > 1))
    places = [(0, 0), (1, 0), (0.5, 1)] if n_feet == 3 else [(0, 0), (1, 0), (0, 1), (1, 1)][:n_feet]
    feet = [Contact("source", "plate", (*map(float, corner + place * apart), 0.0)) for place in np.array(places)]
    mass_kg = float(np.exp(rng.uniform(np.log(0.05), np.log(5))))
    touch = rng.uniform(0.02, 0.98, 2) * size
    if at_edges:
        corner = _at_edge(rng, corner, 0.005 * size, 0.995 * size - apart * (n_feet > 1))
        feet = [Contact("source", "plate", (*map(float, corner + place * apart), 0.0)) for place in np.array(places)]
        touch = _at_edge(rng, touch, 0.0 * size, size)
    is_whole = rng.random() < 1 / 3
    first, last = np.sort(rng.choice(21, 2, replace=False))
    edges = np.geomspace(10, 1000, 21)[first : last + 1]
    bands = Bands.third_octaves() if is_whole else Bands(tuple(map(float, edges)))
    network = ContactNetwork({"plate": plate}, feet, {"plate": Pose((0.0, 0.0, 0.0))})
    x, y = map(float, touch)
    return Draw(kind, plate, network, (Excitation("source", 100.0, 100.0, mass_kg),), bands, (x, y, 0.0))


def _at_edge(
    rng: np.random.Generator, place: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Move a place to an edge or a corner."""
    which = rng.integers(1, 4)
    moved = [which & 1, which & 2]
    ends = np.where(rng.random(2) < 0.5, low, high)
    return np.where(moved, ends, place)


def by_rung(one: Draw, rung: str, density: float = 1.0) -> CoupledField:
    """Field with all plates on one rung."""
    scene = assemble(one.network, one.excitations, one.bands, ContactLaw(), "ignore")
    bodies = {
        key: body_of(rung, plate, scene.top_hz, max(plate.material.loss_factor, LOSS_FLOOR))
        for key, plate in scene.plates.items()
    }
    return scene.solve(bodies, density)


def forget() -> None:
    """Clear the caches of plates."""
    cached: tuple[Any, ...] = (
        *(modes.modes_up_to, estimates.first_bending_hz, modal_body.modal_body, idealisation.is_compact),
        *(lattice_modes._modes_up_to, lattice_body.lattice_body, infinite_body._table),
        *(bending_lattice.bending_lattice, bending_lattice.lines_of, bending_lattice.aligned),
        *(bending_lattice.of_size_one, bending_lattice.outline_of),
    )
    for one in cached:
        one.cache_clear()


def asked(one: Draw, field: PropagationField) -> NDArray[np.float64]:
    """Gains at the touch [dB], at least `FLOOR_DB`."""
    gains = field.attenuation("plate", np.array([one.touch_m]))[0, 0]
    return np.asarray(np.maximum(20 * np.log10(np.maximum(gains, 1e-30)), FLOOR_DB))


def wrong_by(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    return float(np.abs(one - other).max())


@dataclass(frozen=True)
class Outcome:
    """Result of a draw: rung, bound and error [dB] of `AutoFidelity`, and times [s] of it and of `ModalPlate`."""

    kind: str
    rung: str
    bound_db: float
    error_db: float
    auto_s: float
    modal_s: float


def compare(seed: int, model: AutoFidelity, at_edges: bool) -> Outcome:
    one = draw(seed, at_edges=at_edges)
    forget()
    begin = time.process_time()
    field: AutoField = model.prepare(one.network, one.excitations, one.bands)
    found = asked(one, field)
    auto_s = time.process_time() - begin
    forget()
    begin = time.process_time()
    truth = asked(one, by_rung(one, "modal"))
    modal_s = time.process_time() - begin
    choice = field.choices["plate"]
    return Outcome(one.kind, choice.rung, choice.bound_db, wrong_by(found, truth), auto_s, modal_s)


def calibrate(n_draws: int, first: int) -> None:
    """Print the errors of every rung, by how the plate is held."""
    density = AutoFidelity()._density()
    errors: dict[tuple[str, str], list[float]] = {}
    for seed in range(first, first + n_draws):
        one = draw(seed)
        if idealisation.is_compact(one.plate):
            continue
        scene = assemble(one.network, one.excitations, one.bands, ContactLaw(), "ignore")
        case: PlateCase = AutoFidelity()._case(scene, "plate")
        if case.peak_db <= FLOOR_DB:
            continue
        truth = asked(one, by_rung(one, "modal"))
        for rung in MODAL_DB["free"]:
            errors.setdefault((case.held, rung), []).append(wrong_by(asked(one, by_rung(one, rung, density)), truth))
        if one.plate.edges == "FFFF" and one.bands.edges_hz[-1] < 0.2 * estimates.first_bending_hz(one.plate):
            ratio = one.bands.edges_hz[-1] / estimates.first_bending_hz(one.plate)
            error = wrong_by(asked(one, by_rung(one, "rigid", density)), truth)
            errors.setdefault(("free", "rigid, dB over (f / f_1)^2"), []).append(error / ratio**2)
    print("| held | rung | draws | median | 95 % | 99 % | worst |\n|---|---|---|---|---|---|---|")
    for (held, rung), several in sorted(errors.items()):
        cells = " | ".join(f"{np.quantile(several, q):.2f}" for q in (0.5, 0.95, 0.99, 1.0))
        print(f"| {held} | {rung} | {len(several)} | {cells} |")


def report(outcomes: list[Outcome], tolerance_db: float) -> str:
    errors = np.array([one.error_db for one in outcomes])
    lines = [
        "| rung | chosen | error, median / 99 % / worst, dB | within tolerance | bound, dB | ms, median | modal, ms |",
        "|---|---|---|---|---|---|---|",
    ]
    for rung in ("rigid", "infinite", *FINENESS):
        mine = [one for one in outcomes if one.rung == rung]
        if mine:
            apart = np.array([one.error_db for one in mine])
            spread = " / ".join(f"{np.quantile(apart, q):.2f}" for q in (0.5, 0.99, 1.0))
            times = [1e3 * float(np.median([getattr(one, name) for one in mine])) for name in ("auto_s", "modal_s")]
            bound = max(one.bound_db for one in mine)
            lines.append(
                f"| {rung} | {100 * len(mine) / len(outcomes):.1f} % | {spread} | "
                f"{100 * np.mean(apart <= tolerance_db):.1f} % | {bound:.2g} | {times[0]:.1f} | {times[1]:.1f} |"
            )
    auto, modal = (np.array([getattr(one, name) for one in outcomes]) for name in ("auto_s", "modal_s"))
    beyond = Counter(one.kind for one in outcomes if one.error_db > tolerance_db)
    lines += [
        "",
        f"{len(outcomes)} draws: within {tolerance_db:g} dB {100 * np.mean(errors <= tolerance_db):.2f} %, "
        f"99 % of errors below {np.quantile(errors, 0.99):.2f} dB; beyond: {dict(beyond)}.",
        f"Median times: {1e3 * np.median(auto):.1f} ms against {1e3 * np.median(modal):.1f} ms of `modal_plate` "
        f"(ratio of medians {np.median(modal) / np.median(auto):.1f}, "
        f"median of ratios {np.median(modal / auto):.1f}, "
        f"of sums {modal.sum() / auto.sum():.1f}).",
        "",
        f"Machine: {platform.system()} {platform.machine()}, Python {platform.python_version()}, "
        f"numpy {version('numpy')}, scipy {version('scipy')}; seeds from {REPORTED}.",
    ]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=2000)
    parser.add_argument("--tolerance", type=float, default=1.0)
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--at-edges", action="store_true", help="sources and touches at edges and corners")
    parser.add_argument("--calibrate", action="store_true")
    parser.add_argument("--first", type=int, default=REPORTED, help="first seed")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    if arguments.calibrate:
        calibrate(arguments.draws, arguments.first + CALIBRATING)
        return
    model = AutoFidelity(arguments.tolerance, outside_domain="ignore")
    seeds = range(arguments.first, arguments.first + arguments.draws)
    outcomes = []
    with ProcessPoolExecutor(
        arguments.workers, initializer=compare, initargs=(arguments.first, model, arguments.at_edges)
    ) as pool:
        for outcome in pool.map(compare, seeds, repeat(model), repeat(arguments.at_edges), chunksize=10):
            outcomes.append(outcome)
            if len(outcomes) % 200 == 0:
                print(len(outcomes), file=sys.stderr, flush=True)
    print(report(outcomes, arguments.tolerance))


if __name__ == "__main__":
    main()
