"""Change of levels by the load of a hand, and its cost in time, as tables in Markdown.

python benchmarks/figures.py hand

First table: a phone of 0.2 kg stands on a plate with free edges, and the plate on four rubber feet on a concrete floor.
The hand touches 40 points; third octaves from 40 to 640 Hz, `modal_plate`. The change is that of the level [dB] where
the hand touches. The impedance is that of an infinite plate. Second table: processor times for the built-in kitchen in
the default bands of a session.
"""

from __future__ import annotations

import argparse
import time
import warnings
from dataclasses import replace
from itertools import product

import numpy as np
from model_choice import scene_input
from numpy.typing import NDArray

from scene2hap import Bands, Contact, ContactNetwork, Excitation, ModalPlate, Plate, Pose, materials
from scene2hap.demo import kitchen_path
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.coupled.hand import HANDS

PLATES = {
    "steel, 0.8 mm": (0.5, 0.3, 0.0008, "steel"),
    "steel, 1.5 mm": (0.6, 0.4, 0.0015, "steel"),
    "glass, 4 mm": (0.6, 0.4, 0.004, "glass"),
    "glass, 8 mm": (1.0, 0.6, 0.008, "glass"),
    "plywood, 12 mm": (0.8, 0.4, 0.012, "plywood"),
    "oak, 25 mm": (1.2, 0.7, 0.025, "oak"),
}
N_POINTS, SEED = 40, 5
BANDS = Bands.third_octaves(40, 640)


def on_feet(plate: Plate) -> ContactNetwork:
    standing = replace(plate, feet=materials.lookup("rubber"), object_mass_kg=plate.mass_kg)
    floor = Plate(3.0, 2.0, 0.15, materials.lookup("concrete"))
    corners = product((0.1 * plate.length_m, 0.9 * plate.length_m), (0.1 * plate.width_m, 0.9 * plate.width_m))
    feet = [Contact("floor", "plate", (x, y, 0.0)) for x, y in corners]
    phone = Contact("plate", "phone", (0.4 * plate.length_m, 0.3 * plate.width_m, 0.0))
    return ContactNetwork({"floor": floor, "plate": standing}, [*feet, phone], {"floor": Pose((-1.0, -0.8, 0.0))})


def levels_db(hand: str | None, network: ContactNetwork, points: NDArray[np.float64]) -> NDArray[np.float64]:
    model = ModalPlate(outside_domain="ignore", hand=None if hand is None else HANDS[hand])
    field = model.prepare(network, [Excitation("phone", 170.0, 170.0, 0.2)], BANDS)
    return 20 * np.log10(field.attenuation("plate", points)[:, 0])


def changes() -> None:
    print("| plate | impedance [N s/m] | palm, rms / largest [dB] | fingertip, rms / largest [dB] |")
    print("|---|---|---|---|")
    for name, (length, width, thickness_m, material) in PLATES.items():
        plate = Plate(length, width, thickness_m, materials.lookup(material))
        network = on_feet(plate)
        inside = np.random.default_rng(SEED).uniform(0.02, 0.98, (N_POINTS, 2)) * (length, width)
        points = np.column_stack([inside, np.zeros(N_POINTS)])
        free = levels_db(None, network, points)
        cells = []
        for hand in HANDS:
            change = levels_db(hand, network, points) - free
            cells.append(f"{np.sqrt(np.mean(change**2)):.2f} / {np.abs(change).max():.1f}")
        impedance = 8 * np.sqrt(plate.bending_stiffness_nm * plate.material.density_kg_m3 * plate.thickness_m)
        print(f"| {name} | {impedance:.0f} | {' | '.join(cells)} |", flush=True)


def costs() -> None:
    network, excitations, points = scene_input(str(kitchen_path()))
    print("\n| kitchen | prepare again [s] | first touch of an object, median / largest [ms] | further, median [ms] |")
    print("|---|---|---|---|")
    for hand in (None, "palm"):
        model = ModalPlate(outside_domain="ignore", hand=None if hand is None else HANDS[hand])
        model.prepare(network, excitations, AROUND)  # modes are cached from now on
        begin = time.process_time()
        field = model.prepare(network, excitations, AROUND)
        prepare_s, first, further, seen = time.process_time() - begin, list[float](), list[float](), set[str]()
        for object_id, point in points:
            begin = time.process_time()
            field.attenuation(object_id, point[None])
            (further if object_id in seen else first).append(1e3 * (time.process_time() - begin))
            seen.add(object_id)
        cells = f"{prepare_s:.2f} | {np.median(first):.2f} / {max(first):.1f} | {np.median(further):.2f}"
        print(f"| {hand or 'no hand'} | {cells} |")


def main() -> None:
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    warnings.simplefilter("ignore")
    changes()
    costs()


if __name__ == "__main__":
    main()
