"""A hundred thousand plates: every model must be passive, finite and fast, at any edges, aspect ratio and frequency.

python stress/plates.py [--plates 100000] [--first 0] [--minutes M] [--processes 1] [--seed 1] [--seconds 1] [--only N]

Draws plates of 1 cm to 10 m and aspect ratios up to 1:100, held at any of their edges, of materials from felt to steel
and of any loss. Queries every model for the receptance among four points, corners and edges included, at six
frequencies up to 10 kHz. One frequency is exactly on a resonance of a held or free plate. Counted as bad:

    not finite     NaN or infinite
    gains energy   a receptance of a driven point with a positive imaginary part, or a receptance matrix whose imaginary
                   part has an eigenvalue above 1e-4 of its largest entry (the limit for near fields, see
                   docs/physical-models.md)
    negative       a driven point of a held plate that moves against the force far below its first resonance
    slow           more than a second of processor time without a warning
    other          any error outside scene2hap's own tree, or a floating-point warning

Every fourth plate also carries a source of 1e-6 to 1e4 kg, and the coupled scene is solved: gains must be finite and at
least 0. If a model raises a `SlowPlateWarning` for a plate, the plate is skipped and counted; every hundredth plate is
solved all the same. A plate takes some 0.23 s of processor time in all models together.

The number of a plate is its seed: `--only N` repeats one, `--first N` continues where `--minutes` or Ctrl-C ended. A
process takes `PIECE` plates at a time and finishes them, so that there is no gap in the numbers. Each process uses one
thread of BLAS; more threads would add processor time without being faster. Exits with 1 if anything is bad.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read once, by the first import of numpy

import argparse
import collections
import gc
import math
import random
import signal
import time
import warnings
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    InfinitePlate,
    Material,
    ModalPlate,
    Plate,
)
from scene2hap.errors import Scene2HapError
from scene2hap.propagation.bodies import lattice_body, modal_body
from scene2hap.propagation.domain import SlowPlateWarning, ThinPlateWarning
from scene2hap.propagation.lattice import bending_lattice, lattice_modes
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.modal import modes
from scene2hap.propagation.modal.estimates import first_bending_hz, n_rigid_motions

MODELS: dict[str, Any] = {
    "infinite_plate": InfinitePlate(outside_domain="ignore"),
    "modal_plate": ModalPlate(outside_domain="ignore"),
    "auto": AutoFidelity(outside_domain="ignore"),
    "mass_spring_damper": MassSpringDamper(outside_domain="ignore"),
}
CACHES: tuple[Any, ...] = (
    modes.modes_up_to,
    modal_body.modal_body,
    lattice_body.lattice_body,
    lattice_modes._modes_up_to,
    bending_lattice.bending_lattice,
    bending_lattice.lines_of,
)
"""Caches of plates, cleared after each plate: no plate is used twice, and the caches would fill some gigabytes."""
EDGES = ("FFFF", "CCCC", "SSSS", "CFFF", "SSFF", "CCFF", "SFSF", "CFSF", "FFCC", "CFFC", "SFFF", "FFSS")
ROUNDING, BETWEEN_POINTS = 1e-9, 1e-4
SCENE_EVERY, SLOW_EVERY = 4, 100
"""Every fourth plate carries a source; every hundredth plate is solved although it is slow."""
PIECE = 50
"""Plates that a process takes at a time."""
Floats = NDArray[np.float64]


@dataclass
class Outcome:
    """Counts of the outcomes of one model."""

    answered: int = 0
    in_scenes: int = 0
    skipped: int = 0
    warned: int = 0
    refused: collections.Counter[str] = field(default_factory=collections.Counter)
    bad: list[str] = field(default_factory=list)
    slowest_s: float = 0.0
    """Slowest call without a warning."""

    def add(self, other: Outcome) -> None:
        """Add the counts of another process."""
        self.answered += other.answered
        self.in_scenes += other.in_scenes
        self.skipped += other.skipped
        self.warned += other.warned
        self.refused += other.refused
        self.bad += other.bad
        self.slowest_s = max(self.slowest_s, other.slowest_s)


def some_plate(rng: random.Random) -> Plate:
    """Draw a plate, from the size of a coin to that of a floor."""
    longer = math.exp(rng.uniform(math.log(0.01), math.log(10.0)))
    aspect = math.exp(rng.uniform(0.0, math.log(100.0)))
    length_m, width_m = rng.sample((longer, longer / aspect), 2)
    thickness_m = longer / aspect * 10 ** rng.uniform(-3.0, 0.0)
    material = Material(
        "drawn",
        density_kg_m3=10 ** rng.uniform(1.5, 4.1),
        youngs_modulus_pa=10 ** rng.uniform(6.0, 11.6),
        poisson_ratio=rng.uniform(-0.2, 0.49),
        loss_factor=10 ** rng.uniform(-4.0, 0.0),
    )
    mass_kg = None if rng.random() < 0.7 else 10 ** rng.uniform(-6.0, 4.0)
    return Plate(length_m, width_m, thickness_m, material, rng.choice(EDGES), object_mass_kg=mass_kg)


def some_points(plate: Plate, rng: random.Random) -> Floats:
    """A corner, an edge and two points inside."""
    inside = [[rng.uniform(0.02, 0.98) for _ in range(2)] for _ in range(2)]
    at = [[rng.choice([0.0, 1.0]) for _ in range(2)], [rng.choice([0.0, 1.0]), rng.random()], *inside]
    return np.array(at) * (plate.length_m, plate.width_m)


def some_frequencies(plate: Plate, rng: random.Random) -> Floats:
    """Six frequencies [Hz]: far below the first resonance, on it, three anywhere, and a high one."""
    first_hz = first_bending_hz(plate)
    anywhere = [10 ** rng.uniform(0.5, 3.0) for _ in range(3)]
    return np.array([min(1e-3 * first_hz, 10.0), min(first_hz, 1e4), *anywhere, 10 ** rng.uniform(3.0, 4.0)])


@dataclass(frozen=True)
class Case:
    """A plate with the points, frequencies [Hz] and source of its queries."""

    number: int
    plate: Plate
    points: Floats
    f: Floats
    source_kg: float

    @classmethod
    def drawn(cls, number: int, seed: int) -> Case:
        rng = random.Random(f"plate/{seed}/{number}")
        plate = some_plate(rng)
        return cls(number, plate, some_points(plate, rng), some_frequencies(plate, rng), 10 ** rng.uniform(-6.0, 4.0))

    def name(self, model: str) -> str:
        plate = self.plate
        return f"plate {self.number}, {model}, {plate.edges} {plate.length_m:.3g} x {plate.width_m:.3g} m"

    def receptance(self, model: Any, driven: int) -> NDArray[np.complex128]:
        """From one point to all of them (n_points, n_frequencies) [m/N]."""
        return np.asarray(model.plate_receptance(self.plate, self.points[driven], self.points, self.f))

    def gains(self, model: Any) -> Floats:
        """Gains at all points (n_points,) of a source that stands inside the plate."""
        on_top = np.column_stack([self.points, np.zeros(len(self.points))])
        hz = float(self.f[2 + self.number // SCENE_EVERY % 4])
        contact = Contact("plate", "source", tuple(on_top[-1].tolist()))
        network = ContactNetwork({"plate": self.plate}, [contact])
        scene = model.prepare(network, [Excitation("source", hz, hz, self.source_kg)], Bands.dominant())
        return np.asarray(scene.attenuation("plate", on_top)[:, 0, 0])


def query(case: Case, model: Any, limit_s: float, outcome: Outcome, name: str, *, solves_slow: bool) -> None:
    """Query one model, and count the outcome."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warnings.simplefilter("ignore", ThinPlateWarning)
        if not solves_slow:
            warnings.simplefilter("error", SlowPlateWarning)
        np.seterr(all="raise", under="ignore")
        slowest_s, begin = 0.0, time.process_time()

        def timed(answer: NDArray[Any]) -> NDArray[Any]:
            nonlocal slowest_s, begin
            slowest_s, begin = max(slowest_s, time.process_time() - begin), time.process_time()
            return answer

        try:
            found = np.stack([timed(case.receptance(model, driven)) for driven in range(len(case.points))], axis=1)
            outcome.answered += 1
            outcome.bad += [f"{name}: {fault}" for fault in faults(found, case.plate, model)]
            if case.number % SCENE_EVERY == 0:
                gains = timed(case.gains(model))
                outcome.in_scenes += 1
                if not np.isfinite(gains).all() or (gains < 0).any():
                    outcome.bad.append(f"{name}: a source of {case.source_kg:.3g} kg: gain {gains.min():.3g}")
        except SlowPlateWarning:
            outcome.skipped += 1
        except Scene2HapError as refusal:
            outcome.refused[" ".join(str(refusal).split()[-6:])] += 1
        except Exception as error:
            outcome.bad.append(f"{name}: other: {type(error).__name__} {error}")
    outcome.warned += bool(caught)
    outcome.bad += [f"{name}: other: {one.message}" for one in caught if issubclass(one.category, RuntimeWarning)]
    if caught:
        return
    outcome.slowest_s = max(outcome.slowest_s, slowest_s)
    if slowest_s > limit_s:
        outcome.bad.append(f"{name}: slow: {slowest_s:.1f} s")


