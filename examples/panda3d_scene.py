"""A Panda3D scene that is felt: a fan and a phone on furniture, and the phone is carried from one to the other.

    python examples/panda3d_scene.py -o panda3d.wav

The left hand rests on the table and feels the phone until it is taken away, the right hand rests on the shelf. No
window is opened: any NodePath tree will do, `render` of a running game as well. Needs: pip install 'scene2hap[panda3d]'
"""

import argparse

import numpy as np
from panda3d import core

from scene2hap import HapticSession, Touch, WavSink, bake
from scene2hap.engines import Panda3DLink
from scene2hap.scene.engines.panda3d import snapshot

FRAMES_PER_SECOND = 50
Vector = tuple[float, float, float]


def box(parent: core.NodePath, name: str, size_m: Vector, at_m: Vector) -> core.NodePath:
    """A cuboid that stands on its node's origin."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (0.0, 1.0)]) * size_m
    data = core.GeomVertexData(name, core.GeomVertexFormat.get_v3(), core.Geom.UH_static)
    writer = core.GeomVertexWriter(data, "vertex")
    for corner in corners.tolist():
        writer.add_data3(*corner)
    triangles = core.GeomTriangles(core.Geom.UH_static)
    for a, b, c, d in [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]:
        triangles.add_vertices(a, b, c)
        triangles.add_vertices(a, c, d)
    geom = core.Geom(data)
    geom.add_primitive(triangles)
    node = core.GeomNode(name)
    node.add_geom(geom)
    path = parent.attach_new_node(node)
    path.set_pos(*at_m)
    return path


def furnish() -> core.NodePath:
    """Table, shelf, fan and phone on a floor; z is up, units are metres."""
    render = core.NodePath("render")
    box(render, "floor", (4.0, 3.0, 0.1), (0.0, 0.0, 0.0))
    # Pieces whose names begin with that of the node above them are one object with it.
    table = render.attach_new_node("wooden table")
    table.set_z(0.1)
    for x, y in [(-0.7, -0.3), (-0.7, 0.3), (0.7, -0.3), (0.7, 0.3)]:
        box(table, "wooden table leg", (0.06, 0.06, 0.7), (x, y, 0.0))
    box(table, "wooden table top", (1.5, 0.7, 0.03), (0.0, 0.0, 0.7))
    box(render, "shelf", (0.8, 0.3, 0.02), (1.4, 0.0, 1.2))
    box(render, "desk fan", (0.25, 0.2, 0.35), (1.6, 0.0, 1.22))
    box(render, "smartphone", (0.07, 0.15, 0.008), (0.3, 0.0, 0.83)).set_h(30)
    return render


def main() -> None:
    """Read, bake, play."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", metavar="OUT.wav", required=True)
    output = parser.parse_args().output

    render = furnish()
    scene = snapshot(render, name="study")
    bundle = bake(scene)
    touches = [Touch("left", "wooden table", (0.5, 0.1, 0.83)), Touch("right", "shelf", (1.2, 0.1, 1.22))]
    sink = WavSink(output)
    with HapticSession(scene, bundle, sink=sink) as session:
        link = Panda3DLink(render, session)
        for i in range(2 * FRAMES_PER_SECOND):
            if i == FRAMES_PER_SECOND:
                render.find("**/smartphone").set_pos(1.2, 0, 1.22)
            frame = link.update(touches)
            sink.pull_s(1 / FRAMES_PER_SECOND)
            if i % FRAMES_PER_SECOND == 0:
                felt = {hand: {key: round(frame.gain(hand, key), 3) for key in frame.sources} for hand in frame.hands}
                print(f"at {i / FRAMES_PER_SECOND:.0f} s: {felt}")
    print(f"wrote {output}")


if __name__ == "__main__":
    main()
