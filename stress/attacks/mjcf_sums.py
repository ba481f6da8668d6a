"""MJCF files whose rows are small but add up to large totals."""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from stress.attacks.scene_files import Files, _png

Case = Callable[[random.Random], Files]

_BALL = '<body><freejoint/><geom size="1"/></body>'


def _mjcf(inside: str = "", assets: str = "", before: str = "") -> Files:
    box = '<geom type="box" size="1 1 1"/>'
    text = f"<mujoco>{before}<asset>{assets}</asset><worldbody>{box}{inside}</worldbody></mujoco>"
    return {"case.xml": text.encode()}


def _obj(n_vertices: int, n_faces: int, rng: random.Random) -> bytes:
    vertices = []
    for _ in range(n_vertices):
        x, y, z = (rng.gauss(0, 1) for _ in range(3))
        length = math.sqrt(x * x + y * y + z * z)
        vertices.append(f"v {x / length:.4f} {y / length:.4f} {z / length:.4f}\n")
    faces = (f"f {i} {i + 1} {i + 2}\n" for i in range(1, n_faces + 1))
    return ("".join(vertices) + "".join(faces)).encode()


def height_field(rng: random.Random) -> Files:
    """A height field that is declared without data."""
    return _mjcf('<geom type="hfield" hfield="h"/>', '<hfield name="h" nrow="5000" ncol="5000" size="1 1 1 1"/>')


def height_field_shared(rng: random.Random) -> Files:
    """A field in thousands of geoms."""
    geoms = "".join(f'<geom type="hfield" hfield="h" pos="{i} 0 0"/>' for i in range(3000))
    return _mjcf(geoms, '<hfield name="h" nrow="1000" ncol="1000" size="1 1 1 1"/>')


def height_field_in_defaults(rng: random.Random) -> Files:
    """A height field that only a default class names, in copies."""
    before = '<default><default class="c"><geom type="hfield" hfield="h"/></default></default>'
    inside = '<replicate count="900" offset="1 0 0"><geom class="c"/></replicate>'
    return _mjcf(inside, '<hfield name="h" nrow="400" ncol="400" size="1 1 1 1"/>', before)


def height_field_pictures(rng: random.Random) -> Files:
    """Pictures as height fields."""
    row = '<hfield name="h{}" file="a.png" size="1 1 1 1"/>'
    geoms = "".join(f'<geom type="hfield" hfield="h{i}"/>' for i in range(4))
    return _mjcf(geoms, "".join(map(row.format, range(4)))) | {"a.png": _png(2000)}


def one_file_in_many_meshes(rng: random.Random) -> Files:
    """A mesh file that MuJoCo decodes for each of its scales."""
    meshes = "".join(f'<mesh name="m{i}" file="m.obj" scale="1 1 {1 + i}"/>' for i in range(3000))
    geoms = "".join(f'<geom type="mesh" mesh="m{i}"/>' for i in range(3000))
    return _mjcf(geoms, meshes) | {"m.obj": _obj(2000, 1990, rng)}


def one_mesh_in_many_geoms(rng: random.Random) -> Files:
    """A mesh that thousands of geoms draw, in one body or in many."""
    around = rng.choice(["{}", "<body>{}</body>"])
    geoms = "".join(around.format(f'<geom type="mesh" mesh="m" pos="{i} 0 0"/>') for i in range(3000))
    return _mjcf(geoms, '<mesh name="m" file="m.obj"/>') | {"m.obj": _obj(5000, 40_000, rng)[: 1 << 20]}


def one_mesh_in_copies(rng: random.Random) -> Files:
    """One mesh that a replicated body draws."""
    inside = '<replicate count="2000" offset="1 0 0"><body><geom type="mesh" mesh="m"/></body></replicate>'
    return _mjcf(inside, '<mesh name="m" file="m.obj"/>') | {"m.obj": _obj(5000, 40_000, rng)}


def mesh_fitted(rng: random.Random) -> Files:
    """Boxes that are fitted to a mesh, thousands of them."""
    geoms = "".join(f'<geom type="box" mesh="m" pos="{i} 0 0"/>' for i in range(3000))
    return _mjcf(geoms, '<mesh name="m" file="m.obj"/>') | {"m.obj": _obj(3000, 2990, rng)}


def built_in_meshes(rng: random.Random) -> Files:
    """Thousands of generated spheres."""
    rows = "".join(f'<mesh name="m{i}" builtin="sphere" params="4"/>' for i in range(2001))
    return _mjcf('<geom type="mesh" mesh="m0"/>', rows)


def built_in_meshes_of_all_kinds(rng: random.Random) -> Files:
    """Generated meshes of the largest size."""
    kinds = ['"plate" params="200 200"', '"supersphere" params="200 1 1"', '"supertorus" params="200 0.5 1 1"']
    rows = "".join(f'<mesh name="m{i}" builtin={kinds[i % 3]}/>' for i in range(60))
    return _mjcf('<geom type="mesh" mesh="m0"/>', rows)


def bodies(rng: random.Random) -> Files:
    """A very large number of free balls."""
    return _mjcf(_BALL * 18_000)


def geoms_of_the_world(rng: random.Random) -> Files:
    """Geoms that are each an object."""
    return _mjcf("".join(f'<geom size="{1 + i / 1000}" pos="{3 * i} 0 0"/>' for i in range(15_000)))


def distinct_bodies(rng: random.Random) -> Files:
    """Almost the largest accepted number of bodies, all of different shapes."""
    shapes = ('type="box" size="{0} 1 1"', 'type="ellipsoid" size="{0} 1 2"', 'type="capsule" size="{0} 1"')
    rows = (f'<body pos="{3 * i} 0 0"><geom {shapes[i % 3].format(1 + i / 1000)}/></body>' for i in range(3900))
    return _mjcf("".join(rows))


