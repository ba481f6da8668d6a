"""Dependence of levels on uncertain moduli, by the width of the band, as a table in Markdown.

python benchmarks/bands.py [--draws 30] [--seed 5]

Each scene is a plate of 1.2 x 0.7 m on four legs, with a tray on the plate and a source on one of the two. Material,
thickness, place and frequency are random. Young's modulus of each part is drawn within 30 % of the material table. The
table gives the spread of the level at points on the plate: rms about each point's mean, and 99th percentile. The band
lies around the source's dominant frequency. Resonant models use half an octave by default.
"""

from __future__ import annotations

import argparse
import warnings
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from scene2hap import Bands, Contact, ContactNetwork, Excitation, ModalPlate, Plate, Pose, PropagationModel, materials
from scene2hap.propagation.bands.sampling import AROUND, Sampling
from scene2hap.propagation.domain import ThinPlateWarning

MATERIALS = ("oak", "plywood", "steel", "glass", "particle board", "granite")
MODULUS = 0.3
N_SCENES, N_POINTS = 30, 12


def scene(rng: np.random.Generator) -> tuple[ContactNetwork, Excitation, NDArray[np.float64]]:
    """A plate on legs with a tray and a source, and points on the plate."""
    name = str(rng.choice(MATERIALS))
    thickness_m = rng.uniform(0.002, 0.008) if name in ("steel", "glass") else rng.uniform(0.012, 0.03)
    top = Plate(1.2, 0.7, float(thickness_m), materials.lookup(name), object_mass_kg=None)
    tray = Plate(0.45, 0.3, 0.004, materials.lookup("plywood"))
    corners = [(x, y) for x in (0.1, 0.35) for y in (0.05, 0.25)]
    at = rng.uniform([0.05, 0.05], [0.7, 0.4])
    poses = {"top": Pose(), "tray": Pose((float(at[0]), float(at[1]), 0.0)), "floor": Pose((-2.0, -2.0, -0.7))}
    contacts = [Contact("tray", "top", (float(at[0] + x), float(at[1] + y), 0.0)) for x, y in corners]
    contacts += [Contact("floor", "top", (x, y, 0.0)) for x in (0.05, 1.15) for y in (0.05, 0.65)]
    on, (low, high) = ("tray", (0.05, 0.25)) if rng.random() < 0.5 else ("top", (0.1, 0.6))
    dx, dy = rng.uniform(low, high, 2) + (at if on == "tray" else 0.0)
    contacts.append(Contact(on, "source", (float(dx), float(dy), 0.0)))
    floor = Plate(6.0, 5.0, 0.15, materials.lookup("concrete"))
    frequency_hz = float(np.exp(rng.uniform(np.log(40.0), np.log(400.0))))
    source = Excitation("source", frequency_hz, frequency_hz, float(rng.uniform(0.1, 3.0)))
    points = np.column_stack([rng.uniform([0.0, 0.0], [1.2, 0.7], (N_POINTS, 2)), np.zeros(N_POINTS)])
    return ContactNetwork({"top": top, "tray": tray, "floor": floor}, contacts, poses), source, points


def with_moduli(network: ContactNetwork, rng: np.random.Generator) -> ContactNetwork:
    """The same network with each modulus changed by up to `MODULUS`."""
    bodies = {}
    for key, body in network.bodies.items():
        assert isinstance(body, Plate)
        modulus_pa = body.material.youngs_modulus_pa * rng.uniform(1 - MODULUS, 1 + MODULUS)
        bodies[key] = replace(body, material=replace(body.material, youngs_modulus_pa=float(modulus_pa)))
    return replace(network, bodies=bodies)


def spread_db(model: PropagationModel, bands: Bands, n_draws: int, seed: int) -> NDArray[np.float64]:
    """Levels (n_scenes, n_draws, n_points) [dB] about their means over the draws."""
    found = []
    for number in range(N_SCENES):
        rng = np.random.default_rng([seed, number])
        network, source, points = scene(rng)
        gains = [
            model.prepare(with_moduli(network, rng), [source], bands).attenuation("top", points)[:, 0, 0]
            for _ in range(n_draws)
        ]
        levels = 20 * np.log10(np.array(gains))
        found.append(levels - levels.mean(axis=0))
    return np.array(found)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=30)
    parser.add_argument("--seed", type=int, default=5)
    given = parser.parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    print(f"{N_SCENES} scenes, {given.draws} draws of moduli each, {N_POINTS} points\n")
    print("| width [octaves] | rms [dB] | 99th percentile [dB] | scenes above 4 dB rms | frequencies to solve |")
    print("|---|---|---|---|---|")
    for octaves in (0.0, 1 / 3, AROUND.octaves, 2 / 3, 1.0):
        bands = Bands.dominant(octaves)
        spread = spread_db(ModalPlate(), bands, given.draws, given.seed)
        each = np.sqrt(np.mean(spread**2, axis=(1, 2)))
        n = len(Sampling.of(bands, [Excitation("source", 100.0, 100.0)], ModalPlate().loss_floor).frequencies_hz)
        print(
            f"| {octaves:.2g} | {np.sqrt(np.mean(spread**2)):.1f} | {np.percentile(np.abs(spread), 99):.1f} "
            f"| {np.sum(each > 4)} | {n} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
