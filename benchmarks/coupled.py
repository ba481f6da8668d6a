"""Coupled objects compared with finite elements of all objects in one system, as a table in Markdown.

python benchmarks/figures.py coupled      (needs scikit-fem)

Cases: two plates coupled at 3 or 4 points, a tray on its feet, a small stiff plate near a corner, a table on legs that
are masses between springs, a board that stands upright on its edge, and all together, with a source of 0.1-2 kg.
Reference: plates in bending by Argyris triangles (tests/support/plate_fe.py), the upright board in plane stress by
quadratic triangles, rigid bodies as masses, and all joints as springs with loss, solved directly at every frequency.
The stiffness of contacts is input; tests of `contact_stiffness` compare it with Hertz. Errors are those of levels [dB]
at 12 points.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, csc_matrix, csr_matrix, hstack
from scipy.sparse.linalg import splu

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from plate_fe import finite_elements
from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    Material,
    ModalPlate,
    Plate,
    Pose,
    RigidBody,
    materials,
)
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import Joint
from scene2hap.propagation.coupled.joints import joints_of
from scene2hap.propagation.domain import ThinPlateWarning

FREQUENCIES_HZ = np.geomspace(40.0, 800.0, 60)
LOSS, N_POINTS, SEED = 0.02, 12, 3
GRID_M = 0.05
UP = (0.0, 0.0, 1.0)
UPRIGHT = (0.5**0.5, 0.0, 0.0, 0.5**0.5)
"""A quarter turn about x: a plate's width points up, and its normal along -y."""
Triple = tuple[float, float, float]


@dataclass
class Case:
    """Objects, contacts (pairs and world points), a source, the touched object, and the law of contact stiffness."""

    bodies: dict[str, Plate | RigidBody]
    touching: list[tuple[str, str, Triple]]
    source: Excitation
    felt_on: str
    poses: dict[str, Pose] = field(default_factory=dict)
    upright: tuple[str, ...] = ()
    law: ContactLaw = field(default_factory=ContactLaw)

    def network(self) -> ContactNetwork:
        contacts = [Contact(a, b, at, normal=UP) for a, b, at in self.touching]
        return ContactNetwork(self.bodies, contacts, self.poses)


def known(name: str) -> Material:
    return replace(materials.lookup(name), loss_factor=LOSS)


def plate(length_m: float, width_m: float, thickness_m: float, name: str, feet: str | None = None) -> Plate:
    return Plate(length_m, width_m, thickness_m, known(name), feet=known(feet) if feet else None)


def table(name: str, thickness_m: float) -> Plate:
    return plate(1.2, 0.7, thickness_m, name)


def cases() -> dict[str, Case]:
    """The cases by name; contacts lie on nodes of the meshes."""
    small = {"oak": 0.02, "steel": 0.002, "glass": 0.006, "plywood": 0.012}
    found: dict[str, Case] = {}
    for n_points in (3, 4):
        for below, above in (("oak", "steel"), ("plywood", "glass"), ("steel", "oak")):
            corners = [(0.3, 0.2, 0.0), (0.7, 0.2, 0.0), (0.3, 0.5, 0.0), (0.7, 0.5, 0.0)][:n_points]
            found[f"{above} on {below}, {n_points} points"] = Case(
                {"lower": table(below, small[below]), "upper": plate(0.5, 0.4, small[above], above)},
                [*(("lower", "upper", at) for at in corners), ("upper", "source", (0.45, 0.35, 0.0))],
                Excitation("source", 100.0, 100.0, 0.3),
                "lower",
                {"lower": Pose(), "upper": Pose((0.25, 0.15, 0.0))},
            )
    for feet in ("rubber", "felt"):
        tray = plate(0.5, 0.4, 0.002, "steel", feet)  # its mass lets it rest on its feet
        found[f"steel tray on {feet} feet"] = Case(
            {"lower": table("oak", 0.02), "tray": replace(tray, object_mass_kg=tray.mass_kg)},
            [
                *(("lower", "tray", at) for at in [(0.3, 0.2, 0.0), (0.7, 0.2, 0.0), (0.3, 0.5, 0.0), (0.7, 0.5, 0.0)]),
                ("tray", "source", (0.5, 0.35, 0.0)),
            ],
            Excitation("source", 100.0, 100.0, 0.3),
            "lower",
            {"lower": Pose(), "tray": Pose((0.25, 0.15, 0.0))},
        )
    for name, thickness_m in (("glass", 0.012), ("plywood", 0.018)):
        # The first mode of the plate lies above 2 kHz, but the plate yields about as much as its contacts.
        found[f"small {name} plate near a corner"] = Case(
            {"lower": table("oak", 0.034), "upper": plate(0.15, 0.1, thickness_m, name)},
            [
                *(("lower", "upper", at) for at in [(0.1, 0.1, 0.0), (0.15, 0.0, 0.0), (0.15, 0.1, 0.0)]),
                ("upper", "source", (0.1, 0.0, 0.0)),
            ],
            Excitation("source", 100.0, 100.0, 0.5),
            "upper",
            {"lower": Pose(), "upper": Pose()},
        )
    legs = [(0.05, 0.05, 0.0), (1.15, 0.05, 0.0), (0.05, 0.65, 0.0), (1.15, 0.65, 0.0)]
    for name in ("oak", "glass"):
        found[f"{name} table on legs of 0.8 kg"] = Case(
            {
                "top": table(name, small[name]),
                "floor": plate(1.8, 1.4, 0.022, "plywood"),
                **{f"leg_{k}": RigidBody(0.8, material=known("oak")) for k in range(4)},
            },
            [
                *(("top", f"leg_{k}", at) for k, at in enumerate(legs)),
                *((f"leg_{k}", "floor", at) for k, at in enumerate(legs)),
                ("top", "source", (0.4, 0.3, 0.0)),
            ],
            Excitation("source", 100.0, 100.0, 0.2),
            "floor",
            {"top": Pose(), "floor": Pose((-0.3, -0.35, 0.0))},
        )
    for name in ("oak", "glass"):
        # The board stands on its lower edge, along x, at y = 0.3 m.
        found[f"{name} board upright on its edge"] = Case(
            {"lower": table("oak", 0.02), "board": plate(0.6, 0.4, small[name], name)},
            [
                *(("lower", "board", at) for at in [(0.3, 0.3, 0.0), (0.6, 0.3, 0.0), (0.9, 0.3, 0.0)]),
                ("lower", "source", (0.5, 0.5, 0.0)),
            ],
            Excitation("source", 100.0, 100.0, 0.3),
            "lower",
            {"lower": Pose(), "board": Pose((0.3, 0.3, 0.0), UPRIGHT)},
            ("board",),
        )
        found[f"felt on the {name} board"] = replace(found[f"{name} board upright on its edge"], felt_on="board")
    return found


