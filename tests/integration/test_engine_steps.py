"""Links to engines that take several steps of physics in a frame: contacts and touches of all steps count."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap import HapticSession
from scene2hap.engines import MuJoCoLink
from with_tones import with_tones

BOUNCES = """
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="refrigerator" pos="0 0 0.85"><geom type="box" size="0.3 0.3 0.85"/></body>
    <body name="ball" pos="0 0 2.2"><freejoint/><geom size="0.04" mass="0.2" solref="-50000 -10" priority="1"/></body>
  </worldbody>
</mujoco>
"""


def bounced(*, collects: bool, hands: dict[str, str] | None) -> tuple[int, int, int]:
    """Bounces of a ball in the engine, impacts that the session found, and frames in which the left hand touches."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    model = mujoco.MjModel.from_xml_string(BOUNCES)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = snapshot(model, data, unit_m=1.0)
    session = HapticSession(scene, with_tones(scene))
    link = MuJoCoLink(model, data, session, contacts="engine", hands=hands)
    n_bounces, n_touched, met = 0, 0, False
    for _ in range(60):
        for _ in range(33):
            mujoco.mj_step(model, data)
            n_bounces += data.ncon > 0 and not met
            met = data.ncon > 0
            if collects:
                link.collect()
        n_touched += link.update().gain("left", "refrigerator") > 0
        session.render_s(0.033)
    return n_bounces, session.stats.impacts, n_touched


def test_contacts_of_all_steps_of_a_frame_count_if_they_are_collected() -> None:
    """At 30 frames per second most bounces begin and end between two frames."""
    n_bounces, n_found, _ = bounced(collects=True, hands=None)
    assert n_bounces == n_found == 4
    assert bounced(collects=False, hands=None)[1] < 3


def test_hand_that_taps_between_two_frames_touches_if_steps_are_collected() -> None:
    n_bounces, _, n_touched = bounced(collects=True, hands={"left": "ball"})
    assert n_touched >= n_bounces
    assert bounced(collects=False, hands={"left": "ball"})[2] < n_bounces


def test_last_step_of_a_frame_counts_without_being_collected() -> None:
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    model = mujoco.MjModel.from_xml_string(BOUNCES)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = snapshot(model, data, unit_m=1.0)
    link = MuJoCoLink(model, data, HapticSession(scene, with_tones(scene)), hands={"left": "ball"})
    link.collect()  # in the air
    data.qpos[2] = 1.739
    mujoco.mj_forward(model, data)
    assert link.update().gain("left", "refrigerator") > 0


def test_contact_points_of_steps_are_those_of_the_last_step_of_each_pair() -> None:
    from scene2hap.scene.engines.mujoco_contacts import ContactPoints, points_of_steps

    def step(*rows: tuple[int, int, float]) -> ContactPoints:
        table = np.array(rows).reshape(-1, 3)
        return ContactPoints(table[:, :2].astype(np.intp), table[:, [2, 2, 2]], table[:, [2, 2, 2]])

    geoms, points, normals = points_of_steps([step((0, 1, 1.0), (0, 2, 2.0)), step((0, 2, 3.0), (0, 2, 4.0)), step()])
    assert geoms.tolist() == [[0, 1], [0, 2], [0, 2]]
    assert points[:, 0].tolist() == normals[:, 0].tolist() == [1.0, 3.0, 4.0]
