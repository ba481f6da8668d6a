"""An engine without built-in support: PyBullet, through an adapter as in docs/engines.md."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from scene2hap import Box, Contact, EngineLink, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake
from scene2hap.testing import check_engine_adapter

pybullet: Any = pytest.importorskip("pybullet", reason="needs PyBullet: pip install pybullet")

SIZES_M = {"wooden table": (1.2, 0.8, 0.72), "smartphone": (0.07, 0.15, 0.01), "finger": (0.02, 0.02, 0.02)}
PLACES_M = {"wooden table": (0.0, 0.0, 0.36), "smartphone": (0.2, 0.0, 0.73), "finger": (0.35, 0.0, 0.78)}


class PyBullet:
    """An adapter: bodies are named by the ids of the scene, and the body `finger` is the left hand."""

    def __init__(self, client: int) -> None:
        self.client, self.bodies = client, {}
        for name, (x, y, z) in SIZES_M.items():
            shape = pybullet.createCollisionShape(
                pybullet.GEOM_BOX, halfExtents=[x / 2, y / 2, z / 2], physicsClientId=client
            )
            mass_kg = 0.0 if name == "wooden table" else 0.1
            self.bodies[name] = pybullet.createMultiBody(mass_kg, shape, -1, PLACES_M[name], physicsClientId=client)
        self.names = {body: name for name, body in self.bodies.items()}

    def poses(self) -> dict[str, Pose]:
        # PyBullet's quaternions have the order of scene2hap: x, y, z, w.
        return {
            name: Pose(*pybullet.getBasePositionAndOrientation(body, physicsClientId=self.client))
            for name, body in self.bodies.items()
        }

    def touches(self) -> list[Touch]:
        points = pybullet.getContactPoints(bodyA=self.bodies["finger"], physicsClientId=self.client)
        return [Touch("left", self.names[point[2]], point[6]) for point in points]

    def contacts(self) -> list[Contact]:
        # PyBullet's normals point from its second body to its first one.
        points = pybullet.getContactPoints(physicsClientId=self.client)
        return [Contact(self.names[point[2]], self.names[point[1]], point[6], point[7]) for point in points]

    def step(self) -> None:
        for _ in range(24):
            pybullet.stepSimulation(physicsClientId=self.client)


@pytest.fixture
def engine() -> Iterator[PyBullet]:
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81, physicsClientId=client)
    yield PyBullet(client)
    pybullet.disconnect(client)


def scene_of(engine: PyBullet) -> SceneSnapshot:
    poses = engine.poses()
    objects = [SceneObject(name, pose=poses[name], geometry=Box(size)) for name, size in SIZES_M.items()]
    return SceneSnapshot("desk", "z", tuple(objects))


def test_the_adapter_keeps_the_contract(engine: PyBullet) -> None:
    check_engine_adapter(engine, scene_of(engine), step=engine.step, moves="finger")


def test_the_contract_finds_normals_that_point_the_wrong_way(engine: PyBullet) -> None:
    def reversed_contacts() -> list[Contact]:
        return [Contact(one.b, one.a, one.point_m, one.normal) for one in PyBullet.contacts(engine)]

    for _ in range(10):
        engine.step()
    engine.contacts = reversed_contacts
    with pytest.raises(AssertionError, match="swap a and b"):
        check_engine_adapter(engine, scene_of(engine), step=engine.step)


def test_a_falling_finger_feels_the_phone_through_the_table(engine: PyBullet) -> None:
    scene = scene_of(engine)
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    felt = [link.update().gain("left", "smartphone")]
    for _ in range(10):
        engine.step()
        felt.append(link.update().gain("left", "smartphone"))
    assert felt[0] == 0.0
    assert felt[-1] > 0.05


def test_an_object_that_bounces_between_two_frames_is_felt(engine: PyBullet) -> None:
    scene = scene_of(engine)
    for name in ("finger", "wooden table"):
        pybullet.changeDynamics(engine.bodies[name], -1, restitution=0.9, physicsClientId=engine.client)
    pybullet.resetBasePositionAndOrientation(
        engine.bodies["finger"], (-0.3, 0.0, 1.3), (0, 0, 0, 1), physicsClientId=engine.client
    )
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    n_bounces, met = 0, False
    for _ in range(60):
        for _ in range(8):  # 30 frames a second
            pybullet.stepSimulation(physicsClientId=engine.client)
            link.collect()
            points = pybullet.getContactPoints(bodyA=engine.bodies["finger"], physicsClientId=engine.client)
            n_bounces, met = n_bounces + (not met and bool(points)), bool(points)
        link.update([Touch("right", "wooden table", (0.0, 0.0, 0.72))])
        session.render_s(1 / 30)
    assert n_bounces == 5  # at 2.7, 2.4, 1.9, 1.0 and 0.4 m/s; 30 frames a second show the first three
    assert session.stats.impacts == 3


def test_a_finger_that_drops_onto_the_table_is_felt(engine: PyBullet) -> None:
    scene = scene_of(engine)
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    for _ in range(30):
        for _ in range(4):  # 60 frames a second
            pybullet.stepSimulation(physicsClientId=engine.client)
        link.update()
        session.render_s(1 / 60)
    assert [{impact.object_id, impact.with_object} for impact in session.impacts] == [{"finger", "wooden table"}]
