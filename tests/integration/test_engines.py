"""Links to engines: three lines of code each, the contract of adapters, and the example engine of docs/engines.md."""

from __future__ import annotations

import re
import subprocess
import sys
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    Box,
    Contact,
    HapticBundle,
    HapticSession,
    MemorySink,
    Pose,
    PoseTable,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake_object,
)
from scene2hap.common.warning import SceneWarning
from scene2hap.engines import EngineAdapter, EngineLink, MuJoCoLink, Panda3DLink
from scene2hap.errors import CallError, ConfigError, SceneError, SessionError, UnknownObject
from scene2hap.testing import check_engine_adapter
from with_tones import with_tones

PAGE = (Path(__file__).parents[2] / "docs" / "engines.md").read_text(encoding="utf-8")
MODEL = """
<mujoco>
  <worldbody>
    <geom name="wooden_floor" type="box" size="2 2 0.05" pos="0 0 -0.05"/>
    <body name="wooden_table" pos="0 0 0.36"><geom type="box" size="0.6 0.4 0.36"/></body>
    <body name="smartphone" pos="0.2 0 0.73"><freejoint/><geom type="box" size="0.04 0.08 0.005" mass="0.2"/></body>
    <body name="finger" pos="0.35 0 0.77"><freejoint/><geom type="sphere" size="0.01" mass="0.05"/></body>
    <body name="mist" pos="-0.4 0 0.73"><geom type="sphere" size="0.01" contype="0" conaffinity="0"/></body>
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


bundles: dict[str, HapticBundle] = {}


def baked(scene: SceneSnapshot) -> HapticBundle:
    """The bundle of a scene with tones for sounds. Equal scenes are inferred once."""
    key = scene.to_json()
    if key not in bundles:
        bundles[key] = with_tones(scene)
    return bundles[key]


def data_of(model: str) -> Any:
    import mujoco

    return mujoco.MjData(mujoco.MjModel.from_xml_string(model))


def own_engine() -> dict[str, Any]:
    """The names that the code of the page's engine defines."""
    (code,) = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    names: dict[str, Any] = {}
    exec(code, names)
    return names


