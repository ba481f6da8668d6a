"""Time to prepare a scene and to touch it, as a table in Markdown; docs/figures/propagation.md holds the latest.

OPENBLAS_NUM_THREADS=1 python benchmarks/propagation.py

Times are processor times, so that other programs disturb them little. Ratios are those of times measured in turns in
one run. The phone on an oak top that docs/figures/propagation.md shows is printed as well.
"""

from __future__ import annotations

import argparse
import platform
import time
import warnings
from collections.abc import Callable
from functools import partial
from importlib.metadata import version

import numpy as np

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    InfinitePlate,
    ModalPlate,
    Plate,
    PropagationField,
    PropagationModel,
    materials,
    plate_modes,
)
from scene2hap.propagation.bodies import idealisation, infinite_body, modal_body
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.propagation.modal import estimates, modes
from scene2hap.propagation.protocol import ExpectantField
from scene2hap.scene.pose import Pose

SEED = 3
THIRDS = Bands.third_octaves(10, 1000)
N_SOURCES = 8
MODELS: dict[str, PropagationModel] = {"Infinite": InfinitePlate(), "Modal": ModalPlate()}


def room(n_objects: int = 50, n_contacts: int = 60, seed: int = SEED, prefix: str = "") -> ContactNetwork:
    """Objects of a flat: a fifth are sheets of 2-6 mm steel or glass, a fifth are compact.

    Half of the sheets and half of the oak plates have asymmetric edges. Each object stands on one of the six previous
    objects; further contacts close loops.
    """
    rng = np.random.default_rng(seed)
    names = [f"{prefix}{i:04d}" for i in range(n_objects)]
    kinds: list[Callable[[int], Plate]] = [
        lambda i: _plate(rng, (0.3, 0.7), (0.2, 0.4), (0.002, 0.006), ("glass", "steel")[i % 2], i % 10 == 0),
        lambda i: _plate(rng, (0.6, 1.4), (0.3, 0.8), (0.015, 0.03), "oak", i % 10 == 1),
        lambda i: _plate(rng, (0.4, 1.0), (0.2, 0.4), (0.012, 0.02), "plywood", False),
        lambda i: _plate(rng, (0.08, 0.15), (0.06, 0.1), (0.05, 0.1), "ceramic", False),
        lambda i: _plate(rng, (0.2, 0.4), (0.2, 0.3), (0.01, 0.03), "plastic", False),
    ]
    bodies = {name: kinds[i % 5](i) for i, name in enumerate(names)}
    poses = {name: Pose(tuple(rng.uniform(-0.1, 0.1, 3))) for name in names}
    pairs = [(i, int(rng.integers(max(0, i - 6), i))) for i in range(1, n_objects)]
    while len(pairs) < n_contacts:
        i, j = rng.choice(n_objects, 2, replace=False)
        pairs.append((int(i), int(j)))
    contacts = [Contact(names[i], names[j], (*rng.uniform(0.0, 0.4, 2), 0.0)) for i, j in pairs]
    return ContactNetwork(bodies, contacts, poses)


def _plate(
    rng: np.random.Generator,
    length: tuple[float, float],
    width: tuple[float, float],
    thickness: tuple[float, float],
    material: str,
    is_unsymmetric: bool,
) -> Plate:
    size = (rng.uniform(*length), rng.uniform(*width), rng.uniform(*thickness))
    return Plate(*size, materials.lookup(material), "CFFS" if is_unsymmetric else "free")


def sources(prefix: str = "") -> list[Excitation]:
    """Sources on eight of the compact objects."""
    return [Excitation(f"{prefix}{3 + 5 * i:04d}", 100.0, 100.0, 0.3) for i in range(N_SOURCES)]


def seconds(work: Callable[[], object], repeat: int = 1) -> float:
    begin = time.process_time()
    for _ in range(repeat):
        work()
    return (time.process_time() - begin) / repeat


def clear_caches() -> None:
    """Clear the caches of plates."""
    for cached in (modes.modes_up_to, estimates.first_bending_hz, modal_body.modal_body, idealisation.is_compact):
        cached.cache_clear()
    infinite_body._table.cache_clear()


def preparing(model: PropagationModel) -> tuple[float, float]:
    """Times [s] to prepare a new room, and to prepare it again after a move of one object; medians of five."""
    network, excitations = room(), sources()
    model.prepare(network, excitations, THIRDS)  # imports are done before times are measured
    cold, warm = [], []
    for k in range(5):
        clear_caches()
        cold.append(seconds(lambda: model.prepare(network, excitations, THIRDS)))
        poses = {**network.poses, "0007": Pose((0.01 * k, 0.02, 0.0))}
        moved = ContactNetwork(network.bodies, network.contacts, poses)
        warm.append(seconds(partial(model.prepare, moved, excitations, THIRDS)))
    return float(np.median(cold)), float(np.median(warm))


def touching(
    fields: dict[str, PropagationField], object_id: str, point_m: tuple[float, float, float]
) -> dict[str, float]:
    """Time per touch [s]: the best of nine turns of fifty."""
    points = np.array([point_m])
    for field in fields.values():
        field.attenuation(object_id, points)
    best = dict.fromkeys(fields, np.inf)
    for _ in range(9):
        for name, field in fields.items():
            best[name] = min(best[name], seconds(partial(field.attenuation, object_id, points), 50))
    return best


