# Plays a session of a scene2hap bridge: sends the poses of nodes and the touches of hands, and receives gains.
#
# For Godot 4, tested with 4.6. Copy this file and scene2hap_scene.gd into your project, and add one node of this script,
# best as an autoload. It polls in `_process` and never waits for the network. README.md has an example, the page
# docs/bridge-protocol.md of scene2hap the protocol.
#
#     open -> connected -> bake -> baked -> play -> ready_to_play -> send_frame ... gains_received -> leave -> left
#
# Each request returns a number. Either `answered` or `error` comes with the same number.
extends Node

signal connected(welcome)
signal progressed(progress)  # of a bake: job, stage, item, done, of
signal baked(job, objects)
signal ready_to_play(is_new)  # false: the session goes on after a lost connection; true: set sources and levels again
signal order_changed()  # objects or sources came or went
signal gains_received(sequence)
signal impact(impact)  # object, with_object, point_m, frequency_hz, felt
signal state_changed(state)  # of a session that is watched: "playing", "waiting", "ended"
signal answered(request, answer)
signal warned(message)
signal error(kind, message, request)  # request is 0 where no request is to blame
signal lost(reason)  # the client goes on trying to connect, unless the server refused it
signal left()

const CLIENT = "scene2hap-godot4 1"
const VERSION = 1
const FINAL_CODES = [4000, 4001, 4003]  # no hello, other version, wrong token: another attempt would end the same way
const LONGEST_WAIT_MS = 5000  # between two attempts
const ATTEMPT_MS = 5000  # until the server's welcome
const SILENT_MS = 10000  # without a message while frames wait for gains; then the connection counts as lost
const MAX_PENDING = 64  # requests without an answer
const MAX_IN_FLIGHT = 16  # frames without gains; then the newest frame waits here
const HELD_USEC = 250000  # longest time that it waits
const MAX_BAKES = 8  # scenes that are kept, to bake them again for a server that was restarted
const IN_BYTES = 4 << 20  # size of the longest message of the server
const OUT_BYTES = 32 << 20  # size of all messages that wait to be sent, scenes included; the server's default limit

var url = "ws://127.0.0.1:7862/"
var token = ""

# What the numbers of the session mean; set before ready_to_play and order_changed.
var session = ""
var objects = []
var n_moving = 0
var hands = []
var sources = []  # dictionaries: id, state, states, frequency_hz
var n_bands = 1
var watchdog_s = 0.1
var welcome = {}

# Counters since ready_to_play(true), and the time from sending the newest answered frame to its gains.
var frames_sent = 0
var frames_replaced = 0  # by newer ones, while too many waited for gains
var frames_skipped = 0  # by the server
var n_gains = 0
var latency_s = 0.0
var is_paused = false
var is_preparing = false  # the server prepares a newer propagation field

var _socket = null
var _is_wanted = false
var _is_welcome = false
var _is_playing = false
var _is_watching = false
var _is_polling = false
var _is_lost = false  # whether `lost` was emitted since the last welcome
var _inbox = []  # [bytes, is_text, time_usec]
var _is_greeted = false  # whether hello was sent
var _closed = ""  # why the socket closed
var _close_code = 0
var _attempt_ms = 0
var _next_ms = 0
var _wait_ms = 0
var _heard_ms = 0

var _last_request = 0
var _pending = {}  # request: [document, is_sent]
var _bakes = {}  # job: [request, fields of the bake, is_done]
var _play = {}  # fields of the last `play`
var _is_replay = false  # the client itself plays again, since the server forgot the session
var _replay_bake = 0  # request of the bake whose job is to be played again

var _tracked = {}  # id: node
var _moving = []  # ids of the moving objects, in the order of the session
var _nodes = []  # their nodes
var _transforms = []  # their transforms as last written
var _poses = StreamPeerBuffer.new()
var _has_poses = false
var _is_moved = false
var _touches = {}  # hand: [object, point]
var _hand_index = {}
var _object_index = {}
var _source_index = {}
var _key = PackedByteArray()
var _layout = 0
var _sequence = 0
var _pose_sequence = 0  # of the last frame with poses
var _answered_sequence = 0
var _in_flight = []  # [sequence, time_usec]
var _held = null  # [bytes, sequence] of the newest frame that waits
var _put_usec = 0
var _intensities = PackedFloat32Array()
var _gains = PackedFloat32Array()
var _gains_usec = 0


func _init():
	process_mode = Node.PROCESS_MODE_ALWAYS  # else a paused tree would not answer the server's pings
	process_priority = -1000  # gains first, then the game


