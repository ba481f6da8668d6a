"""Coupling of substructures, against one assembled matrix of all masses and springs."""

from __future__ import annotations

import math
from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.propagation.coupled.coupling import Joint, couple

FREQUENCIES_HZ = np.geomspace(10.0, 1000.0, 25)
LOSS = 0.02


class Lump:
    """A body of point masses joined by springs, and to the ground if `held`; point (i, 0) is mass i."""

    loss_factor = LOSS

    def __init__(self, rng: np.random.Generator, n: int = 5, held: bool = False) -> None:
        self.mass = np.diag(rng.uniform(0.05, 2.0, n))
        self.stiffness = np.zeros((n, n))
        for i, j in combinations(range(n), 2):
            k = 10 ** rng.uniform(3.0, 7.0)
            self.stiffness[np.ix_([i, j], [i, j])] += k * np.array([[1, -1], [-1, 1]])
        if held:
            self.stiffness[0, 0] += 1e5

    def dynamic(self, f: float) -> NDArray[np.complex128]:
        return self.stiffness * (1 + 1j * LOSS) - (2 * np.pi * f) ** 2 * self.mass

    def receptance(self, points_m, forces_m, frequencies_hz):
        at, by = points_m[:, 0].astype(int), forces_m[:, 0].astype(int)
        return np.array([np.linalg.inv(self.dynamic(f))[np.ix_(at, by)] for f in frequencies_hz])


class Weight:
    """A rigid mass without extent."""

    loss_factor = math.inf
    stiffness = np.zeros((1, 1))

    def __init__(self, mass_kg: float) -> None:
        self.mass = np.array([[mass_kg]])

    def dynamic(self, f: float) -> NDArray[np.complex128]:
        return (-((2 * np.pi * f) ** 2) * self.mass).astype(np.complex128)

    def receptance(self, points_m, forces_m, frequencies_hz):
        shape = (1, len(points_m), len(forces_m))
        return np.ones(shape) / self.dynamic(1.0)[0, 0] / (frequencies_hz**2)[:, None, None]


def assembled(bodies, joints, source_id, f):
    """Deflection of every mass of every body, for a force that would move the free source by 1."""
    offset, total = {}, 0
    for name, body in bodies.items():
        offset[name] = total
        total += len(body.mass)
    whole = np.zeros((total, total), dtype=np.complex128)
    for name, body in bodies.items():
        at = slice(offset[name], offset[name] + len(body.mass))
        whole[at, at] += body.dynamic(f)
    for joint in joints:
        ends = [offset[joint.a] + int(joint.point_a_m[0]), offset[joint.b] + int(joint.point_b_m[0])]
        k = joint.stiffness_n_m * (1 + 1j * joint.loss_factor) + 2j * np.pi * f * joint.damping_n_s_m
        whole[np.ix_(ends, ends)] += k * np.array([[1, -1], [-1, 1]])
    force = np.zeros(total, dtype=np.complex128)
    force[offset[source_id]] = bodies[source_id].dynamic(f)[0, 0]
    moved = np.linalg.solve(whole, force)
    return {name: moved[offset[name] : offset[name] + len(body.mass)] for name, body in bodies.items()}


def joint(a: str, b: str, i: int, j: int, rng: np.random.Generator) -> Joint:
    return Joint(a, b, (i, 0), (j, 0), 10 ** rng.uniform(3.5, 7), 0.05, rng.uniform(0, 20))


def pair(rng: np.random.Generator) -> SimpleNamespace:
    bodies = {"s": Weight(0.2), "a": Lump(rng), "b": Lump(rng, held=True)}
    return SimpleNamespace(bodies=bodies, joints=[joint("s", "a", 0, 1, rng), joint("a", "b", 3, 2, rng)])


def chain(rng: np.random.Generator) -> SimpleNamespace:
    bodies = {"s": Weight(0.2)} | {f"p{i}": Lump(rng) for i in range(6)}
    links = [joint("s", "p0", 0, 0, rng)] + [joint(f"p{i}", f"p{i + 1}", 4, 0, rng) for i in range(5)]
    return SimpleNamespace(bodies=bodies, joints=links)


