"""Time that a link to an engine adds to a session's update, with 50 bodies on a floor.

    python benchmarks/engine_links.py

Processor time of `link.update` less that of the same `session.update`, median of nine rounds. Needs: pip install
'scene2hap[mujoco,panda3d]'
"""

from __future__ import annotations

import argparse
import itertools
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from scene2hap import HapticSession, PoseTable, Touch, bake
from scene2hap.engines import MuJoCoLink, Panda3DLink
from scene2hap.scene.engines import mujoco as mujoco_scene, panda3d as panda3d_scene

NAMES = [f"{('smartphone', 'wooden_table', 'mug')[i % 3]}_{i}" for i in range(50)]
PLACES_M = [(i % 10 * 0.3, i // 10 * 0.3, 0.0499) for i in range(50)]


def cpu_ms(act: Callable[[], object], n_calls: int = 200) -> float:
    """Processor time of one call [ms], median of nine rounds."""
    rounds = []
    for _ in range(9):
        start = time.process_time()
        for _ in range(n_calls):
            act()
        rounds.append((time.process_time() - start) / n_calls * 1e3)
    return float(np.median(rounds))


def model() -> tuple[Any, Any]:
    """Boxes that rest on a floor, with four contact points each."""
    import mujoco

    bodies = "".join(
        f'<body name="{name}" pos="{x} {y} {z}"><freejoint/><geom type="box" size=".05 .05 .05"/></body>'
        for name, (x, y, z) in zip(NAMES, PLACES_M, strict=True)
    )
    floor = '<geom name="floor" type="box" size="5 5 .05" pos="0 0 -.05"/>'
    made = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{floor}{bodies}</worldbody></mujoco>")
    data = mujoco.MjData(made)
    mujoco.mj_forward(made, data)
    return made, data


def graph() -> Any:
    """Panda3D scene with a card at the place of each box."""
    from panda3d import core

    render = core.NodePath("render")
    for name, place in zip(NAMES, PLACES_M, strict=True):
        card = core.CardMaker(name)
        card.set_frame(-0.05, 0.05, -0.05, 0.05)
        path = render.attach_new_node(card.generate())
        path.set_p(-90)
        path.set_pos(*place)
    return render


def moving_ms(data: Any, session: HapticSession, link: MuJoCoLink, n_moving: int) -> float:
    """Time [ms] that the link adds to a frame, compared with an update by poses that are already available."""
    start = np.array(PLACES_M[:n_moving])
    ready = []
    for way_m in (0.0, 0.0002):
        places = start + np.array([way_m, 0, 0])
        ready.append((places, PoseTable(NAMES[:n_moving], places, [(0, 0, 0, 1)] * n_moving)))
    frames = itertools.cycle(ready)

    def by_hand() -> None:
        data.xpos[1 : 1 + n_moving], table = next(frames)
        session.update(table)

    def by_link() -> None:
        data.xpos[1 : 1 + n_moving], _ = next(frames)
        link.update()

    by_link()
    alone = cpu_ms(by_hand, 50)
    return cpu_ms(by_link, 50) - alone


def main() -> None:
    """Measure and print."""
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    made, data = model()
    scene = mujoco_scene.snapshot(made, data)
    session = HapticSession(scene, bake(scene))
    touches = [Touch("left", NAMES[3], PLACES_M[3])]
    print("| link, frame | ms |")
    print("|---|---|")
    link = MuJoCoLink(made, data, session)
    link.update(touches)
    alone = cpu_ms(lambda: session.update({}, touches))
    print(f"| MuJoCo, at rest | {cpu_ms(lambda: link.update(touches)) - alone:.3f} |")
    with_hand = MuJoCoLink(made, data, session, hands={"right": NAMES[3]})
    with_hand.update(touches)
    print(f"| MuJoCo, at rest, a body as a hand | {cpu_ms(lambda: with_hand.update(touches)) - alone:.3f} |")
    with_contacts = MuJoCoLink(made, data, session, contacts="engine")
    contacts = with_contacts._adapter.contacts()
    with_contacts.update(touches)
    given = cpu_ms(lambda: session.update({}, touches, contacts=contacts), 20)
    added = cpu_ms(lambda: with_contacts.update(touches), 20) - given
    print(f"| MuJoCo, its {data.ncon} contact points | {added:.3f} |")
    for n_moving in (10, 50):
        print(f"| MuJoCo, {n_moving} move | {moving_ms(data, session, link, n_moving):.3f} |")

    render = graph()
    scene = panda3d_scene.snapshot(render, name="floor")
    session = HapticSession(scene, bake(scene))
    follower = Panda3DLink(render, session)
    follower.update(touches)
    alone = cpu_ms(lambda: session.update({}, touches))
    print(f"| Panda3D, at rest | {cpu_ms(lambda: follower.update(touches)) - alone:.3f} |")


if __name__ == "__main__":
    main()