func _process(_delta):
	poll()


# Connect, and connect again whenever the connection is lost, until `close`. A host name is looked up by Godot in this
# call; give an address where that could take long.
func open(server_url: String, server_token := "") -> void:
	close()
	url = server_url
	token = server_token
	_is_wanted = true
	_wait_ms = 0
	_next_ms = 0


# Leave the server at once. A session stays there for `keep_s`; call `leave` before to end it.
func close():
	_is_wanted = false
	if _socket != null:
		_socket.close(1000)
	_forget_connection()
	_stop_playing()
	_pending.clear()


# Whether a session goes on: one that this client plays or watches.
func is_playing():
	return _is_playing


# That of the last frame, or after a resume that of the last one which the session took in.
func sequence():
	return _sequence


# Take in what the server sent. Called each frame; call it as often as you like.
func poll():
	if _is_polling:
		return
	_is_polling = true
	if _socket == null:
		if _is_wanted and Time.get_ticks_msec() >= _next_ms:
			_attempt()
	else:
		_socket.poll()
		_read_socket()
		_dispatch()
		_check_connection()
	_is_polling = false


# ---- Requests. Each returns its number, 0 if too many wait for an answer. ----


# Any request of the protocol. Values may be Vector3 (x, y, z), also packed, and Quaternion (x, y, z, w).
func request(type, fields = {}):
	if _pending.size() >= MAX_PENDING:
		var text = "%s was not sent: %d requests wait for an answer. Wait for them first." % [type, MAX_PENDING]
		call_deferred("emit_signal", "error", "TooManyRequests", text, 0)
		return 0
	_last_request += 1
	var document = {"type": type, "id": _last_request}
	for key in fields:
		if not document.has(key):
			document[key] = fields[key]
	_pending[_last_request] = [document, false]
	if _is_welcome:
		_send_request(_last_request)
	return _last_request


# Infer what the objects are and how they vibrate. `scene` is from scene2hap_scene.gd; options as the protocol has.
func bake(scene, options = {}):
	return request("bake", _joined({"scene": scene}, options))


func bake_file(path, options = {}):
	return request("bake", _joined({"path": path}, options))


func cancel(job):
	return request("cancel", {"job": job})


# Begin a session: {"job": job} of a bake or {"bundle": path}, and options as the protocol has. The tracked nodes move,
# unless `moving` names others.
func play(options):
	var fields = options.duplicate()
	if not fields.has("moving"):
		fields["moving"] = _tracked.keys()
	if fields.has("job"):
		fields["job"] = int(fields["job"])  # messages of the server have all numbers as floats
	_is_replay = false
	return request("play", fields)


# Receive the gains of a session that another client plays.
func watch(session_id):
	return request("watch", {"session": session_id})


# Choose the objects whose poses frames have; each needs a tracked node.
func set_moving(ids):
	return request("moving", {"moving": ids})


# changes: on, state, gain_db, mute.
func set_source(source, changes):
	return request("set_source", _joined({"source": source}, changes))


# changes: gain_db, mute, profile.
func set_user(changes):
	return request("set_user", changes)


# how: speed_m_s or impulse_n_s, with_object.
func strike(object, point_m, how = {}):
	return request("strike", _joined({"object": object, "point_m": point_m}, how))


# An object of scene JSON, as `object_of` of scene2hap_scene.gd makes it.
func add(object):
	return request("add", {"object": object})


# fields: prefab or job, object, position_m, rotation_xyzw.
func spawn(fields):
	return request("spawn", fields)


func remove(object):
	return request("remove", {"object": object})


func pause():
	return request("pause")


func unpause():
	return request("unpause")


func explain(hand):
	return request("explain", {"hand": hand})


func stats():
	return request("stats")


# End the session, or stop watching. The connection stays open.
func leave():
	_is_playing = false
	session = ""  # so that a lost connection does not bring it back
	return request("leave")


# ---- Frames ----


# Send the pose of this node as that of an object. Do so before `play`. A node that is freed, or out of the tree, keeps
# its last pose.
func track(object, node):
	_tracked[object] = node


func untrack(object):
	_tracked.erase(object)


# A hand touches an object at a point in the world until `lift`. Returns whether the session has both.
func touch(hand, object, point_m):
	_touches[hand] = [object, point_m]
	return _hand_index.has(hand) and _object_index.has(object)


func lift(hand):
	_touches.erase(hand)