def loop(rng: np.random.Generator) -> SimpleNamespace:
    bodies = {"s": Weight(0.2), "t": Weight(3.0)} | {f"p{i}": Lump(rng) for i in range(4)}
    ring = [joint(f"p{i}", f"p{(i + 1) % 4}", 4, 0, rng) for i in range(4)]
    cross = [joint("p0", "p2", 2, 2, rng), joint("t", "p2", 0, 3, rng), joint("p3", "t", 1, 0, rng)]
    return SimpleNamespace(bodies=bodies, joints=[joint("s", "p0", 0, 1, rng), *ring, *cross])


def three_contacts(rng: np.random.Generator) -> SimpleNamespace:
    bodies = {"s": Weight(0.2), "a": Lump(rng), "b": Lump(rng)}
    feet = [joint("s", "a", 0, i, rng) for i in (0, 2, 4)]
    return SimpleNamespace(bodies=bodies, joints=[*feet, *(joint("b", "a", i, i + 1, rng) for i in range(3))])


@pytest.mark.parametrize("build", [pair, chain, loop, three_contacts])
@pytest.mark.parametrize("seed", range(4))
def test_equal_to_one_assembled_system(build, seed: int) -> None:
    made = build(np.random.default_rng(seed))
    sources = [name for name, body in made.bodies.items() if isinstance(body, Weight)]
    solved = couple(made.bodies, made.joints, sources, FREQUENCIES_HZ)
    for column, source_id in enumerate(sources):
        whole = [assembled(made.bodies, made.joints, source_id, f) for f in FREQUENCIES_HZ]
        for name, body in made.bodies.items():
            points = np.array([[i, 0.0] for i in range(len(body.mass))])
            found = solved.deflection(name, points)[:, :, column]
            expected = np.array([moved[name] for moved in whole])
            # Relative to the largest motion on that body, since a point may be at rest.
            scale = np.abs(expected).max(axis=1, keepdims=True)
            assert (np.abs(found - expected) <= 1e-9 * scale).all()


@pytest.mark.parametrize("build", [pair, chain, loop, three_contacts])
def test_solution_does_not_depend_on_the_order_of_bodies_and_joints(build) -> None:
    made = build(np.random.default_rng(1))
    plain = couple(made.bodies, made.joints, ["s"], FREQUENCIES_HZ)
    turned = [
        Joint(j.b, j.a, j.point_b_m, j.point_a_m, j.stiffness_n_m, j.loss_factor, j.damping_n_s_m)
        for j in reversed(made.joints)
    ]
    other = couple(dict(reversed(made.bodies.items())), turned, ["s"], FREQUENCIES_HZ)
    points = np.array([[0.0, 0.0]])
    for name in made.bodies:
        np.testing.assert_allclose(other.deflection(name, points), plain.deflection(name, points), rtol=1e-8)


def test_one_contact_follows_the_mobility_formula() -> None:
    rng = np.random.default_rng(5)
    receiver, link = Lump(rng), joint("s", "r", 0, 2, rng)
    omega = 2 * np.pi * FREQUENCIES_HZ
    y = 1j * omega[:, None, None] * receiver.receptance(np.array([[2, 0], [4, 0]]), np.array([[2, 0]]), FREQUENCIES_HZ)
    y_s = 1 / (1j * omega * 0.2)
    y_c = 1j * omega / (link.stiffness_n_m * (1 + 0.05j) + 1j * omega * link.damping_n_s_m)
    expected = y[:, 1, 0] / (y_s + y[:, 0, 0] + y_c)
    solved = couple({"s": Weight(0.2), "r": receiver}, [link], ["s"], FREQUENCIES_HZ)
    np.testing.assert_allclose(solved.deflection("r", np.array([[4.0, 0.0]]))[:, 0, 0], expected, rtol=1e-10)


def scaled(made: SimpleNamespace, stiffness_n_m: float) -> list[Joint]:
    return [Joint(j.a, j.b, j.point_a_m, j.point_b_m, stiffness_n_m, 0.05) for j in made.joints]


