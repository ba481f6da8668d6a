"""MuJoCo models from XML, with a tetrahedron for a mesh."""

from __future__ import annotations

from typing import Any

import pytest

from scene2hap import SceneSnapshot
from scene2hap.scene.engines.mujoco import snapshot

mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")

# A tetrahedron with a corner at the origin of its file; compiling moves it to its own centre of mass.
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nvt 0.25 0.75\nvt 0.75 0.75\nvt 0.25 0.25\n" + "".join(
    f"f {a}/1 {b}/2 {c}/3\n" for a, b, c in [(1, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4)]
)

RESTING = (
    '<mujoco><worldbody><geom name="floor" type="plane" size="2 2 1"/>'
    '<body name="ball" pos="0.5 0 0.199"><freejoint/><geom size="0.2"/></body>'
    '<body name="still" pos="-1 0 0.2"><geom size="0.2"/></body></worldbody></mujoco>'
)


def load(xml: str, assets: dict[str, bytes] | None = None) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(xml, {"wedge.obj": TETRAHEDRON.encode(), **(assets or {})})
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def scene_of(body: str, assets: dict[str, bytes] | None = None, **options: Any) -> SceneSnapshot:
    return snapshot(*load(f"<mujoco>{body}</mujoco>", assets), **options)
