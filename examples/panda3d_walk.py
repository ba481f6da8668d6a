"""A room that you walk through and feel with both hands: a small first-person game in Panda3D.

    python examples/panda3d_walk.py                                 # in a window, felt through the sound card
    python examples/panda3d_walk.py --headless -o walk.wav          # a scripted walk of 16 s without a window

W A S D walk, the mouse looks around, and Escape ends. While the left or right mouse button is held, that hand touches
the object under the cross. Without a display the game plays headless. Needs: pip install
'scene2hap[panda3d,soundcard]'; --picture works without a display too, and needs the system library libX11.
"""

import argparse
import math
import os
import sys
from collections.abc import Iterator
from typing import Any

from direct.gui.OnscreenText import OnscreenText
from direct.showbase.ShowBase import ShowBase
from panda3d import core

from scene2hap import HapticSession, SceneSnapshot, Touch, WavSink, bake
from scene2hap.engines import Panda3DLink
from scene2hap.scene.engines.panda3d import snapshot

EYE_HEIGHT_M, REACH_M, SPEED_M_S, DEGREES_PER_PIXEL = 1.6, 1.3, 1.4, 0.1
HEADLESS_FPS = 50
HANDS = {"left": core.MouseButton.one(), "right": core.MouseButton.three()}
STEPS = {"w": (0, 1), "s": (0, -1), "a": (-1, 0), "d": (1, 0)}
Vector = tuple[float, float, float]
clock = core.ClockObject.get_global_clock()

# The scripted walk: place to stand, point to touch, and hand. Each touch lasts two seconds, after the way there.
ROUTE = [
    ((0.2, -0.75), (0.45, -0.15, 0.75), "right"),  # the table, 15 cm beside the phone
    ((-0.3, -0.75), (-0.55, -0.15, 0.75), "left"),  # the far end of the table
    ((-1.5, 0.4), (-1.7, 1.1, 0.85), "left"),  # the washing machine
    ((1.3, 0.5), (1.35, 1.25, 1.2), "right"),  # the shelf with the fan
]


def box(parent: core.NodePath, name: str, size_m: Vector, at_m: Vector, rgb: Vector) -> core.NodePath:
    """A cuboid that stands on its node's origin; each side has a different brightness, as if lit from above."""
    data = core.GeomVertexData(name, core.GeomVertexFormat.get_v3c4(), core.Geom.UH_static)
    vertex, color = core.GeomVertexWriter(data, "vertex"), core.GeomVertexWriter(data, "color")
    triangles = core.GeomTriangles(core.Geom.UH_static)
    for axis, (dark, bright) in enumerate([(0.7, 0.8), (0.6, 0.9), (0.4, 1.0)]):
        for end, light in enumerate([dark, bright]):
            first = data.get_num_rows()
            for u, v in [(0, 0), (1, 0), (1, 1), (0, 1)]:
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = end, u, v
                vertex.add_data3((corner[0] - 0.5) * size_m[0], (corner[1] - 0.5) * size_m[1], corner[2] * size_m[2])
                color.add_data4(*(light * c for c in rgb), 1.0)
            a, b, c, d = range(first, first + 4)
            for face in [(a, b, c), (a, c, d)]:  # counter-clockwise seen from outside
                triangles.add_vertices(*face if end else reversed(face))
    geom = core.Geom(data)
    geom.add_primitive(triangles)
    node = core.GeomNode(name)
    node.add_geom(geom)
    path = parent.attach_new_node(node)
    path.set_pos(*at_m)
    return path