def geoms_of_one_body(rng: random.Random) -> Files:
    """A body of as many spheres as fit."""
    return _mjcf("<body>" + "".join(f'<geom size="1" pos="{i} 0 0"/>' for i in range(25_000)) + "</body>")


def joints(rng: random.Random) -> Files:
    """Chains of joints, whose mass matrix grows with the square of the length."""
    chain = "<body>" + '<joint type="slide"/>' * 5 + '<geom size="1"/>'
    return _mjcf((chain * 190 + "</body>" * 190) * 18)


def numbers(rng: random.Random) -> Files:
    """Custom numbers with a declared size but without values."""
    return _mjcf(before=f'<custom><numeric name="n" size="{rng.choice([500_000_000, 2_000_000_000])}"/></custom>')


def sensors(rng: random.Random) -> Files:
    """A sensor of up to 2e9 numbers."""
    return _mjcf(before=f'<sensor><user dim="{rng.choice([200_000_000, 2_000_000_000])}"/></sensor>')


def delays(rng: random.Random) -> Files:
    """A sensor with a very long history."""
    row = '<clock nsample="300000000" delay="1" interp="linear"/>'
    return _mjcf(before=f"<sensor>{row}</sensor>")


def key_frames(rng: random.Random) -> Files:
    """Key frames of thousands of balls."""
    return _mjcf(_BALL * 3000, before=f"<keyframe>{'<key/>' * 15_000}</keyframe>")


def user_data(rng: random.Random) -> Files:
    """User data of every geom, as many numbers as in the longest row."""
    geoms = "".join(f'<geom size="1" pos="{i} 0 0"/>' for i in range(3800))
    return _mjcf(geoms + f'<geom size="1" user="{"1 " * 150_000}"/>')


def tendons(rng: random.Random) -> Files:
    """Tendons through thousands of sites."""
    sites = "".join(f'<site name="s{i}"/>' for i in range(5000))
    rows = "".join(f'<site site="s{i}"/>' for i in range(5000))
    return _mjcf(sites, before=f"<tendon>{f'<spatial>{rows}</spatial>' * 4}</tendon>")


def equalities(rng: random.Random) -> Files:
    """Balls that are all connected to one ball."""
    balls = "".join(f'<body name="b{i}" pos="{3 * i} 0 0"><freejoint/><geom size="1"/></body>' for i in range(2000))
    rows = "".join(f'<connect body1="b{i % 2000}" body2="b0" anchor="0 0 0"/>' for i in range(1, 8000))
    return _mjcf(balls, before=f"<equality>{rows}</equality>")


def included_files(rng: random.Random) -> Files:
    """More files than an author would write."""
    files = {
        f"f{i}.xml": f'<mujoco><worldbody><geom size="1" pos="{i} 0 0"/></worldbody></mujoco>' for i in range(3000)
    }
    rows = "".join(f'<include file="{name}"/>' for name in files)
    text = f'<mujoco>{rows}<worldbody><geom size="1"/></worldbody></mujoco>'
    return {"case.xml": text.encode(), **{name: body.encode() for name, body in files.items()}}


def skin_of_numbers(rng: random.Random) -> Files:
    """A deformable skin that no geom draws."""
    vertex = " ".join(f"{rng.random():.3f}" for _ in range(60_000))
    face = " ".join(str(rng.randrange(20_000)) for _ in range(60_000))
    bone = '<bone body="world" bindpos="0 0 0" bindquat="1 0 0 0" vertid="0" vertweight="1"/>'
    return _mjcf(before=f'<deformable><skin name="s" vertex="{vertex}" face="{face}">{bone}</skin></deformable>')


def cable(rng: random.Random) -> Files:
    """A composite of almost the largest accepted number of bodies."""
    joint = '<joint kind="main" damping="1"/><geom type="capsule" size=".01"/>'
    return _mjcf(f'<composite type="cable" curve="s" count="3900 1 1" size="1">{joint}</composite>')


def flexes(rng: random.Random) -> Files:
    """Grids that bend, each of hundreds of bodies."""
    row = '<flexcomp name="f{}" type="grid" dim="2" count="30 30 1" spacing="1 1 1" mass="1" radius="0.1"/>'
    return _mjcf("".join(map(row.format, range(10))))


def custom_texture(rng: random.Random) -> Files:
    """Files of MuJoCo's own formats with wrong counts."""
    texture = '<texture name="t" type="2d" content_type="image/vnd.mujoco.texture" file="t.bin"/>'
    mesh = '<mesh name="m" file="m.stl"/>'
    data = {"t.bin": struct.pack("<ii", 30_000, 30_000), "m.stl": bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(99)}
    return _mjcf(assets=rng.choice([texture, mesh])) | data


def texture_sides(rng: random.Random) -> Files:
    """Cubes of six pictures each."""
    sides = " ".join(f'file{side}="a.png"' for side in ("right", "left", "up", "down", "front", "back"))
    return _mjcf(assets="".join(f'<texture name="t{i}" type="cube" {sides}/>' for i in range(40))) | {
        "a.png": _png(1500)
    }


CASES: tuple[Case, ...] = (
    height_field,
    height_field_shared,
    height_field_in_defaults,
    height_field_pictures,
    one_file_in_many_meshes,
    one_mesh_in_many_geoms,
    one_mesh_in_copies,
    mesh_fitted,
    built_in_meshes,
    built_in_meshes_of_all_kinds,
    bodies,
    geoms_of_the_world,
    distinct_bodies,
    geoms_of_one_body,
    joints,
    numbers,
    sensors,
    delays,
    key_frames,
    user_data,
    tendons,
    equalities,
    included_files,
    skin_of_numbers,
    cable,
    flexes,
    custom_texture,
    texture_sides,
)
