# Prints the frame and reads the gains that docs/bridge-protocol.md has in hexadecimal.
extends RefCounted


func run(game):
	var hap = game.hap
	var phone = Node3D.new()
	phone.position = Vector3(0.25, 0.724, 0)
	game.add_child(phone)
	hap.track("phone", phone)
	hap._take({
		"type": "playing",
		"session": "c2f1a09b",
		"key": "00112233445566ff",
		"layout": 1,
		"objects": ["phone", "table", "lamp"],
		"n_moving": 1,
		"hands": ["left", "right"],
		"sources": [{"id": "phone", "state": "ringing", "states": ["ringing"], "frequency_hz": 175.0}],
		"n_bands": 1,
		"sequence": 7,
		"watchdog_s": 1.0,
	})
	hap.touch("left", "table", Vector3(0.5, 0.72, 0))
	print("frame ", hap.encode_frame(0.5).hex_encode())
	var gains = "53324842020101000000000000000000" + "0700000000000000000000000000e03f"
	gains += "0200010001000000" + "0000003e00000000" + "0000003f00000000"
	var bytes = PackedByteArray()
	for i in range(gains.length() >> 1):
		bytes.append(gains.substr(2 * i, 2).hex_to_int())
	print("of ", bytes.hex_encode())
	print("read ", hap.read_gains(bytes, Time.get_ticks_usec()))
	print("intensities ", hap.intensity("left"), " ", hap.intensity("right"))
	print("gains ", hap.gain("left", "phone"), " ", hap.gain("right", "phone"))
	print("cut ", hap.read_gains(bytes.slice(0, bytes.size() - 1), Time.get_ticks_usec()))
	OS.delay_msec(1200)
	print("stale ", hap.intensity("left"), " ", hap.gain("left", "phone"))