def faults(found: NDArray[np.complex128], plate: Plate, model: Any) -> list[str]:
    """Faults of the receptances among some points (n_points, n_points, n_frequencies) [m/N]."""
    if not np.isfinite(found).all():
        return ["not finite"]
    wrong = []
    driven = found.diagonal(axis1=0, axis2=1)  # (n_frequencies, n_points)
    size = np.abs(found).max(axis=(0, 1))[:, None] + 1e-300
    if (driven.imag > ROUNDING * size).any():
        wrong.append(f"gains energy at a point: {(driven.imag / size).max():.1e}")
    imaginary = (found.imag + found.imag.transpose(1, 0, 2)).transpose(2, 0, 1) / 2
    gain = np.linalg.eigvalsh(imaginary / size[:, :, None]).max()
    if gain > BETWEEN_POINTS:
        wrong.append(f"gains energy between points: {gain:.1e}")
    is_held = n_rigid_motions(plate) == 0 and not isinstance(model, InfinitePlate)
    if is_held and (driven[0].real < -ROUNDING * size[0]).any():
        wrong.append(f"negative: {driven[0].real.min():.1e} m/N")
    return wrong


@dataclass(frozen=True)
class Campaign:
    """The checks of every plate, and the time (`time.monotonic`) at which the campaign ends."""

    models: tuple[str, ...]
    seed: int
    limit_s: float
    end_s: float
    skips_none: bool = False

    def query(self, numbers: Sequence[int]) -> tuple[int, dict[str, Outcome]]:
        """Query all models about some plates. Returns the number of plates and the outcomes; 0 after the end time."""
        outcomes = {name: Outcome() for name in self.models}
        if time.monotonic() >= self.end_s:
            return 0, outcomes
        for number in numbers:
            case = Case.drawn(number, self.seed)
            solves_slow = self.skips_none or number % SLOW_EVERY == 0
            for name, outcome in outcomes.items():
                n_bad = len(outcome.bad)
                query(case, MODELS[name], self.limit_s, outcome, case.name(name), solves_slow=solves_slow)
                for line in outcome.bad[n_bad:]:
                    print(f"* {line}", flush=True)
            for cache in CACHES:
                cache.cache_clear()
        return len(numbers), outcomes


