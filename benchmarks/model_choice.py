"""Cost and error of each propagation model in a coupled scene, as a table in Markdown.

python benchmarks/model_choice.py [SCENE]

The scene is the built-in kitchen of 45 objects, baked offline with masses and feet. Each model prepares it in its own
process, and again as after a move. "First touch" queries a point of an object that was not queried before, "further"
other points of the same object. Levels at 200 points on objects that a source reaches are compared with those of
`ModalPlate` on a frequency grid twice as dense, which agrees with coupled finite elements (tests/physics). Times are
processor times.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap import (
    AutoFidelity,
    Bands,
    Excitation,
    ExponentialPlate,
    InfinitePlate,
    ModalPlate,
    PropagationModel,
    SceneWarning,
    bake,
    load_scene,
)
from scene2hap.bundle import BundleWarning
from scene2hap.demo import kitchen_path
from scene2hap.propagation.coupled.substructuring import prepare_coupled
from scene2hap.propagation.domain import ThinPlateWarning
from scene2hap.propagation.mass_spring_damper import MassSpringDamper
from scene2hap.propagation.protocol import ContactNetwork
from scene2hap.session import HapticSession
from scene2hap.session.present_scene.network import excitations_of
from scene2hap.session.present_scene.scene_state import SceneState

BANDS = Bands.third_octaves(10, 1000)
N_POINTS, SEED = 200, 11
LEAST_DB = -80.0  # Differences below this level are not felt.
MODELS: dict[str, tuple[Callable[[], PropagationModel], str]] = {
    "`exponential_plate`": (ExponentialPlate, "easy to read: the paper's law; the default"),
    "`infinite_plate`": (InfinitePlate, "level alone, for very large or lossy plates"),
    "`modal_plate`": (ModalPlate, "resonances, as a measurement would show them"),
    "`auto`, 1 dB": (lambda: AutoFidelity(tolerance_db=1.0), "the same within a stated error"),
    "`mass_spring_damper`": (MassSpringDamper, "a lattice that can be stepped in time"),
}


def scene_input(
    path: str, *, follows_outlines: bool = False
) -> tuple[ContactNetwork, tuple[Excitation, ...], list[tuple[str, NDArray[np.float64]]]]:
    """Network and excitations as a session gives them to a model, and points on objects that a source reaches.

    The objects of the points are no sources. follows_outlines : whether the model follows outlines.
    """
    scene = load_scene(path)
    bundle = bake(scene)
    session = HapticSession(scene, bundle)
    state, sources = SceneState(scene, bundle, follows_outlines=follows_outlines), session._sources
    network = state.network(None)(()).network
    reach = state.reach(sources.ids)
    rng = np.random.default_rng(SEED)
    ids = sorted(x for x in network.bodies if reach.has(x) and x not in sources.ids)
    points = []
    for _ in range(N_POINTS):
        object_id = str(rng.choice(ids))
        low, high = scene.object(object_id).bounds_m
        points.append((object_id, rng.uniform(low, high)))
    loops = [(row.source_id, row.loop) for row in sources.active_rows()]
    return network, excitations_of(loops, state.bodies, state.haptics), points


def levels_db(field: Any, points: list[tuple[str, NDArray[np.float64]]]) -> NDArray[np.float64]:
    """Band levels (n_points, n_sources, n_bands) [dB], no lower than `LEAST_DB`."""
    gains = np.array([field.attenuation(object_id, point[None])[0] for object_id, point in points])
    return np.asarray(np.maximum(20 * np.log10(np.maximum(gains, 1e-12)), LEAST_DB))


@dataclass(frozen=True)
class Measured:
    """Times of a model in a separate process [s], and its levels [dB]."""

    prepare_s: float
    again_s: float
    first_s: float
    further_s: float
    levels_db: NDArray[np.float64]


def measure(path: str, name: str) -> Measured:
    """Prepare, prepare again as after a move, and touch. `name` is a row of `MODELS`, or "truth"."""
    for category in (SceneWarning, BundleWarning, ThinPlateWarning, UserWarning):
        warnings.simplefilter("ignore", category)
    network, excitations, points = scene_input(path)
    if name == "truth":
        model = ModalPlate()
        field = prepare_coupled(model, network, excitations, BANDS, "ignore", density=2.0)
        return Measured(0.0, 0.0, 0.0, 0.0, levels_db(field, points))
    chosen = MODELS[name][0]()
    times = [time.process_time()]
    for _ in range(2):
        prepared = chosen.prepare(network, excitations, BANDS)
        times.append(time.process_time())
    first, further, seen = list[float](), list[float](), set[str]()
    for object_id, point in points:
        begun = time.process_time()
        prepared.attenuation(object_id, point[None])
        (further if object_id in seen else first).append(time.process_time() - begun)
        seen.add(object_id)
    once, again = np.diff(times).tolist()
    return Measured(once, again, float(np.median(first)), float(np.median(further)), levels_db(prepared, points))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=str(kitchen_path()))
    given = parser.parse_args()
    found = {}
    for name in ("truth", *MODELS):
        # A new process per model, since models share cached modes within a process.
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as alone:
            found[name] = alone.submit(measure, given.scene, name).result()
    truth = found.pop("truth").levels_db
    is_felt = truth > LEAST_DB
    print(f"{truth.shape[1]} sources, {len(truth)} points, third octaves from 10 to 1000 Hz.\n")
    columns = ("model", "use it for", "prepare [ms]", "again [ms]", "first touch [ms]", "further [ms]")
    print(f"| {' | '.join(columns)} | error, median / p95 / worst [dB] |")
    print("|---|---|---|---|---|---|---|")
    for name, one in found.items():
        off = np.abs(one.levels_db - truth)[is_felt]
        error = f"{np.median(off):.2f} / {np.percentile(off, 95):.2f} / {off.max():.2f}"
        times = (one.prepare_s, one.again_s, one.first_s, one.further_s)
        cells = " | ".join(f"{1e3 * seconds:.3g}" for seconds in times)
        print(f"| {name} | {MODELS[name][1]} | {cells} | {'a style' if 'exponential' in name else error} |")


if __name__ == "__main__":
    main()
