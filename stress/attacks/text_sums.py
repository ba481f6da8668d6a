"""Files in OBJ, STL, PLY and COLLADA whose rows are small but add up to large totals."""

from __future__ import annotations

import random
import struct
import zlib
from collections.abc import Callable

from stress.attacks.scene_files import Files, _dae, _png

Case = Callable[[random.Random], Files]

_MB = 1 << 20
_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
_XYZ = "property float x\nproperty float y\nproperty float z\n"
_FACES = "property list uchar int vertex_indices\n"
_DRAWN = '<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>'
_INSTANCE = '<instance_geometry url="#g"/>'


# -- OBJ -------------------------------------------------------------------------------------------------------------


def obj_libraries(rng: random.Random) -> Files:
    """A hundred thousand libraries in one line."""
    names = " ".join(f"a{i}.mtl" for i in range(100_000))
    return {"case.obj": f"{_TRIANGLE}mtllib {names}\nf 1 2 3\n".encode()}


def obj_libraries_that_are_there(rng: random.Random) -> Files:
    """Thousands of existing libraries of one material each."""
    files = {f"a{i}.mtl": f"newmtl m{i}\nKd 1 0 0\n".encode() for i in range(3000)}
    lines = "".join(f"mtllib a{i}.mtl\n" for i in range(3000))
    return {"case.obj": f"{lines}{_TRIANGLE}usemtl m1\nf 1 2 3\n".encode(), **files}


def obj_tetrahedra(rng: random.Random) -> Files:
    """Objects of four triangles, all of different sizes."""
    rows = []
    for i in range(3990):
        rows.append(f"o thing{i}\nv {i} 0 0\nv {i + rng.random():.4f} 0 0\nv {i} {rng.random():.4f} 0\n")
        rows.append(f"v {i} 0 {rng.random():.4f}\nf -4 -3 -2\nf -4 -3 -1\nf -4 -2 -1\nf -3 -2 -1\n")
    return {"case.obj": "".join(rows).encode()}


def obj_materials(rng: random.Random) -> Files:
    """An object of as many materials as fit, each with its own texture transform."""
    n = 12_000
    faces = "".join(f"usemtl m{i}\nf 1/1 2/1 3/1\n" for i in range(n))
    rows = "".join(f"newmtl m{i}\nmap_Kd -s {i} 1 1 a.png\n" for i in range(n))
    return {
        "case.obj": f"mtllib a.mtl\n{_TRIANGLE}vt 0 0\n{faces}".encode(),
        "a.mtl": rows.encode(),
        "a.png": _png(8),
    }


def obj_numbers(rng: random.Random) -> Files:
    """Numbers of every size, in polygons of a thousand corners."""
    numbers = ["1e308", "-1e308", "1e-320", "0x1", "1_0", "nan", "inf", "1", "2", "3"]
    rows = [f"v {rng.choice(numbers)} {rng.choice(numbers[6:])} 0\n" for _ in range(1000)]
    return {"case.obj": ("".join(rows) + ("f " + " ".join(map(str, range(1, 1001))) + "\n") * 200).encode()}


def obj_slashes(rng: random.Random) -> Files:
    """Corners that consist of slashes only."""
    return {"case.obj": (_TRIANGLE + "vt 0 0\n" + "f 1" + "/" * 300_000 + " 2/1" + "/1" * 300_000 + " 3\n").encode()}


def obj_long_line(rng: random.Random) -> Files:
    """A face of a megabyte that is wrong in its last corner."""
    return {"case.obj": (_TRIANGLE + "f " + "1 2 3 " * 170_000 + "9\n").encode()}


def mtl_names(rng: random.Random) -> Files:
    """Materials with names of hundreds of kilobytes."""
    name = "wood " * 60_000
    return {
        "case.obj": f"mtllib a.mtl\n{_TRIANGLE}usemtl {name}\nf 1 2 3\n".encode(),
        "a.mtl": f"newmtl {name}\nKd 1 0 0\nmap_Kd {name}\n".encode(),
    }


# -- STL, PLY --------------------------------------------------------------------------------------------------------


def _facet(z: float) -> str:
    return f"facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"