# Send where everything is now. Call it once per frame, after the game moved its nodes. Times must grow; without one it
# is that of the engine. Returns the sequence of the frame, 0 while no session plays.
func send_frame(time_s = null):
	if not _is_playing or _is_watching or _closed != "":
		return 0
	var now = Time.get_ticks_usec()
	_sequence += 1
	var bytes = encode_frame(now * 1e-6 if time_s == null else time_s)
	# Godot queues without limit what a socket does not take. At most MAX_IN_FLIGHT frames are under way, so that the
	# queue stays short; of those that wait, the newest wins. HELD_USEC passes where frames never get gains.
	if _held != null or (_in_flight.size() >= MAX_IN_FLIGHT and now - _put_usec < HELD_USEC):
		if _held != null:
			frames_replaced += 1
		_held = [bytes, _sequence]
		_put_held()
	else:
		_put_frame(bytes, _sequence)
	return _sequence


# The bytes of a frame with the present sequence. Only poses that changed are written anew.
func encode_frame(time_s):
	var moved = _is_moved or not _has_poses
	for i in range(_nodes.size()):
		var node = _nodes[i]
		if not (is_instance_valid(node) and node.is_inside_tree()):
			continue
		var now = node.global_transform
		if now == _transforms[i]:
			continue
		_transforms[i] = now
		moved = true
		_write_pose(i, now)
	_has_poses = not _nodes.is_empty()
	# The server may skip a frame for a newer one, so that poses are repeated until gains answer a frame that has them.
	_is_moved = moved and _has_poses
	if _is_moved:
		_pose_sequence = _sequence
	var frame = StreamPeerBuffer.new()
	frame.put_u32(0x42483253)  # "S2HB"
	frame.put_u8(1)
	frame.put_u8(VERSION)
	frame.put_u16(_layout)
	frame.put_data(_key)
	frame.put_u32(_sequence)
	frame.put_u32(0)
	frame.put_double(time_s)
	frame.put_u32(_nodes.size() if _is_moved else 0)
	var touches = []
	for hand in _touches:
		var touched = _touches[hand]
		if _hand_index.has(hand) and _object_index.has(touched[0]):
			touches.append([_hand_index[hand], _object_index[touched[0]], touched[1]])
	frame.put_u32(touches.size())
	if _is_moved:
		frame.put_data(_poses.data_array)
	for one in touches:
		frame.put_u32(one[0])
		frame.put_u32(one[1])
		frame.put_float(one[2].x)
		frame.put_float(one[2].y)
		frame.put_float(one[2].z)
	return frame.data_array


# ---- Gains ----


# What a hand feels as the amplitude of a sine, 0 to 1; 0 if the last gains are older than watchdog_s.
func intensity(hand):
	if _is_stale() or not _hand_index.has(hand):
		return 0.0
	return _intensities[_hand_index[hand]]


# What a source's own loop is multiplied with at a hand; that of the loudest band if none is given.
func gain(hand, source, band = -1):
	if _is_stale() or not (_hand_index.has(hand) and _source_index.has(source)):
		return 0.0
	var begin = (_hand_index[hand] * sources.size() + _source_index[source]) * n_bands
	if band >= 0:
		return _gains[begin + band] if band < n_bands else 0.0
	var loudest = 0.0
	for i in range(begin, begin + n_bands):
		loudest = maxf(loudest, _gains[i])
	return loudest


# Take in a gains message. Returns whether it was one.
func read_gains(bytes, time_usec):
	var read = StreamPeerBuffer.new()
	read.data_array = bytes
	if bytes.size() < 40 or read.get_u32() != 0x42483253 or read.get_u8() != 2 or read.get_u8() != VERSION:
		return false
	var layout = read.get_u16()
	read.seek(16)
	var sequence = read.get_u32()
	frames_skipped = read.get_u32()
	read.seek(32)
	var n_hands = read.get_u16()
	var n_sources = read.get_u16()
	var bands = read.get_u16()
	var flags = read.get_u16()
	var n = n_hands * n_sources * bands
	if bytes.size() != 40 + 4 * (n_hands + n):
		return false
	is_paused = flags & 1 != 0
	is_preparing = flags & 2 != 0
	# Around an order, gains of the layout before or after may come: their numbers mean other hands or sources.
	if layout == _layout and n_hands == hands.size() and n_sources == sources.size() and bands == n_bands:
		_intensities.resize(n_hands)
		for i in range(n_hands):
			_intensities[i] = read.get_float()
		_gains.resize(n)
		for i in range(n):
			_gains[i] = read.get_float()
		_gains_usec = time_usec
	if sequence == _pose_sequence:
		_is_moved = false
	if sequence <= _answered_sequence:
		return true  # silence, or gains that the server repeats after a resume
	n_gains += 1
	_answered_sequence = sequence
	while not _in_flight.is_empty() and _in_flight[0][0] <= sequence:
		latency_s = (time_usec - _in_flight[0][1]) * 1e-6
		_in_flight.pop_front()
	gains_received.emit(sequence)
	return true