class Part:
    """One object's degrees of freedom: dynamic stiffness at a frequency, and rows that read its motion along z."""

    def __init__(self, body: Plate | RigidBody, pose: Pose, *, is_upright: bool, mass_kg: float | None = None) -> None:
        self._pose, self._is_upright = pose, is_upright
        self._size_m = (body.length_m, body.width_m) if isinstance(body, Plate) else (0.0, 0.0)
        if isinstance(body, Plate) and not is_upright:
            # Three cells per wavelength at the top frequency, so that the reference is exact to 0.1 dB for thin plates.
            finer = math.ceil(3 * GRID_M / (2 * math.pi / float(body.wavenumber_rad_m(FREQUENCIES_HZ[-1]))))
            cells = finer * round(body.length_m / GRID_M), finer * round(body.width_m / GRID_M)
            self._basis, stiffness, mass, _ = finite_elements(body, cells)
            D = body.bending_stiffness_nm * complex(1, body.material.loss_factor)
            m = body.material.density_kg_m3 * body.thickness_m
            self.dynamic: Callable[[float], csc_matrix] = lambda omega: D * stiffness - m * omega**2 * mass
            self.n = stiffness.shape[0]
        elif isinstance(body, Plate):
            self._basis, stiffness, mass = plane_stress(body)
            loss = complex(1, body.material.loss_factor)
            self.dynamic = lambda omega: loss * stiffness - omega**2 * mass
            self.n = stiffness.shape[0]
        else:
            own_kg = body.mass_kg if mass_kg is None else mass_kg
            self._basis, self.n = None, 1
            self.dynamic = lambda omega: csc_matrix([[-(omega**2) * own_kg + 0j]])

    def rows(self, points_m: NDArray[np.float64], axis: int = 2) -> csr_matrix:
        """Rows that give the motion along a world axis at world points (n, 3)."""
        if self._basis is None:
            return csr_matrix(np.ones((len(points_m), 1)))
        own = self._pose.to_own(points_m)[:, :2].clip(0.0, self._size_m).T
        if not self._is_upright:
            return csr_matrix(self._basis.probes(own))
        # skfem returns a vector field as the first component of all points, then the second.
        both = csr_matrix(self._basis.probes(own))
        component = {0: 0, 2: 1}[axis]
        return both[component * len(points_m) : (component + 1) * len(points_m)]


def plane_stress(body: Plate) -> tuple[Any, csc_matrix, csc_matrix]:
    """Basis, stiffness and mass of a plate in its own plane, in quadratic triangles."""
    import skfem
    from skfem.helpers import ddot, dot, eye, sym_grad, trace

    nu, E = body.material.poisson_ratio, body.material.youngs_modulus_pa
    mesh = skfem.MeshTri.init_tensor(
        np.linspace(0, body.length_m, 2 * round(body.length_m / GRID_M) + 1),
        np.linspace(0, body.width_m, 2 * round(body.width_m / GRID_M) + 1),
    )
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP2()))
    scale = E * body.thickness_m / (1 - nu**2)

    def stiffness(u: Any, v: Any, _: Any) -> Any:
        strain = sym_grad(u)
        return scale * ddot((1 - nu) * strain + nu * eye(trace(strain), 2), sym_grad(v))

    def mass(u: Any, v: Any, _: Any) -> Any:
        return body.material.density_kg_m3 * body.thickness_m * dot(u, v)

    return (
        basis,
        skfem.BilinearForm(stiffness).assemble(basis).tocsc(),
        skfem.BilinearForm(mass).assemble(basis).tocsc(),
    )