def begin_process() -> None:
    """Ignore Ctrl-C in workers; the main process handles it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.freeze()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plates", type=int, default=100_000, help="number of the last plate, plus 1")
    parser.add_argument("--first", type=int, default=0, help="number of the first plate")
    parser.add_argument("--minutes", type=float, default=math.inf, help="when to stop")
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--only", type=int)
    parser.add_argument("--model", choices=MODELS)
    given = parser.parse_args()
    models = tuple(name for name in MODELS if given.model in (None, name))
    end_s = time.monotonic() + 60 * given.minutes
    campaign = Campaign(models, given.seed, given.seconds, end_s, skips_none=given.only is not None)
    numbers = range(given.first, given.plates) if given.only is None else range(given.only, given.only + 1)
    pieces = [numbers[begin : begin + PIECE] for begin in range(0, len(numbers), PIECE)]
    n_plates, outcomes = 0, {name: Outcome() for name in models}
    with ProcessPoolExecutor(given.processes, initializer=begin_process) as pool:
        try:
            for n_done, found in pool.map(campaign.query, pieces):
                n_plates += n_done
                for name, outcome in found.items():
                    outcomes[name].add(outcome)
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
    print(f"\n{n_plates} plates from number {numbers[0]}, seed {given.seed}\n")
    print("| model | answered | in scenes | skipped as slow | with a warning | refused | bad | slowest [s] |")
    print("|---|---|---|---|---|---|---|---|")
    for name, one in outcomes.items():
        refused = "; ".join(f"{n} ...{why}" for why, n in one.refused.most_common(4)) or "0"
        counts = f"{one.answered} | {one.in_scenes} | {one.skipped} | {one.warned} | {refused}"
        print(f"| {name} | {counts} | {len(one.bad)} | {one.slowest_s:.1f} |")
    return int(any(outcome.bad for outcome in outcomes.values()))


if __name__ == "__main__":
    raise SystemExit(main())
