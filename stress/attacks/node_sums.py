"""Files in glTF, GLB, Draco and scene JSON whose rows are small but add up to large totals."""

from __future__ import annotations

import base64
import itertools
import json
import math
import random
import struct
from collections.abc import Callable
from typing import Any

from stress.attacks.scene_files import Files, _floats, _gltf, _png, _vec3

Case = Callable[[random.Random], Files]

_MB = 1 << 20
_BOX = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
_BOX_QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
_BOX_FACES = [corner for a, b, c, d in _BOX_QUADS for corner in (a, b, c, a, c, d)]
_DRACO = "KHR_draco_mesh_compression"


def _boxes(nodes: list[dict[str, Any]], **more: Any) -> Files:
    """Nodes that draw mesh 0, a box."""
    data = struct.pack("<24f", *itertools.chain(*_BOX)) + struct.pack("<36H", *_BOX_FACES)
    return _gltf(
        data,
        bufferViews=[{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        accessors=[_vec3(8, bufferView=0), {"type": "SCALAR", "componentType": 5123, "count": 36, "bufferView": 1}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        nodes=nodes,
        **more,
    )


def distinct_boxes(rng: random.Random) -> Files:
    """Almost the largest accepted number of boxes, all of different sizes."""
    return _boxes(
        [
            {
                "name": f"box{i}",
                "mesh": 0,
                "scale": [1 + i * 1e-3, 1, 1],
                "rotation": [0, 0, 0.1, 0.995],
                "translation": [i % 60 * 2, 0, i // 60 * 2],
            }
            for i in range(3990)
        ]
    )


def mirrored_copies(rng: random.Random) -> Files:
    """A mesh of a thousand triangles, mirrored and scaled differently for each of its copies."""
    nodes = [{"mesh": 0, "scale": [-1 - i / 1000, 1, 1], "translation": [i * 3, 0, 0]} for i in range(2500)]
    return _gltf(_floats(3 * 3000, rng), accessors=[_vec3(3000, bufferView=0)], nodes=nodes)


def items_of_one_group(rng: random.Random) -> Files:
    """A group of leaves, each of which could be a separate object."""
    n = 9000
    leaves: list[dict[str, Any]] = [
        {"name": f"tea_{rng.choice(['cup', 'spoon', 'pot'])}", "mesh": 0, "translation": [3 * i, 0, 0]}
        for i in range(n)
    ]
    return _boxes([*leaves, {"name": "tea", "children": list(range(n))}], scenes=[{"nodes": [n]}])


def touching_items_of_one_group(rng: random.Random) -> Files:
    """The same group, in which each leaf touches the next."""
    n = 9000
    leaves: list[dict[str, Any]] = [
        {"name": "tea_cup" if i % 2 else "tea_lid", "mesh": 0, "translation": [i, 0, 0]} for i in range(n)
    ]
    return _boxes([*leaves, {"name": "tea", "children": list(range(n))}], scenes=[{"nodes": [n]}])


def chains_of_groups(rng: random.Random) -> Files:
    """Deep chains of groups, each with a box at its end."""
    nodes: list[dict[str, Any]] = []
    roots = []
    for chain in range(200):
        roots.append(len(nodes))
        nodes += [{"name": f"n{chain}", "children": [len(nodes) + i + 1]} for i in range(150)]
        nodes.append({"mesh": 0, "translation": [2 * chain, 0, 0]})
    return _boxes(nodes, scenes=[{"nodes": roots}])


def empty_nodes(rng: random.Random) -> Files:
    """Nodes that draw nothing."""
    return _boxes([{"mesh": 0}, *([{}] * 99_000)])


def flat_boxes(rng: random.Random) -> Files:
    """Boxes without height, each with another rotation."""
    return _boxes(
        [
            {
                "mesh": 0,
                "scale": [1 + i * 1e-3, 1, rng.choice([0, 1e-9, 1e-5])],
                "rotation": [math.sin(i), 0, 0, math.cos(i)],
                "translation": [i * 2, 0, 0],
            }
            for i in range(3500)
        ]
    )


def odd_matrices(rng: random.Random) -> Files:
    """Matrices of every size of number."""
    numbers = [0.0, -1.0, 1e-320, 1e-30, 1e30, 1e300, 1.7e308, -0.0]
    return _boxes(
        [{"mesh": 0, "matrix": [*(rng.choice(numbers) for _ in range(15)), 1.0]} for _ in range(50)]
        + [{"mesh": 0, "matrix": [*(rng.choice([1e-9, 1.0, 100.0]) for _ in range(3)), 0] * 3 + [0, 0, 0, 1]}]
    )


def long_names(rng: random.Random) -> Files:
    """Two names that share half a megabyte."""
    name = "a_b" * 150_000
    return _boxes([{"name": name, "children": [1, 2]}, *({"name": f"{name}_{i}", "mesh": 0} for i in range(2))])


def equal_names(rng: random.Random) -> Files:
    """Names that look like generated ids."""
    return _boxes([{"mesh": 0, "name": "a" if i % 2 else f"a#{i}", "translation": [2 * i, 0, 0]} for i in range(3990)])


def primitives_of_every_mode(rng: random.Random) -> Files:
    """Lists, strips and fans of one row of indices."""
    data = _floats(9, rng) + bytes([0, 1, 2]) * 100_000
    primitives = [{"attributes": {"POSITION": 0}, "indices": 1, "mode": i % 7} for i in range(2000)]
    return _gltf(
        data,
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 300_000}],
        accessors=[
            _vec3(3, bufferView=0),
            {"type": "SCALAR", "componentType": 5121, "count": 300_000, "bufferView": 1},
        ],
        meshes=[{"primitives": primitives}],
    )


def painted_primitives(rng: random.Random) -> Files:
    """Primitives that share colours and texture coordinates of many vertices."""
    n, m = 12_000, 300
    uv = {"type": "VEC2", "componentType": 5126, "count": n, "bufferView": 0}
    primitives = [{"attributes": {"POSITION": 0, "COLOR_0": 1, "TEXCOORD_0": 2}, "material": 0} for _ in range(m)]
    return _gltf(
        _floats(4 * n, rng),
        accessors=[_vec3(n, bufferView=0), {**_vec3(n, bufferView=0), "type": "VEC4"}, uv],
        images=[{"uri": "a.png"}],
        textures=[{"source": 0}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        meshes=[{"primitives": primitives}],
    ) | {"a.png": _png(8)}


def sparse_of_sparse(rng: random.Random) -> Files:
    """Sparse accessors of one stored table, each of which replaces as many values as are stored."""
    n, m = 20_000, 60
    data = _floats(3 * n, rng) + b"".join(struct.pack("<I", rng.randrange(n)) for _ in range(n))
    views = [
        {"buffer": 0, "byteLength": 12 * n},
        {"buffer": 0, "byteOffset": 12 * n, "byteLength": 4 * n},
    ]
    sparse = {"count": n, "indices": {"bufferView": 1, "componentType": 5125}, "values": {"bufferView": 0}}
    primitives = [{"attributes": {"POSITION": i}, "mode": 4} for i in range(m)]
    rows = [_vec3(n, bufferView=0, sparse=sparse)] * m
    return _gltf(data, bufferViews=views, accessors=rows, meshes=[{"primitives": primitives}])


def sparse_indices_shared(rng: random.Random) -> Files:
    """One row of sparse indices in as many primitives as fit."""
    count = 900_000
    sparse = {"count": 1, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 1}}
    index = {"type": "SCALAR", "componentType": 5121, "count": count, "sparse": sparse}
    return _gltf(
        _floats(9, rng) + bytes(4),
        bufferViews=[{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 4}],
        accessors=[_vec3(3, bufferView=0), index],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 5}] * 3000}],
    )


