"""Write the open Blender scene for scene2hap: scene.glb, scene.json, and pictures of every object.

    blender -b kitchen.blend -P export_scene2hap.py -- -o kitchen     # Blender itself
    python export_scene2hap.py kitchen.blend -o kitchen               # a Python that has the package bpy

In Blender's text editor, "Run Script" writes to a folder beside the .blend file.

What is one object: see `owner_of`. Scale and mirroring go into vertices, lengths become metres, z stays up in
scene.json (glTF has y up). README.md beside this file tells what to do with the folder.
"""

import argparse
import hashlib
import json
import math
import os
import re
import struct
import sys

import numpy as np

GEOMETRY = {"MESH", "CURVE", "SURFACE", "META", "FONT"}
SWITCH = "scene2hap"  # custom property of an object: "object", "group" or "skip"
DEFAULT_MASS = 1.0  # what Blender gives a new rigid body, so that it says nothing

# The pictures are those of scene2hap's own capture: 4 angles from 45 degrees above, and 4 from below.
AZIMUTHS_DEG = (30, 120, 210, 300)
ELEVATION_DEG = 45
FILL, SCENE_FILL, CONTEXT_FACTOR = 0.75, 0.95, 2.5
DISTANCE_RADII = 4.5
BACKGROUND = (190, 194, 200)
OUTLINE, OUTLINE_SHARE = (255, 0, 190), 1 / 128  # the prompts speak of a pink outline
SAMPLES, HIDING_SHARE = 40, 0.1  # what hides more than this part of an object is left out of its context pictures


# -- which object a piece belongs to ---------------------------------------------------------------------------------


def owner_of(obj):
    """The Blender object that stands for the thing which `obj` is a piece of; None to leave it out.

    1. A collection instance is one object.
    2. A mesh is one object with every mesh that is parented to it, directly or not: a cabinet with its doors.
    3. An empty (or armature, ...) is one object with all meshes below it, unless another empty or a collection instance
       with meshes is below it too. Then it is a group, which is looked through.
    4. The custom property "scene2hap" overrides this: "object" makes an object of a Blender object and all below it,
       "group" lets each thing below it stand for itself, "skip" leaves it out with all below it.
    """
    chain = [obj]
    while chain[-1].parent is not None:
        chain.append(chain[-1].parent)
    if any(one.get(SWITCH) == "skip" for one in chain):
        return None
    candidates = []
    for one in chain:  # from the piece upwards
        if one.get(SWITCH) == "object":
            return one
        if one.get(SWITCH) == "group":
            if one is obj:  # its own mesh still has to belong to something
                candidates.append(one)
            break
        candidates.append(one)
    return next((one for one in reversed(candidates) if is_thing(one)), obj)


def is_thing(obj):
    """Whether an object stands for a thing rather than for a group of things, by rules 1 to 3."""
    if obj.type in GEOMETRY or is_instance(obj):
        return True
    return not any(
        one.get(SWITCH) in ("object", "group")
        or is_instance(one)
        or (one.type not in GEOMETRY and any(below.type in GEOMETRY for below in one.children_recursive))
        for one in obj.children_recursive
    )


def is_instance(obj):
    """Whether an object shows a collection."""
    return obj.type == "EMPTY" and obj.instance_type == "COLLECTION" and obj.instance_collection is not None


# -- what the scene is made of ---------------------------------------------------------------------------------------