func _is_stale():
	return not _is_playing or Time.get_ticks_usec() - _gains_usec > watchdog_s * 1e6 or _gains.is_empty()


# ---- The connection ----


func _attempt():
	_socket = WebSocketPeer.new()
	_socket.inbound_buffer_size = IN_BYTES
	_socket.outbound_buffer_size = OUT_BYTES
	_attempt_ms = Time.get_ticks_msec()
	if _socket.connect_to_url(url) != OK:
		_closed = "%s cannot be reached; give an address such as ws://127.0.0.1:7862/" % url
		_lose()


func _read_socket():
	var state = _socket.get_ready_state()
	if state == WebSocketPeer.STATE_OPEN and not _is_greeted:
		_is_greeted = true
		if not OS.has_feature("web"):  # browsers do not delay
			_socket.set_no_delay(true)
		var hello = {"type": "hello", "version": VERSION, "client": CLIENT}
		if token != "":
			hello["token"] = token
		_socket.send_text(json_text(hello))
	var now = Time.get_ticks_usec()
	while _socket.get_available_packet_count() > 0:
		var bytes = _socket.get_packet()
		_inbox.append([bytes, _socket.was_string_packet(), now])
	if state == WebSocketPeer.STATE_CLOSED:
		# Godot drops what is unread when the connection closes, such as the error that came before. The reason remains.
		_close_code = _socket.get_close_code()
		if not _is_greeted:
			_closed = "%s did not answer; is the bridge running?" % url
		elif _close_code == -1:
			_closed = "the connection ended"
		else:
			_closed = "the server closed the connection: %s (%d)" % [_socket.get_close_reason(), _close_code]


func _dispatch():
	while not _inbox.is_empty():
		var messages = _inbox
		_inbox = []
		for message in messages:
			_heard_ms = Time.get_ticks_msec()
			if not message[1]:
				if not read_gains(message[0], message[2]):
					warned.emit("a binary message of %d bytes was ignored" % message[0].size())
				continue
			var json = JSON.new()
			if json.parse(message[0].get_string_from_utf8()) == OK:
				if typeof(json.data) == TYPE_DICTIONARY and json.data.has("type"):
					_take(json.data)
			if _socket == null:
				return  # a handler closed the connection


func _check_connection():
	if _socket == null:
		return
	var now = Time.get_ticks_msec()
	if _closed == "":
		if not _is_welcome and now - _attempt_ms > ATTEMPT_MS:
			_closed = "%s did not say welcome within %d s" % [url, ATTEMPT_MS * 0.001]
		elif not _in_flight.is_empty() and now - _heard_ms > SILENT_MS:
			_closed = "the server was silent for %d s" % (SILENT_MS * 0.001)
	if _closed != "":
		_lose()
	elif _is_playing:
		_put_held()


func _lose():
	var reason = _closed
	var is_final = _close_code in FINAL_CODES
	_forget_connection()
	_is_playing = false
	_wait_ms = clampi(2 * _wait_ms, 250, LONGEST_WAIT_MS)
	_next_ms = Time.get_ticks_msec() + _wait_ms
	if is_final:
		_is_wanted = false
	for id in _pending.keys():
		var type = _pending[id][0]["type"]
		if is_final or (_pending[id][1] and not type in ["bake", "play"]):
			_pending.erase(id)
			if type != "resume":
				error.emit("ConnectionLost", "%s has no answer: %s" % [type, reason], id)
	for job in _bakes.keys():
		if not _bakes[job][2]:  # nobody would tell when the job is done
			_pending[_bakes[job][0]] = [_bakes[job][1], false]
			_bakes.erase(job)
	if not _is_lost or is_final:
		_is_lost = true
		lost.emit(reason)


func _forget_connection():
	_socket = null
	_is_welcome = false
	_is_greeted = false
	_closed = ""
	_close_code = 0
	_inbox = []
	_in_flight = []
	_held = null
	_has_poses = false  # the next frame writes all of them


