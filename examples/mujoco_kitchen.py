"""A kitchen in MuJoCo: a phone slides along a table, and two simulated hands feel it.

    python examples/mujoco_kitchen.py                               # in a window, felt through the sound card
    python examples/mujoco_kitchen.py --headless -o kitchen.wav     # 8 s without a window, by a script

Space pushes the phone. The arrow keys move the left hand over the table, Page Up and Page Down lift and lower it. The
right hand follows the phone. Without a display the game runs headless. Needs: pip install
'scene2hap[mujoco,soundcard]'. On macOS start it by `mjpython`. --picture needs OpenGL; without a display set
MUJOCO_GL=egl or MUJOCO_GL=osmesa.
"""

import argparse
import math
import os
import sys
import time
from collections import deque
from contextlib import nullcontext

import mujoco
import mujoco.viewer
import numpy as np
from PIL import Image

from scene2hap import HapticFrame, HapticSession, WavSink, bake
from scene2hap.engines import MuJoCoLink
from scene2hap.scene.engines.mujoco import snapshot

FRAME_S = 0.02
HANDS = {"left": "left hand", "right": "right hand"}  # bodies of the model
TOP_M = 0.74
PUSH_M_S = 0.55
# The hands are spheres of 3 cm that press 3 mm into the table top while they follow their targets.
TOUCHING_M, LIFTED_M = TOP_M + 0.027, TOP_M + 0.12
BESIDE_M = np.array([0.0, 0.12, 0.0])
STEPS_M = {
    262: (0.03, 0, 0),
    263: (-0.03, 0, 0),
    265: (0, 0.03, 0),
    264: (0, -0.03, 0),
    266: (0, 0, 1),
    267: (0, 0, -1),
}
"""Steps of the left hand by GLFW's key code: arrows right, left, up and down; Page Up lifts, Page Down lowers it."""

# The names of bodies say what the objects are. Hands are in group 1, which is left out: they carry no vibration.
MODEL = f"""
<mujoco model="kitchen">
  <option timestep="0.002"/>
  <visual><headlight ambient="0.4 0.4 0.4"/><global offwidth="960" offheight="600"/></visual>
  <asset><texture type="skybox" builtin="flat" rgb1="0.6 0.7 0.8" width="64" height="64"/></asset>
  <worldbody>
    <light pos="0 -1 3" dir="0 0.3 -1"/>
    <camera name="guest" pos="0 -1.35 1.55" xyaxes="1 0 0 0 0.55 0.83"/>
    <geom name="stone floor" type="box" size="1.8 1.5 0.05" pos="0 0 -0.05" rgba="0.7 0.68 0.64 1"/>
    <body name="wooden table">
      <geom type="box" size="0.8 0.4 0.015" pos="0 0 {TOP_M - 0.015}" rgba="0.62 0.42 0.25 1"/>
      <geom type="box" size="0.03 0.03 0.355" pos="-0.7 -0.3 0.355" rgba="0.5 0.33 0.2 1"/>
      <geom type="box" size="0.03 0.03 0.355" pos="-0.7 0.3 0.355" rgba="0.5 0.33 0.2 1"/>
      <geom type="box" size="0.03 0.03 0.355" pos="0.7 -0.3 0.355" rgba="0.5 0.33 0.2 1"/>
      <geom type="box" size="0.03 0.03 0.355" pos="0.7 0.3 0.355" rgba="0.5 0.33 0.2 1"/>
    </body>
    <body name="refrigerator" pos="-1.2 1 0.9"><geom type="box" size="0.3 0.3 0.9" rgba="0.9 0.9 0.9 1"/></body>
    <body name="plate" pos="0.55 0.2 {TOP_M + 0.01}"><geom type="cylinder" size="0.12 0.01" rgba="0.9 0.9 1 1"/></body>
    <body name="smartphone" pos="-0.3 0 {TOP_M + 0.004}">
      <freejoint/>
      <geom type="box" size="0.075 0.035 0.004" mass="0.2" priority="1" friction="0.04" rgba="0.1 0.1 0.12 1"/>
    </body>
    <body name="left hand" pos="-0.3 0.12 {LIFTED_M}">
      <freejoint/><geom size="0.03" mass="0.3" group="1" friction="0.1" rgba="0.9 0.3 0.2 1"/>
    </body>
    <body name="right hand" pos="-0.3 -0.12 {LIFTED_M}">
      <freejoint/><geom size="0.03" mass="0.3" group="1" friction="0.1" rgba="0.2 0.4 0.9 1"/>
    </body>
    <body name="left target" mocap="true" pos="-0.3 0.12 {LIFTED_M}"/>
    <body name="right target" mocap="true" pos="-0.3 -0.12 {LIFTED_M}"/>
  </worldbody>
  <equality><weld body1="left target" body2="left hand"/><weld body1="right target" body2="right hand"/></equality>
</mujoco>
"""


