"""Propagation on extreme plates and scenes: no NaN, no overflow, no hang, and a clear error for every refusal.

python benchmarks/figures.py stability

Draws plates, scenes and time steppers far beyond furniture, queries every model, and counts the outcomes:

    answered    finite numbers of the right shape; attenuation also within its bounds
    refused     an error of scene2hap's own tree, whose message has a number and says what to do next
    bad         anything else: NaN, infinity, a floating-point warning, a foreign exception, too much processor time

The number of a case is its seed, so `--only N` repeats one.
"""

from __future__ import annotations

import argparse
import collections
import math
import platform
import random
import re
import signal
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from importlib.metadata import version
from types import FrameType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    InfinitePlate,
    Material,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    SceneWarning,
    plate_modes,
)
from scene2hap.errors import Scene2HapError
from scene2hap.propagation.domain import SlowPlateWarning, ThinPlateWarning
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.lattice.stepping import ExactStepper, NewmarkStepper, State, Stepper
from scene2hap.propagation.mass_spring_damper import CoarsenedWarning, MassSpringDamper

MODELS: dict[str, Any] = {
    "exponential": ExponentialPlate(),
    "infinite": InfinitePlate(),
    "modal": ModalPlate(),
    "modal, no loss": ModalPlate(loss_floor=0.0),
    "auto": AutoFidelity(),
    "auto, no loss": AutoFidelity(loss_floor=0.0),
    "mass-spring-damper": MassSpringDamper(8),
    "mass-spring-damper, no loss": MassSpringDamper(8, loss_floor=0.0),
}
STEPS_S = (1e-9, 1e-4, 10.0)
LATTICE_STEPS_S = (1e-9, 1e-6, 1e-3)


class Hang(BaseException):
    """The limit of processor time has passed; the time of other programs does not count."""


@dataclass
class Tally:
    """Counts of the outcomes of one model."""

    answered: int = 0
    refused: collections.Counter[str] = field(default_factory=collections.Counter)
    bad: list[str] = field(default_factory=list)
    slowest_s: float = 0.0

    def run(self, name: str, limit_s: float, query: Callable[[], NDArray[np.generic]]) -> None:
        """Run a query, and count the outcome. `name` names the case."""

        def alarm(signum: int, frame: FrameType | None) -> None:
            raise Hang

        before = signal.signal(signal.SIGPROF, alarm)
        # The signal is repeated, since Python's main thread does not see one that arrives in a thread of BLAS.
        signal.setitimer(signal.ITIMER_PROF, limit_s, 0.1)
        begin = time.process_time()
        try:
            answer = query()
            if np.isfinite(answer).all():
                self.answered += 1
            else:
                self.bad.append(f"{name}: not finite")
        except Scene2HapError as error:
            clear = re.search(r"\d", str(error)) and len(str(error)) > 30
            if clear:
                self.refused[_reason(error)] += 1
            else:
                self.bad.append(f"{name}: unclear refusal {error}")
        except Hang:
            self.bad.append(f"{name}: more than {limit_s:g} s")
        except Exception as error:
            self.bad.append(f"{name}: {type(error).__name__} {error}")
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, before)
            self.slowest_s = max(self.slowest_s, time.process_time() - begin)


def _reason(error: Scene2HapError) -> str:
    text = str(error)
    for sign, reason in (
        ("loss factor of 0", "no loss"),
        ("makes waves of", "waves shorter than the lattice"),
        ("modes of a lattice", "too many modes of the lattice"),
        ("it must be 0 to", "a frequency out of bounds"),
        ("nodes", "too many nodes"),
        ("functions in one eigenproblem", "too many modes"),
        ("frequencies to resolve", "too little loss for bands"),
        ("does not move", "driven on a held edge"),
    ):
        if sign in text:
            return reason
    return f"{type(error).__name__}: {text[:60]}"


