"""Scene files of every format, and folders of pictures."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from stress.hostile.reader import add, writes


def _scene(path: Path) -> object:
    from scene2hap import load_scene
    from scene2hap.contact.graph import ContactGraph

    scene = load_scene(path)
    assert type(scene).from_json(scene.to_json()).to_json() == scene.to_json(), "a round trip changes the scene"
    textures = [
        material.texture
        for item in scene.objects
        if item.appearance is not None
        for material in item.appearance.materials
    ]
    return scene.objects, ContactGraph(scene).contacts if len(scene.objects) < 200 else (), textures


def _rich_gltf(name: str) -> Callable[[Path], Path]:
    """A file with a hierarchy, sparse and normalised accessors, instances, textures and copies."""

    def write(folder: Path) -> Path:
        from gltf_builder import CUBE, CUBE_FACES
        from looks import embedded, image_file, pbr, quad

        gltf = embedded(quad(pbr(baseColorFactor=[1, 1, 1, 0.5])), image_file())
        cube = gltf.cube(material=0)
        small = gltf.accessor(CUBE * 32767, "i2", "VEC3", normalized=True)
        order = gltf.accessor(CUBE_FACES.reshape(-1), "u4", "SCALAR")
        box = gltf.mesh({"attributes": {"POSITION": small}, "indices": order, "mode": 4}, name="box")
        at = gltf.view(np.array([0, 7]), "<u2")
        moved = gltf.view(CUBE[:2] * 0.5, "<f4")
        sparse = {"count": 2, "indices": {"bufferView": at, "componentType": 5123}, "values": {"bufferView": moved}}
        rough = gltf.accessor(CUBE, "f4", "VEC3", sparse=sparse, min=[0, 0, 0], max=[1, 1, 1])
        bent = gltf.mesh({"attributes": {"POSITION": rough}, "indices": order}, {"attributes": {"POSITION": small}})
        lid = gltf.node("lid", mesh=box, translation=[0, 1, 0], rotation=[0, 0, 0, 1], scale=[1, 0.1, 1])
        gltf.node("chest", mesh=cube, children=[lid], root=True)
        gltf.node("sheet", mesh=0, root=True, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1])
        places = gltf.accessor([[0, 0, 0], [2, 0, 0]], "f4", "VEC3")
        rows = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}
        gltf.node("stool", mesh=bent, root=True, extensions=rows, extras={"mass": 2})
        gltf.header["extensionsUsed"] = ["EXT_mesh_gpu_instancing"]
        return gltf.write(folder / name)

    return write


def _draco(folder: Path) -> Path:
    import DracoPy

    from gltf_builder import CUBE, CUBE_FACES, Gltf

    gltf = Gltf()
    packed = DracoPy.encode(CUBE.astype(np.float32), CUBE_FACES.astype(np.uint32))
    view = gltf.view(np.frombuffer(packed, np.uint8), "u1")
    gltf.header["accessors"] += [
        {"componentType": 5126, "type": "VEC3", "count": 8},
        {"componentType": 5125, "type": "SCALAR", "count": 36},
    ]
    said = {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 0}}}
    mesh = gltf.mesh({"attributes": {"POSITION": 0}, "indices": 1, "extensions": said})
    gltf.node("cube", mesh=mesh, root=True)
    gltf.header["extensionsUsed"] = gltf.header["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return gltf.write(folder / "draco.glb")


def _obj(folder: Path) -> Path:
    from looks import image_file

    (folder / "room.mtl").write_text(
        "newmtl oak\nKd 0.5 0.4 0.3\nd 0.9\nmap_Kd -s 1 1 1 oak.png\nnewmtl red\nKd 1 0 0\n"
    )
    (folder / "oak.png").write_bytes(image_file())
    text = "mtllib room.mtl\no table\n" + "".join(f"v {i % 2} {i // 2 % 2} {i // 4}\n" for i in range(8))
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl oak\nf 1/1/1 2/2/1 4/3/1 3/1/1\nf 5 6 8 7\ns off\n"
    text += "g lid\nusemtl red\nf -8 -7 -3 -4\nf 3//1 4//1 8//1 7//1\no cup\nf 1 3 7 5\nf 2 4 8 6\n"
    path = folder / "room.obj"
    path.write_text(text)
    return path


def _exported(kind: str, **more: Any) -> Callable[[], bytes]:
    def content() -> bytes:
        import trimesh

        data = trimesh.creation.box((1.0, 0.5, 0.2)).export(file_type=kind, **more)
        return data.encode() if isinstance(data, str) else data

    return content


def _dae(folder: Path) -> Path:
    import collada
    import trimesh

    del collada  # needed by the export
    path = folder / "room.dae"
    path.write_bytes(trimesh.creation.box((1.0, 0.5, 0.2)).export(file_type="dae"))
    return path


def _urdf(folder: Path) -> Path:
    from stress.fuzz_scenes import _URDF, seeds

    (folder / "case.obj").write_bytes(seeds()[".obj"])
    path = folder / "arm.urdf"
    path.write_text(_URDF)
    return path


_MJCF = """<mujoco model="room"><compiler angle="radian" meshdir="."/><option timestep="0.002"/>
<default><geom density="700"/></default>
<asset><mesh name="box" file="case.obj" scale="1 1 1"/>
<texture name="t" type="2d" builtin="checker" width="8" height="8"/>
<material name="oak" texture="t" rgba="1 0 0 1"/></asset>
<worldbody><geom name="floor" type="plane" size="5 5 0.1"/>
<body name="table" pos="0 0 1"><freejoint/><geom type="box" size="0.6 0.4 0.02" material="oak"/>
<body name="cup" pos="0 0 0.1" quat="1 0 0 0"><geom type="cylinder" size="0.05 0.1"/>
<geom type="mesh" mesh="box"/></body></body>
<body name="ball" pos="2 0 1" euler="0 0 1"><joint type="hinge" range="-1 1"/>
<geom type="capsule" fromto="0 0 0 1 0 0" size="0.1"/></body>
</worldbody></mujoco>"""


def _mjcf(folder: Path) -> Path:
    from stress.fuzz_scenes import seeds

    (folder / "case.obj").write_bytes(seeds()[".obj"])
    path = folder / "room.xml"
    path.write_text(_MJCF)
    return path


def _habitat(folder: Path) -> Path:
    import habitat_builder

    return habitat_builder.mutated_dataset(folder, random.Random(0))


def _usd(suffix: str) -> Callable[[Path], Path]:
    def content() -> bytes:
        from stress.usd_seeds import usd_files

        return usd_files()[suffix]

    return writes(f"room{suffix}", content)


def _scene_json(folder: Path) -> Path:
    from stress.attacks.bundles import sound

    sound(folder)
    for one in (folder / "sound").rglob("*"):
        one.unlink() if one.is_file() else None
    document = json.loads((folder / "scene.json").read_text())
    document["contacts"] = [{"a": "table", "b": "phone", "point_m": [0, 0.025, 0], "normal": [0, 1, 0], "weight": 0.5}]
    document["geometries"] = {"cube": {"kind": "box", "size_m": [1, 1, 1]}}
    document["objects"][2] |= {"geometry": "cube", "mass_kg": 3.0, "material_names": ["steel"]}
    (folder / "scene.json").write_text(json.dumps(document))
    return folder / "scene.json"


def _meshopt() -> bytes:
    return (Path(__file__).parents[2] / "tests/data/meshopt/quantised.glb").read_bytes()


add("glTF", _rich_gltf("room.gltf"), _scene, "room.gltf", "room.gltf", "room.bin")
add("GLB", _rich_gltf("room.glb"), _scene)
add("GLB meshopt", writes("room.glb", _meshopt), _scene)
add("GLB Draco", _draco, _scene)
add("OBJ", _obj, _scene, "*.obj", "*.obj", "*.mtl", "*.png")
add("STL", writes("box.stl", _exported("stl")), _scene)
add("STL text", writes("box.stl", _exported("stl_ascii")), _scene)
add("PLY", writes("box.ply", _exported("ply")), _scene)
add("PLY text", writes("box.ply", _exported("ply", encoding="ascii")), _scene)
add("COLLADA", _dae, _scene)
add("URDF", _urdf, _scene, "*.urdf", "*.urdf", "*.obj")
add("MJCF", _mjcf, _scene, "*.xml", "*.xml", "*.obj")
add("Habitat", _habitat, _scene, "*.json", "*.csv", "*.urdf", "*.glb")
add("USDA", _usd(".usda"), _scene, every=6)
add("USDC", _usd(".usdc"), _scene, every=6)
add("USDZ", _usd(".usdz"), _scene, every=6)
add("scene JSON", _scene_json, _scene, "scene.json", names_file=False)


def _pictures(folder: Path) -> Path:
    from PIL import Image

    rows = [
        {"object": "phone", "kind": "isolated", "view": "front", "file": "a.png"},
        {"object": None, "kind": "scene", "view": "above", "file": "b.jpg"},
    ]
    Image.new("RGB", (20, 20), (200, 0, 0)).save(folder / "a.png")
    Image.new("RGB", (20, 20)).save(folder / "b.jpg")
    (folder / "pictures.json").write_text(json.dumps(rows))
    return folder


def _shown(folder: Path) -> object:
    from scene2hap.scene.capture.given_pictures import GivenPictures

    pictures = GivenPictures.load(folder)
    return [pictures.image(shot) for shot in pictures.shots]


add("pictures", _pictures, _shown)
