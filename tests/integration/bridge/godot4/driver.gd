# Runs one scenario, named by SCENARIO, with the client of the folder CLIENT, and prints each event as a line of JSON.
extends Node

var Client = load(OS.get_environment("CLIENT") + "/scene2hap_client.gd")
var Scene = load(OS.get_environment("CLIENT") + "/scene2hap_scene.gd")
var hap = Client.new()
var node = Node3D.new()


func _ready():
	add_child(hap)
	add_child(node)
	var listeners = [_on_0, _on_1, _on_2, _on_3]
	var n_values = {
		"connected": 1, "progressed": 1, "baked": 2, "ready_to_play": 1, "order_changed": 0, "gains_received": 1,
		"impact": 1, "state_changed": 1, "answered": 2, "warned": 1, "error": 3, "lost": 1, "left": 0,
	}
	for name in n_values:
		hap.connect(name, listeners[n_values[name]].bind(name))
	call_deferred(OS.get_environment("SCENARIO"))


func _on_0(name):
	say(name, [])


func _on_1(a, name):
	say(name, [a])


func _on_2(a, b, name):
	say(name, [a, b])


func _on_3(a, b, c, name):
	say(name, [a, b, c])


func say(name, values):
	print(Client.json_text({"event": name, "values": values}))


func open():
	hap.open(OS.get_environment("SCENE2HAP_URL"), OS.get_environment("SCENE2HAP_TOKEN"))


# ---- Scenarios ----


# 1000 frames per second for one second.
func flood():
	open()
	hap.track("phone", node)
	hap.play({"bundle": "desk.bundle"})
	await hap.ready_to_play
	var begin = Time.get_ticks_msec()
	var n = 0
	while Time.get_ticks_msec() - begin < 1000:
		node.position.x = n
		n += 1
		hap.send_frame()
		await get_tree().process_frame
		OS.delay_usec(700)
	say("counted", [n, hap.frames_sent, hap.frames_replaced])
	get_tree().quit()


# Ten frames in which nothing moves, each after what the server says.
func rest():
	open()
	hap.track("phone", node)
	hap.play({"bundle": "desk.bundle"})
	await hap.ready_to_play
	for i in range(6):
		hap.send_frame(0.1 * i)
		await hap.gains_received
	get_tree().quit()


# A node moves once, in the second of four frames; gains come for the first and the third.
func skips():
	open()
	hap.track("phone", node)
	hap.play({"bundle": "desk.bundle"})
	await hap.ready_to_play
	hap.send_frame(0.1)
	node.position.x = 1
	hap.send_frame(0.2)
	await hap.gains_received
	hap.send_frame(0.3)
	await hap.gains_received
	hap.send_frame(0.4)
	await hap.gains_received
	get_tree().quit()


# What gains say, now and 0.15 s later.
func gains():
	open()
	hap.track("phone", node)
	hap.play({"bundle": "desk.bundle"})
	await hap.ready_to_play
	hap.send_frame(0.0)
	await hap.gains_received
	var gains = [hap.gain("right", "phone"), hap.gain("right", "phone", 0), hap.gain("nobody", "phone")]
	say("now", [hap.intensity("left")] + gains + [hap.is_paused, hap.is_preparing, hap.frames_skipped])
	hap.send_frame(0.1)
	await hap.gains_received  # of another layout
	say("now", [hap.intensity("left"), hap.gain("right", "phone")])
	var begin = Time.get_ticks_msec()
	while Time.get_ticks_msec() - begin < 150:
		await get_tree().process_frame
	say("later", [hap.intensity("left"), hap.gain("right", "phone")])
	get_tree().quit()


# All requests, with values that JSON makes difficult.
func requests():
	open()
	await hap.connected
	var sent = [
		hap.bake({"name": "a \"b\"\n\t\\ é 😀" + char(1) + char(11)}, {"user_prompt": ""}),
		hap.bake_file("a.glb"),
		hap.cancel(1),
		hap.watch("x"),
		hap.set_moving(["a", "b"]),
		hap.set_source("phone", {"on": false, "gain_db": -6.1}),
		hap.set_user({"mute": true}),
		hap.strike("table", Vector3(0.1, 0.724, -1e-5), {"impulse_n_s": 1.23456789e-7}),
		hap.add({"id": "mug"}),
		hap.spawn({"prefab": "p", "object": "o", "position_m": Vector3(1, 2, 3), "rotation_xyzw": Quaternion(0, 0, 0, 1)}),
		hap.remove("mug"),
		hap.pause(),
		hap.unpause(),
		hap.explain("left"),
		hap.stats(),
		hap.leave(),
		hap.request("pause", {"huge": 1.5e300, "tiny": 1.5e-300, "none": null, "nan": NAN, "list": PackedFloat64Array([0.25])}),
	]
	say("sent", sent)
	var begin = Time.get_ticks_msec()
	while hap._pending.size() > 0 and Time.get_ticks_msec() - begin < 2000:
		await get_tree().process_frame
	for i in range(70):
		hap.pause()
	await get_tree().process_frame
	get_tree().quit()


