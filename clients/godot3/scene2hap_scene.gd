# Writes nodes as scene JSON, for `bake` and `add` of scene2hap_client.gd.
#
# Godot has the axes and the unit of scene JSON: right-handed, Y up, metres. Its triangles turn clockwise seen from
# outside, those of scene JSON counter-clockwise, so that corners are listed the other way round.
extends Reference


# A scene of objects that `object_of` made.
static func scene_of(name, objects):
	return {"format": "scene2hap/scene", "version": 1, "name": name, "up_axis": "y", "objects": objects}


# A node with the meshes below it, as one object. `name` is what inference reads, such as "Washing machine". `pieces`
# are the MeshInstances that belong to it; all below the node if none are given. With `as_box` their bounding box stands
# for them: smaller, and enough for furniture and things that are nearly boxes.
static func object_of(node, id, name, as_box = false, pieces = null):
	var world = node.global_transform
	var turned = world.basis.get_rotation_quat()
	# Without scale, which a pose of scene JSON does not have: it goes into the vertices.
	var to_own = Transform(Basis(turned), world.origin).affine_inverse()
	var geometry = {}
	if pieces == null:
		pieces = mesh_instances(node)
	if as_box:
		geometry = _box(pieces, to_own)
	else:
		geometry = _mesh(pieces, to_own)
	var object = {
		"id": id,
		"name": name,
		# As exactly as frames have it, while sizes are written with few decimals: hence no Vector3.
		"pose": {"position_m": [world.origin.x, world.origin.y, world.origin.z], "rotation_xyzw": turned},
		"geometry": geometry,
	}
	var names = _material_names(pieces)
	if not names.empty():
		object["material_names"] = names
	return object


# An object of `object_of`, held on another one by a hinge at a global point, such as
# the `global_transform.origin` of a HingeJoint.
static func hinged_on(object, other, at):
	object["hinge"] = {"to": other["id"], "point_m": _own_point(object, at), "other_point_m": _own_point(other, at)}
	return object


static func _own_point(object, at):
	var pose = object["pose"]
	var origin = pose["position_m"]
	var own = Transform(Basis(pose["rotation_xyzw"]), Vector3(origin[0], origin[1], origin[2])).affine_inverse()
	return own.xform(at)


# All visible MeshInstances at and below a node.
static func mesh_instances(node):
	var found = []
	if node is MeshInstance and node.mesh != null and node.is_visible_in_tree():
		found.append(node)
	for child in node.get_children():
		found += mesh_instances(child)
	return found


static func _mesh(pieces, to_own):
	var vertices = PoolVector3Array()
	var faces = []
	for piece in pieces:
		var place = to_own * piece.global_transform
		var corners = piece.mesh.get_faces()  # three for each triangle, indexed or not
		var is_mirrored = place.basis.determinant() < 0
		var number = {}  # of each different corner
		for i in range(0, corners.size(), 3):
			var face = []
			for k in [0, 1, 2] if is_mirrored else [0, 2, 1]:
				var corner = corners[i + k]
				if not number.has(corner):
					number[corner] = vertices.size()
					vertices.append(place.xform(corner))
				face.append(number[corner])
			if face[0] != face[1] and face[1] != face[2] and face[2] != face[0]:
				faces.append(face)
	return {"kind": "mesh", "vertices_m": vertices, "faces": faces}


# The resource names of the materials, that of the largest area first. Imported materials have the name in their file.
static func _material_names(pieces):
	var areas = {}
	for piece in pieces:
		for surface in range(piece.mesh.get_surface_count()):
			var material = _material(piece, surface)
			if material != null and material.resource_name != "":
				var area = areas.get(material.resource_name, 0.0) + _area(piece, surface)
				areas[material.resource_name] = area
	var rows = []
	for name in areas:
		rows.append([-areas[name], name])
	rows.sort()
	var names = []
	for row in rows:
		names.append(row[1])
	return names


# As get_active_material, which Godot 3.2 does not have.
static func _material(piece, surface):
	for material in [piece.material_override, piece.get_surface_material(surface)]:
		if material != null:
			return material
	return piece.mesh.surface_get_material(surface)


static func _area(piece, surface):
	var arrays = piece.mesh.surface_get_arrays(surface)
	var vertices = arrays[Mesh.ARRAY_VERTEX]
	var corners = arrays[Mesh.ARRAY_INDEX]
	if corners == null:
		corners = range(vertices.size())
	var place = piece.global_transform
	var doubled = 0.0
	for i in range(0, corners.size() - 2, 3):
		var face = []
		for k in range(3):
			face.append(place.xform(vertices[corners[i + k]]))
		doubled += (face[1] - face[0]).cross(face[2] - face[0]).length()
	return doubled / 2


static func _box(pieces, to_own):
	var box = null
	for piece in pieces:
		var one = (to_own * piece.global_transform).xform(piece.mesh.get_aabb())
		box = one if box == null else box.merge(one)
	if box == null:
		box = AABB()
	var middle = box.position + box.size / 2
	if middle.length() < 1e-6 * box.size.length():
		return {"kind": "box", "size_m": box.size}
	# A box of scene JSON is centred on its pose. This one is not, and the pose is that of the node.
	var vertices = PoolVector3Array()
	for i in range(8):
		vertices.append(box.position + box.size * Vector3(i & 1, (i >> 1) & 1, (i >> 2) & 1))
	var faces = [
		[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
		[2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
	]
	return {"kind": "mesh", "vertices_m": vertices, "faces": faces}
