"""Scene files: few bytes that expand to large totals, and small valid files broken at random."""

from __future__ import annotations

import base64
import itertools
import json
import random
import struct
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from stress.attacks.attack import Attack
from stress.fuzz_scenes import MUTATIONS, seeds

_MB = 1 << 20
Files = dict[str, bytes]
"""Contents by file name; the first file is the scene."""


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by decompression bombs and by mutated files, in turn. Without end."""
    originals = {**seeds(), ".dae": _dae().encode(), ".xml": _mjcf("").encode()}
    for number in itertools.count():
        rng = random.Random(f"scene_files/{seed}/{number}")
        if number % 2 == 0:
            bomb = BOMBS[(number // 2) % len(BOMBS)] if number < 2 * len(BOMBS) else rng.choice(BOMBS)
            name, files = bomb.__name__, bomb(rng)
        else:
            suffix, mutation = rng.choice(list(originals)), rng.choice(MUTATIONS)
            data = originals[suffix]
            for _ in range(rng.choice([1, 1, 2])):
                data = mutation(data, rng) or b"\0"
            name, files = f"{mutation.__name__}{suffix}", {f"case{suffix}": data}
        folder = work / str(number)
        folder.mkdir()
        for file, data in files.items():
            (folder / file).write_bytes(data)
        yield Attack("scene_files", f"{number} {name}", ("scene2hap", "inspect", str(folder / next(iter(files)))))


# -- glTF ------------------------------------------------------------------------------------------------------------


def _gltf(data: bytes = b"", **tables: Any) -> Files:
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        **tables,
    }
    return {"case.gltf": json.dumps(document).encode()}


def _floats(n: int, rng: random.Random) -> bytes:
    return struct.pack(f"<{n}f", *(rng.uniform(-1, 1) for _ in range(n)))


def _vec3(count: int, **more: Any) -> dict[str, Any]:
    return {"type": "VEC3", "componentType": 5126, "count": count, **more}


def accessors_without_bytes(rng: random.Random) -> Files:
    """Accessors without data, each of which declares a large table of zeros."""
    n, count = rng.choice([1, 50, 2000]), rng.choice([10**5, 10**6, 10**7])
    primitives = [{"attributes": {"POSITION": i}} for i in range(n)]
    return _gltf(accessors=[_vec3(count)] * n, meshes=[{"primitives": primitives}])


def sparse_accessors(rng: random.Random) -> Files:
    """Large sparse tables, each with one stored value."""
    n = rng.choice([10, 500])
    sparse = {
        "count": 1,
        "indices": {"bufferView": 0, "componentType": 5121},
        "values": {"bufferView": 0},
    }
    rows = [_vec3(rng.choice([10**5, 9 * 10**6]), sparse=sparse) for _ in range(n)]
    primitives = [{"attributes": {"POSITION": i}} for i in range(n)]
    return _gltf(bytes(12), accessors=rows, meshes=[{"primitives": primitives}])


def shared_accessor(rng: random.Random) -> Files:
    """One table of vertices in thousands of primitives."""
    count = rng.choice([3, 3000, 30_000])
    rows = [_vec3(count, bufferView=0), {"type": "SCALAR", "componentType": 5121, "count": 3, "bufferView": 0}]
    primitive: dict[str, Any] = {"attributes": {"POSITION": 0}}
    if rng.random() < 0.5:
        primitive["indices"] = 1
    primitives = [primitive] * rng.choice([100, 8000])
    return _gltf(_floats(3 * count, rng), accessors=rows, meshes=[{"primitives": primitives}])


def overlapping_accessors(rng: random.Random) -> Files:
    """Many accessors of the same bytes."""
    count, n = 20_000, rng.choice([50, 3000])
    primitives = [{"attributes": {"POSITION": i}} for i in range(n)]
    rows = [_vec3(count, bufferView=0)] * n
    return _gltf(_floats(3 * count, rng), accessors=rows, meshes=[{"primitives": primitives}])


def instances(rng: random.Random) -> Files:
    """One mesh drawn by as many nodes as fit, apart or within one object."""
    count, n = rng.choice([3, 300, 30_000]), rng.choice([1000, 19_000, 40_000])
    nodes: list[dict[str, Any]] = [{"mesh": 0, "translation": [i, 0, 0]} for i in range(n)]
    more: dict[str, Any] = {}
    if rng.random() < 0.5:
        nodes.append({"name": "all", "children": list(range(n))})
        more = {"scenes": [{"nodes": [n]}]}
    return _gltf(_floats(3 * count, rng), accessors=[_vec3(count, bufferView=0)], nodes=nodes, **more)


def deep_nodes(rng: random.Random) -> Files:
    """A long chain of nodes, or a cycle."""
    n = rng.choice([150, 250, 20_000])
    nodes = [{"children": [i + 1]} for i in range(n)] + [{"mesh": 0}]
    if rng.random() < 0.3:
        nodes[-1] = {"children": [0]}
    return _gltf(_floats(9, rng), accessors=[_vec3(3, bufferView=0)], nodes=nodes, scenes=[{"nodes": [0]}])


def embedded_pictures(rng: random.Random) -> Files:
    """One picture under thousands of names."""
    png, n = _png(rng.choice([8, 4000, 9000])), rng.choice([10, 3000])
    vertices = _floats(9, rng)
    return _gltf(
        vertices + png + bytes(200_000),
        bufferViews=[
            {"buffer": 0, "byteLength": 36},
            *({"buffer": 0, "byteOffset": 36, "byteLength": len(png) + i} for i in range(n)),
        ],
        accessors=[_vec3(3, bufferView=0)],
        images=[{"bufferView": i + 1, "mimeType": "image/png"} for i in range(n)],
        textures=[{"source": i} for i in range(n)],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(n)],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": i} for i in range(n)]}],
    )


def meshopt_zeros(rng: random.Random) -> Files:
    """Packed views that unpack to many times their size, for one accessor or many."""
    n, count = rng.choice([1, 40, 1000]), 256 * rng.choice([1, 200, 30_000])
    # A block of 256 elements of zeros has four bytes of headers for each of 16 channels.
    data = b"\xa0" + bytes(64 * (count // 256) + 32)
    packed = {"buffer": 0, "byteLength": len(data), "byteStride": 16, "mode": "ATTRIBUTES", "count": count}
    view = {"buffer": 0, "byteLength": 16 * count, "byteStride": 16}
    return _gltf(
        data,
        bufferViews=[{**view, "extensions": {"EXT_meshopt_compression": packed}}] * n,
        accessors=[_vec3(count, bufferView=i) for i in range(n)],
        meshes=[{"primitives": [{"attributes": {"POSITION": i}} for i in range(n)]}],
    )


def _png(edge: int) -> bytes:
    """A black picture, which packs to a thousandth of its size."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", edge, edge, 8, 2, 0, 0, 0)
    packer = zlib.compressobj(9)
    rows = b"".join(packer.compress(bytes(1 + 3 * edge)) for _ in range(edge)) + packer.flush()
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