class Thing:
    """One object to write: its frame in metres, and the triangles of all its pieces in that frame."""

    def __init__(self, owner, matrix, unit_m):
        self.owner, self.name, self.id = owner, owner.name, owner.name
        position, rotation, _ = matrix.decompose()  # without scale; a mirrored frame gives a proper rotation
        self.position_m = np.array(position) * unit_m
        self.rotation = rotation.normalized()
        self.to_own = np.linalg.inv(np.array(self.rotation.to_matrix()))
        self.unit_m, self.pieces, self.bodies, self.hinge = unit_m, [], [], None

    def in_own(self, points_m):
        """World points in its frame."""
        return (points_m - self.position_m) @ self.to_own.T

    def add(self, mesh, matrix, materials):
        """Add a piece: a mesh with the matrix that places it in the world."""
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        if not count:
            return
        vertices, faces = np.empty(3 * len(mesh.vertices), np.float32), np.empty(3 * count, np.int32)
        loops, polygons = np.empty(3 * count, np.int32), np.empty(count, np.int32)
        mesh.vertices.foreach_get("co", vertices)
        mesh.loop_triangles.foreach_get("vertices", faces)
        mesh.loop_triangles.foreach_get("loops", loops)
        mesh.loop_triangles.foreach_get("polygon_index", polygons)
        smooth, rows = np.empty(len(mesh.polygons), bool), np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("use_smooth", smooth)
        mesh.polygons.foreach_get("material_index", rows)
        uv = np.zeros((3 * count, 2), np.float32)
        if mesh.uv_layers.active is not None:
            all_uv = np.empty(2 * len(mesh.loops), np.float32)
            mesh.uv_layers.active.data.foreach_get("uv", all_uv)
            uv = all_uv.reshape(-1, 2)[loops]
        world = np.array(matrix)
        placed_m = (vertices.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]) * self.unit_m
        faces, uv = faces.reshape(-1, 3), uv.reshape(-1, 3, 2)
        if np.linalg.det(world[:3, :3]) < 0:  # mirrored: keep what was outside outside
            faces, uv = faces[:, ::-1], uv[:, ::-1]
        self.pieces.append((self.in_own(placed_m), faces, uv, smooth[polygons], [materials[i] for i in rows[polygons]]))

    def finish(self):
        """Join the pieces."""
        starts = np.cumsum([0, *(len(piece[0]) for piece in self.pieces)])
        self.vertices_m = np.concatenate([piece[0] for piece in self.pieces])
        self.faces = np.concatenate([piece[1] + start for piece, start in zip(self.pieces, starts, strict=False)])
        self.uv = np.concatenate([piece[2] for piece in self.pieces])
        self.smooth = np.concatenate([piece[3] for piece in self.pieces])
        self.face_material = [material for piece in self.pieces for material in piece[4]]
        self.materials = list(dict.fromkeys(self.face_material))
        # Equal meshes of equal materials are copies; micrometres are rounding errors of their different places.
        shape = np.round(self.vertices_m, 5).astype(np.float32) + 0.0
        names = repr([material and material.name for material in self.face_material])
        self.key = hashlib.sha256(shape.tobytes() + self.faces.tobytes() + names.encode()).hexdigest()[:16]
        rotation = np.array(self.rotation.to_matrix())
        self.world_m = self.vertices_m @ rotation.T + self.position_m

    def material_names(self):
        """The names of its materials, that of the largest area first."""
        corners = self.vertices_m[self.faces]
        doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        areas = {}
        for material, area in zip(self.face_material, doubled.tolist(), strict=True):
            if material:
                areas[material.name] = areas.get(material.name, 0.0) + area
        return sorted(areas, key=areas.get, reverse=True)

    def mass_kg(self, unit_kg):
        """What the rigid bodies say that it weighs: its own, or those of all its pieces; None if they do not."""
        own, all_of_them = mass_of(self.owner), [mass_of(body) for body in self.bodies]
        mass = own if own is not None else None if None in all_of_them else sum(all_of_them)
        return None if mass is None else mass * unit_kg


def is_active(obj):
    """Whether an object is an active rigid body, which moves by itself."""
    return obj.rigid_body is not None and obj.rigid_body.type == "ACTIVE"


def mass_of(obj):
    """The mass that somebody gave an object, in Blender's unit."""
    return obj.rigid_body.mass if is_active(obj) and obj.rigid_body.mass != DEFAULT_MASS else None


