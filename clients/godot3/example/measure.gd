# Measures the cost of a frame, without a server:  godot3-server --path clients/godot3/example --script res://measure.gd
extends SceneTree

const N_FRAMES = 400


func _init():
	print("nodes, moving, us per frame (median)")
	for n in [30, 500]:
		for n_moving in [n, n / 10, 0]:
			print("%d, %d, %.0f" % [n, n_moving, _usec(n, n_moving)])
	quit()


func _usec(n, n_moving):
	var hap = load(ProjectSettings.globalize_path("res://") + "../scene2hap_client.gd").new()
	get_root().add_child(hap)
	var ids = []
	var nodes = []
	for i in range(n):
		var node = Spatial.new()
		get_root().add_child(node)
		node.rotation = Vector3(0.1, 0.2 * i, 0.3)
		hap.track(str(i), node)
		ids.append(str(i))
		nodes.append(node)
	hap._take({
		"type": "playing", "session": "0", "key": "0011223344556677", "layout": 1, "objects": ids, "n_moving": n,
		"hands": ["left", "right"], "sources": [], "n_bands": 1, "sequence": 0, "watchdog_s": 0.1,
	})
	hap.touch("left", "0", Vector3(0, 0, 0))
	hap.touch("right", "1", Vector3(0, 0, 0))
	hap._pose_sequence = -1
	var spent = []
	for k in range(N_FRAMES):
		for i in range(n_moving):
			nodes[i].translation = Vector3(i, 0.001 * k, 0)
		var begin = OS.get_ticks_usec()
		hap.encode_frame(k / 60.0)
		spent.append(OS.get_ticks_usec() - begin)
		# As if gains had answered the frame.
		hap._is_moved = false
	for node in nodes:
		node.free()
	hap.free()
	spent.sort()
	return spent[N_FRAMES / 2]
