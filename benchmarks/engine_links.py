"""What a link to an engine adds to a session's update, with 50 bodies on a floor.

    python benchmarks/engine_links.py

Processor time of `link.update` less that of the same `session.update`, median of nine rounds. Needs: pip install
'scene2hap[mujoco,panda3d]'
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
from panda3d import core

from scene2hap import HapticSession, Pose, Touch, bake
from scene2hap.engines import MuJoCoLink, Panda3DLink
from scene2hap.scene.engines import mujoco as mujoco_scene
from scene2hap.scene.engines import panda3d as panda3d_scene

NAMES = [f"{('smartphone', 'wooden_table', 'mug')[i % 3]}_{i}" for i in range(50)]
PLACES_M = [(i % 10 * 0.3, i // 10 * 0.3, 0.0499) for i in range(50)]
N_MOVING = 10


def cpu_ms(act: Callable[[], object], n_calls: int = 200) -> float:
    """Median over nine rounds, for one call."""
    rounds = []
    for _ in range(9):
        start = time.process_time()
        for _ in range(n_calls):
            act()
        rounds.append((time.process_time() - start) / n_calls * 1e3)
    return float(np.median(rounds))


def model() -> tuple[Any, Any]:
    """Boxes that rest on a floor, with four contact points each."""
    bodies = "".join(
        f'<body name="{name}" pos="{x} {y} {z}"><freejoint/><geom type="box" size=".05 .05 .05"/></body>'
        for name, (x, y, z) in zip(NAMES, PLACES_M, strict=True)
    )
    floor = '<geom name="floor" type="box" size="5 5 .05" pos="0 0 -.05"/>'
    made = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{floor}{bodies}</worldbody></mujoco>")
    data = mujoco.MjData(made)
    mujoco.mj_forward(made, data)
    return made, data


def graph() -> core.NodePath:
    """Cards where the boxes are."""
    render = core.NodePath("render")
    for name, place in zip(NAMES, PLACES_M, strict=True):
        card = core.CardMaker(name)
        card.set_frame(-0.05, 0.05, -0.05, 0.05)
        path = render.attach_new_node(card.generate())
        path.set_p(-90)
        path.set_pos(*place)
    return render


def main() -> None:
    """Measure and print."""
    made, data = model()
    scene = mujoco_scene.snapshot(made, data)
    session = HapticSession(scene, bake(scene))
    touches = [Touch("left", NAMES[3], PLACES_M[3])]
    link = MuJoCoLink(made, data, session)
    link.update(touches)
    alone = cpu_ms(lambda: session.update({}, touches))
    print(f"MuJoCo, at rest: {cpu_ms(lambda: link.update(touches)) - alone:.3f} ms")
    with_hand = MuJoCoLink(made, data, session, hands={"right": NAMES[3]})
    with_hand.update(touches)
    print(f"MuJoCo, a hand: {cpu_ms(lambda: with_hand.update(touches)) - alone:.3f} ms")
    told = MuJoCoLink(made, data, session, contacts="engine")
    contacts = told._adapter.contacts()
    told.update(touches)
    given = cpu_ms(lambda: session.update({}, touches, contacts=contacts), 20)
    added = cpu_ms(lambda: told.update(touches), 20) - given
    print(f"MuJoCo, contacts of the engine: {added:.2f} ms for {data.ncon} contact points")

    way_m = 0.0

    def shift() -> None:
        nonlocal way_m
        way_m = 0.0002 - way_m
        data.xpos[1 : 1 + N_MOVING, 0] = [x + way_m for x, _, _ in PLACES_M[:N_MOVING]]

    def by_hand() -> None:
        shift()
        session.update({NAMES[k]: Pose(tuple(data.xpos[1 + k].tolist())) for k in range(N_MOVING)}, touches)

    def by_link() -> None:
        shift()
        link.update(touches)

    alone = cpu_ms(by_hand)
    print(f"MuJoCo, {N_MOVING} move: {cpu_ms(by_link) - alone:.3f} ms")

    render = graph()
    scene = panda3d_scene.snapshot(render, name="floor")
    session = HapticSession(scene, bake(scene))
    follower = Panda3DLink(render, session)
    follower.update(touches)
    alone = cpu_ms(lambda: session.update({}, touches))
    print(f"Panda3D, at rest: {cpu_ms(lambda: follower.update(touches)) - alone:.3f} ms")


if __name__ == "__main__":
    main()
