"""Which voice speaks for which object and verb, with the numbers of real machines.

Size law: the speed of a machine is that of a reference machine times (reference / size)^(1/2), size being the longest
side, within 3/4 and 4/3. Machines of equal tip speed would give the power 1, but larger ones of a kind are not scaled
copies. Power and bounds are assumed. Whatever runs on the mains' own frequency does not change with size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from scene2hap.audio.sources.synth.events import blows, bubbles, buzzer, music
from scene2hap.audio.sources.synth.oscillating import (
    combustion,
    mains_hum,
    microwave,
    reciprocating,
    vibration_motor,
)
from scene2hap.audio.sources.synth.rotating import compressor, fan, motor, power_tool, pump, spinner
from scene2hap.audio.sources.synth.signals import Signal, Take
from scene2hap.audio.sources.words import noun_phrase, stems

SIZE_POWER = 0.5
SIZE_FACTOR_BOUNDS = (0.75, 4.0 / 3.0)


@dataclass(frozen=True)
class Patch:
    """A voice with its numbers.

    `dominant_hz` bounds the strongest frequency at reference size; `reference_m` is the longest side of the machine
    meant by the numbers, None where size does not matter; `is_steady` says that it loops without ado.
    """

    voice: Callable[[Take], Signal]
    dominant_hz: tuple[float, float]
    reference_m: float | None = None
    is_steady: bool = True

    def size_factor(self, longest_m: float) -> float:
        """What multiplies frequencies for a machine of that size [m]; 1 where the size is unknown (0)."""
        if self.reference_m is None or longest_m <= 0.0:
            return 1.0
        return float(np.clip((self.reference_m / longest_m) ** SIZE_POWER, *SIZE_FACTOR_BOUNDS))


def _fan(
    shaft_hz: float, blades: int, size_m: float, *, rotor: float = 1.0, blade: float = 0.5, flow: float = 0.5
) -> Patch:
    """A fan whose rotor dominates, or its blades where their level is higher."""
    order = blades if blade > rotor else 1
    voice = partial(fan, shaft_hz=shaft_hz, blades=blades, rotor=rotor, blade=blade, flow=flow)
    return Patch(voice, (0.96 * order * shaft_hz, 1.04 * order * shaft_hz), size_m)


def _engine(firing_hz: float, loud_order: int, size_m: float) -> Patch:
    loud_hz = loud_order * firing_hz
    voice = partial(combustion, firing_hz=firing_hz, loud_order=loud_order)
    return Patch(voice, (0.95 * loud_hz, 1.05 * loud_hz), size_m)


def _to_and_fro(stroke_hz: float, *, rattle: float = 0.1) -> Patch:
    return Patch(partial(reciprocating, stroke_hz=stroke_hz, rattle=rattle), (0.96 * stroke_hz, 1.04 * stroke_hz))


MOTOR = Patch(motor, (46.0, 50.0), 0.4)
_HUM = Patch(mains_hum, (99.8, 100.2))
_COMPRESSOR = Patch(compressor, (48.5, 49.5))
_BOILING = Patch(partial(bubbles, largest_hz=90.0, smallest_hz=380.0), (80.0, 420.0))
_SIZZLING = Patch(partial(bubbles, largest_hz=150.0, smallest_hz=500.0, per_second=1200.0), (130.0, 550.0))
_PHONE = Patch(vibration_motor, (175.0, 190.0))
_TICK = Patch(partial(blows, per_second=1.0, body_hz=210.0, decay_s=0.03), (180.0, 240.0), 0.3, is_steady=False)
_ALARM = Patch(partial(buzzer, pitch_hz=240.0, on_s=0.25, off_s=0.25), (235.0, 245.0), is_steady=False)
_BUZZER = Patch(partial(buzzer, pitch_hz=100.0), (98.0, 102.0))
_JACKHAMMER = Patch(partial(blows, per_second=25.0, body_hz=125.0, decay_s=0.03), (95.0, 155.0))
_CAR = _engine(28.0, 2, 4.5)
_DRILL = Patch(partial(power_tool, motor_hz=250.0, spindle_hz=18.0), (240.0, 260.0), 0.25)
_GRINDER = Patch(partial(power_tool, motor_hz=420.0, spindle_hz=183.0, spindle=1.5), (176.0, 190.0), 0.3)
_PUMP = Patch(pump, (276.0, 300.0), 0.3)
_MUSIC = Patch(music, (60.0, 135.0), is_steady=False)
_BREEZE = _fan(22.0, 5, 0.4, rotor=0.5, blade=1.0)

# Names (any of them), verbs (any of them; "" for all), patch.
_TABLE: tuple[tuple[str, str, Patch], ...] = (
    # the kitchen
    ("refrigerator, freezer, minibar, wine cooler, water cooler, dehumidifier", "", _COMPRESSOR),
    ("microwave", "", Patch(microwave, (99.8, 100.2))),
    ("hood", "", _fan(42.0, 7, 0.6, flow=0.7)),
    ("oven, stove, cooktop, cooker, hob, hotplate, toaster", "", _HUM),
    ("pan, pot, kettle, wok, cauldron, fryer, soup", "", _BOILING),
    ("pan, wok, fryer", "sizzle, fry, sear", _SIZZLING),
    ("grill, barbecue", "", _SIZZLING),
    ("dishwasher", "", Patch(pump, (276.0, 300.0), 0.6)),
    ("coffeemaker", "", _to_and_fro(50.0, rattle=0.2)),
    ("blender, mixer, food processor, juicer, coffee grinder", "", Patch(_DRILL.voice, (240.0, 260.0), 0.4)),
    # bathroom and laundry
    ("washer", "", Patch(spinner, (204.0, 221.0), 0.6)),
    ("dryer", "", Patch(motor, (46.0, 50.0), 0.6)),
    ("toothbrush", "", _to_and_fro(260.0)),
    ("shaver, razor, trimmer, clipper, epilator", "", _to_and_fro(110.0, rattle=0.15)),
    ("hairdryer, hand dryer", "", _fan(220.0, 9, 0.22, blade=0.2, flow=0.7)),
    ("massager, massage gun, vibrator", "", Patch(partial(vibration_motor, motor_hz=60.0), (57.0, 63.0), 0.2)),
    # moving air, cooling, cleaning
    ("fan, ventilator, purifier, humidifier, fan heater, aircon, vent", "", _BREEZE),
    ("handheld fan, hand fan, mini fan, usb fan", "", _fan(80.0, 3, 0.12)),
    ("computer, laptop, server, console, projector, computer fan", "", _fan(26.0, 7, 0.12, rotor=0.4, blade=1.0)),
    ("vacuum", "", _fan(330.0, 7, 0.4, blade=0.1, flow=0.6)),
    # small things
    ("phone, smartwatch, pager, tablet", "", _PHONE),
    ("gamepad, controller, joystick", "", Patch(partial(vibration_motor, motor_hz=48.0), (45.0, 51.0))),
    ("clock, watch, metronome, timer", "", _TICK),
    ("alarm clock, alarm, siren, smoke detector", "", _ALARM),
    ("clock, watch, timer, alarm clock", "ring, beep, buzz", _ALARM),
    ("clock, alarm clock", "tick", _TICK),
    ("buzzer, doorbell, bell, intercom", "", _BUZZER),
    ("speaker, loudspeaker, radio, stereo, subwoofer, jukebox, turntable, boombox, piano, guitar", "", _MUSIC),
    ("tv, monitor", "play", _MUSIC),
    ("transformer, lamp, light, charger, adapter, amplifier, tv, monitor, router, printer, heater, radiator", "", _HUM),
    ("pump, fountain, aquarium, boiler, toilet, tap, faucet, shower, pipe, bathtub", "", _PUMP),
    # workshop, garden, road
    ("drill, screwdriver", "", _DRILL),
    ("grinder, sander, polisher, circular saw, saw", "", _GRINDER),
    ("jigsaw, reciprocating saw", "", _to_and_fro(46.0, rattle=0.3)),
    ("jackhammer, rammer, compactor, breaker, hammer drill", "", _JACKHAMMER),
    ("chainsaw", "", _engine(150.0, 1, 0.8)),
    ("leafblower", "", _engine(117.0, 1, 0.8)),
    ("lawnmower, generator", "", _engine(25.0, 2, 1.0)),
    ("car, van, taxi, engine", "", _CAR),
    ("truck, bus, tractor, excavator, bulldozer, forklift, boat, crane, cement mixer", "", _engine(35.0, 2, 7.0)),
    ("motorcycle, scooter, moped", "", _engine(24.0, 2, 2.0)),
    # by what they do, where the thing itself is unknown
    ("", "boil, bubble, simmer", _BOILING),
    ("", "sizzle, fry", _SIZZLING),
    ("", "tick", _TICK),
    ("", "ring, beep, alarm", _ALARM),
    ("", "buzz", _BUZZER),
    ("", "hum", _HUM),
    ("", "vibrate", _PHONE),
    ("", "blow, whir, ventilate", _BREEZE),
    ("", "drill", _DRILL),
    ("", "grind, sand, saw", _GRINDER),
    ("", "pump, flow, gurgle, drain", _PUMP),
    ("", "idle, rev", _CAR),
    ("", "play", _MUSIC),
    ("", "cool, chill", _COMPRESSOR),
)


def patch_for(category: str, *phrases: str) -> Patch:
    """The patch whose name fits a category best, given phrases that may hold the verb; `MOTOR` if none fits.

    A name that holds the category's head noun goes before one that shares another word, a patch made for the verb
    before one for any, more shared words before fewer.
    """
    nouns = noun_phrase(category)
    # A boiling frying pan does not fry: what belongs to the name is no verb.
    spoken = {stem for phrase in phrases for stem in stems(phrase)}.difference(nouns)
    best, best_fit = MOTOR, (False, False, False, 0)
    for name, verbs, patch in _rows():
        if verbs and not verbs & spoken:
            continue
        if not name <= set(nouns):
            continue
        fit = (bool(name.intersection(nouns[-1:])), bool(name), bool(verbs), len(name))
        if fit > best_fit:
            best, best_fit = patch, fit
    return best


def patches() -> tuple[Patch, ...]:
    """Every patch of the table, and `MOTOR`."""
    return (*dict.fromkeys(patch for _, _, patch in _TABLE), MOTOR)


@cache
def _rows() -> tuple[tuple[frozenset[str], frozenset[str], Patch], ...]:
    return tuple(_expanded())


def _expanded() -> Iterator[tuple[frozenset[str], frozenset[str], Patch]]:
    """One row for each name, in stems."""
    for names, verbs, patch in _TABLE:
        for name in names.split(","):
            yield frozenset(stems(name)), frozenset(stems(verbs)), patch