# A node that is freed keeps its pose; ids beyond U+FFFF are found.
func freed():
	open()
	var phone = Node3D.new()
	add_child(phone)
	phone.position = Vector3(1, 2, 3)
	hap.track("😀", phone)
	hap.track("phone", node)
	hap.play({"bundle": "desk.bundle"})
	await hap.ready_to_play
	say("knows", [hap.touch("left", "😀", Vector3(4, 5, 6)), hap.touch("left", "😁", Vector3())])
	hap.touch("left", "😀", Vector3(4, 5, 6))
	hap.send_frame(0.0)
	phone.free()
	node.position = Vector3(7, 8, 9)
	hap.send_frame(0.1)
	await hap.order_changed
	hap.send_frame(0.2)
	hap.track("lamp", null)
	await hap.order_changed
	hap.send_frame(0.3)
	for i in range(20):
		await get_tree().process_frame
	get_tree().quit()


# All that a game does with a session of a real bridge.
func tour():
	open()
	hap.track("phone", node)
	node.position = Vector3(0.2, 0.724, 0)
	hap.touch("left", "phone", Vector3(0.2, 0.728, 0))
	hap.play({"bundle": "desk.bundle", "use_sink": false})
	await hap.ready_to_play
	var time_s = 0.0
	for work in [
		"", "set_source", "pause", "unpause", "strike", "add", "remove", "set_user", "explain", "stats", "set_moving",
		"misspelt",
	]:
		var request = 0
		match work:
			"set_source": request = hap.set_source("phone", {"on": true, "gain_db": -6.0})
			"pause": request = hap.pause()
			"unpause": request = hap.unpause()
			"strike": request = hap.strike("table", Vector3(0.1, 0.72, 0), {"impulse_n_s": 0.05})
			"add": request = hap.add(a_lamp())
			"remove": request = hap.remove("lamp")
			"set_user": request = hap.set_user({"mute": true})
			"explain": request = hap.explain("left")
			"stats": request = hap.stats()
			"set_moving": request = hap.set_moving([])
			"misspelt": request = hap.request("strik", {})
		for i in range(3):
			time_s += 1.0 / 60
			node.position.x += 1e-4  # so that poses are sent
			hap.send_frame(time_s)
			await hap.gains_received
		say("after", [work, request, hap.gain("left", "phone"), hap.intensity("left"), hap.is_paused, hap.objects])
	hap.leave()
	await hap.left
	say("playing", [hap.is_playing(), hap.send_frame(9.0)])
	get_tree().quit()


# Another client watches the session.
func watches():
	open()
	hap.track("phone", node)
	node.position = Vector3(0.2, 0.724, 0)
	hap.touch("left", "phone", Vector3(0.2, 0.728, 0))
	hap.play({"bundle": "desk.bundle", "use_sink": false})
	await hap.ready_to_play
	var other = Client.new()
	add_child(other)
	other.state_changed.connect(_on_1.bind("state_changed"))
	other.open(OS.get_environment("SCENE2HAP_URL"))
	other.watch(hap.session)
	await other.ready_to_play
	hap.send_frame(0.1)
	await other.gains_received
	say("watched", [other.gain("left", "phone"), other.is_playing(), other.send_frame(0.2)])
	hap.close()
	await other.state_changed
	for i in range(20):
		await get_tree().process_frame
	say("watched", [other.gain("left", "phone"), other.is_playing(), 0])
	get_tree().quit()


func a_lamp():
	var lamp = MeshInstance3D.new()
	lamp.mesh = BoxMesh.new()
	lamp.mesh.size = Vector3(0.1, 0.2, 0.1)
	lamp.position = Vector3(-0.1, 0.82, 0.2)
	add_child(lamp)
	return Scene.object_of(lamp, "lamp", "Desk lamp", true)


