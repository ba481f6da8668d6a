"""Plate models compared with finite elements, as tables in Markdown and a figure; see docs/figures/accuracy.md.

python benchmarks/figures.py accuracy      (needs scikit-fem and matplotlib)

The reference is a Kirchhoff plate of Argyris triangles (tests/support/plate_fe.py), solved directly at every frequency.
Its error is shown as the difference from a coarser mesh. Times are processor times.
"""

from __future__ import annotations

import argparse
import platform
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from plate_fe import fe_receptance
from scene2hap import ExponentialPlate, InfinitePlate, MassSpringDamper, ModalPlate, Plate, materials, plate_modes
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.auto import AutoFidelity
from scene2hap.propagation.bodies import infinite_body, lattice_body, modal_body
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.propagation.lattice import lattice, lattice_modes
from scene2hap.propagation.modal import estimates, modes

SEED = 7
N_POINTS = 32
FREQUENCIES_HZ = np.geomspace(20.0, 1000.0, 60)
LOSS = 0.01
WIDTH = 120
FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "accuracy.png"

# Length, width, thickness [m], material, boundary, cells of the finer mesh; both meshes have a node under the force.
PLATES: dict[str, tuple[float, float, float, str, str, tuple[int, int]]] = {
    "oak table": (1.2, 0.7, 0.025, "oak", "free", (18, 12)),
    "oak side table": (0.6, 0.5, 0.02, "oak", "free", (15, 12)),
    "oak shelf on its ends": (0.8, 0.25, 0.018, "oak", "SSFF", (18, 9)),
    "plywood shelf on its ends": (0.9, 0.25, 0.018, "plywood", "SSFF", (18, 9)),
    "plywood floor": (2.4, 1.2, 0.022, "plywood", "simply-supported", (27, 15)),
    "glass coffee table": (0.9, 0.6, 0.006, "glass", "free", (21, 15)),
    "clamped glass pane": (0.6, 0.5, 0.004, "glass", "clamped", (18, 15)),
    "glass shelf, three edges": (0.9, 0.6, 0.006, "glass", "CFSF", (21, 15)),
    "glass door": (1.1, 0.8, 0.006, "glass", "CFSF", (24, 18)),
    "steel bracket": (0.4, 0.3, 0.002, "steel", "CFFF", (18, 15)),
    "steel case": (0.5, 0.35, 0.002, "steel", "clamped", (21, 15)),
    "steel sheet, one corner held": (0.5, 0.3, 0.003, "steel", "CFSF", (18, 12)),
    "plexiglass table": (0.8, 0.5, 0.005, "plexiglass", "free", (21, 15)),
    "concrete floor": (4.0, 3.0, 0.14, "concrete", "simply-supported", (18, 15)),
    "concrete slab": (5.0, 4.0, 0.18, "concrete", "clamped", (18, 15)),
}

# Any, since the methods differ: all models have plate_transfer; models with an elastic body have more.
MODELS: dict[str, Any] = {
    "Exponential": ExponentialPlate(),
    "Infinite": InfinitePlate(outside_domain="ignore"),
    "MassSpringDamper(32)": MassSpringDamper(32, outside_domain="ignore"),
    "Auto(1 dB)": AutoFidelity(outside_domain="ignore"),
    "Modal": ModalPlate(outside_domain="ignore"),
}


LATTICE_CACHES = [
    found for module in (lattice, lattice_modes) for found in vars(module).values() if hasattr(found, "cache_clear")
]


@dataclass
class Result:
    """One model on one plate: errors [dB] of ratio and receptance, median and 95th percentile, and times [ms]."""

    ratio: tuple[float, float] | None = None
    receptance: tuple[float, float] | None = None
    prepare_ms: float = 0.0
    touch_ms: float = 0.0


@dataclass
class Row:
    """One plate."""

    name: str
    n_modes: int
    mesh: tuple[float, float]
    fe_ms: float
    again_ms: float
    results: dict[str, Result] = field(default_factory=dict)


