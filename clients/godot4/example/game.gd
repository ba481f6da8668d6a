# The game of "Check a client" in docs/bridge-protocol.md: 30 nodes on a table, played over a bridge.
#
#     scene2hap bridge --check "godot --headless --path clients/godot4/example"
#
# Settings come from the environment, as on that page, and from SCENE2HAP_REPORT, a file for counters and times.
# SCENE2HAP_SELF_TEST=1 prints the page's example of a frame instead.
extends Node3D

const KEEP_S = 30.0

var hap
var Scene
var nodes = []
var ids = []

var n_frames = int(_setting("SCENE2HAP_FRAMES", "600"))
var rate_hz = float(_setting("SCENE2HAP_RATE_HZ", "60"))
var tell_at = int(_setting("SCENE2HAP_TELL_AT", "0"))  # frame whose sending is printed
var out: FileAccess
var lines = PackedStringArray()
var bake_request = 0
var is_over = false
var next = 0  # frame to send
var answered = 0  # sequence of the last gains
var begin_usec = 0
var begin_frame = 0
var latencies_usec = []
var costs_usec = []  # of send_frame


func _ready():
	OS.low_processor_usage_mode = true
	OS.low_processor_usage_mode_sleep_usec = 50
	# In a project of your own: preload("res://scene2hap_client.gd"). This example shares the file in the folder above.
	hap = load(_above("scene2hap_client.gd")).new()
	Scene = load(_above("scene2hap_scene.gd"))
	add_child(hap)
	if OS.get_environment("SCENE2HAP_SELF_TEST") == "1":
		load("res://self_test.gd").new().run(self)
		_quit(0)
		return
	_make_nodes()
	var path = OS.get_environment("SCENE2HAP_OUT")
	if path != "":
		out = FileAccess.open(path, FileAccess.WRITE)
		if out == null:
			_fail("FileError", "SCENE2HAP_OUT is %s, which cannot be written" % path, 0)
			return
	hap.connected.connect(_on_connected)
	hap.baked.connect(_on_baked, CONNECT_ONE_SHOT)  # for a new server, the client bakes and plays by itself
	hap.ready_to_play.connect(_on_ready_to_play)
	hap.gains_received.connect(_on_gains)
	hap.error.connect(_fail)
	hap.lost.connect(_on_lost)
	hap.left.connect(_on_left)
	hap.open(_setting("SCENE2HAP_URL", hap.url), OS.get_environment("SCENE2HAP_TOKEN"))


func _process(_delta):
	if is_over:
		return
	if rate_hz and hap.is_playing() and begin_usec and next < n_frames:
		# A game polls once per frame, and would see its own period in each latency. This one waits for its next frame
		# by polling, so that it sees the wire.
		while Time.get_ticks_usec() < begin_usec + int((next - begin_frame) * 1e6 / rate_hz):
			OS.delay_usec(50)
			hap.poll()
		if hap.is_playing():
			_send()


func _on_connected(_welcome):
	if not bake_request:
		var objects = []
		for i in range(ids.size()):
			objects.append(Scene.object_of(nodes[i], ids[i], nodes[i].get_meta("label"), true))
		bake_request = hap.bake(Scene.scene_of("check", objects))


func _on_baked(job, _objects):
	for i in range(ids.size()):
		hap.track(ids[i], nodes[i])
	hap.play({"job": job, "moving": ids, "frames": "every", "keep_s": KEEP_S, "use_sink": false})


# Also after a lost connection: the game goes on behind the last frame that the session took in.
func _on_ready_to_play(is_new):
	if is_new:  # at the beginning, or since the server was restarted
		answered = 0
		lines = PackedStringArray()
	next = hap.sequence()
	begin_frame = next
	begin_usec = Time.get_ticks_usec()
	if answered >= n_frames:
		_leave()
	elif rate_hz == 0:
		_send()


func _send():
	if next >= n_frames:
		return
	_place(next)
	_touch(next)
	var before = Time.get_ticks_usec()
	hap.send_frame(next / 60.0)
	costs_usec.append(Time.get_ticks_usec() - before)
	next += 1
	if next == tell_at:
		print("frame ", next)