@pytest.mark.parametrize("build", [pair, chain, loop, three_contacts])
def test_soft_joints_decouple_and_stiff_ones_are_rigid(build) -> None:
    made = build(np.random.default_rng(2))
    points = np.array([[0.0, 0.0], [0.0, 0.0]])

    def motion(stiffness_n_m: float, name: str) -> NDArray[np.complex128]:
        solved = couple(made.bodies, scaled(made, stiffness_n_m), ["s"], FREQUENCIES_HZ)
        return solved.deflection(name, points)[:, 0, 0]

    for name in made.bodies:
        free = 1.0 if name == "s" else 0.0
        assert np.abs(motion(1e-6, name) - free).max() < 1e-6
        assert np.abs(motion(0.0, name) - free).max() < 1e-100
        rigid = motion(math.inf, name)
        assert np.abs(motion(1e18, name) - rigid).max() <= 1e-6 * np.abs(rigid).max()
    # A rigid joint has one deflection on both of its sides.
    solved = couple(made.bodies, scaled(made, math.inf), ["s"], FREQUENCIES_HZ)
    for link in made.joints:
        sides = [solved.deflection(x, np.array([at])) for x, at in ((link.a, link.point_a_m), (link.b, link.point_b_m))]
        assert np.abs(sides[0] - sides[1]).max() <= 1e-6 * np.abs(sides[0]).max()


def test_statically_indeterminate_rigid_feet_give_the_right_motion() -> None:
    """Four rigid joints between 1 kg and 3 kg: the forces are indeterminate, but the motion is not."""
    joints = [Joint("s", "r", (i, 0), (i, 0)) for i in range(4)]
    solved = couple({"s": Weight(1.0), "r": Weight(3.0)}, joints, ["s"], FREQUENCIES_HZ)
    np.testing.assert_allclose(solved.deflection("r", np.array([[0.0, 0.0]])), 0.25, rtol=1e-6)


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.sampled_from([pair, chain, loop, three_contacts]))
def test_reciprocal_and_passive(seed: int, build) -> None:
    """The coupled receptance between masses attached anywhere is symmetric and creates no energy at any frequency."""
    rng = np.random.default_rng(seed)
    made = build(rng)
    probes = {f"probe{i}": Weight(10 ** rng.uniform(-2, 1)) for i in range(3)}
    names = [name for name, body in made.bodies.items() if isinstance(body, Lump)]
    links = [joint(x, str(rng.choice(names)), 0, int(rng.integers(5)), rng) for x in probes]
    solved = couple(made.bodies | probes, [*made.joints, *links], list(probes), FREQUENCIES_HZ)
    at = np.array([[0.0, 0.0]])
    free = np.array([[body.dynamic(f)[0, 0] for body in probes.values()] for f in FREQUENCIES_HZ])
    y = np.concatenate([solved.deflection(x, at) for x in probes], axis=1) / free[:, None, :]
    largest = np.abs(y).max(axis=(1, 2), keepdims=True)
    assert (np.abs(y - y.transpose(0, 2, 1)) <= 1e-9 * largest).all()
    # Power into the system is -omega/2 Im(F^H u), so that the receptance's imaginary part is never positive.
    lossy = (y - y.conj().transpose(0, 2, 1)) / 2j
    assert (np.linalg.eigvalsh(lossy).max(axis=1) <= 1e-9 * largest[:, 0, 0]).all()


def test_joints_with_missing_ends_are_refused() -> None:
    bodies = {"s": Weight(1.0), "r": Weight(1.0)}
    for a, b in (("s", "ghost"), ("s", "s")):
        with pytest.raises(ModelDomainError, match="it must join two of the bodies 'r', 's'"):
            couple(bodies, [Joint(a, b, (0, 0), (0, 0))], ["s"], FREQUENCIES_HZ)
    with pytest.raises(ModelDomainError, match="stiffness_n_m is -1"):
        Joint("s", "r", (0, 0), (0, 0), -1.0)
    assert Joint("s", "r", (0, 0), (0, 0), 0).stiffness_n_m == 0  # not only as a float
