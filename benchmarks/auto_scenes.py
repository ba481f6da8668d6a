"""AutoFidelity compared with ModalPlate in whole scenes: cost and error, at edges and corners too, in Markdown.

python benchmarks/auto_scenes.py SCENE [SCENE ...] [--tolerance 1.0] [--seed 4]

Each scene is baked offline and prepared by both models with empty caches. Bands are third octaves from 10 to 1000 Hz,
and the default bands around dominant frequencies. Each plate that a source reaches is touched at five points: two
anywhere, two on an edge, one at a corner. The error of a touch is that of its worst band and source; both gains are at
least -40 dB re the source. For errors both models solve rectangles. Times are processor times.

In a session `AutoFidelity` follows outlines, and `ModalPlate` solves the rectangle of length and width. The second
table has the preparation time of each in this case, also for eight round tables, the worst case.
"""

from __future__ import annotations

import argparse
import time
import warnings
from collections import Counter
from typing import Any

import numpy as np
from auto_fidelity import forget
from model_choice import scene_input
from numpy.typing import NDArray

from scene2hap import (
    AutoFidelity,
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ModalPlate,
    Outline,
    Plate,
    Pose,
    materials,
)
from scene2hap.propagation.auto import AutoField
from scene2hap.propagation.auto_rungs import FLOOR_DB
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.modal.in_plane import in_plane_modes

BANDS = {"third octaves": Bands.third_octaves(10, 1000), "around": AROUND}


def touches(network: ContactNetwork, object_id: str, plate: Plate, rng: np.random.Generator) -> NDArray[np.float64]:
    """Two points anywhere, two on edges and a corner (5, 3) [m]."""
    parts = rng.random((5, 2))
    parts[2:, 0] = parts[2:, 0].round()
    parts[4] = parts[4].round()
    own = np.column_stack([parts * (plate.length_m, plate.width_m), np.zeros(5)])
    return network.poses[object_id].to_world(own)


def prepared(model: Any, network: ContactNetwork, excitations: Any, bands: Bands) -> tuple[Any, float]:
    """Prepare a field with empty caches. Returns the field and the processor time [s]."""
    forget()
    in_plane_modes.cache_clear()
    begin = time.process_time()
    field = model.prepare(network, excitations, bands)
    return field, time.process_time() - begin


def round_tables(*, follows_outlines: bool) -> tuple[ContactNetwork, tuple[Excitation, ...]]:
    """Eight round tables of about 0.9 m on a floor, each of a different size, with a phone on each."""
    turn = np.linspace(0.0, 2 * np.pi, 64, endpoint=False)
    disc, oak = 0.5 + 0.5 * np.column_stack([np.cos(turn), np.sin(turn)]), materials.lookup("oak")
    bodies, poses, contacts = {"floor": Plate(8.0, 4.0, 0.15, materials.lookup("concrete"))}, {"floor": Pose()}, []
    for k in range(8):
        x, y = 0.3 + 1.9 * (k % 4), 0.4 + 1.9 * (k // 4)
        side_m = 0.87 + 0.01 * k
        round_top = Plate.of_outline(Outline(((side_m * disc).tolist(),)), 0.025, oak)
        bodies[f"table_{k}"] = round_top if follows_outlines else Plate(side_m, side_m, 0.025, oak)
        poses[f"table_{k}"] = Pose((x, y, 0.0))
        feet = [(x + a, y + b, 0.0) for a in (0.2, 0.7) for b in (0.2, 0.7)]
        contacts += [Contact("floor", f"table_{k}", at) for at in feet]
        contacts.append(Contact(f"table_{k}", f"phone_{k}", (x + 0.5, y + 0.4, 0.0)))
    sources = [Excitation(f"phone_{k}", 175.0, 175.0, 0.2) for k in range(8)]
    return ContactNetwork(bodies, contacts, poses), tuple(sources)


def in_sessions(paths: list[str]) -> None:
    """Print the second table."""
    print("\n| scene | bands | outlines | `modal_plate`, rectangles [s] | `auto`, outlines [s] | ratio |")
    print("|---|---|---|---|---|---|")
    scenes = {
        path.replace("\\", "/").rsplit("/", 1)[-1]: [scene_input(path, follows_outlines=x)[:2] for x in (False, True)]
        for path in paths
    }
    scenes["eight round tables"] = [round_tables(follows_outlines=x) for x in (False, True)]
    for name, ((rectangles, excitations), (outlines, _)) in scenes.items():
        n_outlines = sum(isinstance(x, Plate) and x.outline is not None for x in outlines.bodies.values())
        for kind, bands in BANDS.items():
            _, modal_s = prepared(ModalPlate(outside_domain="ignore"), rectangles, excitations, bands)
            _, auto_s = prepared(AutoFidelity(outside_domain="ignore"), outlines, excitations, bands)
            print(
                f"| {name} | {kind} | {n_outlines} | {modal_s:.2f} | {auto_s:.2f} | {modal_s / auto_s:.1f} |",
                flush=True,
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--tolerance", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=4)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print("| scene | bands | modal [s] | auto [s] | ratio | touches | within tolerance | worst [dB] | rungs |")
    print("|---|---|---|---|---|---|---|---|---|")
    every, ratios = [], []
    for path in given.scenes:
        network, excitations, _ = scene_input(path)
        for name, bands in BANDS.items():
            rng = np.random.default_rng(given.seed)
            modal, modal_s = prepared(ModalPlate(outside_domain="ignore"), network, excitations, bands)
            auto, auto_s = prepared(AutoFidelity(given.tolerance, outside_domain="ignore"), network, excitations, bands)
            assert isinstance(auto, AutoField)
            errors, worst = [], (0.0, "")
            for object_id in auto.choices:
                body = network.bodies.get(object_id)
                if isinstance(body, Plate):
                    points = touches(network, object_id, body, rng)
                    one, other = (
                        np.maximum(20 * np.log10(np.maximum(field.attenuation(object_id, points), 1e-9)), FLOOR_DB)
                        for field in (auto, modal)
                    )
                    errors.append(np.abs(one - other).max(axis=(1, 2)))
                    worst = max(worst, (float(errors[-1].max()), object_id))
            found = np.concatenate(errors)
            every.append(found)
            ratios.append(modal_s / auto_s)
            rungs = ", ".join(f"{n} {rung}" for rung, n in Counter(one.rung for one in auto.choices.values()).items())
            scene = path.replace("\\", "/").rsplit("/", 1)[-1]
            kept = f"{len(found)} | {100 * np.mean(found <= given.tolerance):.1f} % | {worst[0]:.2f} on {worst[1]}"
            print(
                f"| {scene} | {name} | {modal_s:.2f} | {auto_s:.2f} | {ratios[-1]:.1f} | {kept} | {rungs} |", flush=True
            )
    all_of_them = np.concatenate(every)
    print(
        f"\n{len(all_of_them)} touches: {100 * np.mean(all_of_them <= given.tolerance):.2f} % within "
        f"{given.tolerance:g} dB, worst {all_of_them.max():.2f}; median ratio of cost {np.median(ratios):.1f}."
    )
    in_sessions(given.scenes)


if __name__ == "__main__":
    main()