func _on_gains(sequence):
	latencies_usec.append(int(hap.latency_s * 1e6))
	var fields = PackedStringArray([str(sequence)])
	for hand in hap.hands:
		for source in hap.sources:
			fields.append(_nine_digits(hap.gain(hand, source["id"])))
	lines.append(",".join(fields))
	answered = sequence
	if answered >= n_frames:
		_leave()
	elif rate_hz == 0 and answered == next:  # and not gains that are repeated after a resume, while a frame is under way
		_send()


func _leave():
	is_over = true
	hap.leave()


func _on_lost(reason):
	print("lost: ", reason)


func _fail(kind, message, _request):
	printerr(kind, ": ", message)
	_quit(1)


func _on_left():
	if out != null:
		out.store_string("\n".join(lines) + "\n")
	var report = JSON.stringify({
		"sent": hap.frames_sent,
		"gains": hap.n_gains,
		"replaced": hap.frames_replaced,
		"skipped": hap.frames_skipped,
		"latency_p50_usec": _percentile(latencies_usec, 50),
		"latency_p99_usec": _percentile(latencies_usec, 99),
		"latency_max_usec": _percentile(latencies_usec, 100),
		"send_p50_usec": _percentile(costs_usec, 50),
		"send_p99_usec": _percentile(costs_usec, 99),
	})
	print(report)
	if OS.has_environment("SCENE2HAP_REPORT"):
		var file = FileAccess.open(OS.get_environment("SCENE2HAP_REPORT"), FileAccess.WRITE)
		file.store_string(report)
		file.close()
	_quit(0)


func _quit(code):
	is_over = true
	if out != null:
		out.close()
	hap.close()
	get_tree().quit(code)


# ---- The game. All is computed in GDScript's doubles; a Vector3 rounds to single once. ----


func _make_nodes():
	_make("table", "Wooden table", Vector3(2.4, 0.04, 0.8))
	_make("phone", "Smartphone", Vector3(0.07, 0.008, 0.15))
	_make("shaver", "Electric shaver", Vector3(0.05, 0.04, 0.16))
	for k in range(3, 30):
		_make("cup_%02d" % k, "Coffee mug", Vector3(0.08, 0.09, 0.08))
	_place(0)


func _make(id, label, size):
	var node = MeshInstance3D.new()
	var box = BoxMesh.new()
	box.size = size
	node.mesh = box
	node.set_meta("label", label)
	add_child(node)
	nodes.append(node)
	ids.append(id)


func _place(i):
	nodes[0].position = Vector3(0, 0.7, 0)
	nodes[1].position = Vector3(-1.0 + i / 1800.0, 0.724, 0.2)
	var since = i % 3600
	nodes[2].position = Vector3(0.5, 0.94 if since >= 1200 and since < 1800 else 0.74, -0.2)
	for k in range(3, 30):
		nodes[k].position = Vector3(_cup_x(k, i), 0.765, _cup_z(k))


func _cup_x(k, i):
	var c = (k - 3) % 9
	var d = absf((i + 37 * k) % 240 - 120) / 120.0
	return -0.9 + 0.2 * c + 0.05 * d


func _cup_z(k):
	return [-0.35, 0.0, 0.35][floori((k - 3) / 9.0)]


func _touch(i):
	if i % 600 >= 540:
		hap.lift("left")
	else:
		hap.touch("left", "table", Vector3(-0.5, 0.72, 0.1))
	if i % 1200 < 600:
		hap.touch("right", "phone", Vector3(-1.0 + i / 1800.0, 0.724 + 0.004, 0.2))
	else:
		hap.touch("right", "cup_12", Vector3(_cup_x(12, i), 0.765 + 0.045, _cup_z(12)))


# A number with nine significant digits, which give a single back exactly.
static func _nine_digits(value):
	if value == 0.0:
		return "0"
	var exponent = int(floor(log(value) / log(10.0)))
	var mantissa = value / pow(10.0, exponent) if exponent >= 0 else value * pow(10.0, -exponent)
	return "%.8fe%d" % [mantissa, exponent]


static func _percentile(values, percent):
	values.sort()
	return values[int(min(values.size() - 1, values.size() * percent / 100))] if values else 0


static func _setting(key, otherwise):
	return OS.get_environment(key) if OS.has_environment(key) else otherwise


# The folder above, or this project, where an export has the file.
static func _above(file):
	if ResourceLoader.exists("res://" + file):
		return "res://" + file
	return ProjectSettings.globalize_path("res://").path_join("..").path_join(file)
