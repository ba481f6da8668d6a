"""A room for tests: its objects, their known properties, and its file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import cos, pi, sin
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gltf_builder import Gltf
from looks import embedded, image_file
from scene2hap import Pose, SceneObject, SceneSnapshot, TriMesh
from scene2hap.contact.junction import Pair, pair_of
from scene2hap.scene.geometry import vector
from scene2hap.scene.objects import with_relative_heights
from scene2hap.scene.shapes import Box
from scene2hap.scene.surface.dominant_surface import dominant_surface

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Thing:
    """An object: its mesh, the place of its origin [m], its rotation about the vertical [rad] and its appearance.

    texture : pixels (height, width, 3) of the object's texture in a GLB; scene JSON has no appearance.
    """

    id: str
    mesh: TriMesh
    at_m: Triple
    yaw_rad: float = 0.0
    colour: Triple = (0.6, 0.6, 0.6)
    texture: NDArray[np.uint8] | None = None


@dataclass(frozen=True)
class Room:
    """Objects and their properties, which are known by construction.

    contacts : the pairs that touch; sources : the ids that vibrate; sizes_m : length, width and thickness of some
    dominant surfaces; copies : groups of ids that share a mesh.
    """

    name: str
    things: tuple[Thing, ...]
    contacts: frozenset[Pair] = frozenset()
    sources: frozenset[str] = frozenset()
    sizes_m: Mapping[str, Triple] = field(default_factory=dict)
    copies: tuple[tuple[str, ...], ...] = ()
    up_axis: str = "y"

    @property
    def ids(self) -> list[str]:
        """The ids of all objects, in the order of the file."""
        return [thing.id for thing in self.things]

    @property
    def n_looks(self) -> tuple[int, int]:
        """The number of materials (one for each mesh) and of different textures in the room's GLB."""
        meshes = {id(thing.mesh) for thing in self.things}
        return len(meshes), len({id(thing.texture) for thing in self.things if thing.texture is not None})

    def in_units(self, unit_m: float) -> Room:
        """The room as exported from a program whose unit is `unit_m` metres."""
        meshes = {id(thing.mesh): scaled(thing.mesh, 1 / unit_m) for thing in self.things}
        things = [
            replace(thing, mesh=meshes[id(thing.mesh)], at_m=vector(np.array(thing.at_m) / unit_m))
            for thing in self.things
        ]
        return replace(self, things=tuple(things))

    def triangles_m(self) -> NDArray[np.float64]:
        """World corners (m, 3, 3) [m] of all triangles, computed only from the construction."""
        placed = []
        for thing in self.things:
            c, s = cos(thing.yaw_rad), sin(thing.yaw_rad)
            turn = ((c, 0, s), (0, 1, 0), (-s, 0, c)) if self.up_axis == "y" else ((c, -s, 0), (s, c, 0), (0, 0, 1))
            placed.append((thing.mesh.vertices_m @ np.array(turn).T + thing.at_m)[thing.mesh.faces])
        return np.concatenate(placed)

    def write(self, folder: Path) -> Path:
        """Write the room as a file for `load_scene`: a GLB, or scene JSON if z is up. Returns the path."""
        return self._json(folder / f"{self.name}.json") if self.up_axis == "z" else self._glb(folder)

    def _glb(self, folder: Path) -> Path:
        gltf, meshes, images = Gltf(), dict[int, int](), dict[int, int]()
        gltf.header["materials"] = []
        for thing in self.things:
            if thing.texture is not None and id(thing.texture) not in images:
                images[id(thing.texture)] = self._image(gltf, thing.texture)
            if id(thing.mesh) not in meshes:
                meshes[id(thing.mesh)] = self._mesh(gltf, thing, images.get(id(thing.texture)))
            turn = [0.0, sin(thing.yaw_rad / 2), 0.0, cos(thing.yaw_rad / 2)]
            gltf.node(thing.id, mesh=meshes[id(thing.mesh)], root=True, translation=list(thing.at_m), rotation=turn)
        return gltf.write(folder / f"{self.name}.glb")

    def _image(self, gltf: Gltf, pixels: NDArray[np.uint8]) -> int:
        """Add an image and a texture that shows it. Returns their number, which is the same for both."""
        textures = gltf.header.setdefault("textures", [])
        gltf.header.setdefault("images", [])
        embedded(gltf, image_file(pixels))
        gltf.header["images"][-1]["mimeType"] = "image/png"
        textures.append({"source": len(textures)})
        return len(textures) - 1

    def _mesh(self, gltf: Gltf, thing: Thing, image: int | None) -> int:
        looks: dict[str, object] = {"baseColorFactor": [*thing.colour, 1.0]}
        corners = thing.mesh.vertices_m
        bounds = {"min": corners.min(axis=0).tolist(), "max": corners.max(axis=0).tolist()}
        attributes = {"POSITION": gltf.accessor(corners, "f4", "VEC3", **bounds)}
        if image is not None:
            looks["baseColorTexture"] = {"index": image}
            attributes["TEXCOORD_0"] = gltf.accessor(corners[:, :2] + 0.3 * corners[:, 2:], "f4", "VEC2")
        gltf.header["materials"].append({"pbrMetallicRoughness": looks})
        indices = gltf.accessor(thing.mesh.faces.reshape(-1), "u4", "SCALAR")
        number = len(gltf.header["materials"]) - 1
        return gltf.mesh({"attributes": attributes, "indices": indices, "material": number})

    def _json(self, path: Path) -> Path:
        up = (0.0, 0.0, 1.0)
        objects = [
            SceneObject(
                thing.id,
                thing.id,
                Pose(thing.at_m, (0.0, 0.0, sin(thing.yaw_rad / 2), cos(thing.yaw_rad / 2))),
                thing.mesh,
                dominant_surface(thing.mesh, up=up),
            )
            for thing in self.things
        ]
        path.write_text(SceneSnapshot(self.name, "z", with_relative_heights(objects, "z")).to_json(), encoding="utf-8")
        return path