def some_plate(rng: random.Random) -> Plate:
    """Thickness 1e-6..10 m, E 1e3..1e13 Pa, eta 0..2, nu -0.99..0.499, rho 1e-3..1e9, up to 1000:1; often an end."""

    def between(low: float, high: float) -> float:
        return rng.choice([low, high]) if rng.random() < 0.2 else math.exp(rng.uniform(math.log(low), math.log(high)))

    eta = rng.choice([0.0, 2.0, between(1e-6, 2.0), between(1e-3, 0.1)])
    nu = rng.choice([-0.99, 0.499, 0.0, 0.3, rng.uniform(-0.99, 0.499)])
    material = Material("drawn", between(1e-3, 1e9), between(1e3, 1e13), nu, eta)
    length = between(0.01, 30.0)
    sides = (length, length / rng.choice([1.0, 1000.0, between(1.0, 1000.0)]))
    boundary = "".join(rng.choice("FFSC") for _ in range(4))
    length_m, width_m = rng.sample(sides, 2)
    return Plate(length_m, width_m, between(1e-6, 10.0), material, boundary)


def some_frequencies(plate: Plate, rng: random.Random) -> NDArray[np.float64]:
    """Three random frequencies [Hz], and one exactly on a resonance if there is one below 10 kHz."""
    f = [10 ** rng.uniform(-3, 3), 10 ** rng.uniform(1, 3), rng.choice([1e-6, 1000.0, 250.0])]
    compact = max(plate.length_m, plate.width_m) < 4 * min(plate.length_m, plate.width_m)
    resonances = (
        plate_modes(plate, 8).frequencies_hz if compact else MassSpringDamper(8).natural_frequencies_hz(plate, 5)
    )
    if 0 < resonances[-1] < 1e4:
        f.append(float(resonances[-1]))
    return np.array(f)


def kernels(number: int, tallies: dict[str, Tally], limit_s: float) -> None:
    """One plate, all models: transfer and receptance."""
    rng = random.Random(f"kernel/{number}")
    plate = some_plate(rng)
    f = some_frequencies(plate, rng)
    size = np.array([plate.length_m, plate.width_m])
    points = np.array([[rng.choice([0.0, 1.0, rng.random()]) for _ in range(2)] for _ in range(4)]) * size
    for name, model in MODELS.items():
        case = f"kernel {number}, {name}, {plate}"
        tallies[name].run(case, limit_s, partial(model.plate_transfer, plate, points[0], points, f))
        if not isinstance(model, ExponentialPlate):
            tallies[name].run(case, limit_s, partial(model.plate_receptance, plate, points[0], points, f))


def some_scene(rng: random.Random) -> tuple[ContactNetwork, list[Excitation]]:
    """Two to seven bodies with mass ratios up to 1e12; contacts form a tree and some loops, several at one point."""
    ids = [f"o{i}" for i in range(rng.randint(2, 7))]
    bodies: dict[str, Plate | RigidBody] = {}
    for object_id in ids:
        if rng.random() < 0.3:
            bodies[object_id] = RigidBody(10 ** rng.uniform(-6, 6), rng.choice([None, (0.1, 0.2, 0.3)]))
        else:
            plate = some_plate(rng)
            if rng.random() < 0.7:  # mostly furniture, so that few scenes are refused because of one foil
                material = replace(plate.material, youngs_modulus_pa=10 ** rng.uniform(9, 11.3), density_kg_m3=1000.0)
                plate = replace(plate, thickness_m=10 ** rng.uniform(-2.5, -1), length_m=1.0, width_m=0.7)
                plate = replace(plate, material=material)
            bodies[object_id] = plate
    stacked = (rng.random(), rng.random(), 0.0)
    contacts = []
    for i in range(1, len(ids)):
        for other in {rng.randrange(i), rng.randrange(i)}:
            for _ in range(rng.choice([1, 1, 4, 30])):
                point = stacked if rng.random() < 0.5 else (rng.random(), rng.random(), 0.0)
                weight = rng.choice([0.0, 1.0, 1.0, 1e-12])
                area = rng.choice([None, None, 1e-12, 1.0])
                contacts.append(Contact(ids[i], ids[other], point, area_m2=area, weight=weight))
    poses = {object_id: Pose((rng.random(), rng.random(), 0.0)) for object_id in ids if rng.random() < 0.5}
    sources = [
        Excitation(object_id, 10 ** rng.uniform(0, 3), 10 ** rng.uniform(1, 3), 10 ** rng.uniform(-6, 6))
        for object_id in rng.sample(ids, rng.randint(1, min(3, len(ids))))
    ]
    return ContactNetwork(bodies, contacts, poses), sources


