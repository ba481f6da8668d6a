"""From a scene as users build it to the gains of a hand, against a calculation that shares no code with the models.

A phone on a bar stool on a floor: both plates by Legendre polynomials (Ritz), the mass of the legs at the feet, Hertz's
contacts, the phone as a rigid box with one free vibration, third octaves by 60 frequencies each.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.linalg import eigh

from contact_scenes import boxes
from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake, materials

Floats = NDArray[np.float64]
N = 16


class RitzPlate:
    """A free plate from its corner: Legendre polynomials along both sides, and point masses."""

    def __init__(self, size_m: tuple[float, float, float], material: materials.Material, loss: float) -> None:
        self.length, self.width, h = size_m
        nu, D = material.poisson_ratio, material.youngs_modulus_pa * h**3 / 12 / (1 - material.poisson_ratio**2)
        x, w = legendre.leggauss(2 * N)
        p0, p1, p2 = (self._axis(x, order) for order in range(3))
        a, b, area = 2 / self.length, 2 / self.width, self.length * self.width / 4

        def both(one: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> Floats:
            return np.asarray(np.kron((one[0] * w) @ one[1].T, (other[0] * w) @ other[1].T), dtype=np.float64)

        self.stiffness = D * area * (
            a**4 * both((p2, p2), (p0, p0))
            + b**4 * both((p0, p0), (p2, p2))
            + nu * a**2 * b**2 * (both((p2, p0), (p0, p2)) + both((p0, p2), (p2, p0)))
            + 2 * (1 - nu) * a**2 * b**2 * both((p1, p1), (p1, p1))
        )  # fmt: skip
        self.mass = material.density_kg_m3 * h * area * np.eye(N * N)
        self.loss = loss

    @staticmethod
    def _axis(x: Floats, order: int) -> Floats:
        rows = np.eye(N) * np.sqrt(np.arange(N) + 0.5)
        return np.array([legendre.legval(x, legendre.legder(row, order) if order else row) for row in rows])

    def at(self, points_m: Floats) -> Floats:
        x, y = self._axis(2 * points_m[:, 0] / self.length - 1, 0), self._axis(2 * points_m[:, 1] / self.width - 1, 0)
        shapes: Floats = np.einsum("ik,jk->ijk", x, y).reshape(N * N, -1)
        return shapes

    def receptance(self, points_m: Floats, forces_m: Floats, omega: Floats) -> NDArray[np.complex128]:
        squares, shapes = eigh(self.stiffness, self.mass)
        resonance = np.maximum(squares, 0.0) * (1 + 1j * self.loss) - omega[:, None] ** 2
        moved, pushed = shapes.T @ self.at(points_m), shapes.T @ self.at(forces_m)
        found: NDArray[np.complex128] = np.einsum("mp,fm,mq->fpq", moved, 1 / resonance, pushed, optimize=True)
        return found


def hertz(one: materials.Material, other: materials.Material, force_n: float) -> complex:
    modulus = 1 / sum((1 - m.poisson_ratio**2) / (m.youngs_modulus_pa * (1 + 1j * m.loss_factor)) for m in (one, other))
    loss = max(modulus.imag / modulus.real, 0.05)
    return complex((6 * abs(modulus) ** 2 * 0.005 * force_n) ** (1 / 3) * (1 + 1j * loss))


def test_gains_of_a_phone_on_a_stool_are_those_of_an_independent_calculation() -> None:
    side, floor_m, seat_m = 0.36, (2.0, 1.6), 0.03
    corners = np.array([(x, z) for x in (-0.18, 0.18) for z in (-0.18, 0.18)])
    legs = [((0.03, 0.72, 0.03), (x, 0.36, z)) for x in (-0.165, 0.165) for z in (-0.165, 0.165)]
    stool = boxes("bar stool", ((side, seat_m, side), (0.0, 0.735, 0.0)), *legs)
    scene = SceneSnapshot.build(
        [
            SceneObject("wooden floor", pose=Pose((0, -0.05, 0)), geometry=Box((floor_m[0], 0.1, floor_m[1]))),
            SceneObject("bar stool", geometry=stool.geometry),
            SceneObject("smartphone", pose=Pose((0, 0.754, 0)), geometry=Box((0.07, 0.008, 0.15))),
        ]
    )
    bundle = bake(scene).override("smartphone", mass_kg=0.19).override("bar stool", mass_kg=6.0)
    config = {"propagation": "modal_plate", "prepare": "blocking", "bands": "third-octaves", "gain_limit_db": None}
    session = HapticSession(scene, bundle, config)
    touched = np.array([(0.0, 0.1), (0.1, 0.0), (-0.17, -0.17)])
    found = [session.update(touches=[Touch("left", "bar stool", (x, 0.75, z))]).gains[0, 0] for x, z in touched]

    wood, glass, felt = (materials.lookup(name) for name in ("wood", "glass", "felt"))
    seat = RitzPlate((side, side, seat_m), wood, 0.04)
    feet, tips = corners + side / 2, np.array([(x, z) for x in (-0.035, 0.035) for z in (-0.075, 0.075)])
    rest_kg = 6.0 - side * side * seat_m * wood.density_kg_m3
    seat.mass = seat.mass + rest_kg / 4 * seat.at(feet) @ seat.at(feet).T
    floor = RitzPlate((*floor_m, 0.1), wood, max(wood.loss_factor, 0.01))
    edges = np.geomspace(10.0, 1000.0, 21)
    f = np.concatenate([a + (b - a) * (np.arange(60) + 0.5) / 60 for a, b in pairwise(edges)])
    omega = 2 * np.pi * f
    pushed = np.concatenate([tips + side / 2, feet])
    signs = np.repeat([1.0, -1.0], 4)
    system = seat.receptance(pushed, pushed, omega) * np.outer(signs, signs)
    turning = [0.19 / 12 * (edge**2 + 0.008**2) for edge in (0.07, 0.15)]
    phone = 1 / 0.19 + sum(np.outer(tips[:, k], tips[:, k]) / turning[k] for k in range(2))
    system[:, :4, :4] -= phone / omega[:, None, None] ** 2
    on_floor = corners + np.array(floor_m) / 2
    system[:, 4:, 4:] += floor.receptance(on_floor, on_floor, omega)
    springs = np.repeat([hertz(glass, wood, 0.19 * 9.80665 / 4), hertz(felt, wood, 6.0 * 9.80665 / 4)], 4)
    forces = np.linalg.solve(system + np.diag(1 / springs), np.repeat([1.0, 0.0], 4)[None, :, None])[:, :, 0]
    moved = np.einsum("fpq,fq->fp", seat.receptance(touched + side / 2, pushed, omega), signs * forces)
    expected = np.sqrt(np.square(np.abs(moved)).reshape(20, 60, 3).mean(axis=1)).T
    errors = np.abs(20 * np.log10(np.array(found) / expected))
    assert np.median(errors) < 0.05
    assert errors.max() < 0.5