def apart(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> tuple[float, float]:
    db = np.abs(20 * np.log10(np.abs(one / other)))
    return float(np.median(db)), float(np.quantile(db, 0.95))


def ms(work: Callable[[], object]) -> float:
    begin = time.process_time()
    work()
    return 1e3 * (time.process_time() - begin)


def clear_caches() -> None:
    """Clear the caches of plates."""
    for cached in (modes.modes_up_to, estimates.first_bending_hz, modal_body.modal_body, infinite_body._table):
        cached.cache_clear()
    for cached in (lattice_body.lattice_body, *LATTICE_CACHES):
        cached.cache_clear()


def row(name: str) -> Row:
    length, width, thickness, material, boundary, cells = PLATES[name]
    # The same loss factor for all models, so that they differ only in propagation.
    plate = Plate(length, width, thickness, replace(materials.lookup(material), loss_factor=LOSS), boundary)
    size = np.array([length, width])
    drive = size / 3  # a node of both meshes
    points = np.random.default_rng(SEED).uniform(0.03, 0.97, (N_POINTS, 2)) * size
    every = np.vstack([drive, points])

    truths: list[NDArray[np.complex128]] = []
    fe_ms = ms(lambda: truths.append(fe_receptance(plate, cells, drive, every, FREQUENCIES_HZ, LOSS)))
    truth = truths[0]
    coarse = fe_receptance(plate, (cells[0] - 3, cells[1] - 3), drive, every, FREQUENCIES_HZ, LOSS)
    modal = MODELS["Modal"]
    n_modes = int((plate_modes(plate, max_frequency_hz=1000.0).frequencies_hz <= 1000.0).sum())
    modal.elastic_body(plate, 1000.0)
    again_ms = ms(lambda: modal.elastic_body(plate, 1000.0))
    found = Row(name, n_modes, apart(coarse, truth), fe_ms, again_ms)
    for kind, model in MODELS.items():
        try:
            found.results[kind] = result(model, plate, drive, points, truth)
        except ModelDomainError:
            found.results[kind] = Result()
    return found


def result(
    model: Any, plate: Plate, drive: NDArray[np.float64], points: NDArray[np.float64], truth: NDArray[np.complex128]
) -> Result:
    answer = Result(ratio=apart(model.plate_transfer(plate, drive, points, FREQUENCIES_HZ), truth[1:] / truth[0]))
    if not hasattr(model, "plate_receptance"):
        answer.touch_ms = ms(lambda: model.plate_transfer(plate, drive, points, FREQUENCIES_HZ)) / len(points)
        return answer
    every = np.vstack([drive, points])
    answer.receptance = apart(model.plate_receptance(plate, drive, every, FREQUENCIES_HZ), truth)
    # As in a scene: the body is made once, then each touch queries its response to a force at a contact.
    prepares, touches = [], []
    for _ in range(3):
        clear_caches()
        begin = time.process_time()
        body = model.elastic_body(plate, 1000.0)
        body.receptance(drive[None], drive[None], FREQUENCIES_HZ)
        prepared = time.process_time()
        for point in points:
            body.receptance(point[None], drive[None], FREQUENCIES_HZ)
        prepares.append(1e3 * (prepared - begin))
        touches.append(1e3 * (time.process_time() - prepared))
    answer.prepare_ms, answer.touch_ms = min(prepares), min(touches) / len(points)
    return answer


def pair(values: tuple[float, float] | None) -> str:
    return "-" if values is None else f"{values[0]:.2f} / {values[1]:.2f}"


def draw(rows: list[Row]) -> None:
    """Draw error over run time: a small point for each plate and model, a large one for the median of each model."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(7.5, 4.6), dpi=110, layout="constrained")
    for index, kind in enumerate(MODELS):
        done = [one.results[kind] for one in rows if one.results[kind].ratio is not None]
        if not done:
            continue
        x = np.array([one.prepare_ms + one.touch_ms for one in done])
        y = np.array([max(one.ratio[1], 0.01) for one in done if one.ratio is not None])
        colour = f"C{index}"
        axes.scatter(x, y, s=16, alpha=0.45, color=colour, linewidths=0)
        axes.scatter(np.median(x), np.median(y), s=90, color=colour, edgecolors="black", label=kind, zorder=3)
    axes.set(xscale="log", yscale="log", xlabel="a new plate and one touch, ms", ylabel="error, 95th percentile, dB")
    axes.axhline(1.0, color="grey", linewidth=0.8, linestyle=":")
    axes.grid(alpha=0.25, which="major")
    axes.legend(frameon=False, fontsize=9)
    axes.set_title("Ratio to the driven point against finite elements; large: median of plates", fontsize=10)
    figure.savefig(FIGURE)
    pyplot.close(figure)


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    for kind in MODELS.values():  # imports are done before times are measured
        kind.plate_transfer(Plate(0.6, 0.5, 0.02, materials.lookup("oak")), [0.1, 0.1], [0.2, 0.2], [100.0])
    rows = []
    for name in PLATES:
        rows.append(row(name))
        print(name, rows[-1].n_modes, file=sys.stderr, flush=True)
    draw(rows)
    print(page(rows))


def page(rows: list[Row]) -> str:
    kinds = list(MODELS)
    physical = kinds[1:]
    lines = [
        fill(
            f"A force at a third of both sides, {len(FREQUENCIES_HZ)} frequencies from {FREQUENCIES_HZ[0]:g} to "
            f"{FREQUENCIES_HZ[-1]:g} Hz, {N_POINTS} points drawn with seed {SEED}, loss factor {LOSS:g} for all. "
            "Errors are in dB, median / 95th percentile over points and frequencies. Truth: Argyris triangles solved "
            "directly at every frequency; the column FE says how far a mesh with three cells fewer on each side is "
            "from it.",
            WIDTH,
        ),
        "",
        "![run time against error](accuracy.png)",
        "",
        "## Receptance [m/N], the driven point included",
        "",
        "| plate | modes to 1 kHz | FE | " + " | ".join(physical) + " |",
        "|---" * (len(physical) + 3) + "|",
    ]
    for one in rows:
        cells = [pair(one.results[kind].receptance) for kind in physical]
        lines.append(f"| {one.name} | {one.n_modes} | {pair(one.mesh)} | " + " | ".join(cells) + " |")
    lines += [
        "",
        "## Ratio to the driven point",
        "",
        "| plate | " + " | ".join(kinds) + " |",
        "|---" * (len(kinds) + 1) + "|",
    ]
    for one in rows:
        lines.append(f"| {one.name} | " + " | ".join(pair(one.results[kind].ratio) for kind in kinds) + " |")
    lines += [
        "",
        "## Processor time [ms]: a new plate up to 1 kHz, and a touch on it",
        "",
        "| plate | " + " | ".join(physical) + " | Modal, second query | FE |",
        "|---" * (len(physical) + 3) + "|",
    ]
    for one in rows:
        cells = [
            "-"
            if one.results[kind].ratio is None
            else f"{one.results[kind].prepare_ms:.1f} + {one.results[kind].touch_ms:.2f}"
            for kind in physical
        ]
        lines.append(f"| {one.name} | " + " | ".join(cells) + f" | {one.again_ms:.3f} | {one.fe_ms:.0f} |")
    lines += [
        "",
        fill(
            "`ExponentialPlate`, the paper's law, is a style, legible rather than physical: its column says how far "
            "legible is from real, not how good it is. `InfinitePlate` has the right level on average and none of the "
            "resonances. `MassSpringDamper` is the same plate as a lattice of splines; `-` where waves "
            "are too short for it. `ModalPlate` is the plate. `AutoFidelity` keeps its tolerance for gains "
            "of bands, not for the single frequencies of this page. All of them and the truth leave out shear: "
            "where six thicknesses make a wavelength, a thin plate's frequencies are 15 % too high.",
            WIDTH,
        ),
        "",
        f"Machine: {platform.system()} {platform.machine()}, Python {platform.python_version()}, "
        f"numpy {version('numpy')}, scipy {version('scipy')}, scikit-fem {version('scikit-fem')}.",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