def furnish(render: core.NodePath) -> None:
    """A room of 5 m by 4 m; z is up, units are metres, and the names of nodes describe the objects."""
    wood, white, grey = (0.62, 0.42, 0.25), (0.92, 0.92, 0.9), (0.5, 0.52, 0.55)
    box(render, "concrete floor", (5.0, 4.0, 0.1), (0.0, 0.0, -0.1), (0.72, 0.68, 0.62))
    box(render, "plaster wall", (5.0, 0.1, 2.5), (0.0, 2.05, 0.0), (0.8, 0.84, 0.86))
    # Pieces whose names begin with that of the node above them are one object with it.
    table = render.attach_new_node("wooden table")
    for x, y in [(-0.7, -0.3), (-0.7, 0.3), (0.7, -0.3), (0.7, 0.3)]:
        box(table, "wooden table leg", (0.06, 0.06, 0.72), (x, y, 0.0), wood)
    box(table, "wooden table top", (1.6, 0.8, 0.03), (0.0, 0.0, 0.72), wood)
    box(render, "smartphone", (0.07, 0.15, 0.008), (0.3, -0.1, 0.75), (0.1, 0.1, 0.12))
    box(render, "washing machine", (0.6, 0.6, 0.85), (-1.7, 1.2, 0.0), white)
    box(render, "wooden shelf", (0.9, 0.3, 0.02), (1.5, 1.35, 1.18), wood)
    box(render, "desk fan", (0.25, 0.2, 0.35), (1.7, 1.35, 1.2), grey)
    box(render, "sofa", (0.8, 1.8, 0.42), (2.0, -0.6, 0.0), (0.35, 0.45, 0.6))


class Walker:
    """The player: a camera in the scene, and hands that touch the object in its centre."""

    def __init__(self, render: core.NodePath, scene: SceneSnapshot) -> None:
        self.render, self.floor_m = render, scene.object("concrete floor").bounds_m
        self.eyes = render.attach_new_node("eyes")
        self.eyes.set_pos(0.0, -1.6, EYE_HEIGHT_M)
        gaze = core.CollisionNode("gaze")
        gaze.add_solid(core.CollisionRay(0, 0, 0, 0, 1, 0))
        gaze.set_from_collide_mask(core.GeomNode.get_default_collide_mask())
        gaze.set_into_collide_mask(core.CollideMask.all_off())
        self.hits, self.traverser = core.CollisionHandlerQueue(), core.CollisionTraverser()
        self.traverser.add_collider(self.eyes.attach_new_node(gaze), self.hits)

    def walk(self, right_m: float, forward_m: float) -> None:
        """Move on the floor, not beyond its edges."""
        heading = math.radians(self.eyes.get_h())
        x, y, z = self.eyes.get_pos()
        x += right_m * math.cos(heading) - forward_m * math.sin(heading)
        y += right_m * math.sin(heading) + forward_m * math.cos(heading)
        (low_x, low_y, _), (high_x, high_y, _) = self.floor_m
        self.eyes.set_pos(min(max(x, low_x), high_x), min(max(y, low_y), high_y), z)

    def touches(self, hands: list[str], link: Panda3DLink) -> list[Touch]:
        """Touches of the hands at the point in the centre of the view; none if it is too far away."""
        self.traverser.traverse(self.render)
        if not hands or not self.hits.get_num_entries():
            return []
        self.hits.sort_entries()
        hit = self.hits.get_entry(0)
        point = hit.get_surface_point(self.render)
        object_id = link.object_id(hit.get_into_node_path())  # a leg belongs to its table
        is_near = (point - self.eyes.get_pos()).length() <= REACH_M
        return [Touch(hand, object_id, tuple(point)) for hand in hands] if object_id and is_near else []


def person(game: ShowBase, walker: Walker) -> Iterator[list[str]]:
    """Steer by keyboard and mouse. Yields the hands that reach out, once per frame."""
    window = game.win
    window.request_properties(core.WindowProperties(title="scene2hap", cursor_hidden=True))
    game.disable_mouse()  # Panda3D's own mouse control
    while True:
        middle_x, middle_y = window.get_x_size() // 2, window.get_y_size() // 2
        pointer, is_down = window.get_pointer(0), game.mouseWatcherNode.is_button_down
        if window.get_properties().foreground and window.move_pointer(0, middle_x, middle_y):
            h, p, _ = walker.eyes.get_hpr()
            h -= DEGREES_PER_PIXEL * (pointer.get_x() - middle_x)
            walker.eyes.set_hpr(h, min(max(p - DEGREES_PER_PIXEL * (pointer.get_y() - middle_y), -85), 85), 0)
        for key, (right, forward) in STEPS.items():
            if is_down(core.KeyboardButton.ascii_key(key)):
                way_m = SPEED_M_S * clock.dt
                walker.walk(right * way_m, forward * way_m)
        yield [hand for hand, button in HANDS.items() if is_down(button)]