class Kitchen:
    """The simulation, and the target of the left hand."""

    def __init__(self) -> None:
        self.model = mujoco.MjModel.from_xml_string(MODEL)
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.left_m = np.array(self.data.body("left hand").xpos)

    def push(self) -> None:
        """Give the phone a speed along the table; friction stops it."""
        self.data.joint(int(self.model.body("smartphone").jntadr[0])).qvel[0] = PUSH_M_S

    def key(self, code: int) -> None:
        """Move the left hand, or push the phone."""
        if code == ord(" "):
            self.push()
        if code in STEPS_M:
            x, y, lift = STEPS_M[code]
            self.left_m += (x, y, 0)
            self.left_m[2] = {0: self.left_m[2], 1: LIFTED_M, -1: TOUCHING_M}[lift]

    def script(self, t: float) -> None:
        """Put the left hand down, push the phone away from it, and later move the hand to the phone."""
        self.left_m[2] = TOUCHING_M
        if math.isclose(t, 2.0, abs_tol=FRAME_S / 2):
            self.push()
        if t > 6.0:
            self.left_m[:2] = (self.data.body("smartphone").xpos + BESIDE_M)[:2]

    def step(self, link: MuJoCoLink) -> None:
        """Simulate one frame. The hands approach their targets at 5 times the remaining distance per second."""
        phone_m = self.data.body("smartphone").xpos
        wanted = {"left target": self.left_m, "right target": [*(phone_m - BESIDE_M)[:2], TOUCHING_M]}
        for name, place in wanted.items():
            mocap = self.data.mocap_pos[self.model.body(name).mocapid[0]]
            mocap += 5.0 * FRAME_S * (place - mocap)
        for _ in range(round(FRAME_S / self.model.opt.timestep)):
            mujoco.mj_step(self.model, self.data)
            link.collect()

    def told(self, frame: HapticFrame) -> str:
        """Text with the distance of each hand from the phone, and its gain."""
        phone_m = self.data.body("smartphone").xpos
        ways = {hand: math.dist(self.data.body(f"{hand} hand").xpos[:2], phone_m[:2]) for hand in frame.hands}
        return "; ".join(f"{hand} {way:.3f} m: {frame.gain(hand, 'smartphone'):.4f}" for hand, way in ways.items())


def play(arguments: argparse.Namespace, has_window: bool) -> None:
    """Bake the kitchen, and play until the window is closed or until the time is over."""
    kitchen = Kitchen()
    model, data = kitchen.model, kitchen.data
    scene = snapshot(model, data, geom_groups={0})
    output = arguments.output or (None if has_window else "kitchen.wav")
    sink = WavSink(output) if output else "soundcard"
    keys: deque[int] = deque()  # pressed since the last frame, from the window's thread
    with (
        HapticSession(scene, bake(scene), sink=sink) as session,
        mujoco.viewer.launch_passive(model, data, key_callback=keys.append) if has_window else nullcontext() as viewer,
    ):
        link = MuJoCoLink(model, data, session, hands=HANDS, geom_groups={0})
        i, begin = 0, time.perf_counter()
        while viewer.is_running() if viewer else i < arguments.seconds / FRAME_S:
            if not viewer:
                kitchen.script(i * FRAME_S)
            while keys:
                kitchen.key(keys.popleft())
            kitchen.step(link)
            frame = link.update()
            if isinstance(sink, WavSink):
                sink.pull_s(FRAME_S)
            i += 1
            if i % 25 == 0:
                print(f"at {i * FRAME_S:.1f} s: {kitchen.told(frame)}")
            if viewer:
                viewer.sync()
                time.sleep(max(0.0, begin + i * FRAME_S - time.perf_counter()))
    if has_window:
        time.sleep(0.5)  # the viewer's thread closes the window; leaving before crashes MuJoCo 4.0
    if arguments.picture:
        with mujoco.Renderer(model, 600, 960) as renderer:
            renderer.update_scene(data, camera="guest")
            Image.fromarray(renderer.render()).save(arguments.picture)
    if output:
        print(f"wrote {output}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--headless", action="store_true", help="no window and no sound card: a script plays")
    parser.add_argument("--seconds", type=float, default=8.0, help="length of the game without a window (8)")
    parser.add_argument("-o", "--output", metavar="OUT.wav", help="write a WAV in the place of the sound card")
    parser.add_argument("--picture", metavar="OUT.png", help="save a picture of the kitchen at the end")
    given = parser.parse_args()
    play(given, not given.headless and (sys.platform in ("win32", "darwin") or bool(os.environ.get("DISPLAY"))))