def test_three_lines_of_code_play_a_mujoco_scene(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    sink = MemorySink()
    with HapticSession(scene, baked(scene), sink=sink) as session:
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


def test_engine_contacts_can_be_used(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    session = HapticSession(scene, baked(scene))
    link = MuJoCoLink(model, data, session, contacts="engine")
    for _ in range(4):
        step()
        frame = link.update([Touch("left", "wooden_table", (0.3, 0.0, 0.72))])
    assert frame.gain("left", "smartphone") > 0.05


def test_three_lines_of_code_play_a_panda3d_scene() -> None:
    render, scene = panda3d_engine()
    session = HapticSession(scene, baked(scene))
    link = Panda3DLink(render, session)
    touches = [Touch("left", "wooden table", (0.2, 0.0, 0.7))]
    assert link.update(touches).gain("left", "smartphone") > 0.05
    render.find("**/smartphone").set_z(1.5)
    assert link.update(touches).gain("left", "smartphone") == 0.0


def test_every_adapter_keeps_its_contract(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    link = MuJoCoLink(model, data, HapticSession(scene, baked(scene)), hands={"left": "finger"}, contacts="engine")
    check_engine_adapter(link._adapter, scene, step=step, moves="finger")


def test_engine_of_the_page_keeps_the_adapter_contract() -> None:
    names = own_engine()
    adapter = names["adapter"]
    names["world"].reset()
    check_engine_adapter(adapter, names["scene"], step=names["world"].step, moves="smartphone")


def test_panda3d_adapter_keeps_its_contract() -> None:
    render, scene = panda3d_engine()
    link = Panda3DLink(render, HapticSession(scene, baked(scene)))
    check_engine_adapter(link._adapter, scene, step=lambda: render.find("**/smartphone").set_x(0.1), moves="smartphone")


def test_objects_at_rest_are_not_updated(mujoco_engine: Any) -> None:
    """Trembling does not update objects either, but slow motion accumulates until it does."""
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

    session = HapticSession(scene, baked(scene))
    slow, places = Slow(), []
    link = EngineLink(slow, session)
    for _ in range(30):
        slow.x_m += 2e-5
        link.update()
        places.append(session.snapshot.object("smartphone").pose.position_m[0])
    assert len(set(places)) < 10
    assert abs(places[-1] - places[0]) > 4e-4


HAND = """
<mujoco>
  <worldbody>
    <body name="wooden_table" pos="0 0 0.36"><geom type="box" size="0.6 0.4 0.36"/></body>
    <body name="smartphone" pos="-0.2 0 0.73"><geom type="box" size="0.04 0.08 0.005"/></body>
    <body name="palm" pos="0.1 0 0.78"><freejoint/><geom type="box" size="0.04 0.04 0.01" mass="0.2"/>
      <body name="thumb" pos="0.06 0 -0.02"><joint/><geom type="sphere" size="0.012" mass="0.02"/>
        <body name="nail" pos="0 0 -0.02"><geom type="sphere" size="0.008" mass="0.01"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def test_attached_parts_touch_for_their_hand() -> None:
    """The nail touches the table and counts for the palm's hand; contacts among parts of the hand do not count."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    model = mujoco.MjModel.from_xml_string(HAND)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = snapshot(model, data)
    session = HapticSession(scene, baked(scene))
    link = MuJoCoLink(model, data, session, hands={"left": "palm", "right": "nail"})
    assert link.update().gain("left", "smartphone") == 0.0
    mujoco.mj_step(model, data, nstep=30)
    frame = link.update()
    assert frame.gain("left", "smartphone") == frame.gain("right", "smartphone") > 0.05
    assert {touch.object_id for touch in link._adapter.touches() if touch.hand == "left"} == {"wooden_table"}


def test_a_body_without_a_name_is_a_hand_by_its_id() -> None:
    """The id that the scene shows is the only one that such a body has."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco_contacts import geoms_below

    model = mujoco.MjModel.from_xml_string(HAND.replace('name="nail"', ""))
    data = mujoco.MjData(model)
    expected = [*(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, k) is None for k in model.geom_bodyid), False]
    assert geoms_below(model, data, "thumb/body1").tolist() == expected
    assert sum(expected) > 0


@pytest.mark.parametrize("contacts", [None, "engine"])
def test_objects_missing_in_the_session_are_skipped(mujoco_engine: Any, contacts: Any) -> None:
    """An object removed from the session is skipped, and followed again once it is added back."""
    model, data, scene, step = mujoco_engine
    session = HapticSession(scene, baked(scene))
    link = MuJoCoLink(model, data, session, hands={"left": "finger"}, contacts=contacts)
    link.update()
    for gone in ("wooden_table", "finger"):
        session.remove(gone)
    for _ in range(5):
        step()
        link.update()
    session.add(scene.object("finger"))
    link.update()
    fallen_m = scene.object("finger").pose.position_m[2] - session.snapshot.object("finger").pose.position_m[2]
    assert fallen_m > 0.02
    with pytest.raises(UnknownObject, match="'wooden_table' was removed"):
        link.update([Touch("left", "wooden_table", (0, 0, 0.72))])


def test_a_session_may_have_less_than_the_engine(mujoco_engine: Any) -> None:
    model, data, scene, step = mujoco_engine
    fewer = SceneSnapshot(scene.name, scene.up_axis, tuple(item for item in scene.objects if item.id != "finger"))
    link = MuJoCoLink(model, data, HapticSession(fewer, baked(fewer)), hands={"left": "finger"}, contacts="engine")
    for _ in range(10):
        step()
        frame = link.update()
    assert frame.gain("left", "smartphone") > 0.05


def test_readded_object_has_the_pose_of_the_engine(mujoco_engine: Any) -> None:
    """Also if it did not move in the engine meanwhile; for poses in a table and in a mapping."""
    model, data, scene, _ = mujoco_engine
    for adapter in (MuJoCoLink(model, data, HapticSession(scene, baked(scene)))._adapter, Given(scene)):
        session = HapticSession(scene, baked(scene))
        link = EngineLink(adapter, session)
        link.update()
        session.remove("smartphone")
        link.update()
        there = scene.object("smartphone")
        session.add(replace(there, pose=Pose((1.0, 0.0, 2.0))))
        link.update()
        assert session.snapshot.object("smartphone").pose.position_m == there.pose.position_m


@pytest.mark.parametrize("as_table", [False, True])
def test_an_adapter_may_have_new_objects_in_any_frame(as_table: bool) -> None:
    scene = own_scene()
    session = HapticSession(scene, baked(scene))
    adapter = Given(scene)
    link = EngineLink(adapter, session)
    link.update()
    cup = SceneObject("cup", pose=Pose((0.6, 0.8, 0.2)), geometry=Box((0.1, 0.1, 0.1)))
    for x_m in (0.6, 0.7):
        now = {"table": TABLE, "phone": PHONE, "cup": Pose((x_m, 0.77, 0.2))}
        table = PoseTable(list(now), *zip(*((p.position_m, p.rotation_xyzw) for p in now.values()), strict=True))
        adapter.given["poses"] = table if as_table else now
        link.update()
        if "cup" not in session.object_ids:
            session.add(cup)
            link.update()
        assert session.snapshot.object("cup").pose == now["cup"]


def test_a_panda3d_link_follows_in_the_unit_of_the_snapshot() -> None:
    render, _ = panda3d_engine()
    from scene2hap.scene.engines.panda3d import snapshot

    for path in render.get_children():
        path.set_scale(100)
        path.set_pos(path.get_pos() * 100)
    scene = snapshot(render, unit_m=0.01)
    link = Panda3DLink(render, (session := HapticSession(scene, baked(scene))), unit_m=0.01)
    render.find("**/smartphone").set_x(20)
    link.update()
    assert session.poses["smartphone"].position_m == pytest.approx((0.2, 0, 0.701), abs=1e-6)


def test_a_node_out_of_the_graph_stays_where_it_was() -> None:
    render, _ = panda3d_engine()
    from scene2hap.scene.engines.panda3d import snapshot

    phone = render.find("**/smartphone")
    carried = render.attach_new_node("smartphone")
    carried.set_z(1.0)
    phone.set_z(-0.299)
    phone.reparent_to(carried)
    scene = snapshot(render, name="study")
    session = HapticSession(scene, baked(scene))
    link = Panda3DLink(render, session)
    (phone_id,) = (item.id for item in scene.objects if "smartphone" in item.id)
    before = session.snapshot.object(phone_id).pose
    phone.detach_node()
    link.update()
    assert session.snapshot.object(phone_id).pose == before
    phone.reparent_to(render)
    link.update()
    assert session.snapshot.object(phone_id).pose.position_m[2] == pytest.approx(before.position_m[2] - 1.0, abs=1e-6)


def test_a_node_that_came_later_is_followed() -> None:
    render, scene = panda3d_engine()
    from scene2hap.scene.engines.panda3d import snapshot

    session = HapticSession(scene, baked(scene))
    link = Panda3DLink(render, session)
    fan = render.attach_new_node("fan")
    fan.set_pos(0.3, 0.2, 0.9)
    for turn in (0, 90):  # two blades in one model, which a collider is part of
        blade = render.find("**/smartphone").copy_to(fan.attach_new_node(f"blade {turn}"))
        blade.set_h(turn)
    hit = fan.attach_new_node("collider")
    item = snapshot(fan, group=1).objects[0]
    session.spawn(bake_object(item, up_axis="z"), "fan_17", item.pose)
    link.follow("fan_17", fan)
    assert (item.id, link.object_id(fan), link.object_id(hit)) == ("fan", "fan_17", "fan_17")
    fan.set_x(-0.1)
    link.update()
    assert session.poses["fan_17"].position_m == pytest.approx((-0.1, 0.2, 0.9), abs=1e-6)
    with pytest.raises(SceneError, match=r"draws no triangles.*'lamp'"):
        link.follow("lamp", render.attach_new_node("lamp"))
    with pytest.raises(SceneError, match="must be a panda3d.core.NodePath"):
        link.follow("lamp", "lamp")


class Given:
    """An adapter with given poses, touches and contacts; by default those of its scene at rest."""

    def __init__(self, scene: SceneSnapshot, **given: Any) -> None:
        self.given = {"poses": {item.id: item.pose for item in scene.objects}, "touches": [], "contacts": None, **given}

    def poses(self) -> Any:
        return self.given["poses"]

    def touches(self) -> Any:
        return self.given["touches"]

    def contacts(self) -> Any:
        return self.given["contacts"]


def own_scene() -> SceneSnapshot:
    return SceneSnapshot.build(
        [
            SceneObject("table", pose=Pose((0.5, 0.36, 0.2)), geometry=Box((1.2, 0.72, 0.7))),
            SceneObject("phone", pose=Pose((0.2, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15))),
        ]
    )


TABLE, PHONE = Pose((0.5, 0.36, 0.2)), Pose((0.2, 0.724, 0.1))
HALF = 0.5**0.5
WRONG = [
    ({"poses": None}, SceneError, "poses() of Given gave None", "poses() is a NoneType"),
    ({"poses": [TABLE]}, SceneError, "poses() of Given gave a list", "poses() is a list"),
    ({"poses": {"table": TABLE}}, SceneError, "the engine lacks 1 of 2 objects", "poses() lacks 'phone'"),
    ({"poses": {"table": TABLE, "phone": (0, 0, 0)}}, SceneError, "it must be a Pose", "it must be a Pose"),
    (
        {"poses": {"table": Pose((50, 36, 20)), "phone": Pose((20, 72.4, 10))}},
        SceneError,
        "the engine's positions are 100 times those of the session",
        "from where the snapshot has it",
    ),
    ({"touches": 5}, SessionError, "touches is 5", "touches() is a int"),
    ({"touches": [("left", "table")]}, SessionError, "touches has", "touches() has a tuple"),
    ({"touches": [Touch("left", "cup", (0, 0, 0))]}, UnknownObject, "no object 'cup'", "touches() has 'cup'"),
    ({"contacts": 5}, SessionError, "contacts is 5", "contacts() is a int"),
    ({"contacts": [Contact("phone", "cup", (0, 0, 0))]}, SceneError, "cup", "contacts() has 'cup'"),
]


@pytest.mark.parametrize(("given", "error", "answered", "asserted"), WRONG)
def test_invalid_adapter_results_are_refused(given: Any, error: type[Exception], answered: str, asserted: str) -> None:
    """The link raises an error in play, and the contract check detects the fault too."""
    scene = own_scene()
    with pytest.raises(error, match=re.escape(answered)):
        EngineLink(Given(scene, **given), HapticSession(scene, baked(scene))).update()
    with pytest.raises(AssertionError, match=re.escape(asserted)):
        check_engine_adapter(Given(scene, **given), scene, step=lambda: None)


@pytest.mark.parametrize(
    ("given", "moves", "words"),
    [
        # With w first, the identity becomes a half turn about x.
        ({"poses": {"table": Pose((0.5, 0.36, 0.2), (1, 0, 0, 0)), "phone": PHONE}}, None, "180 degrees"),
        ({"poses": {"table": TABLE, "phone": Pose((0.2, 0.1, 0.724))}}, None, "'phone' 0.882 m and 0 degrees"),
        ({"touches": [Touch("left", "phone", (20.0, 72.4, 10.0))]}, None, "touches.. has a point 7.* m off 'phone'"),
        ({"contacts": [Contact("phone", "table", (20.0, 72.0, 10.0))]}, None, "contacts.. has a point"),
        ({}, "phone", "where it was before the step"),
        ({}, "cup", "which is no object of the scene"),
    ],
)
def test_contract_finds_faults_that_play_does_not(given: Any, moves: str | None, words: str) -> None:
    scene = own_scene()
    with pytest.raises(AssertionError, match=words):
        check_engine_adapter(Given(scene, **given), scene, step=lambda: None, moves=moves)


@pytest.mark.parametrize("as_table", [False, True])
def test_link_moves_a_diverged_session_to_the_engine_state(as_table: bool) -> None:
    """The session diverges by an object added back at another place between two frames, or by a refused frame."""
    scene = own_scene()
    session = HapticSession(scene, baked(scene))
    adapter = Given(scene)
    link = EngineLink(adapter, session)

    def put(phone: Pose) -> None:
        rows = ((TABLE.position_m, phone.position_m), (TABLE.rotation_xyzw, phone.rotation_xyzw))
        now: Any = {"table": TABLE, "phone": phone}
        adapter.given["poses"] = PoseTable(["table", "phone"], *rows) if as_table else now

    put(PHONE)
    link.update()
    session.remove("phone")
    session.add(replace(scene.object("phone"), pose=Pose((0.9, 0.724, 0.1))))
    link.update()
    assert session.poses["phone"] == PHONE
    there = Pose((0.7, 0.724, 0.1))
    put(there)
    with pytest.raises(UnknownObject, match="'cup'"):
        link.update([Touch("left", "cup", (0, 0, 0))])
    link.update()
    assert session.poses["phone"] == there


def test_the_last_reported_contacts_stay_in_frames_without_a_report() -> None:
    """None ends no contact of objects at rest, and never begins a search: physics may run more slowly than frames."""
    scene = own_scene()
    adapter = Given(scene, contacts=[Contact("phone", "table", (0.2, 0.72, 0.1))])
    link = EngineLink(adapter, HapticSession(scene, baked(scene)))
    touch = [Touch("left", "table", (0.4, 0.72, 0.1))]

    def feels_the_phone(contacts: Any, phone: Pose = PHONE) -> bool:
        adapter.given |= {"contacts": contacts, "poses": {"table": TABLE, "phone": phone}}
        return link.update(touch).gain("left", "phone") > 0

    moved = Pose((0.3, 0.724, 0.1))
    report = [Contact("phone", "table", (0.2, 0.72, 0.1))]
    assert feels_the_phone(report)
    assert feels_the_phone(None)
    assert not feels_the_phone([])
    assert not feels_the_phone(None)
    assert feels_the_phone(report)
    assert not feels_the_phone(None, moved)
    assert feels_the_phone(report, moved)


def test_frame_has_a_time_on_the_clock() -> None:
    scene = own_scene()
    link = EngineLink(Given(scene), HapticSession(scene, baked(scene)))
    link.update(at_sample=480)
    with pytest.raises(SessionError, match="at_sample is 479"):
        link.update(None, at_sample=479)


def test_mocap_hand_touches_only_movable_objects() -> None:
    """MuJoCo finds no contact between a mocap body and a body without a joint."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    hand = '<body name="glove" mocap="true" pos="0.2 0 0.744"><geom type="sphere" size="0.01"/></body></worldbody>'
    model = mujoco.MjModel.from_xml_string(MODEL.replace("</worldbody>", hand))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = snapshot(model, data)
    session = HapticSession(scene, baked(scene))
    link = MuJoCoLink(model, data, session, hands={"left": "glove"})
    assert link.update().gain("left", "smartphone") == 1.0
    data.mocap_pos[0] = (0.4, 0.0, 0.729)
    mujoco.mj_forward(model, data)
    assert link.update().gain("left", "smartphone") == 0.0


def test_links_are_public_and_load_no_engine() -> None:
    code = (
        "import sys, scene2hap as s; print(s.MuJoCoLink is s.engines.MuJoCoLink, s.Panda3DLink, s.EngineLink, "
        "s.EngineAdapter, s.testing.check_engine_adapter, {'mujoco', 'panda3d'} & set(sys.modules))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.startswith("True")
    assert run.stdout.rstrip().endswith("set()")


def test_unit_mismatch_is_detected_in_play(mujoco_engine: Any) -> None:
    """A link without the unit is refused; one object that moved away from the origin does not count as a unit."""
    model, data, _, _ = mujoco_engine
    from scene2hap.scene.engines.mujoco import snapshot

    scene = snapshot(model, data, unit_m=0.5)
    session = HapticSession(scene, baked(scene))
    data.qpos[0] += 0.3
    import mujoco

    mujoco.mj_forward(model, data)
    with pytest.raises(SceneError, match=r"positions are 2 times those of the session"):
        MuJoCoLink(model, data, session)
    MuJoCoLink(model, data, session, unit_m=0.5)
    own = own_scene()
    EngineLink(Given(own, poses={"table": TABLE, "phone": Pose((2.0, 7.24, 1.0))}), HapticSession(own, baked(own)))


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda m, d, s: MuJoCoLink(m, data_of("<mujoco/>"), s), SceneError, "data is of another model"),
        (lambda m, d, s: MuJoCoLink(m, d), CallError, "missing a required argument: 'session'"),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands="left"), ConfigError, "it must be a mapping of hands to bodies"),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands={"left": ["finger"]}), UnknownObject, "the name of one body"),
        (
            lambda m, d, s: MuJoCoLink(m, data_of(MODEL.replace("smartphone", "telephone")), s),
            SceneError,
            "whose names",
        ),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands={"left": "mist"}), SceneError, "'mist' has no geom that collides"),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands={"finger": "left"}), UnknownObject, "no body 'left'"),
        (lambda m, d, s: MuJoCoLink(m, d, s, unit_m="1"), SceneError, "unit_m is '1'"),
        (lambda m, d, s: EngineLink(Given, s), ConfigError, "adapter is the class Given; give an instance"),
        (lambda m, d, s: MuJoCoLink(d, m, s), SceneError, "they must be mujoco.MjModel and mujoco.MjData"),
        (lambda m, d, s: MuJoCoLink(m, d, "session"), ConfigError, "it must be a HapticSession"),
        (
            lambda m, d, s: MuJoCoLink(m, d, s, hands={"third": "finger"}),
            ConfigError,
            "no hand 'third'; this session has 'left', 'right'",
        ),
        (lambda m, d, s: MuJoCoLink(m, d, s, hands={"left": "fingr"}), UnknownObject, "Did you mean 'finger'"),
        (lambda m, d, s: MuJoCoLink(m, d, s, contacts="mujoco"), ConfigError, "it must be 'engine', or None"),
        (lambda m, d, s: EngineLink(object(), s), ConfigError, "object has no method 'poses'"),
    ],
)
def test_objects_that_are_not_links_are_refused(
    make: Any, error: type[Exception], words: str, mujoco_engine: Any
) -> None:
    model, data, scene, _ = mujoco_engine
    with pytest.raises(error, match=words):
        make(model, data, HapticSession(scene, baked(scene)))


