"""MuJoCo joints as hinges."""

from typing import Any

import numpy as np
import pytest

from scene2hap import ContactGraph, HapticSession, MuJoCoLink, Touch, bake
from scene2hap.scene.engines import mujoco as engine, mujoco_contacts

mujoco: Any = pytest.importorskip("mujoco", reason="install the extra mujoco")

# An arm: an upright post; a forearm that turns about the post's head, whose joint is given 0.4 m off along the axis; a
# hand in a ball joint at the forearm's end; two fingers that slide in the hand; a badge welded to the hand.
ARM = """
<mujoco model="arm">
  <option gravity="0 0 0"/>
  <worldbody>
    <body name="post" pos="1 0 0">
      <geom type="box" size="0.05 0.05 0.5" pos="0 0 0.5" density="1000"/>
      <body name="forearm" pos="0 0 1">
        <joint name="elbow" type="hinge" axis="0 1 0" pos="0 0.4 0"/>
        <geom type="box" size="0.3 0.04 0.04" pos="0.25 0.06 0" density="1000"/>
        <body name="sleeve" pos="0.55 0 0">
          <body name="hand" pos="0 0.06 0">
            <joint name="wrist" type="ball"/>
            <geom type="box" size="0.05 0.05 0.02" pos="0.05 0 0" density="1000"/>
            <body name="finger" pos="0.12 0 0">
              <joint name="grip" type="slide" axis="0 1 0"/>
              <geom type="box" size="0.03 0.01 0.01"/>
            </body>
            <body name="badge" pos="0.05 0 0.025"><geom type="box" size="0.01 0.01 0.004"/></body>
          </body>
        </body>
      </body>
    </body>
    <body name="pendulum" pos="0 3 0">
      <joint type="hinge" axis="0 1 0" pos="0 0 2"/>
      <geom type="sphere" size="0.1"/>
      <body name="far" pos="0 0 -1">
        <joint type="hinge" axis="1 0 0" pos="0 0 0.4"/>
        <geom type="sphere" size="0.1"/>
      </body>
    </body>
  </worldbody>
  <contact><exclude body1="post" body2="forearm"/></contact>
</mujoco>
"""


