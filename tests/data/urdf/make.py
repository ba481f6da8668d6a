"""Write laundry.urdf with its meshes, by yourdfpy, and laundry.glb with the same links at the poses of yourdfpy.

python make.py FOLDER    (needs yourdfpy 0.0.60 and trimesh)
"""

import sys
from pathlib import Path

import numpy as np
import trimesh
from trimesh.transformations import euler_matrix, translation_matrix
from yourdfpy import URDF
from yourdfpy.urdf import (
    Box,
    Collision,
    Color,
    Geometry,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Robot,
    Visual,
)

folder = Path(sys.argv[1])
(folder / "meshes").mkdir(parents=True, exist_ok=True)
SHAPES = {
    "carcass.stl": trimesh.creation.annulus(0.2, 0.3, 0.5, sections=8),
    "door.obj": trimesh.creation.icosahedron().apply_scale((0.2, 0.02, 0.3)),
    "drum.dae": trimesh.creation.cylinder(0.2, 0.3, sections=12),
    "sheet.ply": trimesh.Trimesh([[0, 0, 0], [0.4, 0, 0], [0.4, 0.3, 0], [0, 0.3, 0]], [[0, 1, 2], [0, 2, 3]]),
}
for name, mesh in SHAPES.items():
    mesh.export(folder / "meshes" / name)


def turned(x: float, y: float, z: float, *angles: float) -> np.ndarray:
    return translation_matrix((x, y, z)) @ (euler_matrix(*angles, axes="sxyz") if angles else np.eye(4))


def visual(shape: str | tuple[float, ...], origin=None, colour=None, scale=None) -> Visual:
    if isinstance(shape, tuple):
        geometry = Geometry(box=Box(size=np.array(shape)))
    else:
        geometry = Geometry(mesh=Mesh(filename=f"package://laundry/meshes/{shape}", scale=scale))
    material = None if colour is None else Material(name=colour[0], color=Color(rgba=np.array(colour[1])))
    return Visual(name=None, origin=origin, geometry=geometry, material=material)


STEEL, OAK = ("steel", (0.8, 0.8, 0.9, 1.0)), ("oak", (0.6, 0.4, 0.2, 1.0))


def link(name: str, mass_kg: float | None, *visuals: Visual) -> Link:
    inertial = None if mass_kg is None else Inertial(origin=np.eye(4), mass=mass_kg, inertia=np.eye(3))
    # Larger than the visuals, and no part of the object.
    hull = Collision(name=None, origin=None, geometry=Geometry(box=Box(size=np.array([2.0, 2.0, 2.0]))))
    return Link(name=name, inertial=inertial, visuals=list(visuals), collisions=[hull] if visuals else [])


def joint(kind: str, parent: str, child: str, origin: np.ndarray) -> Joint:
    moves = kind in ("revolute", "prismatic")
    limit = Limit(effort=1.0, velocity=1.0, lower=-1.0, upper=1.0) if moves else None
    axis = np.array([0.0, 0.0, 1.0]) if moves else None
    return Joint(f"{parent}_to_{child}", kind, parent, child, origin=origin, axis=axis, limit=limit)


robot = Robot(name="laundry")
robot.links = [
    link("base", None),
    link("floor", None, visual((3.0, 2.0, 0.1), turned(0.0, 0.0, -0.05), OAK)),
    link(
        "washing_machine",
        62.5,
        visual((0.6, 0.6, 0.85), None, STEEL),
        visual("drum.dae", turned(0.0, -0.1, 0.0, 1.2, 0.0, 0.0)),
    ),
    link(
        "machine_door", 2.0, visual("door.obj", turned(0.2, 0.0, 0.0, 0.0, 0.0, 0.3), STEEL, np.array([1.0, 1.5, 1.0]))
    ),
    link("stool", 3.5, visual("carcass.stl", turned(0.0, 0.0, 0.25), OAK)),
    link("towel", 0.4, visual("sheet.ply", turned(0.0, 0.0, 0.001))),
]
robot.joints = [
    joint("fixed", "base", "floor", np.eye(4)),
    joint("fixed", "floor", "washing_machine", turned(0.5, 0.3, 0.425, 0.0, 0.0, 0.4)),
    joint("revolute", "washing_machine", "machine_door", turned(-0.2, -0.33, 0.05, 0.1, -0.2, 0.3)),
    joint("fixed", "base", "stool", turned(-0.8, 0.2, 0.0, 0.0, 0.0, 1.0)),
    joint("prismatic", "stool", "towel", turned(-0.1, 0.0, 0.5, 0.0, 0.0, -0.5)),
]
written = URDF(robot=robot, build_scene_graph=False, load_meshes=False)
written.write_xml_file(str(folder / "laundry.urdf"))

read = URDF.load(str(folder / "laundry.urdf"), load_meshes=False)
scene = trimesh.Scene()
for row in robot.links:
    parts = []
    for drawn in row.visuals:
        box, mesh = drawn.geometry.box, drawn.geometry.mesh
        if box is not None:
            part = trimesh.creation.box(box.size)
        else:
            part = SHAPES[Path(mesh.filename).name].copy()
            part.apply_scale(np.ones(3) if mesh.scale is None else mesh.scale)
        part.apply_transform(np.eye(4) if drawn.origin is None else drawn.origin)
        part.visual = trimesh.visual.ColorVisuals()
        parts.append(part)
    if parts:
        transform = read.get_transform(row.name, "base")
        scene.add_geometry(trimesh.util.concatenate(parts), node_name=row.name, geom_name=row.name, transform=transform)
scene.export(folder / "laundry.glb")
print(len(scene.geometry), "links")