def touch_on_a_plate(plate: Plate, feet: int = 1, *, is_expected: bool = False) -> dict[str, float]:
    contacts = [
        Contact(f"s{i}", "plate", (plate.length_m * (0.1 + 0.1 * i) + dx, plate.width_m * (0.2 + 0.07 * i) + dy, 0.0))
        for i in range(N_SOURCES)
        for dx, dy in ((0.0, 0.0), (0.02, 0.0), (0.0, 0.03), (0.02, 0.03))[:feet]
    ]
    network = ContactNetwork({"plate": plate}, contacts)
    excitations = [Excitation(f"s{i}", 100.0, 100.0, 0.2) for i in range(N_SOURCES)]
    models = {"Exponential": ExponentialPlate(), **MODELS}
    fields = {name: model.prepare(network, excitations, THIRDS) for name, model in models.items()}
    for field in fields.values():
        if is_expected and isinstance(field, ExpectantField):
            field.expect("plate")
    return touching(fields, "plate", (0.3, 0.2, 0.0))


def flats(n_rooms: int) -> ContactNetwork:
    """Network of many rooms of fifty objects; the rooms do not touch one another."""
    parts = [room(seed=SEED + i, prefix=f"{i:03d}-") for i in range(n_rooms)]
    return ContactNetwork(
        {name: body for part in parts for name, body in part.bodies.items()},
        [contact for part in parts for contact in part.contacts],
        {name: pose for part in parts for name, pose in part.poses.items()},
    )


def phone_on_oak() -> None:
    glass, oak = materials.lookup("glass"), materials.lookup("oak")
    feet = [Contact("phone", "top", (0.4 + x, 0.3 + y, 0.0)) for x in (0.01, 0.14) for y in (0.01, 0.06)]
    bodies = {"top": Plate(1.2, 0.7, 0.025, oak), "phone": Plate(0.15, 0.07, 0.008, glass)}
    network = ContactNetwork(bodies, feet, {"phone": Pose((0.4, 0.3, 0.0))})
    points = {"beside a foot": (0.42, 0.32, 0), "under its middle": (0.475, 0.335, 0), "0.4 m away": (0.85, 0.45, 0)}
    points["far corner"] = (1.15, 0.05, 0)
    print(
        "| band, Hz | " + " | ".join(f"Modal, {name}" for name in points) + " | Infinite, 0.4 m | Exponential, 0.4 m |"
    )
    print("|---" * (len(points) + 3) + "|")
    gains = [
        20
        * np.log10(
            model.prepare(network, [Excitation("phone", 175, 175, 0.2)], THIRDS).attenuation(
                "top", list(points.values())
            )
        )
        for model in (ModalPlate(), InfinitePlate(), ExponentialPlate())
    ]
    for band, (low, high) in enumerate(THIRDS.widths_hz()):
        modal = [f"{gain:.1f}" for gain in gains[0][:, 0, band]]
        others = [f"{gain[2, 0, band]:.1f}" for gain in gains[1:]]
        print(f"| {low:.0f}-{high:.0f} | " + " | ".join(modal + others) + " |")


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    print("| quantity | Infinite | Modal | bound |\n|---|---|---|---|")
    times = {name: preparing(model) for name, model in MODELS.items()}
    print(
        "| 50 objects, 60 contacts, 20 bands, cold, s | " + " | ".join(f"{t[0]:.2f}" for t in times.values()) + " | 1 |"
    )
    ratios = " | ".join(f"{t[1]:.3f} ({100 * t[1] / t[0]:.0f} %)" for t in times.values())
    print(f"| when one object moves, s (of cold) | {ratios} | 10 % |")
    steel = materials.lookup("steel")
    free, held = Plate(0.65, 0.42, 0.002, steel), Plate(0.72, 0.45, 0.002, steel, "CFFS")
    for what, plate, feet in (("free", free, 1), ("CFFS", held, 1), ("free, four feet each", free, 4)):
        n = int((plate_modes(plate, max_frequency_hz=1000.0).frequencies_hz <= 1000.0).sum())
        best = touch_on_a_plate(plate, feet)
        cells = [f"{1e6 * best[name]:.0f} ({best[name] / best['Exponential']:.1f})" for name in MODELS]
        own = f"{1e6 * best['Exponential']:.0f}"
        print(f"| touch, 8 sources, {n} modes, {what}, us (over Exponential, {own}) | " + " | ".join(cells) + " | 5 |")
        best = touch_on_a_plate(plate, feet, is_expected=True)
        ratio = best["Modal"] / best["Exponential"]
        print(f"| the same, expected, us (over Exponential) | | {1e6 * best['Modal']:.0f} ({ratio:.1f}) | 5 |")
    cells = []
    for model in MODELS.values():
        fields = {str(n): model.prepare(flats(n), sources("000-"), THIRDS) for n in (1, 100)}
        best = touching(fields, "000-0001", (0.2, 0.2, 0.0))
        cells.append(f"{best['100'] / best['1']:.2f}")
    print("| touch among 5,000 objects over that among 50 | " + " | ".join(cells) + " | 1.5 |\n")
    phone_on_oak()
    print(
        f"\nMachine: {platform.system()} {platform.machine()}, Python {platform.python_version()}, "
        f"numpy {version('numpy')}, scipy {version('scipy')}; seed {SEED}."
    )


if __name__ == "__main__":
    main()