def stl_solids(rng: random.Random) -> Files:
    """Solids of one triangle and one name."""
    solid = f"solid a\n{_facet(0)}endsolid a\n"
    return {"case.stl": (solid * (_MB // len(solid))).encode()}


def stl_named_solids(rng: random.Random) -> Files:
    """Solids of one triangle, all with different names."""
    return {"case.stl": "".join(f"solid s{i}\n{_facet(i)}endsolid s{i}\n" for i in range(9000)).encode()}


def stl_words(rng: random.Random) -> Files:
    """One keyword of STL, repeated."""
    return {"case.stl": rng.choice([b"solid ", b"solid\n", b"solid solid endsolid\n", b"vertex "]) * 160_000}


def stl_blanks(rng: random.Random) -> Files:
    """A solid behind a megabyte of blanks."""
    return {"case.stl": b"solid" + rng.choice([b" ", b"\n", b"\t\r\n"]) * 400_000 + _facet(0).encode()}


def stl_needles(rng: random.Random) -> Files:
    """Long thin triangles that all cross."""
    rows = []
    for _ in range(20_000):
        a, b = ([rng.uniform(-1, 1) for _ in range(3)] for _ in range(2))
        rows.append(struct.pack("<12fH", 0, 0, 1, *a, *b, *(c + 1e-7 for c in b), 0xFFFF))
    return {"case.stl": bytes(80) + struct.pack("<I", len(rows)) + b"".join(rows)}


def ply_lists(rng: random.Random) -> Files:
    """Faces of every number of corners, written as text."""
    faces = "".join(
        f"{k} {' '.join(rng.choice('012') for _ in range(k))}\n" for k in (rng.randrange(0, 9) for _ in range(60_000))
    )
    head = f"ply\nformat ascii 1.0\nelement vertex 3\n{_XYZ}element face 60000\n{_FACES}end_header\n"
    return {"case.ply": (head + "0 0 0\n1 0 0\n0 1 0\n" + faces).encode()}


def ply_elements(rng: random.Random) -> Files:
    """As many elements as fit, each of lists."""
    rows = "".join(f"element e{i} 1\nproperty list uint uint x\n" for i in range(15_000))
    head = f"ply\nformat binary_little_endian 1.0\n{rows}end_header\n"
    return {"case.ply": head.encode() + bytes(4 * 15_000)}


def ply_wide(rng: random.Random) -> Files:
    """A vertex with as many properties as fit, as text."""
    n = 30_000
    head = "ply\nformat ascii 1.0\nelement vertex 3\n" + _XYZ + "".join(f"property float p{i}\n" for i in range(n))
    row = "0 " * (n + 3) + "\n"
    faces = f"element face 1\n{_FACES}end_header\n"
    return {"case.ply": (head + faces + row * 3 + "3 0 1 2\n").encode()}


def ply_colours(rng: random.Random) -> Files:
    """Coloured vertices, some of whose coordinates are NaN."""
    n = 40_000
    head = (
        f"ply\nformat binary_big_endian 1.0\nelement vertex {n}\n{_XYZ}property uchar red\nproperty uchar green\n"
        f"property uchar blue\nelement face {n}\n{_FACES}end_header\n"
    )
    vertex = b"".join(struct.pack(">3f3B", rng.choice([0, 1, float("nan")]), i % 7, i % 11, 1, 2, 3) for i in range(n))
    face = b"".join(struct.pack(">B3i", 3, i, (i + 1) % n, (i + 2) % n) for i in range(n))
    return {"case.ply": head.encode() + vertex + face}


def ply_one_list(rng: random.Random) -> Files:
    """One face with the largest number of corners."""
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex 3\n{_XYZ}element face 1\n"
        "property list uint int vertex_indices\nend_header\n"
    )
    body = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<I", rng.choice([2**32 - 1, 2**30, 250_000]))
    return {"case.ply": head.encode() + body + bytes(_MB)}


# -- COLLADA ---------------------------------------------------------------------------------------------------------


def dae_polygons_drawn_again(rng: random.Random) -> Files:
    """A mesh of polygons that is drawn by thousands of nodes and triangulated again for each."""
    n = 60_000
    polygons = (
        f'<polylist count="{n}"><input semantic="VERTEX" source="#v" offset="0"/><vcount>{"3 " * n}</vcount>'
        f"<p>{'0 1 2 ' * n}</p></polylist>"
    )
    return {"case.dae": _dae(f"<node>{_INSTANCE}</node>" * 9000).replace(_DRAWN, polygons).encode()}


def dae_inputs(rng: random.Random) -> Files:
    """Triangles with as many inputs as fit."""
    inputs = "".join(f'<input semantic="TEXCOORD" source="#p" offset="0" set="{i}"/>' for i in range(12_000))
    return {"case.dae": _dae().replace('offset="0"/><p>', f'offset="0"/>{inputs}<p>').encode()}


def dae_sets_shared(rng: random.Random) -> Files:
    """Many sets of texture coordinates for many triangles."""
    inputs = "".join(f'<input semantic="TEXCOORD" source="#p" offset="0" set="{i}"/>' for i in range(3000))
    triangles = _DRAWN.replace('offset="0"/><p>', f'offset="0"/>{inputs}<p>')
    triangles = triangles.replace('count="1"', 'count="40000"').replace("0 1 2", "0 1 2 " * 40_000)
    return {"case.dae": _dae().replace(_DRAWN, triangles).encode()}


def dae_transforms(rng: random.Random) -> Files:
    """A node with thousands of rotations, scales and views."""
    steps = "<rotate>0 0 1 1</rotate><scale>1 1 1</scale><lookat>0 0 1 0 0 0 0 1 0</lookat>" * 9000
    return {"case.dae": _dae(f'<node id="n">{steps}{_INSTANCE}</node>').encode()}


def dae_effects(rng: random.Random) -> Files:
    """An effect of as many parameters as fit."""
    rows = "".join(
        f'<newparam sid="s{i}"><surface type="2D"><init_from>i{i}</init_from></surface></newparam>'
        f'<newparam sid="t{i}"><sampler2D><source>s{i}</source></sampler2D></newparam>'
        for i in range(4500)
    )
    images = "".join(f'<image id="i{i}"><init_from>a{i}.png</init_from></image>' for i in range(4500))
    effect = f'<effect id="e"><profile_COMMON>{rows}<technique sid="t"><lambert/></technique></profile_COMMON></effect>'
    more = f"<library_images>{images}</library_images><library_effects>{effect}</library_effects>"
    return {"case.dae": _dae(more=more).encode()}


def dae_bound_materials(rng: random.Random) -> Files:
    """Nodes that each bind as many materials as fit."""
    effect = '<effect id="e"><profile_COMMON><technique sid="t"><lambert/></technique></profile_COMMON></effect>'
    more = (
        f'<library_effects>{effect}</library_effects><library_materials><material id="m"><instance_effect url="#e"/>'
        "</material></library_materials>"
    )
    bound = "".join(f'<instance_material symbol="s{i}" target="#m"/>' for i in range(15_000))
    bind = f"<bind_material><technique_common>{bound}</technique_common></bind_material>"
    drawn = f'<instance_geometry url="#g">{bind}</instance_geometry>'
    return {"case.dae": _dae(f"<node>{drawn}</node>", more).encode()}


def dae_wide_tree(rng: random.Random) -> Files:
    """A node that instances one node of many children thousands of times."""
    library = f'<library_nodes><node id="l">{f"<node>{_INSTANCE}</node>" * 1000}</node></library_nodes>'
    return {"case.dae": _dae('<node id="r">' + '<instance_node url="#l"/>' * 15_000 + "</node>", library).encode()}


def dae_numbers(rng: random.Random) -> Files:
    """Indices and numbers of every size."""
    count = rng.choice(["-1", "2147483648", "99999999999999999999", "0.5", "nan", "1e9"])
    text = _dae().replace("0 1 2", f"0 1 {count}").replace("1 0 0 0 1 0", f"{count} nan 1e400 -inf 1 0")
    return {"case.dae": text.encode()}


def dae_packed(rng: random.Random) -> Files:
    """Compressed text in a file with the suffix of plain text."""
    return {"case.dae": zlib.compress(b"<COLLADA>" + bytes(300 * _MB), 9)}


CASES: tuple[Case, ...] = (
    obj_libraries,
    obj_libraries_that_are_there,
    obj_tetrahedra,
    obj_materials,
    obj_numbers,
    obj_slashes,
    obj_long_line,
    mtl_names,
    stl_solids,
    stl_named_solids,
    stl_words,
    stl_blanks,
    stl_needles,
    ply_lists,
    ply_elements,
    ply_wide,
    ply_colours,
    ply_one_list,
    dae_polygons_drawn_again,
    dae_inputs,
    dae_sets_shared,
    dae_transforms,
    dae_effects,
    dae_bound_materials,
    dae_wide_tree,
    dae_numbers,
    dae_packed,
)