# A game that only waits, until it has lost the connection for good.
func refused():
	open()
	await hap.lost
	var begin = Time.get_ticks_msec()
	while Time.get_ticks_msec() - begin < 600:
		await get_tree().process_frame
	get_tree().quit()


# A game that waits, and asks for something before it is connected.
func waits():
	open()
	hap.stats()
	await hap.answered
	get_tree().quit()


# Without a server: writes nodes as scene JSON.
func scenes():
	var mesh = BoxMesh.new()
	mesh.size = Vector3(0.2, 0.4, 0.6)
	var prism = PrismMesh.new()
	prism.size = Vector3(0.3, 0.2, 0.1)
	for row in [[mesh, "Walnut"], [prism, "Brass"]]:
		row[0].material = StandardMaterial3D.new()
		row[0].material.resource_name = row[1]
	var objects = []
	for row in [["plain", Vector3(1, 1, 1)], ["scaled", Vector3(2, 1, 0.5)], ["mirrored", Vector3(-1, 1, 1)]]:
		var root = Node3D.new()
		add_child(root)
		root.position = Vector3(1, 2, 3)
		root.rotation = Vector3(0.3, 0.5, -0.2)
		for piece in [[prism, Vector3(-0.5, 0, 0)], [mesh, Vector3(0.5, 0, 0)]]:
			var part = MeshInstance3D.new()
			part.mesh = piece[0]
			part.position = piece[1]
			part.scale = row[1]
			root.add_child(part)
		var hidden = MeshInstance3D.new()
		hidden.mesh = mesh
		hidden.visible = false
		root.add_child(hidden)
		objects.append(Scene.object_of(root, row[0], "Lamp"))
		objects.append(Scene.object_of(root, row[0] + " box", "Lamp", true))
		objects.append(Scene.object_of(root.get_child(1), row[0] + " centred", "Lamp", true))
	objects += hinged()
	print(Client.json_text(Scene.scene_of("test", objects)))
	get_tree().quit()


# A door whose origin is at its edge, on its cabinet, in a kitchen that is turned and scaled.
func hinged():
	var kitchen = Node3D.new()
	add_child(kitchen)
	kitchen.position = Vector3(4, 0, -1)
	kitchen.rotation = Vector3(0, 0.7, 0)
	kitchen.scale = Vector3(0.5, 0.5, 0.5)
	var objects = []
	var rows = [
		["cabinet", Vector3(1.2, 1.6, 0.8), Vector3(0, 1, 0)],
		["door", Vector3(1.2, 1.6, 0.04), Vector3(0.6, 0, 0.02)],
	]
	for row in rows:
		var root = Node3D.new()
		kitchen.add_child(root)
		if row[0] == "door":
			root.position = Vector3(-0.6, 1, 0.41)
		var part = MeshInstance3D.new()
		part.mesh = BoxMesh.new()
		part.mesh.size = row[1]
		part.position = row[2]
		root.add_child(part)
		objects.append(Scene.object_of(root, row[0], row[0]))
	var joint = HingeJoint3D.new()
	kitchen.add_child(joint)
	joint.position = Vector3(-0.6, 1, 0.4)
	return [objects[0], Scene.hinged_on(objects[1], objects[0], joint.global_position)]


# The script of README.md, as res://level.gd.
func readme():
	hap.queue_free()
	var level = load("res://level.gd").new()
	var cubes = {
		"Table": [Vector3(1.2, 0.04, 0.7), Vector3(0, 0.7, 0)],
		"Phone": [Vector3(0.07, 0.008, 0.15), Vector3(0.2, 0.724, 0)],
	}
	for key in cubes:
		var cube = MeshInstance3D.new()
		var mesh = BoxMesh.new()
		mesh.size = cubes[key][0]
		cube.mesh = mesh
		cube.name = key
		cube.position = cubes[key][1]
		level.add_child(cube)
	var hand = Node3D.new()
	hand.name = "RightHand"
	hand.position = Vector3(0.1, 0.72, 0)
	level.add_child(hand)
	add_child(level)
	await level.hap.ready_to_play
	for i in range(20):
		await level.hap.gains_received
	say("felt", [level.hap.intensity("right"), level.hap.gain("right", "phone"), level.hap.gain("left", "phone")])
	get_tree().quit()
