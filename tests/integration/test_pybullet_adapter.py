"""An engine without built-in support: PyBullet, by the adapter of docs/engines.md."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from scene2hap import Box, Contact, EngineLink, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake
from scene2hap.testing import check_engine_adapter

pybullet: Any = pytest.importorskip("pybullet", reason="needs PyBullet: pip install pybullet")

PAGE = (Path(__file__).parents[2] / "docs" / "engines.md").read_text(encoding="utf-8")
SIZES_M = {"wooden table": (1.2, 0.8, 0.72), "smartphone": (0.07, 0.15, 0.01), "finger": (0.02, 0.02, 0.02)}
PLACES_M = {"wooden table": (0.0, 0.0, 0.36), "smartphone": (0.2, 0.0, 0.73), "finger": (0.35, 0.0, 0.78)}
# An upright arm of two links of 0.5 m. The centres of mass of both are off their frames.
ARM = """
<robot name="robot">
  <link name="washing_machine">
    <inertial><origin xyz="0 0.1 0.2"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
    <visual><origin xyz="0 0 0.25"/><geometry><box size="0.1 0.1 0.5"/></geometry></visual>
    <collision><origin xyz="0 0 0.25"/><geometry><box size="0.1 0.1 0.5"/></geometry></collision>
  </link>
  <link name="steel_rod">
    <inertial><origin xyz="0.3 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
    <visual><origin xyz="0 0 0.25"/><geometry><box size="0.1 0.1 0.5"/></geometry></visual>
    <collision><origin xyz="0 0 0.25"/><geometry><box size="0.1 0.1 0.5"/></geometry></collision>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="washing_machine"/><child link="steel_rod"/><origin xyz="0 0 0.5"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="100" velocity="10"/>
  </joint>
</robot>
"""


def adapter(hands: dict[str, int], reports: bool = True) -> Any:
    """Return the page's adapter, with PyBullet's contacts by default."""
    (code,) = re.findall(r"<!-- ci: pybullet -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    names: dict[str, Any] = {}
    exec(code, names)
    return names["Bullet"](hands, reports)


@pytest.fixture
def client() -> Iterator[int]:
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81)
    yield client
    pybullet.disconnect(client)


@pytest.fixture
def bodies(client: int) -> dict[str, int]:
    made = {}
    for name, size_m in SIZES_M.items():
        shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[x / 2 for x in size_m])
        made[name] = pybullet.createMultiBody(0.0 if name == "wooden table" else 0.1, shape, -1, PLACES_M[name])
    return made


@pytest.fixture
def engine(bodies: dict[str, int]) -> Any:
    made = adapter({"left": bodies["finger"]})
    for name, size_m in SIZES_M.items():
        made.add(SceneObject(name, geometry=Box(size_m)), bodies[name])
    return made


def step() -> None:
    for _ in range(24):
        pybullet.stepSimulation()


def scene_of(engine: Any) -> SceneSnapshot:
    return SceneSnapshot.build(engine.objects, up_axis="z")


def test_the_adapter_keeps_the_contract(engine: Any) -> None:
    check_engine_adapter(engine, scene_of(engine), step=step, moves="finger")


def test_the_contract_finds_normals_that_point_the_wrong_way(engine: Any) -> None:
    def reversed_contacts() -> list[Contact]:
        return [Contact(one.b, one.a, one.point_m, one.normal) for one in type(engine).contacts(engine)]

    for _ in range(10):
        step()
    engine.contacts = reversed_contacts
    with pytest.raises(AssertionError, match="swap a and b"):
        check_engine_adapter(engine, scene_of(engine), step=step)


@pytest.mark.parametrize("reports", [True, False])
def test_a_falling_finger_feels_the_phone_through_the_table(engine: Any, reports: bool) -> None:
    engine.reports = reports
    scene = scene_of(engine)
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    felt = [link.update().gain("left", "smartphone")]
    for _ in range(10):
        step()
        felt.append(link.update().gain("left", "smartphone"))
    assert felt[0] == 0.0
    assert felt[-1] > 0.05


def test_an_object_that_bounces_between_two_frames_is_felt(engine: Any, bodies: dict[str, int]) -> None:
    scene = scene_of(engine)
    for name in ("finger", "wooden table"):
        pybullet.changeDynamics(bodies[name], -1, restitution=0.9)
    pybullet.resetBasePositionAndOrientation(bodies["finger"], (-0.3, 0.0, 1.3), (0, 0, 0, 1))
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    n_bounces, met = 0, False
    for _ in range(60):
        for _ in range(8):  # 30 frames a second
            pybullet.stepSimulation()
            link.collect()
            points = pybullet.getContactPoints(bodyA=bodies["finger"])
            n_bounces, met = n_bounces + (not met and bool(points)), bool(points)
        link.update([Touch("right", "wooden table", (0.0, 0.0, 0.72))])
        session.render_s(1 / 30)
    assert n_bounces == 5  # at 2.7, 2.4, 1.9, 1.0 and 0.4 m/s; 30 frames a second show the first three
    assert session.stats.impacts == 3


def test_a_finger_that_drops_onto_the_table_is_felt(engine: Any) -> None:
    scene = scene_of(engine)
    session = HapticSession(scene, bake(scene))
    link = EngineLink(engine, session)
    for _ in range(30):
        for _ in range(4):  # 60 frames a second
            pybullet.stepSimulation()
        link.update()
        session.render_s(1 / 60)
    assert [{impact.object_id, impact.with_object} for impact in session.impacts] == [{"finger", "wooden table"}]


@pytest.mark.parametrize("reports", [True, False])
def test_vibration_passes_along_the_links_of_a_robot(client: int, tmp_path: Path, reports: bool) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(ARM)
    body = pybullet.loadURDF(str(path), (1.0, 0.0, 0.0), useFixedBase=True)
    pybullet.resetJointState(body, 0, 1.0)
    engine = adapter({}, reports)
    engine.add_urdf(str(path), body, "robot/")
    # The frames of the links, and not their centres of mass; 1 rad about y leans the rod towards x.
    turned = Pose.from_euler((1.0, 0.0, 0.5), (0.0, 1.0, 0.0))
    for name, expected in {"robot/washing_machine": Pose((1.0, 0.0, 0.0)), "robot/steel_rod": turned}.items():
        assert engine.poses()[name].position_m == pytest.approx(expected.position_m, abs=1e-6)
        assert engine.poses()[name].rotation_xyzw == pytest.approx(expected.rotation_xyzw, abs=1e-6)
    scene = scene_of(engine)
    link = EngineLink(engine, HapticSession(scene, bake(scene)))
    on_rod = turned.to_world([(0.05, 0.0, 0.4)])[0]
    assert link.update([Touch("left", "robot/steel_rod", on_rod)]).gain("left", "robot/washing_machine") > 0.05