def arm(elbow: float = 0.0, wrist: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(ARM)
    data = mujoco.MjData(model)
    data.joint("elbow").qpos, data.joint("wrist").qpos = elbow, wrist
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize("elbow", [0.0, 0.7])
def test_hinges_and_balls_hold_at_their_pivots(elbow: float) -> None:
    scene = engine.snapshot(*arm(elbow))
    held = {item.id: item.hinge for item in scene.objects if item.hinge is not None}
    # Slides are found from geometry, the world holds nothing, and the pivot of `far` is 0.5 m from the sphere above.
    assert {x: hinge.to for x, hinge in held.items()} == {"forearm": "post", "hand": "forearm", "badge": "hand"}
    # Along the axis, both extend from 0.02 to 0.05 m: the post from -0.05 to 0.05, the forearm from 0.02 to 0.1.
    assert held["forearm"].point_m == pytest.approx((0.0, 0.035, 0.0), abs=1e-9)
    assert held["forearm"].other_point_m == pytest.approx((0.0, 0.035, 1.0), abs=1e-9)
    assert held["hand"].point_m == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert held["hand"].other_point_m == pytest.approx((0.55, 0.06, 0.0), abs=1e-9)
    # The badge is 1 mm above the hand: from 0.021 to 0.029 m, the hand up to 0.02 m. Fixed to the world, it has none.
    assert held["badge"].other_point_m == pytest.approx((0.05, 0.0, 0.0205), abs=1e-9)
    assert held["badge"].point_m == pytest.approx((0.0, 0.0, -0.0045), abs=1e-9)


CABINET = """
<mujoco>
  <worldbody>
    <body name="wooden cabinet" pos="0 0 0.5">
      <geom type="box" size="0.3 0.01 0.5" pos="0 0.29 0"/>
      <geom type="box" size="0.01 0.3 0.5" pos="0.29 0 0"/>
      <geom type="box" size="0.01 0.3 0.5" pos="-0.29 0 0"/>
      <geom type="box" size="0.3 0.3 0.01" pos="0 0 0.49"/>
      <body name="wooden door" pos="-0.31 -0.315 0">
        <joint name="hinge" type="hinge" axis="0 0 1"/>
        <geom type="box" size="0.3 0.01 0.5" pos="0.3 0 0" mass="3"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize("contacts", [None, "engine"])
def test_the_slam_of_a_door_is_found(contacts: Any) -> None:
    """MuJoCo lets a body collide with the one before it if that is fixed to the world."""
    model = mujoco.MjModel.from_xml_string(CABINET)
    data = mujoco.MjData(model)
    data.joint("hinge").qpos = -0.8
    mujoco.mj_forward(model, data)
    scene = engine.snapshot(model, data, contacts=contacts)
    with HapticSession(scene, bake(scene), sink="memory") as session:
        link = MuJoCoLink(model, data, session, contacts=contacts)
        for _ in range(40):
            if data.joint("hinge").qpos[0] < -0.06:
                data.joint("hinge").qvel = 2.5
            for _ in range(8):
                mujoco.mj_step(model, data)
                link.collect()
            link.update([Touch("left", "wooden cabinet", (0.3, 0.0, 0.6))])
        assert session.stats.impacts == 1


def test_bodies_that_are_welded_to_the_world_have_no_hinge() -> None:
    text = """
    <mujoco><worldbody>
      <body name="stove"><geom type="box" size="0.3 0.3 0.4"/>
        <body name="kettle" pos="0 0 0.5"><geom type="box" size="0.1 0.1 0.1"/></body>
      </body>
    </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert [item.hinge for item in engine.snapshot(model, data).objects] == [None, None]


def test_links_stay_in_contact_however_they_turn() -> None:
    model, data = arm()
    graph = ContactGraph(engine.snapshot(model, data))
    for elbow in np.linspace(0.0, 1.2, 7):
        data.joint("elbow").qpos, data.joint("wrist").qpos = elbow, (np.cos(elbow), 0.0, 0.0, np.sin(elbow))
        mujoco.mj_forward(model, data)
        table = engine.poses(model, data)
        graph.update(dict(table.items()))
        (contact,) = [one for one in graph.contacts if {one.a, one.b} == {"post", "forearm"}]
        assert contact.point_m == pytest.approx((1.0, 0.035, 1.0), abs=1e-9)
        (contact,) = [one for one in graph.contacts if {one.a, one.b} == {"hand", "forearm"}]
        end = (1.0 + 0.55 * np.cos(elbow), 0.06, 1.0 - 0.55 * np.sin(elbow))
        assert contact.point_m == pytest.approx(end, abs=1e-9)


def test_links_touch_at_their_pivots_also_with_the_contacts_of_the_engine() -> None:
    model, data = arm(0.5)
    scene = engine.snapshot(model, data, contacts="engine")
    assert scene.contacts == ()
    graph = ContactGraph(scene)
    data.joint("elbow").qpos = 1.0
    # A compiled copy, of which no snapshot was made: the session may be of a bundle that was baked earlier.
    again = mujoco.MjModel.from_xml_string(ARM)
    again_data = mujoco.MjData(again)
    again_data.qpos[:] = data.qpos
    mujoco.mj_forward(again, again_data)
    poses = dict(engine.poses(again, again_data).items())
    graph.update(poses, contacts=mujoco_contacts.contacts(again, again_data))
    points = {(one.a, one.b): one.point_m for one in graph.contacts}
    assert points.keys() == {("forearm", "post"), ("forearm", "hand"), ("badge", "hand")}
    assert points["forearm", "post"] == pytest.approx((1.0, 0.035, 1.0), abs=1e-9)
    end = (1.0 + 0.55 * np.cos(1.0), 0.06, 1.0 - 0.55 * np.sin(1.0))
    assert points["forearm", "hand"] == pytest.approx(end, abs=1e-9)


def test_another_unit_scales_the_pivots() -> None:
    hinge = engine.snapshot(*arm(), unit_m=0.1).object("hand").hinge
    assert hinge is not None
    assert hinge.other_point_m == pytest.approx((0.055, 0.006, 0.0), abs=1e-9)