def truth(case: Case, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Levels (n_frequencies, n_points) re the source's free motion [-]."""
    source = case.source.source_id
    parts = {
        key: Part(body, case.poses.get(key, Pose()), is_upright=key in case.upright)
        for key, body in case.bodies.items()
    }
    parts[source] = Part(RigidBody(case.source.mass_kg), Pose(), is_upright=False)
    starts = dict(zip(parts, np.cumsum([0, *(part.n for part in parts.values())]).tolist(), strict=False))
    n = sum(part.n for part in parts.values())

    def spread(key: str, rows: csr_matrix) -> csr_matrix:
        left, right = starts[key], n - starts[key] - parts[key].n
        return csr_matrix(hstack([csr_matrix((rows.shape[0], left)), rows, csr_matrix((rows.shape[0], right))]))

    network = case.network()
    springs = csc_matrix((n, n), dtype=np.complex128)
    source_kg = {source: case.source.mass_kg}
    for joint in joints_of(network, network.bodies.keys() | {source}, case.law, source_kg):
        at = next(p for p in matching(case, joint.a, joint.b) if is_at(network, joint, p))
        one, other = (spread(key, parts[key].rows(np.array([at]))) for key in (joint.a, joint.b))
        pull = one - other
        springs = springs + joint.stiffness_n_m * complex(1, joint.loss_factor) * (pull.T @ pull)
    axes = (0, 2) if case.felt_on in case.upright else (2,)
    reads = [spread(case.felt_on, parts[case.felt_on].rows(points_m, axis)) for axis in axes]
    found = []
    for omega in 2 * np.pi * FREQUENCIES_HZ:
        system = csc_matrix(block_diag([part.dynamic(omega) for part in parts.values()]) + springs)
        push = np.zeros(n, dtype=np.complex128)
        push[starts[source]] = -(omega**2) * case.source.mass_kg
        moved = splu(system).solve(push)
        found.append(np.sqrt(sum(np.abs(read @ moved) ** 2 for read in reads)))
    return np.array(found)


def matching(case: Case, a: str, b: str) -> list[Triple]:
    """Where two objects may touch: their own contacts, then those of others, by which a layer may be pressed."""
    return [at for x, y, at in sorted(case.touching, key=lambda one: {one[0], one[1]} != {a, b})]


def is_at(network: ContactNetwork, joint: Joint, at: Triple) -> bool:
    """Whether a joint is where two objects touch at a world point."""
    here = [network.on_body(key, [at])[0] for key in (joint.a, joint.b)]
    return bool(np.allclose(here[0], joint.point_a_m, atol=1e-9) and np.allclose(here[1], joint.point_b_m, atol=1e-9))


def points_on(case: Case) -> NDArray[np.float64]:
    body = case.bodies[case.felt_on]
    assert isinstance(body, Plate)
    own = np.random.default_rng(SEED).uniform(0.05, 0.95, (N_POINTS, 2)) * (body.length_m, body.width_m)
    return case.poses[case.felt_on].to_world(np.column_stack([own, np.zeros(N_POINTS)]))


def found_by(model: ModalPlate, case: Case, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    network, levels = case.network(), []
    for f in FREQUENCIES_HZ:
        source = replace(case.source, frequency_tactile_hz=float(f))
        field_ = model.prepare(network, [source], Bands.dominant())
        levels.append(field_.attenuation(case.felt_on, points_m)[:, 0, 0])
    return np.array(levels)


def main() -> None:
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    warnings.simplefilter("ignore", ThinPlateWarning)
    print("| case | median [dB] | 95th percentile [dB] | worst [dB] | finite elements [s] | `modal_plate` [s] |")
    print("|---|---|---|---|---|---|")
    every = []
    for name, case in cases().items():
        points_m = points_on(case)
        begin = time.process_time()
        real = truth(case, points_m)
        between = time.process_time()
        own = found_by(ModalPlate(loss_floor=0.0), case, points_m)
        end = time.process_time()
        errors = np.abs(20 * np.log10(own / real))
        every.append(errors)
        cells = f"{np.median(errors):.3f} | {np.percentile(errors, 95):.2f} | {errors.max():.2f}"
        print(f"| {name} | {cells} | {between - begin:.1f} | {end - between:.1f} |", flush=True)
    errors = np.concatenate([one.ravel() for one in every])
    print(f"| all | {np.median(errors):.3f} | {np.percentile(errors, 95):.2f} | {errors.max():.2f} | | |")


if __name__ == "__main__":
    main()
