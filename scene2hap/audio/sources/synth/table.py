"""Table of names, verbs and patches, with the parameters of real machines.

Speeds of induction motors are those at a mains frequency of 50 Hz.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from scene2hap.audio.sources.synth.events import blows, bubbles, buzzer, music, telephone_bell
from scene2hap.audio.sources.synth.oscillating import (
    combustion,
    mains_hum,
    microwave,
    reciprocating,
    ringing_motor,
    vibration_motor,
)
from scene2hap.audio.sources.synth.patch import Patch, Rhythm
from scene2hap.audio.sources.synth.rotating import compressor, fan, motor, power_tool, pump, spinner, washing
from scene2hap.audio.sources.synth.signals import Take
from scene2hap.audio.sources.synth.working import geared, jet, rolling, rotor_slap, stepper

# In these functions, `levels` are further settings of the voice.


def _fan(shaft_hz: float, blades: int, size_m: float, **levels: Any) -> Patch:
    return Patch(partial(fan, shaft_hz=shaft_hz, blades=blades, **levels), size_m)


def _engine(firing_hz: float, loud_order: int, size_m: float, **levels: Any) -> Patch:
    return Patch(partial(combustion, firing_hz=firing_hz, loud_order=loud_order, **levels), size_m)


def _to_and_fro(stroke_hz: float, **levels: Any) -> Patch:
    return Patch(partial(reciprocating, stroke_hz=stroke_hz, **levels))


def _shaker(motor_hz: float, size_m: float | None = None) -> Patch:
    return Patch(partial(vibration_motor, motor_hz=motor_hz), size_m)


def _geared(motor_hz: float, output_hz: float, size_m: float | None, **levels: Any) -> Patch:
    """Return a geared motor; without a size an induction motor, whose speed depends on the mains and not on size."""
    return Patch(partial(geared, motor_hz=motor_hz, output_hz=output_hz, on_mains=size_m is None, **levels), size_m)


def _strokes(per_second: float, body_hz: float, decay_s: float, **levels: Any) -> Patch:
    return Patch(partial(blows, per_second=per_second, body_hz=body_hz, decay_s=decay_s, **levels))


def _tool(motor_hz: float, spindle_hz: float, size_m: float, **levels: Any) -> Patch:
    return Patch(partial(power_tool, motor_hz=motor_hz, spindle_hz=spindle_hz, **levels), size_m)


MOTOR = Patch(motor, 0.4)
_HUM = Patch(mains_hum)
_COMPRESSOR = Patch(compressor)
# An induction motor of two poles turns the crank.
_PISTONS = _to_and_fro(47.5, rattle=0.3, speed=Take.mains_speed_hz)
# A coil pulls the piston of an espresso machine once per cycle, since a diode passes only one half wave.
_VIBRATORY_PUMP = _to_and_fro(50.0, rattle=0.2, speed=Take.magnet_hz)
# Clippers without a rotating motor make 6000 strokes a minute at 50 Hz, and 7200 at 60 Hz (data sheets, from memory).
_MAGNET_CLIPPER = _to_and_fro(100.0, rattle=0.15, speed=Take.magnet_hz)
# Bubbles rise in surges.
_BOILING = Patch(partial(bubbles, largest_hz=90.0, smallest_hz=380.0), rhythm=Rhythm(4.3, 0.4, 0.02))
_SIZZLING = Patch(partial(bubbles, largest_hz=150.0, smallest_hz=500.0, per_second=1200.0))
_CRACKLING = Patch(partial(bubbles, largest_hz=100.0, smallest_hz=400.0, per_second=40.0))
# Drops strike a panel of a roof or a window at random, and each lets it ring.
_RAIN = Patch(partial(bubbles, largest_hz=80.0, smallest_hz=300.0, per_second=450.0))
_RINGING_PHONE = Patch(ringing_motor)
_TELEPHONE = Patch(telephone_bell)
_VIBRATION = Patch(vibration_motor)
# The escapement of a clockwork ticks four or five times a second.
_TIMER = _strokes(4.5, 330.0, 0.015, click=0.6)
_TICK = Patch(partial(blows, per_second=1.0, body_hz=210.0, decay_s=0.03), 0.3)
_ALARM = Patch(partial(buzzer, pitch_hz=240.0, on_s=0.25, off_s=0.25))
_HORN = Patch(partial(buzzer, pitch_hz=220.0))
_BUZZER = Patch(partial(buzzer, pitch_hz=100.0, on_mains=True))
# Wings of a worker bee beat at some 235 Hz; there are always some at work (from memory).
_BEES = Patch(partial(buzzer, pitch_hz=235.0), rhythm=Rhythm(3.3, 0.28, 0.1))
_CHIME = _strokes(1.0, 260.0, 0.35, click=0.1)
# Cats purr at 26.3 Hz, give or take 2, breathing in and out (Frazer Sissom, Rice and Peters, J Zool 223, 1991).
_PURR = replace(_strokes(26.3, 79.0, 0.012, click=0.05), rhythm=Rhythm(1.4, 0.28, 0.03))
_DRIP = _strokes(1.3, 300.0, 0.02)
_JACKHAMMER = _strokes(25.0, 125.0, 0.03)
_CLATTER = _strokes(30.0, 120.0, 0.015)
# A motor of 7000 turns a minute drives the needle by a belt, for up to 850 stitches a minute, in machines of any size.
# A crank moves the needle, so that its strokes are regular (data sheets of household machines, from memory).
_STITCHES = Patch(partial(geared, motor_hz=117.0, output_hz=14.0, load=0.3, rumble=0.3, thump_hz=112.0, slack=0.0))
# 4200 blows a minute of a pneumatic striker (data sheets of rotary hammers of 3 kg, from memory).
_ROTARY_HAMMER = _strokes(70.0, 140.0, 0.012)
_CAR = _engine(28.0, 2, 4.5)
_DIESEL = _engine(35.0, 2, 7.0)
_SMALL_ENGINE = _engine(25.0, 2, 1.0)
_SHAKER = _shaker(60.0, 0.2)
_TWO_STROKE = _engine(117.0, 1, 0.8)
# Two cutting edges at 18 turns a second.
_DRILL = replace(_tool(250.0, 18.0, 0.25), rhythm=Rhythm(36.0, 0.4))
# Its blades sit on the motor; what they hit passes under them twice a turn, and now and then.
_BLENDER = replace(_tool(290.0, 290.0, 0.4, spindle=0.0), rhythm=Rhythm(13.0, 0.4, 0.05))
# Beans break under the blades, more of them at a time than a blender's soft contents.
_COFFEE_GRINDER = replace(_tool(260.0, 260.0, 0.25, spindle=0.0), rhythm=Rhythm(21.0, 0.5, 0.05))
# A universal motor behind a planetary gear, whose beater meets the dough two or three times a second.
_DOUGH_MIXER = _geared(165.0, 2.6, 0.4, load=0.3, rumble=0.3)
_GRINDER = _tool(420.0, 183.0, 0.3, spindle=1.5)
_CUTTER = _tool(300.0, 300.0, 0.3, spindle=0.0)
# Blades of 165 to 250 mm turn 5500 times a minute, behind a gear of 1 to 4 (data sheets, from memory).
_CIRCULAR_SAW = _tool(370.0, 92.0, 0.4, spindle=1.5)
_PUMP = Patch(pump, 0.3)
_MUSIC = Patch(music)
# Blades that differ slightly, loaded by air; 1400 turns a minute. With more flow, some takes would be felt at the blade
# rate and others at twice this rate, since noise uses up the head-room that 100 Hz needs.
_BREEZE = replace(_fan(23.3, 5, 0.4, rotor=0.5, blade=1.0, flow=0.7), rhythm=Rhythm(1.9, 0.28, 0.02))
# The air flutters in the nozzle.
_BLOWER = replace(_fan(220.0, 9, 0.22, blade=0.2, flow=0.7), rhythm=Rhythm(10.7, 0.35, 0.03))
# Two fans with almost equal speeds.
_COMPUTER = replace(_fan(26.0, 7, 0.12, rotor=0.4, blade=1.0, flow=1.8), rhythm=Rhythm(1.45, 0.32, 0.02))
_CASE_FAN = replace(_fan(26.0, 7, 0.12, rotor=0.6, blade=1.0, flow=2.3), rhythm=Rhythm(0.7, 0.12, 0.02))
_CENTRIFUGE = _fan(66.0, 4, 0.4, blade=0.1, flow=0.2)
_KNEADER = _geared(48.0, 3.5, None, load=0.25)
_CONVEYOR = _geared(48.0, 9.0, None, rumble=0.4)
_GEAR_MOTOR = _geared(95.0, 3.0, 0.5)
# A membrane or rollers move a fluid once or twice a second (data sheets of breast and dialysis pumps, from memory).
_FLUID_PUMP = _geared(95.0, 1.2, 0.2, load=0.25)
# Rows of teeth on slow shafts meet the paper six times a second (assumed).
_SHREDDER = _geared(100.0, 6.0, 0.4, load=0.3, rumble=0.5)
# A generator hums, and a blade passes the tower every 1.3 s: three blades, 15 turns a minute (data sheets of wind
# turbines, from memory).
_WIND_TURBINE = replace(_HUM, rhythm=Rhythm(0.75, 0.28, 0.02))
# Wheels on the shaft of a two-pole motor.
_BENCH_GRINDER = _geared(48.0, 48.0, None, load=0.1, rumble=0.4)
_WINCH = _geared(48.0, 6.0, None)
_ELECTRIC_DRIVE = _geared(90.0, 8.0, 1.5)
_TUMBLER = replace(_geared(48.0, 0.85, None, load=0.1, thump_hz=70.0), rhythm=Rhythm(0.85, 0.28, 0.0))
# Each move begins with a jerk.
_STEPPER = Patch(stepper, rhythm=Rhythm(2.7, 0.28, 0.02))
_ROLLING = Patch(rolling)
_HISS = Patch(jet)
_WATER = Patch(partial(jet, low_hz=60.0, tilt_db=-4.5))
_ROAR = Patch(partial(jet, low_hz=40.0, tilt_db=-5.5))
_STEAM = Patch(partial(jet, pump=1.5))

# Names (any of them), verbs (any of them; "" for all), patch.
TABLE: tuple[tuple[str, str, Patch], ...] = (
    # the kitchen
    ("refrigerator, freezer, minibar, wine cooler, water cooler, dehumidifier, milk tank", "", _COMPRESSOR),
    ("water dispenser, vending machine, heat pump, ice machine, ice maker", "", _COMPRESSOR),
    # Its transformer feeds a rectifier of one diode: every other half wave pulls harder.
    ("microwave", "", Patch(microwave, rhythm=Rhythm(50.0, 0.4, 0.0, on_mains=True))),
    ("hood", "", _fan(42.0, 7, 0.6, flow=0.7)),
    ("oven, stove, cooktop, cooker, hob, hotplate, toaster", "", _HUM),
    ("cooker, steamer", "boil, bubble, simmer", _BOILING),
    ("stove, burner", "hiss, roar", _ROAR),
    ("stove, fireplace", "crackle", _CRACKLING),
    ("air fryer", "", _fan(46.0, 7, 0.35, blade=0.3, flow=0.7)),
    ("pan, pot, kettle, wok, cauldron, fryer, soup, rice cooker, slow cooker", "", _BOILING),
    ("pan, wok, fryer, iron", "sizzle, fry, sear", _SIZZLING),
    ("grill, barbecue", "", _SIZZLING),
    # Two spray arms pass at 40 turns a minute.
    ("dishwasher", "", Patch(pump, 0.6, rhythm=Rhythm(1.3, 0.28, 0.0))),
    ("coffeemaker", "", _VIBRATORY_PUMP),
    ("blender, food processor, juicer, milk frother", "", _BLENDER),
    ("coffee grinder, coffee mill, spice grinder", "", _COFFEE_GRINDER),
    ("mixer", "", _DOUGH_MIXER),
    # Its cup circles at 2500 turns a minute (data sheets, from memory).
    ("vortex mixer", "", _shaker(42.0, 0.2)),
    ("amalgamator", "", _shaker(70.0, 0.2)),
    ("bread maker", "", _KNEADER),
    ("knife", "", _to_and_fro(50.0, rattle=0.3)),
    # bathroom and laundry
    ("washer", "", Patch(washing)),
    ("washer", "spin, centrifuge, dry", Patch(spinner, 0.6)),
    ("washer", "rinse, fill, flow", Patch(partial(washing, drum_hz=0.7, slosh=0.5))),
    ("washer", "drain, pump", Patch(partial(pump, vanes=3), 0.6)),
    ("dryer, dry cleaner", "", _TUMBLER),
    # Its head passes from tooth to tooth.
    ("toothbrush, facial brush", "", replace(_to_and_fro(260.0), rhythm=Rhythm(4.5, 0.28, 0.02))),
    ("shaver, razor, trimmer, epilator", "", _to_and_fro(110.0, rattle=0.15)),
    ("clipper", "", _MAGNET_CLIPPER),
    ("hairdryer, hand dryer, heat gun, hot brush", "", _BLOWER),
    ("massager, massage gun, vibrator, massage mattress, massage pillow, foot spa", "", _SHAKER),
    ("massage chair", "", _geared(48.0, 0.7, 1.1, load=0.2)),
    ("flosser", "", _strokes(23.3, 140.0, 0.015, click=0.05)),
    # moving air, cooling, cleaning
    ("fan, ventilator, purifier, humidifier, fan heater, aircon, vent", "", _BREEZE),
    ("heater", "blow", _BREEZE),
    # Its blades pass too slowly to be felt; its motor of many poles hums.
    ("ceiling fan", "", _HUM),
    ("handheld fan, hand fan, mini fan, usb fan, nail dryer", "", _fan(80.0, 3, 0.12)),
    ("computer, laptop, console, projector", "", _COMPUTER),
    ("computer fan, case fan", "", _CASE_FAN),
    ("workstation, gpu, network rack, mining rig, supercomputer", "", _COMPUTER),
    # Flat cases need small fans of 9000 turns a minute (data sheets, from memory).
    ("server, rack server, server rack", "", _fan(150.0, 5, 0.45, blade=0.3, flow=0.8)),
    # A disc of 5400 turns a minute in a light case, and a drum of heads of 1500 (data sheets, from memory).
    ("set top box, settop box, dvr, media player", "", _fan(90.0, 3, 0.25, blade=0.05, flow=0.1)),
    ("vcr, video recorder, tape recorder, cassette deck", "", _geared(62.0, 25.0, 0.4, load=0.4)),
    ("hard drive, hard disk", "", _fan(120.0, 3, 0.15, blade=0.05, flow=0.1)),
    ("vacuum sealer", "", _PISTONS),
    # The nozzle flutters on a carpet.
    ("vacuum", "", replace(_fan(330.0, 7, 0.4, blade=0.1, flow=0.6), rhythm=Rhythm(2.8, 0.28, 0.02))),
    ("steam cleaner, steamer, iron, paint sprayer, sprayer", "", _STEAM),
    ("sprinkler, hose, car wash", "", _HISS),
    ("pressure washer", "", Patch(partial(pump, vanes=3), 0.6)),
    # small things
    ("phone, smartwatch, pager, tablet", "", _RINGING_PHONE),
    ("telephone, rotary phone, landline, payphone, phone booth", "", _TELEPHONE),
    ("gamepad, controller, joystick", "", _shaker(48.0)),
    ("clock, watch", "", _TICK),
    # 120 beats a minute, the middle of its scale.
    ("metronome", "", _strokes(2.0, 230.0, 0.025)),
    # A balance of 18,000 beats an hour (watchmakers' tables, from memory).
    ("pocket watch", "", _strokes(5.0, 300.0, 0.012, click=0.6)),
    ("timer", "", _TIMER),
    ("alarm clock, alarm, siren, smoke detector", "", _ALARM),
    ("clock, watch, timer, alarm clock", "ring, beep, buzz", _ALARM),
    ("clock, alarm clock", "tick", _TICK),
    ("buzzer, doorbell, bell, intercom", "", _BUZZER),
    ("doorbell, bell, chime", "chime, ring, toll, tinkle", _CHIME),
    ("speaker, loudspeaker, radio, stereo, subwoofer, jukebox, turntable, boombox, piano, guitar", "", _MUSIC),
    ("tv, monitor", "play", _MUSIC),
    ("monitor, scanner, defibrillator", "beep", _ALARM),
    ("transformer, lamp, light, charger, adapter, amplifier, tv, monitor, router, heater, radiator", "", _HUM),
    ("welding machine, welder, elevator, power plant", "", _HUM),
    ("printer, copier, scanner, fax, plotter, cnc machine", "", _STEPPER),
    ("pump, fountain, aquarium, boiler, pool cleaner, bubbler, parts washer, log splitter", "", _PUMP),
    ("pressure monitor", "", _PUMP),
    ("toilet, tap, faucet, shower, pipe, bathtub, river, waterfall, stream", "", _WATER),
    ("tap, faucet, shower, pipe", "drip", _DRIP),
    # Metal that slips as it warms.
    ("radiator, heater, pipe", "tick", _TICK),
    ("drone, quadcopter", "", _fan(90.0, 2, 0.3, rotor=0.4, blade=1.0)),
    ("robot, gearbox, wiper, citrus press, bread slicer, electric opener, electric desk", "", _GEAR_MOTOR),
    ("money counter, claw machine, toll gate, turnstile, automatic door, stairlift", "", _GEAR_MOTOR),
    ("sewing machine, embroidery machine, knitting machine", "", _STITCHES),
    # Two hundred picks a minute of a shuttle (from memory).
    ("loom", "", _strokes(3.3, 90.0, 0.04)),
    # A platform circles at 240 turns a minute (data sheets, from memory).
    ("orbital shaker", "", _geared(48.0, 4.0, None)),
    # workshop and machines
    ("drill, screwdriver", "", _DRILL),
    ("grinder, sander, polisher, saw", "", _GRINDER),
    ("circular saw, table saw, mitre saw, miter saw", "", _CIRCULAR_SAW),
    # Wheels of 300 mm turn 18 times a second behind a belt (data sheets, from memory).
    ("band saw", "", _geared(48.0, 18.0, None, rumble=0.4)),
    ("bench grinder", "", _BENCH_GRINDER),
    ("shredder", "", _SHREDDER),
    ("wood chipper", "", _GRINDER),
    ("wood router, rotary tool, planer", "", _CUTTER),
    # A handpiece of 20,000 turns a minute at its drill (data sheets, from memory).
    ("dental drill", "", _tool(333.0, 333.0, 0.2, spindle=0.0)),
    ("jigsaw, reciprocating saw", "", _to_and_fro(46.0, rattle=0.3)),
    ("jackhammer, breaker, demolition hammer", "", _JACKHAMMER),
    ("hammer drill", "", _ROTARY_HAMMER),
    # 660 blows a minute; its spring spreads each of them (data sheets, from memory).
    ("rammer", "", _strokes(11.0, 77.0, 0.065)),
    # An eccentric of 5400 turns a minute (data sheets, from memory).
    ("compactor", "", _shaker(90.0, 0.7)),
    ("impact driver, impact wrench", "", _strokes(58.0, 174.0, 0.01)),
    ("nail gun, stapler", "", _strokes(1.5, 150.0, 0.04)),
    ("lathe, milling machine, drill press", "", _geared(48.0, 12.0, None)),
    ("infusion pump, dialysis machine, breast pump", "", _FLUID_PUMP),
    ("turbine", "", _WIND_TURBINE),
    ("compressor, air pump, suction pump, oxygen concentrator, refinery", "", _PISTONS),
    # A magnet at twice the mains shakes trays and bowls.
    ("bowl feeder", "", _MAGNET_CLIPPER),
    # An unbalanced mass of 960 turns a minute throws stones up, and they strike the deck (data sheets, from memory).
    ("screening machine", "", _strokes(16.0, 64.0, 0.04)),
    ("motor", "", MOTOR),
    ("conveyor, conveyor belt, escalator, travelator, stair climber", "", _CONVEYOR),
    ("treadmill", "", _geared(60.0, 2.6, 1.8, rumble=0.3, thump_hz=75.0)),
    ("hoist, winch, lift, crane", "hum, whir", _WINCH),
    ("funicular, ferris wheel, carousel, kiddie ride, honey extractor, rotary iron, pumpjack", "", _WINCH),
    ("power tool", "", _DRILL),
    # garden and building site
    # The cutting chain loads the engine.
    ("chainsaw", "", replace(_engine(150.0, 1, 0.8, revs=0.04, roar=2.0), rhythm=Rhythm(7.0, 0.4, 0.3))),
    ("chainsaw", "rev, start, throttle", _engine(130.0, 1, 0.8, revs=0.35, rev_s=1.7, roar=2.0)),
    ("leafblower, string trimmer, brush cutter", "", _TWO_STROKE),
    # Its blades reverse 3400 times a minute (data sheets, from memory).
    ("hedge trimmer", "", _to_and_fro(56.7, rattle=0.4)),
    ("lawnmower, generator, tiller, scarifier, snow blower, cultivator", "", _SMALL_ENGINE),
    ("robot mower", "", _fan(50.0, 3, 0.6)),
    ("concrete mixer, cement mixer", "", _geared(48.0, 0.5, None, load=0.1, rumble=0.4, thump_hz=60.0)),
    ("concrete poker", "", _shaker(200.0)),
    ("power plate, vibration plate, road roller", "", _shaker(45.0)),
    ("pile driver, forging hammer, hydraulic press, molding machine", "", _strokes(0.8, 55.0, 0.15)),
    # road, rail, air
    ("car, van, taxi, engine, ambulance, camper, buggy, kart, atv, quad bike, jet ski, snowmobile", "", _CAR),
    ("outboard motor", "", _CAR),
    ("truck, bus, tractor, excavator, bulldozer, forklift, boat, crane, cement truck", "", _DIESEL),
    ("loader, grader, digger, locomotive, ship, yacht, motorboat, speedboat, harvester, snow plow", "", _DIESEL),
    ("hovercraft, baler, feed wagon, manure spreader, drilling rig, oil rig", "", _DIESEL),
    ("motorcycle, scooter, moped", "", _engine(24.0, 2, 2.0)),
    ("scooter, forklift, car, bike, skateboard, hoverboard, segway, wheelchair", "hum", _ELECTRIC_DRIVE),
    ("electric car, bumper car, golf cart, toy train, stacker, submarine, thruster", "", _ELECTRIC_DRIVE),
    ("train, tram, subway, metro", "", _ROLLING),
    # Two blades at 2400 turns a minute pass as often as its four cylinders fire (data sheets, from memory).
    ("propeller plane", "", _engine(80.0, 1, 8.0)),
    # The first shaft of a turbofan at cruise; its blade rate is far above the range of touch.
    ("airplane, aeroplane, plane, jet", "", _fan(75.0, 24, 30.0, blade=0.05, flow=0.8)),
    ("helicopter", "", Patch(rotor_slap)),
    # by verb, if the object is unknown
    ("", "boil, bubble, simmer", _BOILING),
    ("", "sizzle, fry", _SIZZLING),
    ("", "tick", _TICK),
    ("", "ring, beep, alarm", _ALARM),
    ("", "chime, toll, tinkle", _CHIME),
    ("", "buzz", _BUZZER),
    ("bee, beehive, bee hive", "", _BEES),
    ("rain", "", _RAIN),
    ("", "rain, patter", _RAIN),
    ("", "hum", _HUM),
    ("", "vibrate, shake", _VIBRATION),
    ("", "purr", _PURR),
    ("", "drip", _DRIP),
    ("", "blow, whir, ventilate", _BREEZE),
    ("", "drill", _DRILL),
    ("", "grind, sand, saw", _GRINDER),
    ("", "hammer, pound", _JACKHAMMER),
    ("", "clatter, rattle", _CLATTER),
    ("", "knead, tumble, churn, stir", _KNEADER),
    ("", "hiss, spray, steam", _HISS),
    ("", "roar", _ROAR),
    ("", "crackle, pop", _CRACKLING),
    ("", "spin", _CENTRIFUGE),
    ("", "blare, honk, wail", _HORN),
    ("", "pulse, throb, thump", _SHAKER),
    ("", "rumble, roll", _ROLLING),
    ("", "print, scan", _STEPPER),
    ("", "pump", _PUMP),
    ("", "flow, flush, gurgle, drain, trickle, swish", _WATER),
    ("", "idle, rev", _CAR),
    ("", "play, boom", _MUSIC),
    ("", "cool, chill", _COMPRESSOR),
)