def script(walker: Walker) -> Iterator[list[str]]:
    """Walk along the route. Yields the hands that reach out, once per frame."""
    for stand, target, hand in ROUTE:
        walker.eyes.set_p(0)
        while (way := core.Vec2(*stand) - walker.eyes.get_pos().xy).length() > 0.01:
            walker.eyes.set_h(math.degrees(math.atan2(-way.x, way.y)))
            walker.walk(0.0, min(way.length(), SPEED_M_S * clock.dt))
            yield []
        walker.eyes.look_at(walker.render, *target)
        until_s = clock.frame_time + 2.0
        while clock.frame_time < until_s:
            yield [hand]
    while True:
        yield []


def play(arguments: argparse.Namespace, has_window: bool) -> None:
    """Bake the room, and play until Escape or until the time is over."""
    quiet = "audio-library-name null\nnotify-level-device fatal\nwin-size 960 600\nwindow-title scene2hap"
    core.load_prc_file_data("", quiet)
    if not has_window:  # as fast as it goes, and the same in every run
        clock.mode, clock.dt = core.ClockObject.M_non_real_time, 1 / HEADLESS_FPS
    game = ShowBase(windowType="onscreen" if has_window else "none")
    furnish(game.render)
    scene = snapshot(game.render, name="room")
    walker = Walker(game.render, scene)
    player = person(game, walker) if has_window else script(walker)
    if has_window:
        game.camera.reparent_to(walker.eyes)
        game.camLens.set_near_far(0.05, 50)
        game.set_background_color(0.6, 0.65, 0.7)
        text = OnscreenText("+", mayChange=True, fg=(1, 1, 1, 1), shadow=(0, 0, 0, 1))
        game.accept("escape", game.task_mgr.stop)

    output = arguments.output or (None if has_window else "walk.wav")
    sink = WavSink(output) if output else "soundcard"
    with HapticSession(scene, bake(scene), sink=sink) as session:
        link, told = Panda3DLink(game.render, session), ""

        def feel(task: Any) -> int:  # once per frame, before it is drawn
            nonlocal told
            touches = walker.touches(next(player), link)
            if isinstance(sink, WavSink):
                sink.pull_s(clock.dt)  # before the update, since frames in a window are of unequal length
            frame = link.update(touches)
            line = "; ".join(f"{one.hand} hand on {one.object_id}" for one in touches) or "nothing touched"
            if line != told:
                told = line
                gains = {key: max(frame.gain(hand, key) for hand in frame.hands) for key in frame.sources}
                felt = [f"{gain:.2f} of {key}" for key, gain in gains.items() if gain > 0.001]
                print(f"at {clock.frame_time:.2f} s: {line}", f"({', '.join(felt)})" if felt else "")
                if has_window:
                    text.setText(f"+\n\n{line}")
            if not has_window and clock.frame_time >= arguments.seconds:
                game.task_mgr.stop()
            return task.cont

        game.task_mgr.add(feel, "feel", sort=10)
        game.run()
    if arguments.picture:
        photograph(walker.eyes, arguments.picture)
    if output:
        print(f"wrote {output}")


def photograph(eyes: core.NodePath, png: str) -> None:
    """Save the view of the camera, by Panda3D's software renderer, which needs no display."""
    pipe = core.GraphicsPipeSelection.get_global_ptr().make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
    wanted, size = core.FrameBufferProperties.get_default(), core.WindowProperties.size(960, 600)
    engine, flags = core.GraphicsEngine.get_global_ptr(), core.GraphicsPipe.BF_refuse_window
    buffer = engine.make_output(pipe, "picture", 0, wanted, size, flags)
    buffer.set_clear_color((0.6, 0.65, 0.7, 1))
    lens = core.PerspectiveLens(75, 50)
    lens.set_near_far(0.05, 50)
    buffer.make_display_region().set_camera(eyes.attach_new_node(core.Camera("camera", lens)))
    engine.render_frame()
    buffer.save_screenshot(core.Filename.from_os_specific(png))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--headless", action="store_true", help="no window and no sound card: a scripted walk")
    parser.add_argument("--seconds", type=float, default=16.0, help="length of the scripted walk (16)")
    parser.add_argument("-o", "--output", metavar="OUT.wav", help="write a WAV in the place of the sound card")
    parser.add_argument("--picture", metavar="OUT.png", help="save what the walker sees at the end")
    given = parser.parse_args()
    play(given, not given.headless and (sys.platform in ("win32", "darwin") or bool(os.environ.get("DISPLAY"))))