def scenes(number: int, tallies: dict[str, Tally], limit_s: float) -> None:
    """One scene, all models: attenuation everywhere."""
    rng = random.Random(f"scene/{number}")
    network, excitations = some_scene(rng)
    bands = rng.choice([Bands.dominant(), Bands.dominant(), Bands((10.0, 100.0, 1000.0))])
    touch = np.array([[rng.random(), rng.random(), 0.0] for _ in range(2)])
    for name, model in MODELS.items():

        def everywhere(model: Any = model) -> NDArray[np.float64]:
            prepared = model.prepare(network, excitations, bands)
            gains = np.array([prepared.attenuation(object_id, touch) for object_id in network.bodies])
            assert gains.shape == (len(network.bodies), 2, len(excitations), bands.n_bands)
            assert (gains >= 0).all()
            return gains

        tallies[f"{name}, scene"].run(f"scene {number}, {name}", limit_s, everywhere)


def steppers(n_steps: int) -> Iterator[tuple[str, float, float, float]]:
    """Yield (name, dt [s], largest gain of energy of a damped mode in a step, drift of undamped modes).

    Gain and drift are relative to the initial energy.
    """
    omega = np.tile(2 * np.pi * np.array([0.01, 1.0, 50.0, 250.0, 1000.0, 1e5]), 3)
    zeta = np.repeat([0.0, 0.005, 1.0], 6)
    for dt in STEPS_S:
        for name, stepper in (
            ("exact", ExactStepper(omega, zeta, dt)),
            ("Newmark", NewmarkStepper(np.ones_like(omega), 2 * zeta * omega, omega**2, dt)),
        ):
            start = State(1 / omega, np.full_like(omega, 0.3))
            gain, drift = walked(stepper, start, n_steps, lambda s: s.velocity**2 + (omega * s.displacement) ** 2, zeta)
            yield name, dt, gain, drift


def walked(
    stepper: Stepper,
    state: State,
    n_steps: int,
    energy: Callable[[State], NDArray[np.float64]],
    zeta: NDArray[np.float64],
) -> tuple[float, float]:
    """Largest gain of energy in a step of modes with zeta > 0, and largest drift of the other modes."""
    first = before = highest = lowest = energy(state)
    gain = np.full_like(first, -np.inf)
    for _ in range(n_steps):
        state = stepper.step(state)
        now = energy(state)
        gain = np.maximum(gain, now - before)
        highest, lowest = np.maximum(highest, now), np.minimum(lowest, now)
        before = now
    drift = np.maximum(highest - first, first - lowest) / first
    return (gain / first)[zeta > 0].max(initial=-np.inf), drift[zeta == 0].max(initial=0.0)


def lattice_steppers(
    n_steps: int, boundaries: tuple[str, ...] = ("CFFF", "SFFF")
) -> Iterator[tuple[str, float, float, float]]:
    """Yield the same as `steppers`, for all nodes of a lattice at once, clamped or hinged so that it can rotate."""
    from scipy.sparse import csr_array

    for boundary in boundaries:
        lattice = bending_lattice(Plate(0.5, 0.4, 0.004, Material("glass", 2500.0, 70e9, 0.22), boundary), 6)
        mass, stiffness = lattice.masses.sum(axis=1) * 10.0, lattice.stiffness * lattice.plate.bending_stiffness_nm
        start = State(np.zeros(lattice.n_nodes), np.random.default_rng(1).standard_normal(lattice.n_nodes))
        for dt in LATTICE_STEPS_S:
            found = []
            for damping, zeta in ((1e-6 * stiffness, 1.0), (csr_array(stiffness.shape), 0.0)):
                stepper = NewmarkStepper(mass, damping, stiffness, dt)

                def energy(state: State, stepper: NewmarkStepper = stepper) -> NDArray[np.float64]:
                    return np.array([stepper.energy(state)])

                found.append(walked(stepper, start, n_steps, energy, np.array([zeta])))
            yield f"Newmark, whole lattice {boundary}", dt, found[0][0], found[1][1]