def read_scene(bpy):
    """All things of the open scene, in the order in which Blender has them."""
    scene, depsgraph = bpy.context.scene, bpy.context.evaluated_depsgraph_get()
    things = {}
    # Blender lists a curve, a text, a surface or a metaball twice: itself, and the mesh that is made of it.
    meshed = {one.object.original for one in depsgraph.object_instances if one.object.type == "MESH"}
    for instance in depsgraph.object_instances:  # with collection instances, particles and geometry nodes
        obj = instance.object
        shown = instance.parent if instance.is_instance else obj
        original = shown.original
        if obj.type not in GEOMETRY or not instance.show_self or (obj.type != "MESH" and obj.original in meshed):
            continue
        if original.hide_render or obj.original.hide_render or obj.display_type in ("WIRE", "BOUNDS"):
            continue  # such as the cutters of booleans
        owner = owner_of(original)
        if owner is None:
            continue
        if owner not in things:
            things[owner] = Thing(owner, owner.evaluated_get(depsgraph).matrix_world, unit_length_m(scene))
        mesh = obj.to_mesh()  # with its modifiers
        if mesh is None:
            continue
        materials = [material and material.original for material in mesh.materials] or [None]
        slots = [slot.material and slot.material.original for slot in obj.material_slots] or materials
        slots += [slots[-1]] * max(0, 1 + max_index(mesh) - len(slots))
        things[owner].add(mesh, instance.matrix_world.copy(), slots)
        things[owner].bodies.append(original)
        obj.to_mesh_clear()
    found = [thing for thing in things.values() if thing.pieces]
    for thing in found:
        thing.finish()
    used = set()
    for thing in found:  # names are unique within one file, not across linked libraries
        while thing.id in used:
            thing.id += "'"
        used.add(thing.id)
    add_hinges(scene, depsgraph, {thing.owner: thing for thing in found})
    return found


def add_hinges(scene, depsgraph, things):
    """Give hinges to things by rigid body constraints of the type Hinge.

    An active body is held on a passive one, else the second object on the first.
    """
    evaluated = {one.original for one in depsgraph.ids}  # the matrix of what is disabled in viewports is not computed
    for obj in scene.objects:
        joint = obj.rigid_body_constraint
        if joint is None or joint.type != "HINGE" or not joint.enabled or obj not in evaluated:
            continue
        if joint.object1 is None or joint.object2 is None:
            continue
        bodies = sorted((joint.object1, joint.object2), key=is_active)
        other, held = (things.get(owner_of(body)) for body in bodies)
        if other is None or held is None or other is held or held.hinge is not None:
            continue
        at_m = np.array(obj.evaluated_get(depsgraph).matrix_world.translation) * held.unit_m
        points = {"point_m": held.in_own(at_m).tolist(), "other_point_m": other.in_own(at_m).tolist()}
        held.hinge = {"to": other.id, **points}


def max_index(mesh):
    """The highest number of a material slot that a mesh uses."""
    rows = np.zeros(max(1, len(mesh.polygons)), np.int32)
    if len(mesh.polygons):
        mesh.polygons.foreach_get("material_index", rows)
    return int(rows.max())


def unit_length_m(scene):
    """Metres per unit. Without a unit system Blender ignores its unit scale."""
    units = scene.unit_settings
    return 1.0 if units.system == "NONE" else units.scale_length


# -- files -----------------------------------------------------------------------------------------------------------


def scene_json(name, things, unit_kg):
    """The scene as docs/scene-json.md has it."""
    geometries, objects = {}, []
    for thing in things:
        if thing.key not in geometries:
            mesh = {"vertices_m": np.round(thing.vertices_m, 7).tolist(), "faces": thing.faces.tolist()}
            geometries[thing.key] = {"kind": "mesh", **mesh}
        w, x, y, z = thing.rotation
        pose = {"position_m": thing.position_m.tolist(), "rotation_xyzw": [x, y, z, w]}
        row = {"id": thing.id, "name": thing.name, "pose": pose, "geometry": thing.key, "instance_key": thing.key}
        row["material_names"] = thing.material_names()
        more = {"mass_kg": thing.mass_kg(unit_kg), "hinge": thing.hinge}
        objects.append(row | {key: value for key, value in more.items() if value is not None})
    head = {"format": "scene2hap/scene", "version": 1, "name": name, "up_axis": "z"}
    return {**head, "objects": objects, "geometries": geometries}