def quantised(rng: random.Random) -> Files:
    """Positions of two bytes with strides, and texture transforms of any size."""
    n = 30_000
    data = bytes(rng.randrange(256) for _ in range(8 * n))
    transforms = {"KHR_texture_transform": {"offset": [1e300, -1e300], "rotation": 1e300, "scale": [1e300, 0]}}
    return _gltf(
        data,
        bufferViews=[{"buffer": 0, "byteLength": 8 * n, "byteStride": 8}],
        accessors=[
            {"type": "VEC3", "componentType": 5122, "count": n, "bufferView": 0, "normalized": True},
            {"type": "VEC2", "componentType": 5122, "count": n, "bufferView": 0, "normalized": True},
        ],
        images=[{"uri": "a.png"}],
        textures=[{"source": 0}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": transforms}}}],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        extensionsRequired=["KHR_mesh_quantization"],
    ) | {"a.png": _png(8)}


def huge_numbers(rng: random.Random) -> Files:
    """Vertices at the limits of a float, and NaN."""
    numbers = [3.4e38, -3.4e38, 1e-45, float("nan"), float("inf"), 1e5, -1e5]
    data = struct.pack("<900f", *(rng.choice(numbers[:3] + numbers[5:]) for _ in range(900)))
    return _gltf(data, accessors=[_vec3(300, bufferView=0)], nodes=[{"mesh": 0, "scale": [1e-38] * 3}])


def data_uri_pictures(rng: random.Random) -> Files:
    """As many pictures as fit, each of which unpacks to the largest accepted size."""
    uri = "data:image/png;base64," + base64.b64encode(_png(2000)).decode()
    n = _MB // len(uri)
    return _gltf(
        _floats(9, rng) + bytes(12),
        accessors=[_vec3(3, bufferView=0)],
        images=[{"uri": uri}] * n,
        textures=[{"source": i} for i in range(n)],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in range(n)],
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": i} for i in range(n)]}],
    )


