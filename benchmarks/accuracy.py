"""Plate models beside finite elements, as a table in Markdown; docs/accuracy.md holds the latest.

OPENBLAS_NUM_THREADS=1 python benchmarks/accuracy.py > docs/accuracy.md      (needs scikit-fem)

Truth is a Kirchhoff plate of Argyris triangles (tests/plate_fe.py), solved directly at every frequency; its own error
is shown as the difference from a coarser mesh.
"""

from __future__ import annotations

import platform
import sys
import time
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from plate_fe import fe_receptance
from scene2hap import ExponentialPlate, InfinitePlate, ModalPlate, Plate, materials, plate_modes
from scene2hap.propagation import modes as modes_module

SEED = 7
FREQUENCIES_HZ = np.geomspace(20.0, 1000.0, 60)
LOSS = 0.01
CELLS, COARSE = (18, 12), (12, 9)  # multiples of three, so that the force acts on a node
PLATES = {
    "oak table": (1.2, 0.7, 0.025, "oak", "free"),
    "glass coffee table": (0.9, 0.6, 0.006, "glass", "free"),
    "plywood shelf on its ends": (0.9, 0.25, 0.018, "plywood", "SSFF"),
    "steel bracket": (0.4, 0.3, 0.002, "steel", "CFFF"),
    "clamped glass pane": (0.6, 0.5, 0.004, "glass", "clamped"),
}


def db(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> str:
    apart = np.abs(20 * np.log10(np.abs(one / other)))
    return f"{np.median(apart):.2f} / {np.quantile(apart, 0.95):.2f}"


def row(name: str) -> str:
    length, width, thickness, material, boundary = PLATES[name]
    # One loss for all models, so that they differ by their propagation alone.
    plate = Plate(length, width, thickness, replace(materials.lookup(material), loss_factor=LOSS), boundary)
    size = np.array([length, width])
    drive = size / 3  # a node of both meshes
    points = np.random.default_rng(SEED).uniform(0.05, 0.95, (12, 2)) * size
    every = np.vstack([drive, points])

    begin = time.perf_counter()
    truth = fe_receptance(plate, CELLS, drive, every, FREQUENCIES_HZ, LOSS)
    fe_s = time.perf_counter() - begin
    coarse = fe_receptance(plate, COARSE, drive, every, FREQUENCIES_HZ, LOSS)
    expected = truth[1:] / truth[0]

    cells = [name, str(len(plate_modes(plate, max_frequency_hz=1000.0).frequencies_hz)), db(coarse, truth)]
    times = []
    for model in (ExponentialPlate(), InfinitePlate(), ModalPlate()):
        model.plate_transfer(plate, drive, points, FREQUENCIES_HZ)  # so that imports are done before the clock starts
        modes_module._modes_up_to.cache_clear()
        begin = time.perf_counter()
        found = model.plate_transfer(plate, drive, points, FREQUENCIES_HZ)
        times.append(f"{1e3 * (time.perf_counter() - begin):.1f}")
        cells.append(db(found, expected))
    physical = (InfinitePlate(), ModalPlate())
    cells += [db(model.plate_receptance(plate, drive, drive, FREQUENCIES_HZ), truth[:1]) for model in physical]
    return "| " + " | ".join([*cells, " / ".join(times), f"{1e3 * fe_s:.0f}"]) + " |"


def main() -> None:
    print(
        f"""Plate models beside finite elements.

`OPENBLAS_NUM_THREADS=1 python benchmarks/accuracy.py > docs/accuracy.md` makes this table. A force at a third of both
sides, {len(FREQUENCIES_HZ)} frequencies from {FREQUENCIES_HZ[0]:g} to {FREQUENCIES_HZ[-1]:g} Hz, twelve points drawn \
with seed {SEED}, loss factor {LOSS:g} for all. Modes are
counted to 1 kHz. Errors in dB, median / 95th percentile over points and frequencies, of transfer from the driven point
and, under "driven", of the receptance there. Truth: a thin plate of {CELLS[0]} × {CELLS[1]} × 2 Argyris triangles.

| plate | modes | FE mesh | Exponential | Infinite | Modal | Infinite, driven | Modal, driven | ms, each | FE, ms |
|---|---|---|---|---|---|---|---|---|---|"""
    )
    for name in PLATES:
        print(row(name), flush=True)
    print(
        f"""
`ExponentialPlate` is a style, legible rather than physical, so its column says how far legible is from real, not how
good it is. `InfinitePlate` has the right level on average and none of the resonances. `ModalPlate` is the plate; its
time is that of a plate never seen before, modes included. All three and the truth leave out shear: where six
thicknesses make a wavelength, a thin plate's frequencies are 15 % too high.

Machine: {platform.system()} {platform.machine()}, Python {platform.python_version()}, numpy {version("numpy")}, \
scipy {version("scipy")}, scikit-fem {version("scikit-fem")}."""
    )


if __name__ == "__main__":
    main()