def build(bpy, things):
    """A scene of its own with one Blender object per thing, in metres; copies share a mesh."""
    scene = bpy.data.scenes.new("scene2hap")
    meshes = {}
    for number, thing in enumerate(things):
        if thing.key not in meshes:
            mesh = meshes[thing.key] = bpy.data.meshes.new(f"scene2hap {number}")
            mesh.from_pydata(thing.vertices_m.tolist(), [], thing.faces.tolist())
            for material in thing.materials:
                mesh.materials.append(material)
            rows = {material: row for row, material in enumerate(thing.materials)}
            mesh.polygons.foreach_set("material_index", [rows[material] for material in thing.face_material])
            mesh.polygons.foreach_set("use_smooth", thing.smooth.tolist())
            mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", thing.uv.ravel())
            mesh.update()
        thing.built = bpy.data.objects.new(f"scene2hap {number}", meshes[thing.key])
        thing.built.location, thing.built.rotation_mode = thing.position_m, "QUATERNION"
        thing.built.rotation_quaternion = thing.rotation
        scene.collection.objects.link(thing.built)
    return scene


def write_glb(bpy, scene, things, path):
    """Write the built scene as GLB, under the names of the things."""
    options = {"export_format": "GLB", "use_active_scene": True, "export_apply": False, "export_animations": False}
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
        bpy.ops.export_scene.gltf(filepath=path, export_yup=True, **options)
    # Object names are unique in a .blend file, so that the built ones could not have those of the things.
    names = {thing.built.name: thing.id for thing in things}
    with open(path, "rb") as file:
        content = file.read()
    length = struct.unpack_from("<I", content, 12)[0]
    document, rest = json.loads(content[20 : 20 + length]), content[20 + length :]
    for node in document["nodes"]:
        node["name"] = names.get(node.get("name"), node.get("name"))
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A)
    with open(path, "wb") as file:
        file.write(head + text + rest)


# -- pictures --------------------------------------------------------------------------------------------------------