func _stop_playing():
	_is_playing = false
	session = ""
	_play = {}
	_bakes.clear()
	_is_replay = false
	_replay_bake = 0


func _put_frame(bytes, sequence):
	_put_usec = Time.get_ticks_usec()
	_in_flight.append([sequence, _put_usec])
	if _in_flight.size() > MAX_IN_FLIGHT:
		_in_flight.pop_front()
	frames_sent += 1
	_socket.send(bytes, WebSocketPeer.WRITE_MODE_BINARY)


func _put_held():
	if _held == null:
		return
	if _in_flight.size() < MAX_IN_FLIGHT or Time.get_ticks_usec() - _put_usec >= HELD_USEC:
		var held = _held
		_held = null
		_put_frame(held[0], held[1])


func _send_request(id):
	_pending[id][1] = true
	if _socket.send_text(json_text(_pending[id][0])) != OK:
		_pending.erase(id)
		var text = "the message does not fit into %d bytes; send fewer vertices, or boxes" % OUT_BYTES
		call_deferred("emit_signal", "error", "TooLong", text, id)


# ---- Messages of the server ----


func _take(document):
	var id = int(document["re"]) if document.get("re") != null else 0
	var asked = _pending[id][0] if _pending.has(id) else {}
	_pending.erase(id)
	match document["type"]:
		"welcome":
			_take_welcome(document)
		"baking":
			_take_baking(int(document["job"]), id, asked)
		"progress":
			progressed.emit(document)
		"cancelled":
			_bakes.erase(int(document["job"]))
		"baked":
			_take_baked(int(document["job"]), document.get("objects"))
		"playing", "watching":
			_take_playing(document, asked)
		"order":
			_take_order(document)
			order_changed.emit()
		"impact":
			impact.emit(document)
		"state":
			state_changed.emit(document.get("is"))
		"warning":
			warned.emit(document.get("message"))
		"left":
			_is_playing = false
			session = ""
			left.emit()
		"error":
			_take_error(document, id, asked)
			return
	if id:
		answered.emit(id, document)


func _take_welcome(document):
	welcome = document
	_is_welcome = true
	_is_lost = false
	_wait_ms = 0
	var waiting = _pending.keys()
	if session != "":
		_last_request += 1
		var again = {"type": "resume", "id": _last_request, "session": session, "key": _key.hex_encode()}
		if _is_watching:
			again = {"type": "watch", "id": _last_request, "session": session}
		_pending[_last_request] = [again, false]
		_send_request(_last_request)
	for id in waiting:
		_send_request(id)
	connected.emit(document)


func _take_baking(job, id, asked):
	if _bakes.size() >= MAX_BAKES:
		_bakes.erase(_bakes.keys()[0])
	_bakes[job] = [id, asked, false]


func _take_baked(job, names):
	if _bakes.has(job):
		_bakes[job][2] = true
		if _replay_bake != 0 and _bakes[job][0] == _replay_bake:
			_replay_bake = 0
			_play["job"] = job
			_replay()
			return
	baked.emit(job, names)


func _take_playing(document, asked):
	_is_watching = document["type"] == "watching"
	var is_new = asked.get("type") != "resume"
	session = document["session"]
	_key = PackedByteArray()
	var key = document.get("key", "0000000000000000")  # who watches has none
	for i in range(8):
		_key.append(key.substr(2 * i, 2).hex_to_int())
	if is_new:
		_play = asked
		_is_replay = false
		frames_sent = 0
		frames_replaced = 0
		frames_skipped = 0
		n_gains = 0
		_answered_sequence = int(document["sequence"])
	_take_order(document)
	_sequence = int(document["sequence"])
	_is_playing = true
	_heard_ms = Time.get_ticks_msec()
	ready_to_play.emit(is_new)


func _take_order(document):
	_layout = int(document["layout"])
	objects = document["objects"]
	n_moving = int(document["n_moving"])
	hands = document["hands"]
	sources = document["sources"]
	n_bands = int(document["n_bands"])
	watchdog_s = float(document["watchdog_s"])
	_hand_index = _numbered(hands)
	_object_index = _numbered(objects)
	_source_index = {}
	for i in range(sources.size()):
		_source_index[sources[i]["id"]] = i
	_intensities = PackedFloat32Array()
	_gains = PackedFloat32Array()
	var before = {}
	for i in range(_nodes.size()):
		before[_moving[i]] = _transforms[i]
	_moving = objects.slice(0, n_moving)
	_nodes = []
	_transforms = []
	_poses = StreamPeerBuffer.new()
	_has_poses = false
	if _is_watching:
		return  # who watches sends no frames
	var without = []
	for id in _moving:
		var node = _tracked.get(id)
		var is_there = is_instance_valid(node) and node.is_inside_tree()
		if not is_there and not before.has(id):
			without.append(id)
			continue
		_nodes.append(node if is_there else null)
		_transforms.append(node.global_transform if is_there else before[id])
		_write_pose(_nodes.size() - 1, _transforms.back())
	if not without.is_empty():
		_nodes = []  # a pose too few would be refused, and a wrong one would be worse
		var text = "no node is tracked for %s, so that no poses are sent; call `track` first, or `set_moving`" % [without]
		error.emit("NotTracked", text, 0)