def pairs(text: str) -> frozenset[Pair]:
    """Parse lines of "thing thing ...: other" into pairs."""
    rows = (line.split(":") for line in text.strip().splitlines())
    return frozenset(pair_of(thing, other.strip()) for things, other in rows for thing in things.split())


def cuboid(size_m: Triple, middle_m: Triple = (0.0, 0.0, 0.0)) -> TriMesh:
    """A cuboid centred on a point of its frame."""
    mesh = Box(size_m).mesh
    return TriMesh(mesh.vertices_m + np.array(middle_m), mesh.faces)


def cylinder(radius_m: float, height_m: float, n: int = 24) -> TriMesh:
    """A closed cylinder whose bottom is at y = 0."""
    around = 2 * pi * np.arange(n) / n
    ring = np.stack([radius_m * np.cos(around), np.zeros(n), radius_m * np.sin(around)], axis=1)
    top = ring + np.array((0.0, height_m, 0.0))
    k, after = np.arange(n), (np.arange(n) + 1) % n
    sides = [np.stack([k, k + n, after], axis=1), np.stack([after, k + n, after + n], axis=1)]
    lids = [
        np.stack([np.full(n, 2 * n), k, after], axis=1),
        np.stack([np.full(n, 2 * n + 1), after + n, k + n], axis=1),
    ]
    corners = np.concatenate([ring, top, [(0.0, 0.0, 0.0), (0.0, height_m, 0.0)]])
    return TriMesh(corners, np.concatenate(sides + lids))


def joined(*parts: TriMesh) -> TriMesh:
    """Join several meshes into one."""
    starts = np.cumsum([0, *[len(part.vertices_m) for part in parts]])
    faces = [part.faces.astype(np.int64) + start for part, start in zip(parts, starts, strict=False)]
    return TriMesh(np.concatenate([part.vertices_m for part in parts]), np.concatenate(faces))


def swapped(mesh: TriMesh) -> TriMesh:
    """Rotate a mesh with y up into one with z up."""
    return TriMesh(Pose((0.0, 0.0, 0.0), (0.5**0.5, 0.0, 0.0, 0.5**0.5)).to_world(mesh.vertices_m), mesh.faces)


def moved(mesh: TriMesh, by_m: Sequence[float]) -> TriMesh:
    """Move a mesh in its frame."""
    return TriMesh(mesh.vertices_m + np.array(by_m), mesh.faces)


def scaled(mesh: TriMesh, factor: float) -> TriMesh:
    """Scale a mesh by a factor."""
    return TriMesh(mesh.vertices_m * factor, mesh.faces)


def checked(colour: Triple, n: int = 8) -> NDArray[np.uint8]:
    """A chequered texture of a colour and a darker one, with a mark in one corner that shows its orientation."""
    odd = np.indices((n, n)).sum(axis=0) % 2
    pixels = (255 * np.asarray(colour) * np.where(odd, 1.0, 0.6)[:, :, None]).astype(np.uint8)
    pixels[0, 0] = (0, 0, 255)
    return pixels