class Photographer:
    """Renders the built scene by Workbench (OpenGL) or Cycles (CPU)."""

    def __init__(self, bpy, scene, things, folder, engine, size_px):
        from mathutils.bvhtree import BVHTree

        self.bpy, self.scene, self.things, self.folder, self.size_px = bpy, scene, things, folder, size_px
        self.trees = [BVHTree.FromPolygons(thing.world_m.tolist(), thing.faces.tolist()) for thing in things]
        self.is_cycles, self.rows = engine == "cycles", []
        self.camera = bpy.data.objects.new("scene2hap camera", bpy.data.cameras.new("scene2hap camera"))
        scene.collection.objects.link(self.camera)
        scene.camera, scene.world = self.camera, bpy.data.worlds.new("scene2hap")
        render, shading = scene.render, scene.display.shading
        render.engine = "CYCLES" if self.is_cycles else "BLENDER_WORKBENCH"
        render.resolution_x = render.resolution_y = size_px
        render.resolution_percentage, render.film_transparent = 100, True
        render.image_settings.file_format, render.image_settings.color_mode = "PNG", "RGBA"
        render.dither_intensity = 0.0  # its noise makes files large
        scene.view_settings.view_transform = "Standard"
        if self.is_cycles:
            self.set_up_cycles()
        else:
            shading.light, shading.color_type, shading.show_specular_highlight = "STUDIO", "TEXTURE", False
            scene.view_settings.exposure = 0.7  # its studio light is dim
            for mesh in {thing.built.data for thing in things}:
                for row, material in enumerate(mesh.materials):
                    if material is not None:
                        mesh.materials[row] = shown_by_workbench(material)

    def set_up_cycles(self):
        """Light from the eye and a little from everywhere, without shadows: things are to be recognised."""
        scene, data = self.scene, self.bpy.data
        scene.cycles.device, scene.cycles.samples, scene.cycles.max_bounces = "CPU", 16, 4
        scene.cycles.use_denoising, scene.render.use_persistent_data = False, True
        scene.world.color = (0.35, 0.35, 0.35)
        lamp = data.lights.new("scene2hap", "SUN")
        lamp.energy, lamp.use_shadow = 2.0, False
        sun = data.objects.new("scene2hap sun", lamp)
        sun.parent = self.camera
        scene.collection.objects.link(sun)
        # Shows an object in the colour of its `color` alone.
        self.flat = data.materials.new("scene2hap flat")
        self.flat.use_nodes = True
        nodes, links = self.flat.node_tree.nodes, self.flat.node_tree.links
        nodes.clear()
        info, glow = nodes.new("ShaderNodeObjectInfo"), nodes.new("ShaderNodeEmission")
        links.new(info.outputs["Color"], glow.inputs["Color"])
        links.new(glow.outputs["Emission"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])

    def take_all(self, kinds):
        """Take the pictures of the given kinds; copies share those of the object alone."""
        everything = np.concatenate([thing.world_m for thing in self.things])
        middles = np.array([(thing.world_m.min(axis=0) + thing.world_m.max(axis=0)) / 2 for thing in self.things])
        if "scene" in kinds:
            for azimuth in AZIMUTHS_DEG:
                self.aim(everything, azimuth, ELEVATION_DEG, SCENE_FILL)
                self.take("scene", None, azimuth, ELEVATION_DEG, self.not_hiding(middles, range(len(middles))))
        span = np.linalg.norm(np.ptp(everything, axis=0))
        taken = set()
        for number, thing in enumerate(self.things):
            print(f"pictures of {thing.id} ({number + 1} of {len(self.things)})", flush=True)
            own = max(np.linalg.norm(np.ptp(thing.world_m, axis=0)), 1e-9)
            wider = min(CONTEXT_FACTOR, max(1.25, 1.25 * span / own))
            points = thing.world_m[:: -(-len(thing.world_m) // SAMPLES)]
            for elevation in (ELEVATION_DEG, -ELEVATION_DEG):
                for azimuth in AZIMUTHS_DEG:
                    if "isolated" in kinds and thing.key not in taken:
                        self.aim(thing.world_m, azimuth, elevation, FILL)
                        self.take("isolated", number, azimuth, elevation, {number})
                    if "context" in kinds:
                        self.aim(thing.world_m, azimuth, elevation, FILL / wider)
                        shown = self.not_hiding(points, [number] * len(points))
                        self.take("context", number, azimuth, elevation, shown)
            taken.add(thing.key)

    def aim(self, points_m, azimuth_deg, elevation_deg, fill):
        """Look at the middle of points, so that they fill that part of the picture; azimuth 0 looks at what faces -y.

        As `frame` of scene2hap.scene.capture.views.
        """
        from mathutils import Matrix

        low, high = points_m.min(axis=0), points_m.max(axis=0)
        radius = max(np.linalg.norm(high - low) / 2, 1e-9)
        azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
        level = np.array([math.sin(azimuth), -math.cos(azimuth), 0.0])
        away = math.cos(elevation) * level + math.sin(elevation) * np.array([0.0, 0.0, 1.0])
        right = np.cross((0.0, 0.0, 1.0), level)
        axes = np.stack((right, np.cross(away, right), away))  # of a camera, which looks along its own -z
        self.eye = (low + high) / 2 + away * radius * DISTANCE_RADII
        placed = (points_m - self.eye) @ axes.T
        plane = placed[:, :2] / -placed[:, 2:]
        low, high = plane.min(axis=0), plane.max(axis=0)
        half = max((high - low).max() / 2 / fill, 1e-9)
        camera, matrix = self.camera.data, np.eye(4)
        camera.sensor_width = camera.sensor_height = 36.0
        camera.lens = 18.0 / half
        camera.shift_x, camera.shift_y = (low + high) / 2 / (2 * half)
        camera.clip_start, camera.clip_end = radius / 100, radius * 1000
        matrix[:3, :3], matrix[:3, 3] = axes.T, self.eye
        self.camera.matrix_world = Matrix(matrix.tolist())

    def not_hiding(self, points_m, owners):
        """The things that are to be seen: all that do not hide too many points of other things from the eye."""
        from mathutils import Vector

        eye, shown = Vector(self.eye), set()
        ways = [(Vector(point) - eye, owner) for point, owner in zip(points_m, owners, strict=True)]
        for number, tree in enumerate(self.trees):
            others = [way for way, owner in ways if owner != number]
            hidden = sum(tree.ray_cast(eye, way.normalized(), way.length * 0.999)[0] is not None for way in others)
            if hidden <= max(1, HIDING_SHARE * len(others)):
                shown.add(number)
        return shown

    def take(self, kind, number, azimuth, elevation, shown):
        """Render one picture, note it for the index, and outline the object in a picture of its surroundings."""
        view = f"{'above' if elevation > 0 else 'below'} {azimuth}°"
        name = f"{kind}_{view[:5]}_{azimuth:03d}.png"
        folder = "scene"
        if number is not None:
            folder = f"{number:04d}_{re.sub('[^A-Za-z0-9_-]+', '_', self.things[number].id)[:60]}"
        path = f"pictures/{folder}/{name}"
        for i, thing in enumerate(self.things):
            thing.built.hide_render = i not in shown
        picture = self.render()
        pixels = picture[..., :3] * picture[..., 3:] + np.array(BACKGROUND) / 255 * (1 - picture[..., 3:])
        if kind == "context":
            for i, thing in enumerate(self.things):
                thing.built.color = (1, 1, 1, 1) if i == number else (0, 0, 0, 1)
            mask = self.render_flat()
            pixels[outline_of(mask, max(1, round(OUTLINE_SHARE * self.size_px)))] = np.array(OUTLINE) / 255
        self.save(pixels, os.path.join(self.folder, *path.split("/")))
        row = {"kind": kind, "view": view, "file": path}
        self.rows.append(row if number is None else {"object": self.things[number].id, **row})

    def render(self):
        """Pixels (n, n, 4) of the scene as it stands, opacity last, the lowest row first."""
        self.scene.render.filepath = os.path.join(self.folder, "rendering.png")
        self.bpy.ops.render.render(write_still=True, scene=self.scene.name)
        image = self.bpy.data.images.load(self.scene.render.filepath)
        pixels = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(pixels)
        self.bpy.data.images.remove(image)
        os.remove(self.scene.render.filepath)
        return pixels.reshape(self.size_px, self.size_px, 4)

    def render_flat(self):
        """Where the white object is seen (n, n)."""
        shading, layer, cycles = self.scene.display.shading, self.scene.view_layers[0], self.scene.cycles
        if self.is_cycles:
            layer.material_override, cycles.samples = self.flat, 1
        else:
            shading.light, shading.color_type = "FLAT", "OBJECT"
        pixels = self.render()
        if self.is_cycles:
            layer.material_override, cycles.samples = None, 16
        else:
            shading.light, shading.color_type = "STUDIO", "TEXTURE"
        return pixels[..., 0] * pixels[..., 3] > 0.5

    def save(self, pixels, path):
        """Write pixels (n, n, 3) as a PNG file."""
        os.makedirs(os.path.dirname(path), exist_ok=True)
        image = self.bpy.data.images.new("scene2hap", self.size_px, self.size_px, alpha=False)
        image.pixels.foreach_set(np.dstack((pixels, np.ones(pixels.shape[:2]))).astype(np.float32).ravel())
        image.filepath_raw, image.file_format = path, "PNG"
        image.save()
        self.bpy.data.images.remove(image)


def shown_by_workbench(material):
    """A copy of a material in its own colour: Workbench reads no shader nodes but textures."""
    copy = material.copy()
    shader = next((node for node in node_list(material) if node.type == "BSDF_PRINCIPLED"), None)
    if shader is not None:
        copy.diffuse_color = shader.inputs["Base Color"].default_value
    return copy


def node_list(material):
    """The shader nodes of a material."""
    return material.node_tree.nodes if material.node_tree is not None else []


def outline_of(mask, width_px):
    """Pixels not of the object within `width_px` of it."""
    padded, grown = np.pad(mask, width_px), np.zeros_like(mask)
    rows, columns = mask.shape
    for down in range(-width_px, width_px + 1):
        for across in range(-width_px, width_px + 1):
            if math.hypot(down, across) <= width_px + 0.5:
                top, left = width_px + down, width_px + across
                grown |= padded[top : top + rows, left : left + columns]
    return grown & ~mask


# -- the whole -------------------------------------------------------------------------------------------------------


def export(bpy, folder, kinds, engine, size_px):
    """Write the open scene to a folder."""
    source = bpy.context.scene
    things = read_scene(bpy)
    if not things:
        raise SystemExit("the scene has no visible mesh; nothing was written.")
    os.makedirs(folder, exist_ok=True)
    unit_kg = unit_length_m(source) ** 3  # Blender shows masses so (BKE_unit_value_scale)
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump(scene_json(source.name, things, unit_kg), file)
    kinds_made = ("objects", "meshes", "materials", "lights", "cameras", "worlds")
    before = {kind: set(getattr(bpy.data, kind)) for kind in kinds_made}
    scene = build(bpy, things)
    try:
        write_glb(bpy, scene, things, os.path.join(folder, "scene.glb"))
        if kinds:
            if engine == "workbench":
                print("Pictures need OpenGL. If Blender aborts here, it found none: use --engine cycles.", flush=True)
            photographer = Photographer(bpy, scene, things, folder, engine, size_px)
            photographer.take_all(kinds)
            with open(os.path.join(folder, "pictures.json"), "w", encoding="utf-8") as file:
                json.dump(photographer.rows, file, indent=1)
    finally:
        bpy.data.scenes.remove(scene)
        for kind, known in before.items():
            for made in set(getattr(bpy.data, kind)) - known:
                getattr(bpy.data, kind).remove(made)
    for thing in things:
        size = " x ".join(f"{edge:.3g}" for edge in np.ptp(thing.world_m, axis=0))
        pieces = f", {len(thing.pieces)} pieces" if len(thing.pieces) > 1 else ""
        print(f"  {thing.id}: {size} m{pieces}")
    print(f"wrote {len(things)} objects to {folder}")


def main(argv):
    """Run by Blender, by Python, or by Blender's text editor, which gives no arguments."""
    own = argv[argv.index("--") + 1 :] if "--" in argv else argv[1:] if argv[0].endswith(".py") else []
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("blend", nargs="?", metavar="FILE.blend", help="file to open (default: the open scene)")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="folder to write (default: beside the .blend file)")
    parser.add_argument("--pictures", choices=("all", "isolated", "none"), default="all", help="pictures to take (all)")
    parser.add_argument(
        "--engine", choices=("workbench", "cycles"), default="workbench", help="cycles needs no OpenGL, and is slower"
    )
    parser.add_argument("--size-px", type=int, default=512, help="width and height of a picture (512)")
    arguments = parser.parse_args(own)
    import bpy

    if arguments.blend:
        bpy.ops.wm.open_mainfile(filepath=arguments.blend)
    beside = os.path.splitext(bpy.data.filepath)[0] or os.path.join(os.getcwd(), "scene")
    kinds = {"all": ("scene", "isolated", "context"), "isolated": ("scene", "isolated"), "none": ()}
    folder = os.path.abspath(arguments.output or f"{beside}.scene2hap")
    export(bpy, folder, kinds[arguments.pictures], arguments.engine, arguments.size_px)


if __name__ == "__main__":
    main(sys.argv)