func _take_error(document, id, asked):
	var kind = document.get("error", "")
	var text = document.get("message", "")
	var type = asked.get("type", "")
	if type == "resume" and kind == "UnknownSession":
		session = ""
		_replay()
		return
	if type == "play" and _is_replay and asked.get("job") != null and _bakes.has(asked["job"]):
		# A server that was restarted has neither the session nor the job.
		var fields = _bakes[asked["job"]][1]
		_bakes.erase(asked["job"])
		_replay_bake = request("bake", fields)
		return
	_is_replay = _is_replay and type != "play"
	if document.get("job") != null and not id:
		var job = int(document["job"])
		if _bakes.has(job):
			id = _bakes[job][0]
			_bakes.erase(job)
			_replay_bake = 0 if id == _replay_bake else _replay_bake
	error.emit(kind, text, id)


# Play anew, as last time: the server has forgotten the session.
func _replay():
	if not _play.has("type") or _play["type"] != "play":
		return
	var fields = _play.duplicate()
	_is_replay = true
	request("play", fields)


func _write_pose(i, transform):
	var at = transform.origin
	var turned = transform.basis.get_rotation_quaternion()
	_poses.seek(28 * i)
	_poses.put_float(at.x)
	_poses.put_float(at.y)
	_poses.put_float(at.z)
	_poses.put_float(turned.x)
	_poses.put_float(turned.y)
	_poses.put_float(turned.z)
	_poses.put_float(turned.w)


static func _numbered(names):
	var numbers = {}
	for i in range(names.size()):
		numbers[names[i]] = i
	return numbers


static func _joined(a, b):
	var both = a.duplicate()
	for key in b:
		both[key] = b[key]
	return both


# ---- JSON. Godot's own writes a Vector3 as a text, and control characters that JSON does not have. ----


static func json_text(value):
	if typeof(value) == TYPE_ARRAY or typeof(value) >= TYPE_PACKED_BYTE_ARRAY:  # all packed arrays are behind it
		var items = PackedStringArray()
		for item in value:
			items.append(json_text(item))
		return "[" + ",".join(items) + "]"
	match typeof(value):
		TYPE_DICTIONARY:
			var fields = PackedStringArray()
			for key in value:
				fields.append(_quoted(str(key)) + ":" + json_text(value[key]))
			return "{" + ",".join(fields) + "}"
		TYPE_VECTOR3:
			return "[%s,%s,%s]" % [_short(value.x), _short(value.y), _short(value.z)]
		TYPE_QUATERNION:
			return json_text([value.x, value.y, value.z, value.w])
		TYPE_FLOAT:
			return number_text(value)
		TYPE_INT:
			return str(value)
		TYPE_BOOL:
			return "true" if value else "false"
		TYPE_NIL:
			return "null"
	return _quoted(str(value))


# A number with at least 12 significant digits.
static func number_text(value):
	if is_nan(value) or is_inf(value):
		return "null"  # the server's message then names the field
	var exponent = 0
	if value != 0.0 and (absf(value) < 0.1 or absf(value) >= 1e9):
		exponent = int(floor(log(absf(value)) / log(10.0)))
	if exponent == 0 or exponent < -300:
		return "%.12f" % value
	return "%.12fe%d" % [value * pow(10.0, -exponent), exponent]


# A number of a Vector3, which are singles, with the fewest decimals that give it back: 0.07 and not 0.0700000003.
static func _short(value):
	for format in ["%.3f", "%.5f", "%.7f"]:
		var text = format % value
		if Vector3(float(text), 0, 0).x == value:
			return text
	return number_text(value)


static func _quoted(text):
	text = text.replace("\\", "\\\\").replace("\"", "\\\"")
	for code in range(1, 32):
		text = text.replace(char(code), "\\u%04x" % code)
	return "\"" + text + "\""
