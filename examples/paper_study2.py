"""Study 2 of the Scene2Hap paper: level of a source on the surface on which it stands.

python examples/paper_study2.py -o study2      (needs scene2hap[plots])

Three scenes, as in the study: a speaker that plays music on a metal table, a smartphone that buzzes on a wooden table,
a washing machine on a wooden floor. A hand touches the source (0 m), and the surface 0.4, 0.8 and 1.2 m from it, under
three conditions: none (only the source vibrates), full (the surface vibrates as the source does) and attenuated (by the
paper's law). The folder gets one WAV for each scene and condition, `levels.csv` with the level at each point by every
propagation model, and `levels.png`, the level over distance.

The paper does not state the sizes and the duration of a touch, so they are assumed. Distances are assumed to be
measured along the surface from a corner on which the source stands. Sounds are synthesized, and materials are those of
the built-in table. The resonant models start at the level of the paper's law 0.1 m from the source
(`reference="felt_near"`), so that the figure compares how vibration spreads; `--reference source` gives the levels that
the models compute themselves. Levels are those that a session plays: at most 0 dB, also at a resonance.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from scene2hap import (
    Box,
    HapticBundle,
    HapticSession,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    TriMesh,
    WavSink,
    bake,
)
from scene2hap.common.plots import new_figure

DISTANCES_M = (0.0, 0.4, 0.8, 1.2)
CONDITIONS = {"none": "no_propagation", "full": "full_propagation", "attenuated": "exponential_plate"}
MODELS = {
    "exponential_plate": ("#0072B2", "-", 1.5, "paper's law"),
    "mass_spring_damper": ("#E9B5D3", "-", 6.0, "mass-spring-damper"),
    "modal_plate": ("#D55E00", "-", 1.5, "modal plate"),
    "auto": ("#000000", ":", 2.0, "auto"),
}
"""Colour, line, width [points] and label of each model; the lines of the resonant models almost coincide."""
TOUCHED_S = 1.5
SAMPLE_RATE_HZ = 8000
"""Sample rate of the WAVs; vibration ends at 1 kHz."""
HAND = "hand"


@dataclass(frozen=True)
class Trial:
    """A scene of the study: its objects, and the corner on which the source stands [m].

    Vibration enters the surface at the corner, and distances run from it along x.
    """

    name: str
    source: str
    surface: str
    objects: tuple[SceneObject, ...]
    corner_m: tuple[float, float, float]

    @property
    def scene(self) -> SceneSnapshot:
        """The objects as a scene."""
        return SceneSnapshot.build(self.objects, name=self.name)

    def touch(self, distance_m: float) -> Touch:
        """Touch at a distance from the corner; on the source itself at 0 m."""
        x, y, z = self.corner_m
        if distance_m == 0.0:
            top = next(item for item in self.objects if item.id == self.source)
            return Touch(HAND, self.source, (top.pose.position_m[0], float(top.bounds_m[1, 1]), 0.0))
        return Touch(HAND, self.surface, (x + distance_m, y, z))


def boxes(parts: Iterable[tuple[Sequence[float], Sequence[float]]]) -> TriMesh:
    """One mesh of several boxes, each by its edges and the middle of its lower side [m]."""
    vertices, faces, n = [], [], 0
    for (x, y, z), at in parts:
        mesh = Box((x, y, z)).mesh
        vertices.append(mesh.vertices_m + np.array(at) + (0.0, y / 2, 0.0))
        faces.append(mesh.faces + n)
        n += len(mesh.vertices_m)
    return TriMesh(np.concatenate(vertices), np.concatenate(faces))


def table(name: str, thickness_m: float) -> SceneObject:
    """A table of 1.8 × 0.8 m, its top 0.75 m high, on four legs at its corners."""
    height = 0.75 - thickness_m
    legs = [((0.05, height, 0.05), (x, 0.0, z)) for x in (-0.85, 0.85) for z in (-0.35, 0.35)]
    return SceneObject(name, geometry=boxes([*legs, ((1.8, thickness_m, 0.8), (0.0, height, 0.0))]))


def standing(name: str, size_m: tuple[float, float, float], x_m: float, on_m: float) -> SceneObject:
    """A box whose left side is at `x_m`, on something of the height `on_m`."""
    return SceneObject(name, pose=Pose((x_m + size_m[0] / 2, on_m + size_m[1] / 2, 0.0)), geometry=Box(size_m))


def floor(name: str, thickness_m: float) -> SceneObject:
    """A floor of 4 × 3 m whose upper side is at 0 m."""
    return SceneObject(name, pose=Pose((0.0, -thickness_m / 2, 0.0)), geometry=Box((4.0, thickness_m, 3.0)))


def trials() -> tuple[Trial, ...]:
    """The three scenes."""
    speaker = standing("loudspeaker", (0.18, 0.28, 0.2), -0.6, 0.75)
    phone = standing("smartphone", (0.15, 0.008, 0.07), -0.6, 0.75)
    washer = standing("washing machine", (0.6, 0.85, 0.6), -1.2, 0.0)
    ground = floor("concrete floor", 0.15)
    return (
        Trial("speaker on a metal table", "loudspeaker", "steel table",
              (ground, table("steel table", 0.02), speaker), (-0.42, 0.75, 0.1)),
        Trial("smartphone on a wooden table", "smartphone", "wooden table",
              (ground, table("wooden table", 0.03), phone), (-0.45, 0.75, 0.035)),
        Trial("washing machine on a wooden floor", "washing machine", "wooden floor",
              (floor("wooden floor", 0.04), washer), (-0.6, 0.0, 0.3)),
    )  # fmt: skip


def levels_db(
    trial: Trial, bundle: HapticBundle, model: str, reference: str, distances_m: Sequence[float]
) -> list[float]:
    """Level at the hand at each distance [dB re the source], minus infinity if no vibration arrives."""
    # Control conditions are not scaled to the paper's law: full propagation is 0 dB everywhere.
    reference = reference if model in MODELS else "source"
    config = {"propagation": model, "reference": reference, "prepare": "blocking"}
    session = HapticSession(bundle.snapshot, bundle, config, hands=[HAND])
    gains = (session.update(touches=[trial.touch(at)]).gain(HAND, trial.source) for at in distances_m)
    return [20 * math.log10(gain) if gain > 0 else -math.inf for gain in gains]


def write_wav(trial: Trial, bundle: HapticBundle, model: str, path: Path) -> None:
    """Write the vibration of a hand that touches one point after the other, `TOUCHED_S` each."""
    sink = WavSink(path)
    config = {"propagation": model, "prepare": "blocking", "sample_rate_hz": SAMPLE_RATE_HZ}
    with HapticSession(bundle.snapshot, bundle, config, hands=[HAND], sink=sink) as session:
        for distance_m in DISTANCES_M:
            session.update(touches=[trial.touch(distance_m)])
            sink.pull_s(TOUCHED_S)


def figure_of(studied: Sequence[tuple[Trial, HapticBundle]], reference: str) -> Figure:
    """Level over distance: a panel for each scene, a line for each model, dots at the points of the study."""
    figure = new_figure(11.0, 4.2)
    panels = figure.subplots(1, len(studied), sharey=True)
    along = np.linspace(0.02, 1.25, 42).tolist()
    for axes, (trial, bundle) in zip(panels, studied, strict=True):
        (loop, *_) = bundle.loops[trial.source].values()
        for model, (colour, line, width, label) in MODELS.items():
            levels = levels_db(trial, bundle, model, reference, along)
            axes.plot(along, levels, line, color=colour, linewidth=width, label=label)
            at_points = levels_db(trial, bundle, model, reference, DISTANCES_M)
            axes.plot(DISTANCES_M, at_points, "o", color=colour, markersize=4)
        axes.axhline(0.0, color="0.5", linewidth=1.0, linestyle="-.", label="full propagation")
        axes.plot([0.0], [0.0], "s", color="0.3", markersize=7, fillstyle="none", label="no propagation: source alone")
        axes.set_title(f"{trial.name}\nfelt at {loop.frequency_tactile_hz:.0f} Hz", fontsize=9)
        axes.set(xlabel="distance from the source [m]", xlim=(-0.05, 1.27), ylim=(-80.0, 6.0))
        axes.grid(visible=True, alpha=0.3)
    panels[0].set_ylabel("level at the hand [dB re the source]")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=6, fontsize=8)
    return figure


def rows_of(studied: Sequence[tuple[Trial, HapticBundle]], reference: str) -> list[tuple[str, str, str, float, float]]:
    """Scene, material of the surface, model, distance [m] and level [dB re the source] for each point and model."""
    rows = []
    for trial, bundle in studied:
        material = bundle.objects[trial.surface].material
        for model in (*MODELS, "no_propagation", "full_propagation"):
            levels = levels_db(trial, bundle, model, reference, DISTANCES_M)
            made_of = material.name if material is not None else "unknown"
            rows += [(trial.name, made_of, model, at, db) for at, db in zip(DISTANCES_M, levels, strict=True)]
    return rows


def main(argv: Sequence[str] | None = None) -> None:
    """Bake the scenes, and write WAVs, table and figure."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, required=True, help="the folder to write")
    parser.add_argument("--reference", choices=("felt_near", "source"), default="felt_near")
    given = parser.parse_args(argv)
    given.output.mkdir(parents=True, exist_ok=True)
    studied = [(trial, bake(trial.scene)) for trial in trials()]
    for trial, bundle in studied:
        for condition, model in CONDITIONS.items():
            name = f"{trial.name} {condition}".replace(" ", "_")
            write_wav(trial, bundle, model, given.output / f"{name}.wav")
    with (given.output / "levels.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "surface", "model", "distance_m", "level_db"])
        writer.writerows([*row[:3], f"{row[3]:g}", f"{row[4]:.2f}"] for row in rows_of(studied, given.reference))
    figure_of(studied, given.reference).savefig(given.output / "levels.png", dpi=150)
    print(f"{given.output}: {len(studied) * len(CONDITIONS)} WAVs, levels.csv, levels.png")


if __name__ == "__main__":
    main()