def run(n_kernels: int, n_scenes: int, limit_s: float = 60.0, only: int | None = None) -> dict[str, Tally]:
    """Query all models; warnings that are not our own count as bad."""
    tallies: dict[str, Tally] = collections.defaultdict(Tally)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", ThinPlateWarning)
        warnings.simplefilter("ignore", SlowPlateWarning)
        warnings.simplefilter("ignore", CoarsenedWarning)
        warnings.simplefilter("ignore", SceneWarning)  # materials are drawn beyond real ones
        for case, n in ((kernels, n_kernels), (scenes, n_scenes)):
            for number in range(n) if only is None else [only]:
                case(number, tallies, limit_s)
    return tallies


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kernels", type=int, default=120)
    parser.add_argument("--scenes", type=int, default=60)
    parser.add_argument("--steps", type=int, default=1_000_000)
    parser.add_argument("--lattice-steps", type=int, default=10_000)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--only", type=int)
    arguments = parser.parse_args()

    print(
        f"""{arguments.kernels} plates of \
1e-6 to 10 m thickness, E 1e3 to 1e13 Pa,
nu -0.99 to 0.499, loss 0 to 2, density 1e-3 to 1e9 kg/m3 and sides up to 1000:1, driven anywhere, also exactly on a
resonance and without loss; and {arguments.scenes} scenes of up to seven bodies, their masses up to 1e12 apart, with up
to thirty contacts on one point. Bad means NaN, infinity, a floating-point warning, a foreign exception, an unclear
refusal or more than {arguments.seconds:g} s of processor time. A third of the scenes are computed in two bands,
which are sampled at about 1 / loss frequencies; one without a floor of loss is refused if they are too many.

| model | answered | refused | bad | slowest, s |
|---|---|---|---|---|"""
    )
    tallies = run(arguments.kernels, arguments.scenes, arguments.seconds, arguments.only)
    for name, tally in tallies.items():
        reasons = "; ".join(f"{count} {reason}" for reason, count in tally.refused.most_common()) or "0"
        print(f"| {name} | {tally.answered} | {reasons} | {len(tally.bad)} | {tally.slowest_s:.1f} |")
    bad = [line for tally in tallies.values() for line in tally.bad]

    print(
        f"""
Energy over {arguments.steps} steps of eighteen modes from 0.01 Hz to 100 kHz, ratios 0, 0.005 and 1, each by itself; \
and over {arguments.lattice_steps}
steps of a lattice of 56 nodes, clamped or hinged, with and without damping. Parts of the first energy.

| stepper | dt, s | largest gain in a step, damped | drift, undamped |
|---|---|---|---|""",
        flush=True,
    )
    for kind, n in ((steppers, arguments.steps), (lattice_steppers, arguments.lattice_steps)):
        for name, dt, gain, drift in kind(n):
            print(f"| {name} | {dt:g} | {max(gain, 0.0):.1e} | {drift:.1e} |", flush=True)
            if not (gain <= 1e-12 and drift <= 1e-9):
                bad.append(f"{name}, dt {dt:g} s: gain {gain:.1e}, drift {drift:.1e}")

    print(
        """
Time stepping has viscous modal damping of ratio eta/2, harmonic answers the complex stiffness D (1 + j eta). A mode of
frequency f_n answers the more by viscous damping, in dB:

| eta | f/f_n = 0 | 0.5 | 0.9 | 1 | 1.1 | 2 | 10 |
|---|---|---|---|---|---|---|---|"""
    )
    r = np.array([0, 0.5, 0.9, 1, 1.1, 2, 10])
    for eta in (0.001, 0.01, 0.1, 0.5, 1.0, 2.0):
        ratio = np.hypot(1 - r**2, eta) / np.hypot(1 - r**2, eta * r)
        cells = " | ".join(f"{x + 0.0:.3f}" for x in 20 * np.log10(ratio))
        print(f"| {eta:g} | {cells} |")
    print(f"\n{len(bad)} bad outcomes.", *(f"* {line}" for line in bad), sep="\n")
    print(
        f"\nMachine: {platform.system()} {platform.machine()}, Python {platform.python_version()}, numpy "
        f"{version('numpy')}, scipy {version('scipy')}."
    )
    return bool(bad)


if __name__ == "__main__":
    raise SystemExit(main())