def ignored_tables(rng: random.Random) -> Files:
    """Skins, animations and cameras, which are not read."""
    row = {"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}] * 5, "samplers": [{}] * 5}
    return _boxes([{"mesh": 0, "skin": 0}], animations=[row] * 2000, skins=[{"joints": [0] * 50_000}], cameras=[{}])


def glb_chunks(rng: random.Random) -> Files:
    """A GLB of as many empty chunks as fit."""
    text = json.dumps({"asset": {"version": "2.0"}}).encode()
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", 0, 0x004E4942) * 120_000
    return {"case.glb": b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks}


def glb_of_one_view(rng: random.Random) -> Files:
    """A GLB with views of the same bytes in many strides."""
    data = _floats(3 * 20_000, rng)
    views = [{"buffer": 0, "byteLength": len(data), "byteStride": 12 + 4 * (i % 60)} for i in range(1000)]
    rows = [_vec3(len(data) // (12 + 4 * (i % 60)) - 1, bufferView=i) for i in range(1000)]
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": views,
        "accessors": rows,
        "meshes": [{"primitives": [{"attributes": {"POSITION": i}}]} for i in range(1000)],
        "nodes": [{"mesh": i, "translation": [3 * i, 0, 0]} for i in range(1000)],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return {"case.glb": b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks}


def _draco(data: bytes, primitives: int, meshes: int = 1) -> Files:
    row = {
        "attributes": {"POSITION": 0},
        "extensions": {_DRACO: {"bufferView": 0, "attributes": {"POSITION": 0}}},
    }
    return _gltf(
        data,
        accessors=[_vec3(3)],
        meshes=[{"primitives": [row] * primitives}] * meshes,
        nodes=[{"mesh": i, "translation": [i, 0, 0]} for i in range(meshes)],
        extensionsUsed=[_DRACO],
    )


def _packed_plane(edge: int) -> bytes:
    """A flat grid, which Draco packs to a bit for each triangle."""
    try:
        import DracoPy
        import numpy as np
    except ImportError:
        return bytes(100)
    x, y = np.meshgrid(np.arange(edge), np.arange(edge))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(np.float32)
    i = (np.arange(edge - 1)[:, None] * edge + np.arange(edge - 1)).ravel()
    faces = np.concatenate([np.stack([i, i + 1, i + edge], 1), np.stack([i + 1, i + edge + 1, i + edge], 1)])
    return bytes(DracoPy.encode(points, faces.astype(np.uint32), quantization_bits=11, compression_level=10))


def draco_shared(rng: random.Random) -> Files:
    """Millions of packed triangles in thirty primitives."""
    return _draco(_packed_plane(1200), 30)


def draco_in_many_meshes(rng: random.Random) -> Files:
    """Thousands of meshes that share one primitive of few packed triangles."""
    return _draco(_packed_plane(60), 1, 2000)


def draco_large(rng: random.Random) -> Files:
    """One primitive of as many packed triangles as a megabyte holds."""
    return _draco(_packed_plane(1700), 1)


def draco_promises(rng: random.Random) -> Files:
    """Short headers with the largest number of triangles, in both methods."""
    number = b"\xff\xff\xff\xff\x0f"
    header = b"DRACO" + bytes([2, 2, 1, rng.choice([0, 1]), 0, 0])
    return _draco(header + bytes([0]) + number + number + number + bytes(1000), 40)


def json_distinct_boxes(rng: random.Random) -> Files:
    """Boxes that all differ in size and rotation."""
    objects = [
        {
            "id": f"o{i}",
            "name": f"chair {i}",
            "pose": {"position_m": [2 * i, 0, 0], "rotation_xyzw": [rng.random(), rng.random(), 0.1, 1.0]},
            "geometry": {"kind": "box", "size_m": [1 + i * 1e-3, 1, rng.choice([1e-6, 1, 1e3])]},
        }
        for i in range(3990)
    ]
    return _json(objects)


def json_contacts(rng: random.Random) -> Files:
    """As many contacts as fit between two boxes."""
    box = {"kind": "box", "size_m": [1, 1, 1]}
    objects = [{"id": f"o{i}", "name": "o", "pose": {"position_m": [i, 0, 0]}, "geometry": box} for i in range(2)]
    return _json(objects, contacts=[{"a": "o0", "b": "o1", "point_m": [0.5, i, 0]} for i in range(20_000)])


def json_meshes(rng: random.Random) -> Files:
    """Different meshes with very small and very large coordinates."""
    objects = []
    for i in range(2000):
        points = [[rng.choice([0, 1, 1e-300, 1e6, -1e6, rng.random()]) for _ in range(3)] for _ in range(5)]
        shape = {"kind": "mesh", "vertices_m": points, "faces": [[0, 1, 2], [2, 3, 4], [0, 2, 4]]}
        objects.append({"id": f"o{i}", "name": "o", "pose": {"position_m": [i, 0, 0]}, "geometry": shape})
    return _json(objects)


def json_names(rng: random.Random) -> Files:
    """Names of half a megabyte that hold everyday words."""
    box = {"kind": "box", "size_m": [1, 1, 1]}
    name = "microwave oven on a wooden table " * 15_000
    objects = [{"id": f"o{i}", "name": name[i:], "pose": {"position_m": [i, 0, 0]}, "geometry": box} for i in range(2)]
    return _json(objects)


def json_sources(rng: random.Random) -> Files:
    """Sources that each need contact with a missing object."""
    kinds = ["frying pan", "soup pot", "smartphone", "microwave oven", "kettle", "toothbrush"]
    objects = [
        {
            "id": f"{kinds[i % 6]} {i}",
            "name": kinds[i % 6],
            "pose": {"position_m": [2 * i, 0, 0]},
            "geometry": {"kind": "box", "size_m": [0.3, 0.2, 0.1]},
        }
        for i in range(3990)
    ]
    return _json(objects)


def _json(objects: list[dict[str, Any]], **more: Any) -> Files:
    document = {"format": "scene2hap/scene", "version": 1, "name": "a", "up_axis": "y", "objects": objects, **more}
    return {"case.json": json.dumps(document).encode()}


CASES: tuple[Case, ...] = (
    distinct_boxes,
    mirrored_copies,
    items_of_one_group,
    touching_items_of_one_group,
    chains_of_groups,
    empty_nodes,
    flat_boxes,
    odd_matrices,
    long_names,
    equal_names,
    primitives_of_every_mode,
    painted_primitives,
    sparse_of_sparse,
    sparse_indices_shared,
    quantised,
    huge_numbers,
    data_uri_pictures,
    ignored_tables,
    glb_chunks,
    glb_of_one_view,
    draco_shared,
    draco_in_many_meshes,
    draco_large,
    draco_promises,
    json_distinct_boxes,
    json_contacts,
    json_meshes,
    json_names,
    json_sources,
)
