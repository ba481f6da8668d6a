"""A hundred thousand plates: every model passive, finite and quick, at any edges, aspect and frequency.

python stress/plates.py [--plates 100000] [--seed 1] [--seconds 1] [--only N]

Draws plates of 1 cm to 10 m and aspects up to 1:100, held at any of their edges, of materials from felt to steel and of
any loss, and asks every model for the receptance among four points, corners and edges included, at six frequencies up
to 10 kHz, one of them exactly on a resonance of a plate that is held or free. Counted as bad:

    not finite     NaN or infinite
    gains energy   a driven point with a positive imaginary part, or the matrix among all points with an eigenvalue of
                   it above 1e-4 of its largest entry (what the near field leaves out is a millionth)
    negative       a driven point of a held plate that goes against a force far below its first resonance
    slow           more than a second of processor time without a warning
    other          any error outside scene2hap's own tree, or a floating-point warning

Each plate is drawn from its own number, so `--only N` repeats one. Exits with 1 if anything is bad.
"""

from __future__ import annotations

import argparse
import collections
import math
import random
import time
import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import AutoFidelity, InfinitePlate, Material, ModalPlate, Plate
from scene2hap.errors import Scene2HapError
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.modes import first_bending_hz, n_rigid_motions

MODELS: dict[str, Any] = {
    "infinite_plate": InfinitePlate(outside_domain="ignore"),
    "modal_plate": ModalPlate(outside_domain="ignore"),
    "auto": AutoFidelity(outside_domain="ignore"),
    "mass_spring_damper": MassSpringDamper(outside_domain="ignore"),
}
EDGES = ("FFFF", "CCCC", "SSSS", "CFFF", "SSFF", "CCFF", "SFSF", "CFSF", "FFCC", "CFFC", "SFFF", "FFSS")
ROUNDING, BETWEEN_POINTS = 1e-9, 1e-4
Floats = NDArray[np.float64]


@dataclass
class Outcome:
    """What came back from one model."""

    answered: int = 0
    warned: int = 0
    refused: collections.Counter[str] = field(default_factory=collections.Counter)
    bad: list[str] = field(default_factory=list)
    slowest_s: float = 0.0


def some_plate(rng: random.Random) -> Plate:
    """A plate, from a coin to a floor."""
    longer = math.exp(rng.uniform(math.log(0.01), math.log(10.0)))
    aspect = math.exp(rng.uniform(0.0, math.log(100.0)))
    sides = rng.sample((longer, longer / aspect), 2)
    thickness_m = longer / aspect * 10 ** rng.uniform(-3.0, 0.0)
    material = Material(
        "drawn",
        density_kg_m3=10 ** rng.uniform(1.5, 4.1),
        youngs_modulus_pa=10 ** rng.uniform(6.0, 11.6),
        poisson_ratio=rng.uniform(-0.2, 0.49),
        loss_factor=10 ** rng.uniform(-4.0, 0.0),
    )
    mass_kg = None if rng.random() < 0.7 else 10 ** rng.uniform(-6.0, 4.0)
    return Plate(*sides, thickness_m, material, rng.choice(EDGES), object_mass_kg=mass_kg)


def some_points(plate: Plate, rng: random.Random) -> Floats:
    """A corner, an edge and two points inside."""
    inside = [[rng.uniform(0.02, 0.98) for _ in range(2)] for _ in range(2)]
    at = [[rng.choice([0.0, 1.0]) for _ in range(2)], [rng.choice([0.0, 1.0]), rng.random()], *inside]
    return np.array(at) * (plate.length_m, plate.width_m)


def some_frequencies(plate: Plate, rng: random.Random) -> Floats:
    """Far below the first resonance, on it, anywhere, and high."""
    first_hz = first_bending_hz(plate)
    anywhere = [10 ** rng.uniform(0.5, 3.0) for _ in range(3)]
    return np.array([min(1e-3 * first_hz, 10.0), min(first_hz, 1e4), *anywhere, 10 ** rng.uniform(3.0, 4.0)])


def ask(model: Any, plate: Plate, points: Floats, f: Floats, limit_s: float, outcome: Outcome, name: str) -> None:
    """Ask one model, and note what comes back."""
    columns, taken_s = [], 0.0
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        warnings.simplefilter("ignore", ThinPlateWarning)
        np.seterr(all="raise", under="ignore")
        try:
            for at in points:
                begin = time.process_time()
                columns.append(model.plate_receptance(plate, at, points, f))
                taken_s = max(taken_s, time.process_time() - begin)
        except Scene2HapError as refusal:
            outcome.refused[" ".join(str(refusal).split()[-6:])] += 1
        except Exception as error:
            outcome.bad.append(f"{name}: other: {type(error).__name__} {error}")
    outcome.slowest_s = max(outcome.slowest_s, taken_s)
    outcome.warned += bool(said)
    if any(issubclass(one.category, RuntimeWarning) for one in said):
        outcome.bad.append(f"{name}: other: {said[0].message}")
    if taken_s > limit_s and not said:
        outcome.bad.append(f"{name}: slow: {taken_s:.1f} s")
    if len(columns) < len(points):
        return
    found = np.stack(columns, axis=1)
    outcome.answered += 1
    if not np.isfinite(found).all():
        outcome.bad.append(f"{name}: not finite")
        return
    driven = found.diagonal(axis1=0, axis2=1)  # (n_frequencies, n_points)
    size = np.abs(found).max(axis=(0, 1))[:, None] + 1e-300
    if (driven.imag > ROUNDING * size).any():
        outcome.bad.append(f"{name}: gains energy at a point: {(driven.imag / size).max():.1e}")
    imaginary = (found.imag + found.imag.transpose(1, 0, 2)).transpose(2, 0, 1) / 2
    gain = np.linalg.eigvalsh(imaginary / size[:, :, None]).max()
    if gain > BETWEEN_POINTS:
        outcome.bad.append(f"{name}: gains energy between points: {gain:.1e}")
    is_held = n_rigid_motions(plate) == 0 and not isinstance(model, InfinitePlate)
    if is_held and (driven[0].real < -ROUNDING * size[0]).any():
        outcome.bad.append(f"{name}: negative: {driven[0].real.min():.1e} m/N")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plates", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--only", type=int)
    parser.add_argument("--model", choices=MODELS)
    given = parser.parse_args()
    outcomes = {name: Outcome() for name in MODELS if given.model in (None, name)}
    for number in range(given.plates) if given.only is None else [given.only]:
        rng = random.Random(f"plate/{given.seed}/{number}")
        plate = some_plate(rng)
        points, f = some_points(plate, rng), some_frequencies(plate, rng)
        for name, outcome in outcomes.items():
            case = f"plate {number}, {name}, {plate.edges} {plate.length_m:.3g} x {plate.width_m:.3g} m"
            n_bad = len(outcome.bad)
            ask(MODELS[name], plate, points, f, given.seconds, outcome, case)
            for line in outcome.bad[n_bad:]:
                print(f"* {line}", flush=True)
    print(f"\n{given.plates} plates, seed {given.seed}\n")
    print("| model | answered | with a warning | refused | bad | slowest [s] |")
    print("|---|---|---|---|---|---|")
    for name, outcome in outcomes.items():
        refused = "; ".join(f"{n} ...{why}" for why, n in outcome.refused.most_common(4)) or "0"
        told = f"{outcome.answered} | {outcome.warned} | {refused} | {len(outcome.bad)} | {outcome.slowest_s:.1f}"
        print(f"| {name} | {told} |")
    return int(any(outcome.bad for outcome in outcomes.values()))


if __name__ == "__main__":
    raise SystemExit(main())
