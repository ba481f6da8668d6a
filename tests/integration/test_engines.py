"""Links to engines: three lines each, one contract for every adapter, and the page's own engine."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticSession, MemorySink, Pose, SceneSnapshot, Touch, bake
from scene2hap.engines import EngineAdapter, EngineLink, MuJoCoLink, Panda3DLink
from scene2hap.errors import ConfigError, SceneError, UnknownObject
from scene2hap.testing import check_engine_adapter

PAGE = (Path(__file__).parents[2] / "docs" / "engines.md").read_text(encoding="utf-8")
MODEL = """
<mujoco>
  <worldbody>
    <geom name="wooden_floor" type="box" size="2 2 0.05" pos="0 0 -0.05"/>
    <body name="wooden_table" pos="0 0 0.36"><geom type="box" size="0.6 0.4 0.36"/></body>
    <body name="smartphone" pos="0.2 0 0.73"><freejoint/><geom type="box" size="0.04 0.08 0.005" mass="0.2"/></body>
    <body name="finger" pos="0.35 0 0.77"><freejoint/><geom type="sphere" size="0.01" mass="0.05"/></body>
  </worldbody>
</mujoco>
"""

Engine = tuple[EngineAdapter, SceneSnapshot, Callable[[], object], str]


@pytest.fixture
def mujoco_engine() -> tuple[Any, Any, SceneSnapshot, Callable[[], object]]:
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    model = mujoco.MjModel.from_xml_string(MODEL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data, snapshot(model, data), lambda: mujoco.mj_step(model, data, nstep=100)


def panda3d_engine() -> tuple[Any, SceneSnapshot]:
    core = pytest.importorskip("panda3d.core", reason="needs the extra panda3d")
    from panda3d.core import CardMaker, NodePath

    del core
    from scene2hap.scene.engines.panda3d import snapshot

    render = NodePath("render")
    for name, size, height in (("wooden table", 1.0, 0.7), ("smartphone", 0.1, 0.701)):
        card = CardMaker(name)
        card.set_frame(-size / 2, size / 2, -size / 2, size / 2)
        path = render.attach_new_node(card.generate())
        path.set_p(-90)
        path.set_z(height)
    return render, snapshot(render, name="study")


def own_engine() -> dict[str, Any]:
    """The engine of the page, as it stands there."""
    (code,) = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    names: dict[str, Any] = {}
    exec(code, names)
    return names


def test_a_mujoco_scene_is_felt_in_three_lines(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    sink = MemorySink()
    with HapticSession(scene, bake(scene), sink=sink) as session:
        link = MuJoCoLink(model, data, session, hands={"left": "finger"})
        felt = [link.update().gain("left", "smartphone")]
        for _ in range(20):
            step()
            felt.append(link.update().gain("left", "smartphone"))
            sink.pull_s(0.02)
    # The finger falls onto the table and feels the phone through it.
    assert felt[0] == 0.0
    assert felt[-1] > 0.05
    assert np.abs(sink.samples).max() > 0.001


def test_contacts_may_be_the_engines(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    session = HapticSession(scene, bake(scene))
    link = MuJoCoLink(model, data, session, contacts="engine")
    for _ in range(4):
        step()
        frame = link.update([Touch("left", "wooden_table", (0.3, 0.0, 0.72))])
    assert frame.gain("left", "smartphone") > 0.05


def test_a_panda3d_scene_is_felt_in_three_lines() -> None:
    render, scene = panda3d_engine()
    session = HapticSession(scene, bake(scene))
    link = Panda3DLink(render, session)
    touches = [Touch("left", "wooden table", (0.2, 0.0, 0.7))]
    assert link.update(touches).gain("left", "smartphone") > 0.05
    render.find("**/smartphone").set_z(1.5)
    assert link.update(touches).gain("left", "smartphone") == 0.0


def test_every_adapter_keeps_its_contract(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    link = MuJoCoLink(model, data, HapticSession(scene, bake(scene)), hands={"left": "finger"}, contacts="engine")
    check_engine_adapter(link._adapter, scene, step=step, moves="finger")


def test_the_pages_own_engine_keeps_it_too() -> None:
    names = own_engine()
    adapter = names["adapter"]
    names["world"].reset()
    check_engine_adapter(adapter, names["scene"], step=names["world"].step, moves="smartphone")


def test_panda3d_keeps_it_too() -> None:
    render, scene = panda3d_engine()
    link = Panda3DLink(render, HapticSession(scene, bake(scene)))
    check_engine_adapter(link._adapter, scene, step=lambda: render.find("**/smartphone").set_x(0.1), moves="smartphone")


def test_what_is_at_rest_is_not_moved(mujoco_engine: Any) -> None:
    """Nor by what trembles; but slow motion adds up."""
    _, _, scene, _ = mujoco_engine

    class Slow:
        x_m = 0.0

        def poses(self) -> dict[str, Pose]:
            found = {item.id: item.pose for item in scene.objects}
            x, y, z = found["smartphone"].position_m
            return {**found, "smartphone": Pose((x + self.x_m, y, z))}

        def touches(self) -> tuple[()]:
            return ()

        def contacts(self) -> None:
            return None

    session = HapticSession(scene, bake(scene))
    slow, places = Slow(), []
    link = EngineLink(slow, session)
    for _ in range(30):
        slow.x_m += 2e-5
        link.update()
        places.append(session.snapshot.object("smartphone").pose.position_m[0])
    assert len(set(places)) < 10
    assert abs(places[-1] - places[0]) > 4e-4


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda m, d, s: MuJoCoLink(d, m, s), SceneError, "they must be mujoco.MjModel and mujoco.MjData"),
        (lambda m, d, s: MuJoCoLink(m, d, "session"), ConfigError, "it must be a HapticSession"),
        (
            lambda m, d, s: MuJoCoLink(m, d, s, hands={"third": "finger"}),
            ConfigError,
            "the session has no hand 'third'",
        ),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands={"left": "fingr"}), UnknownObject, "Did you mean 'finger'"),
        (lambda m, d, s: MuJoCoLink(m, d, s, contacts="mujoco"), ConfigError, "it must be 'engine', or None"),
        (lambda m, d, s: EngineLink(object(), s), ConfigError, "object has no method 'poses'"),
    ],
)
def test_what_is_no_link(make: Any, error: type[Exception], words: str, mujoco_engine: Any) -> None:
    model, data, scene, _ = mujoco_engine
    with pytest.raises(error, match=words):
        make(model, data, HapticSession(scene, bake(scene)))


def test_a_session_of_another_scene_is_refused(mujoco_engine: Any) -> None:
    model, data, _, _ = mujoco_engine
    _, other = panda3d_engine()
    with pytest.raises(SceneError, match=r"the engine lacks 1 of 2 objects of the session: 'wooden table'"):
        MuJoCoLink(model, data, HapticSession(other, bake(other)))