def test_engines_are_imported_when_they_are_linked() -> None:
    """The error of an engine that is not installed names its extra."""
    code = """
import sys
from scene2hap import Box, HapticSession, SceneObject, SceneSnapshot, bake
from scene2hap.engines import MuJoCoLink, Panda3DLink
assert not {"mujoco", "panda3d"} & sys.modules.keys()
sys.modules["mujoco"] = sys.modules["panda3d.core"] = None
scene = SceneSnapshot.build([SceneObject("table", geometry=Box((0.1, 0.1, 0.1)))])  # without a sound to be made
session = HapticSession(scene, bake(scene))
for link in (lambda: MuJoCoLink(None, None, session), lambda: Panda3DLink(None, session)):
    try:
        link()
    except ImportError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.count("is not installed. Run: pip install 'scene2hap[") == 2, done.stderr


def test_session_of_a_different_scene_is_refused(mujoco_engine: Any) -> None:
    model, data, _, _ = mujoco_engine
    _, other = panda3d_engine()
    with pytest.raises(
        SceneError, match=r"the engine lacks 1 of 2 objects of the session: 'wooden table'\..*geom_groups"
    ):
        MuJoCoLink(model, data, HapticSession(other, baked(other)))


def test_collected_steps_of_an_adapter_count_in_the_next_frame_alone() -> None:
    """Of each pair, the contacts and touches of the last step that has any."""
    scene = own_scene()
    adapter = Given(scene)
    link = EngineLink(adapter, HapticSession(scene, baked(scene)))

    def step(touches: list[Touch], contacts: list[Contact]) -> None:
        adapter.given |= {"touches": touches, "contacts": contacts}

    step([Touch("left", "table", (0.4, 0.72, 0.1))], [Contact("phone", "table", (0.2, 0.72, 0.1))])
    link.collect()
    step([], [])
    link.collect()
    assert link.update().gain("left", "phone") > 0
    assert link.update().gain("left", "phone") == 0


@pytest.mark.parametrize(
    ("hand", "pair", "named"),
    [
        (
            '<body name="glove" mocap="true" pos="0 0 .8"><geom size=".02"/></body>',
            "",
            "nor 'wooden_table', 'wooden_floor', and",
        ),
        (
            '<body name="glove" mocap="true" pos="0 0 .8"><geom size=".02"/></body>',
            '<pair geom1="skin" geom2="top"/>',
            None,
        ),
        ('<body name="glove" pos="0 0 .8"><freejoint/><geom size=".02"/></body>', "", None),
        (
            '<body name="glove" mocap="true" pos="0 0 .8"><geom size=".02"/>'
            '<body name="nail"><joint/><geom size=".01"/></body></body>',
            "",
            None,
        ),
    ],
    ids=["mocap", "with a pair", "free", "with a joint"],
)
def test_hands_that_mujoco_keeps_from_fixed_objects_bring_a_warning(hand: str, pair: str, named: str | None) -> None:
    """The engine itself has no contact of the hand with the table in the first case."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    text = MODEL.replace("</worldbody>", f"{hand}</worldbody><contact>{pair}</contact>")
    text = text.replace('size=".02"', 'name="skin" size=".02"').replace('size="0.6 ', 'name="top" size="0.6 ')
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.mocap_pos[:] = (0, 0, 0.73)
    data.qpos[-7:-4] = (0, 0, 0.73) if "freejoint" in hand else data.qpos[-7:-4]
    mujoco.mj_forward(model, data)
    skin, top = (mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name) for name in ("skin", "top"))
    meets = any({one.geom1, one.geom2} == {skin, top} for one in data.contact)
    scene = snapshot(model, data)
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always", SceneWarning)
        MuJoCoLink(model, data, HapticSession(scene, baked(scene)), hands={"left": "glove"})
    said = [str(one.message) for one in found if "Weld a free body" in str(one.message)]
    assert [one for one in said if named is not None and named in one] == said
    assert bool(said) == (named is not None)
    assert named is None or not meets