# -- OBJ, PLY, STL ---------------------------------------------------------------------------------------------------


def obj_continued(rng: random.Random) -> Files:
    """A statement of as many lines as fit."""
    line = rng.choice([b"\\\n", b"1 \\\n", b"f \\\n"])
    return {"case.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 " + line * (_MB // len(line)) + b"\n"}


def obj_many_objects(rng: random.Random) -> Files:
    """Many objects in a file of many vertices, as in valid files from CAD."""
    n = rng.choice([1000, 15_000])
    vertices = b"".join(b"v %d %d %d\n" % (i, i % 7, i % 11) for i in range(n))
    return {"case.obj": vertices + b"".join(b"o o%d\nf %d %d %d\n" % (i, i, i + 1, i + 2) for i in range(1, n - 2))}


def obj_heap(rng: random.Random) -> Files:
    """The same triangle again and again, as triangles or as polygons."""
    face = rng.choice([b"f 1 2 3\n", b"f " + b"1 2 3 " * 1000 + b"\n", b"f 1 2 4\nf 2 3 4\n"])
    return {"case.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + face * (_MB // len(face))}


def obj_soup(rng: random.Random) -> Files:
    """Large triangles at random."""
    n = 3000
    vertices = b"".join(b"v %.2f %.2f %.2f\n" % tuple(rng.uniform(-1, 1) for _ in range(3)) for _ in range(n))
    faces = b"".join(b"f %d %d %d\n" % tuple(rng.randrange(1, n) for _ in range(3)) for _ in range(60_000))
    return {"case.obj": (vertices + faces)[:_MB].rpartition(b"\n")[0]}


def mtl_options(rng: random.Random) -> Files:
    """A megabyte of options of one texture."""
    option = rng.choice(["-s 1 ", "-o ", "-mm 0 1 ", "-x ", "-clamp on ", "-s\t1\t2\t3 "])
    text = "newmtl a\nmap_Kd " + option * (_MB // len(option)) + "a.png\n"
    return {"case.obj": b"mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.mtl": text.encode()}


def mtl_again(rng: random.Random) -> Files:
    """One library or texture under as many names as fit."""
    if rng.random() < 0.5:
        lines = "".join(f"mtllib {'./' * (i % 500)}a.mtl\n" for i in range(2000))
        return {"case.obj": f"{lines}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".encode(), "a.mtl": b"newmtl a\n" * 100_000}
    rows = "".join(f"newmtl m{i}\nmap_Kd {'./' * (i % 100)}a.png\n" for i in range(8000))
    scene = b"mtllib a.mtl\nusemtl m1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    return {"case.obj": scene, "a.mtl": rows.encode(), "a.png": _png(8) + bytes(500_000)}


def ply_promises(rng: random.Random) -> Files:
    """A header with wrong counts."""
    n, m = rng.choice([0, 3, 10**9, 10**15]), rng.choice([1, 10**9, 10**18])
    form = rng.choice(["ascii", "binary_little_endian", "binary_big_endian"])
    properties = rng.choice(["property float x\nproperty float y\nproperty float z\n", ""])
    faces = rng.choice(["property list uchar int vertex_indices\n", "property list uint double vertex_indices\n", ""])
    head = f"ply\nformat {form} 1.0\nelement vertex {n}\n{properties}element face {m}\n{faces}end_header\n"
    return {"case.ply": head.encode() + bytes(rng.choice([0, 100, 500_000]))}


def stl_promises(rng: random.Random) -> Files:
    """A wrong number of triangles, or text that does not end its loops."""
    if rng.random() < 0.5:
        count = rng.choice([0, 1, 2**31, 2**32 - 1])
        return {"case.stl": bytes(80) + struct.pack("<I", count) + bytes(rng.choice([0, 50, 500_000]))}
    return {"case.stl": b"solid a\n" + b"facet normal 0 0 0\nouter loop\n" * (_MB // 32)}


# -- COLLADA, JSON, MJCF ---------------------------------------------------------------------------------------------


def _dae(nodes: str = '<node id="n"><instance_geometry url="#g"/></node>', more: str = "") -> str:
    return (
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
        "<created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified></asset><library_geometries>"
        '<geometry id="g"><mesh><source id="p"><float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array>'
        '<technique_common><accessor source="#f" count="3" stride="3"><param name="X" type="float"/><param name="Y" '
        'type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input '
        'semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" '
        f'offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>{more}<library_visual_scenes>'
        f'<visual_scene id="s">{nodes}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/>'
        "</scene></COLLADA>"
    )


def dae_document_type(rng: random.Random) -> Files:
    """A document type in every encoding, with entities that grow."""
    entities = '<!ENTITY a0 "lol">' + "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10))
    rest = _dae('<node id="n" name="&a9;"><instance_geometry url="#g"/></node>').partition("?>")[2]
    encoding = rng.choice(["utf-8", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-7", "cp037"])
    said = f'<?xml version="1.0" encoding="{encoding}"?><!DOCTYPE x [{entities}]>{rest}'
    return {"case.dae": said.encode(encoding)}


def dae_instances(rng: random.Random) -> Files:
    """Nodes that each instance the next node twice."""
    depth = rng.choice([10, 40, 300])
    library = "".join(
        f'<node id="n{i}"><instance_node url="#n{i + 1}"/><instance_node url="#n{i + 1}"/></node>' for i in range(depth)
    )
    end = f'<node id="n{depth}"><instance_geometry url="#g"/></node>'
    return {
        "case.dae": _dae(
            '<node id="r"><instance_node url="#n0"/></node>', f"<library_nodes>{end}{library}</library_nodes>"
        ).encode()
    }


def json_objects(rng: random.Random) -> Files:
    """As many objects as fit, of one shape, turned or not."""
    n, m = rng.choice([3000, 9000]), rng.choice([1, 3000])
    faces = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]] * m
    shape = {"kind": "mesh", "vertices_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": faces}
    objects = []
    for i in range(n):
        turned = [rng.random(), rng.random(), rng.random(), 1.0] if rng.random() < 0.5 else [0, 0, 0, 1]
        pose = {"position_m": [i, 0, 0], "rotation_xyzw": turned}
        objects.append({"id": f"o{i}", "name": "o", "pose": pose, "geometry": "g"})
    document = {"format": "scene2hap/scene", "version": 1, "name": "a", "up_axis": "y", "objects": objects}
    return {"case.json": json.dumps({**document, "geometries": {"g": shape}}).encode()[: 2 * _MB]}


def json_deep(rng: random.Random) -> Files:
    """Brackets, digits, lone surrogates."""
    core = rng.choice(["[" * 300_000, '{"a":' * 100_000, "9" * 900_000, '"\\ud800"', "1e999", "NaN", "-" * 10])
    return {"case.json": f'{{"format": "scene2hap/scene", "version": 1, "name": {core}'.encode()}


def _mjcf(inside: str, assets: str = "") -> str:
    return f'<mujoco><asset>{assets}</asset><worldbody><geom type="box" size="1 1 1"/>{inside}</worldbody></mujoco>'


def mjcf_textures(rng: random.Random) -> Files:
    """Generated textures, each within its limit."""
    edge, n = rng.choice([512, 2000, 8000]), rng.choice([1, 50, 2000])
    kind = rng.choice(['type="2d"', 'type="cube"', ""])
    rows = "".join(f'<texture name="t{i}" {kind} builtin="flat" width="{edge}" height="{edge}"/>' for i in range(n))
    return {"case.xml": _mjcf("", rows).encode()}


def mjcf_pictures(rng: random.Random) -> Files:
    """Pictures that unpack to a thousand times their size."""
    edge = rng.choice([100, 9000, 16_000])
    rows = "".join(f'<texture name="t{i}" type="2d" file="a.png"/>' for i in range(rng.choice([1, 20])))
    return {"case.xml": _mjcf("", rows).encode(), "a.png": _png(edge)}


def mjcf_copies(rng: random.Random) -> Files:
    """Copies beside and within copies."""
    count, n = rng.choice([10, 99, 5000]), rng.choice([1, 30, 500])
    ball = '<body><freejoint/><geom size="0.1"/></body>'
    row = f'<replicate count="{count}" offset="0.3 0 0">{ball}</replicate>'
    if rng.random() < 0.3:
        row = f'<replicate count="{count}" offset="0 0.3 0">{row}</replicate>'
    return {"case.xml": _mjcf(row * n).encode()}


def mjcf_models(rng: random.Random) -> Files:
    """Models that each name the next model twice."""
    depth = rng.choice([5, 19])
    files = {}
    for i in range(depth):
        inner = f"m{i + 1}.xml" if i + 1 < depth else ""
        rows = f'<model name="a" file="{inner}"/><model name="b" file="{inner}"/>' if inner else ""
        files["case.xml" if i == 0 else f"m{i}.xml"] = _mjcf("", rows).encode()
    return files


# -- Habitat ---------------------------------------------------------------------------------------------------------


def _habitat(templates: list[str], rng: random.Random, **files: bytes) -> Files:
    """Habitat scene with an instance of each template, and its dataset, in one folder."""
    rows = [
        {"template_name": name, "translation": [i, 0, 0], "uniform_scale": rng.uniform(0.5, 2)}
        for i, name in enumerate(templates)
    ]
    scene = {"translation_origin": rng.choice(["COM", "asset_local"]), "object_instances": rows}
    return {"case.scene_instance.json": json.dumps(scene).encode(), **files}


def habitat_instances(rng: random.Random) -> Files:
    """Many instances of one model, each of a different size."""
    count, n = rng.choice([3, 300, 30_000]), rng.choice([100, 3900, 40_000])
    model = _gltf(_floats(3 * count, rng), accessors=[_vec3(count, bufferView=0)])["case.gltf"]
    return _habitat(["a"] * n, rng, **{"a.gltf": model})


def habitat_models(rng: random.Random) -> Files:
    """Many models, each as large as one model may be."""
    n, count = rng.choice([10, 400]), rng.choice([10**4, 10**5])
    model = _gltf(_floats(9, rng), accessors=[_vec3(count), _vec3(3, bufferView=0)])["case.gltf"]
    return _habitat([f"m{i}" for i in range(n)], rng, **{f"m{i}.gltf": model for i in range(n)})


def habitat_patterns(rng: random.Random) -> Files:
    """Folders that are listed again and again."""
    patterns = rng.choice([["."] * 200_000, ["/".join("*" * 5000)], ["../" * 5000 + "*"], ["*a" * 100], ["/**" * 3000]])
    dataset = {"objects": {"paths": {".json": patterns, ".gltf": patterns}}}
    return _habitat(["a"], rng, **{"a.scene_dataset_config.json": json.dumps(dataset).encode()})


def habitat_names(rng: random.Random) -> Files:
    """A dataset file with as many templates as fit, for as many names as fit."""
    n = rng.choice([10, 4000])
    rows = [{"template_handle": f"t{i}", "attributes": {"render_asset": "a.gltf"}} for i in range(15_000)]
    model = _gltf(_floats(9, rng), accessors=[_vec3(3, bufferView=0)])["case.gltf"]
    files = {"a.scene_dataset_config.json": json.dumps({"objects": {"configs": rows}}).encode(), "a.gltf": model}
    return _habitat([f"{i}" for i in range(n)], rng, **files)


# -- USD -------------------------------------------------------------------------------------------------------------


def usd_doubling(rng: random.Random) -> Files:
    """Prims that each draw the next prim twice, by any kind of arc, as instances or not."""
    arc = rng.choice(["references", "payload", "inherits", "specializes", "instanceable = true\nreferences"])
    depth = rng.choice([12, 30, 200])
    rows = "".join(
        f'def Xform "a{i}" {{\ndef "x" ({arc} = </a{i + 1}>) {{\n}}\ndef "y" ({arc} = </a{i + 1}>) {{\n}}\n}}\n'
        for i in range(depth)
    )
    return {"case.usda": f'#usda 1.0\n{rows}def Cube "a{depth}" {{\n}}\n'.encode()}


def usd_files(rng: random.Random) -> Files:
    """Layers that each name the next layer twice; the last one names the first, another file or an address."""
    depth = rng.choice([3, 15, 300])
    files = {}
    for i in range(depth):
        last = rng.choice(["case.usda", "../beside/bundle.json", "/etc/a.usda", "https://127.0.0.1/a.usda", "gone.usd"])
        inner = f"l{i + 1}.usda" if i + 1 < depth else last
        arcs = rng.choice(["references", "payload"])
        text = '#usda 1.0\n(\ndefaultPrim = "a"\n)\ndef Xform "a" {\ndef Cube "c" {\n}\n' + "".join(
            f'def "{name}" ({arcs} = @{inner}@</a>) {{\n}}\n' for name in "xy"
        )
        files["case.usda" if i == 0 else f"l{i}.usda"] = (text + "}\n").encode()
    return files


def usd_text(rng: random.Random) -> Files:
    """A megabyte of brackets, numbers and prims."""
    nested = "dictionary a = {" * 30_000 + "}" * 30_000
    body = rng.choice(
        [
            f'def "a" (customData = {{{nested}}}) {{\n}}\n',
            'def Xform "a" {\n' * 40_000,
            "".join(f'def Cube "c{i}" {{\n}}\n' for i in range(50_000)),
            f'def Mesh "m" {{\nint[] faceVertexCounts = [{"3, " * 300_000}3]\n}}\n',
            'def PointInstancer "p" {\nrel prototypes = </p>\nint[] protoIndices = [0, 0]\n'
            "point3f[] positions = [(0, 0, 0), (1, 1, 1)]\n}\n",
            f'def Mesh "m" {{\npoint3f[] points = [{"(0, 0, 1), (1, 0, 2), (0, 1, 3), " * 20_000}(0, 0, 0)]\n'
            f"int[] faceVertexCounts = [60001]\nint[] faceVertexIndices = {list(range(60_001))}\n}}\n",
        ]
    )
    return {"case.usda": f"#usda 1.0\n{body}".encode()[: 2 * _MB]}


def usdz_promises(rng: random.Random) -> Files:
    """An archive with equal entries, compressed entries, or entries with wrong sizes."""
    content = b'#usda 1.0\ndef Cube "c" {\n}\n' + b" " * rng.choice([0, 500_000])
    n, size = rng.choice([1, 5_000]), rng.choice([len(content), 2**31])
    how = rng.choice([0, 8])
    head = struct.pack("<4s5H3I2H", b"PK\3\4", 20, 0, how, 0, 0, zlib.crc32(content), size, size, 6, 0) + b"a.usda"
    rows = b""
    for i in range(n):
        name = b"a.usda" if i == 0 else b"%d.usda" % i
        numbers = (20, 20, 0, how, 0, 0, zlib.crc32(content), size, size, len(name), 0, 0, 0, 0, 0, 0)
        rows += struct.pack("<4s6H3I5H2I", b"PK\1\2", *numbers) + name
    at = len(head) + len(content)
    return {"case.usdz": head + content + rows + struct.pack("<4s4H2IH", b"PK\5\6", 0, 0, n, n, len(rows), at, 0)}


BOMBS: tuple[Callable[[random.Random], Files], ...] = (
    accessors_without_bytes,
    sparse_accessors,
    shared_accessor,
    overlapping_accessors,
    instances,
    deep_nodes,
    embedded_pictures,
    meshopt_zeros,
    obj_continued,
    obj_many_objects,
    obj_heap,
    obj_soup,
    mtl_options,
    mtl_again,
    ply_promises,
    stl_promises,
    dae_document_type,
    dae_instances,
    json_objects,
    json_deep,
    mjcf_textures,
    mjcf_pictures,
    mjcf_copies,
    mjcf_models,
    habitat_instances,
    habitat_models,
    habitat_patterns,
    habitat_names,
    usd_doubling,
    usd_files,
    usd_text,
    usdz_promises,
)
