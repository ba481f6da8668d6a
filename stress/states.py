"""Sessions with random events: clicks, drift, latency and levels, each against its bound.

python stress/states.py [clicks] [drift] [latency] [levels] [--seed 0] [--draws N] [--hours 1.5]

clicks : touches begin, move and end, objects move, sources start, stop and change their state, and up to three things
    strike at once. In any 50 ms the mix has less energy in 1.15-3.5 kHz, where no loop has any, than a step of -60 dB
    of full scale.
drift : two sources play for hours, in frames of 10 to 50 ms. The phase of a rendered tone is that of `position_s`,
    which is the clock's, within a tactile sample; a source with a duty cycle switches with the frame after each turn.
latency : from an `update` to the first sample that differs from that of a session without the event, in every model.
    An object that is put down is judged only if the model needs no preparation for it.
levels : of a source and of a strike at two distances, relative to the source or the struck point. The law is compared
    with exp(-k r), any other model with a field that its own `prepare` makes of the same table.

Prints a table in Markdown for each, and exits with 1 if a bound is broken. `--draws` is the number of games (14), lives
(2), sessions for each model (3) and tables for each model (6).
"""

from __future__ import annotations

import argparse
import math
import sys
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.signal import firwin, oaconvolve

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap import AudioClip, Bands, Contact, HapticBundle, HapticLoop, HapticSession, Plate, Pose, Touch
from scene2hap.propagation import MODELS
from scene2hap.propagation.impact import burst_of
from scene2hap.propagation.protocol import ContactNetwork, Excitation
from scene2hap.render.bursts import wave_of
from scene2hap.scene.snapshot import SceneSnapshot
from scenes import box, haptics, scene, table_with_two_phones, tone_loop

RATE, BLOCK, SLOW = 48_000, 256, 8000
MOST_CLICK_DB, MOST_DRIFT_S, MOST_LATE_S, MOST_OFF_DB = -60.0, 1 / SLOW, 0.08, 1.0
"""Bounds. A switch is late by a frame, by half the ramp of its gain, and by the 10 ms in which it is looked for."""
LOW_HZ, HIGH_HZ, WINDOW = 1150.0, 3500.0, RATE // 20
BAND = firwin(2001, (LOW_HZ, HIGH_HZ), pass_zero=False, window=("kaiser", 10.06), fs=RATE)
TOP_M, HOME = 0.72, Pose((0.1, 0.725, 0.4))
_OF_TOUCHES = ("touches begin", "touches move", "touches end")
EVENTS = (*_OF_TOUCHES, "object moves", "object lifted", "start or stop", "on or off", "other state")
Signal = NDArray[np.floating]


def steps_db(samples: Signal) -> NDArray[np.float64]:
    """For each 50 ms of samples, by their first: the step with as much energy in 1.15-3.5 kHz [dB re full scale]."""
    high = oaconvolve(samples.astype(np.float64), BAND, mode="same")
    energy = np.cumsum(np.concatenate([[0.0], high**2]))
    of_a_step = RATE / (2 * np.pi**2) * (1 / LOW_HZ - 1 / HIGH_HZ)
    return np.asarray(10 * np.log10(np.maximum(energy[WINDOW:] - energy[:-WINDOW], 1e-30) / of_a_step))


def game(
    rng: np.random.Generator, kind: str, n_events: int, *, has_strikes: bool
) -> tuple[list[tuple[int, str]], NDArray[np.float32]]:
    """Frame and name of each event, and the samples (n, 2). With strikes, sums reach full scale."""
    snapshot, bundle = table_with_two_phones()
    loops = {x: {s: tone_loop(2 * int(rng.integers(20, 200))) for s in its} for x, its in bundle.loops.items()}
    times: dict[str, Any] = {
        "start_up_s": rng.uniform(0.1, 0.6),
        "wind_down_s": rng.uniform(0.1, 0.6),
        "spins": rng.random() < 0.5,
    }
    phone = bundle.objects["phone"]
    objects = {"phone": replace(phone, states=tuple(replace(state, **times) for state in phone.states))}
    made = HapticSession(
        snapshot, replace(bundle, objects={**bundle.objects, **objects}, loops=loops), {"propagation": kind}
    )
    made.update()
    made.wait_prepared()
    touches, events, heard, lift = [], [], [], 0.0
    is_on = {"phone": True, "alarm": True}
    for name in [*rng.choice([*EVENTS, "strike"] if has_strikes else EVENTS, n_events).tolist(), "touches end"]:
        moved, at = {}, (float(rng.uniform(0.1, 1.4)), TOP_M, float(rng.uniform(0.1, 0.7)))
        events.append((made.position, name))
        if name.startswith("touches"):
            ids = rng.choice(["table", "table", "phone", "alarm"], 2)
            on = [Touch(hand, x, at) for hand, x in zip(made.hands, ids.tolist(), strict=True)]
            touches = [] if name == "touches end" else on
        elif name in ("object moves", "object lifted"):
            lift = (0.3 - lift) if name == "object lifted" else lift
            moved = {"phone": Pose((at[0], 0.725 + lift, at[2]))}
        elif name in ("start or stop", "on or off"):
            source = "phone" if name == "start or stop" else "alarm"
            made.set_source(source, on=not is_on[source])
            is_on[source] = not is_on[source]
        elif name == "other state":
            made.set_source("phone", state=str(rng.choice(["ringing", "alarm"])))
        for frame in range(int(rng.integers(20 if name == "strike" else 1, 40))):
            made.update({} if frame else moved, touches)
            if name == "strike" and not frame:
                for by in rng.choice(
                    np.array([None, "cup", "block", "alarm"]), rng.integers(1, 4), replace=False
                ).tolist():
                    made.strike("table", at, speed_m_s=float(rng.uniform(0.1, 5.0)), with_object=by)
            heard += [made.render(BLOCK) for _ in range(int(rng.integers(2, 5)))]
    made.update()
    heard.append(made.render(RATE))
    return events, np.concatenate(heard)


def clicks(seed: int, draws: int | None) -> bool:
    worst: dict[str, list[tuple[float, int]]] = defaultdict(list)
    kinds = MODELS.kinds()
    for draw in range(draws or 2 * len(kinds)):
        rng, kind, has_strikes = np.random.default_rng((seed, draw)), kinds[draw // 2 % len(kinds)], draw % 2 == 1
        events, heard = game(rng, kind, 150, has_strikes=has_strikes)
        levels = np.maximum(*(steps_db(hand) for hand in heard.T))
        for (begin, name), (end, _) in zip(events, [*events[1:], (len(levels), "")], strict=True):
            named = "game with strikes" if has_strikes and name != "strike" else name
            worst[named].append((float(levels[max(0, begin - WINDOW // 2) : max(end, begin + 1)].max()), draw))
    rows = [(name, len(each), f"{max(each)[0]:.0f}", max(each)[1]) for name, each in sorted(worst.items())]
    print_table("event | events | largest click, as a step [dB re full scale] | in game", rows)
    return max(map(max, worst.values()))[0] <= MOST_CLICK_DB


def life(rng: np.random.Generator, hours: float) -> tuple[float, float, int]:
    """How far a loop is off its place, how late a duty cycle is at most [s], and the number of its switches."""
    snapshot, bundle = table_with_two_phones()
    n, rate = int(rng.integers(2000, 200_000)), int(rng.choice([8000, 11_025, 22_050, 44_100, 48_000]))
    tone_hz = max(1, round(rng.uniform(60, 250) * n / rate)) * rate / n
    clip = AudioClip((0.3 * np.sin(2 * np.pi * tone_hz * np.arange(n) / rate)).astype(np.float32), rate)
    on_s, off_s = rng.uniform(0.3, 3.0, 2).tolist()
    states = tuple(replace(state, on_s=on_s, off_s=off_s) for state in bundle.objects["alarm"].states)
    objects = {**bundle.objects, "alarm": replace(bundle.objects["alarm"], states=states)}
    loops = {**bundle.loops, "phone": {"ringing": HapticLoop(clip, clip, tone_hz, tone_hz)}}
    made = HapticSession(snapshot, replace(bundle, objects=objects, loops=loops), {"sample_rate_hz": SLOW})
    touches = [Touch("left", "phone", HOME.position_m), Touch("right", "alarm", (1.5, 0.725, 0.4))]
    made.update(touches=touches)
    made.set_source("alarm", on=True)  # begins a turn
    drift_s, late_s, n_switches, was_on, end = 0.0, 0.0, 0, True, round(3600 * hours * SLOW)
    lengths = rng.integers(SLOW // 100, SLOW // 20, 1000).tolist()
    seconds, window, k = np.arange(SLOW) / SLOW, np.hanning(SLOW), 0
    while made.position < end:
        made.update(touches=touches)
        k += 1
        if k % 10_000 == 0:
            begin, place_s = made.position, made.position_s("phone")
            lap_s, clock_s = Fraction(n, rate), Fraction(begin, SLOW)
            wrong_s = abs(place_s - float(clock_s % lap_s))
            second = made.render(SLOW)[:, 0] * window
            turn = 1j * (second * np.exp(-2j * np.pi * tone_hz * (place_s + seconds))).sum()
            drift_s = max(drift_s, min(wrong_s, float(lap_s) - wrong_s), abs(np.angle(turn)) / (2 * np.pi * tone_hz))
            made.update(touches=touches)  # a switch during that second without an update
            made.render(SLOW // 25)
            continue
        heard = made.render(lengths[k % 1000])[-80:, 1]
        in_turn_s = made.position / SLOW % (on_s + off_s)
        is_on = in_turn_s < on_s
        if (np.abs(heard).max() > 0.15) != is_on:
            late_s = max(late_s, in_turn_s - (0.0 if is_on else on_s))
        n_switches, was_on = n_switches + (is_on != was_on), is_on
    return drift_s, late_s, n_switches


def drift(seed: int, draws: int | None, hours: float = 1.5) -> bool:
    found = [life(np.random.default_rng((seed, draw)), hours) for draw in range(draws or 2)]
    rows = [(f"{hours:g}", f"{1e3 * off_s:.3f}", n, f"{1e3 * late_s:.0f}") for off_s, late_s, n in found]
    print_table("hours | loop off its place by [ms] | switches of a duty cycle | latest by [ms]", rows)
    return all(off_s <= MOST_DRIFT_S and late_s <= MOST_LATE_S for off_s, late_s, _ in found)


ON_PHONE, ON_TABLE = Touch("left", "phone", HOME.position_m), Touch("right", "table", (0.4, TOP_M, 0.4))
Happens = Callable[[HapticSession], Any]


def switched(*, on: bool) -> Happens:
    def happens(one: HapticSession) -> None:
        one.set_source("phone", on=on)
        one.update(touches=[ON_PHONE])

    return happens


def struck(one: HapticSession) -> None:
    one.update(touches=[ON_TABLE])
    one.strike("table", (0.5, TOP_M, 0.3), with_object="cup", speed_m_s=1.0)


def without_sources(one: HapticSession) -> None:
    for source in one.source_ids:
        one.set_source(source, on=False)
    one.update(touches=[ON_TABLE])


LATENCIES: dict[str, tuple[Happens, Happens]] = {
    "touch begins": (lambda one: one.update(), lambda one: one.update(touches=[ON_PHONE])),
    "touch ends": (lambda one: one.update(touches=[ON_PHONE]), lambda one: one.update()),
    "source on": (switched(on=False), switched(on=True)),
    "source off": (switched(on=True), switched(on=False)),
    "object lifted": (
        lambda one: one.update(touches=[ON_TABLE]),
        lambda one: one.update({"phone": Pose((0.1, 1.2, 0.4))}, [ON_TABLE]),
    ),
    "object put down": (
        lambda one: one.update({"phone": Pose((0.1, 1.2, 0.4))}, [ON_TABLE]),
        lambda one: one.update({"phone": HOME}, [ON_TABLE]),
    ),
    "strike": (without_sources, struck),
}
"""Before an event, and the event."""


def latency_frames(kind: str, rng: np.random.Generator) -> dict[str, int | None]:
    """Frames from the update of each event to its first sample, None for one that cannot be felt, or not at once."""
    pair = [HapticSession(*table_with_two_phones(), {"propagation": kind, "impacts": flag}) for flag in (True, False)]
    found: dict[str, int | None] = {}
    for name, (before, event) in LATENCIES.items():
        n = RATE + int(rng.integers(RATE))
        for one in pair:
            for source in one.source_ids:
                one.set_source(source, on=True)
            one.update({"phone": HOME})
            before(one)
            one.wait_prepared()
            one.update()
            before(one)
            one.render(n)
        event(pair[0])
        then = pair[name == "object lifted"]
        is_felt = not name.startswith("object") or (then.is_current and then.would_feel([ON_TABLE])[0, 0].max() > 1e-3)
        found[name] = first_difference(*pair) if is_felt else None
    for one in pair:
        without_sources(one)
        one.wait_prepared()
        one.render_s(2.0)
    n_before, late = pair[0].stats.impacts, float(rng.random())
    for frame in range(60):
        fallen_m = min(9.81 / 2 * max(0.0, (frame - 20 + late) / 90) ** 2, 0.1)
        for one in pair:
            one.update({"cup": Pose((0.8, TOP_M + 0.15 - fallen_m, 0.3))}, [ON_TABLE])
        if pair[0].stats.impacts > n_before:
            break
        for one in pair:
            one.render_s(1 / 90)
    found["landing"] = first_difference(*pair)
    return found


def first_difference(one: HapticSession, other: HapticSession) -> int:
    """The first frame in which the next blocks of two sessions differ; beyond a block if they do not."""
    differ = (one.render(BLOCK) != other.render(BLOCK)).any(axis=1)
    return int(differ.argmax()) if differ.any() else BLOCK + 1


def latency(seed: int, draws: int | None) -> bool:
    rows: dict[str, list[int | None]] = {}
    names = [*LATENCIES, "landing"]
    for kind in MODELS.kinds():
        each = [latency_frames(kind, np.random.default_rng((seed, draw))) for draw in range(draws or 3)]
        rows[kind] = [max((x for one in each if (x := one[name]) is not None), default=None) for name in names]
    over = {None: "-", BLOCK + 1: f"over {BLOCK}"}
    shown = [[kind, *(over.get(x, x) for x in row)] for kind, row in rows.items()]
    print_table(f"frames to the first sample, of a block of {BLOCK} | " + " | ".join(names), shown)
    return all(x is None or x <= BLOCK for row in rows.values() for x in row)


class TableDraw:
    """A table of random size and material with a source on it, a struck point and two hands."""

    def __init__(self, rng: np.random.Generator) -> None:
        length, width, height = rng.uniform((0.6, 0.4, 0.012), (1.6, 0.9, 0.04)).tolist()
        material, self.hz = str(rng.choice(["oak", "steel", "glass", "pine"])), 2.0 * int(rng.integers(20, 150))
        self.table, self.source = box("table", (length, height, width), (0.0, 0.0, 0.0)), (0.1, 0.1, 0.01)
        inside = [rng.uniform(-0.45, 0.45, 2) * (length, width) for _ in range(4)]
        self.at, self.near, self.far, self.struck = ((float(x), height / 2, float(z)) for x, z in inside)
        phone = box("phone", (0.1, 0.01, 0.1), (self.at[0], height / 2 + 0.005, self.at[2]))
        self.contact = Contact("phone", "table", self.at)
        self.snapshot = SceneSnapshot("table", "y", scene(self.table, phone).objects, (self.contact,))
        objects = {"table": haptics(material, (length, width, height)), "phone": haptics("glass", self.source, "on")}
        self.bundle = HapticBundle(self.snapshot, "", objects, {"phone": {"on": tone_loop(self.hz)}})
        self.plates = {"table": Plate(length, width, height, material), "phone": Plate(*self.source, "glass")}
        corners = {item.id: item.pose.compose(item.surface.pose) for item in (self.table, phone)}
        middles = {item.id: item.pose.position_m for item in (self.table, phone)}
        self.network = ContactNetwork(self.plates, [self.contact], corners, "y", middles)

    def gains(self, kind: str, sources: Iterable[Excitation], at: tuple[float, float, float]) -> NDArray[np.float64]:
        """Gains (2, n) [-] of sources at a point of the table, at both hands, relative to that point or the source."""
        given, ways = [*sources], np.linalg.norm(np.subtract([self.near, self.far], at), axis=1)
        if kind == "exponential_plate":
            k = self.plates["table"].wavenumber_rad_m(np.array([one.frequency_tactile_hz for one in given]))
            return np.asarray(np.exp(-np.outer(ways, k)))
        is_strike = given[0].source_id != "phone"
        network = self.network
        if is_strike:
            more = [Contact(one.source_id, "table", at) for one in given]
            middles = {**network.middles_m, **{one.source_id: at for one in given}}
            network = replace(network, contacts=[*network.contacts, *more], middles_m=middles)
            # A light source brings so little into a plate that `auto` would leave its edges out.
            kind = "modal_plate" if kind == "auto" else kind
        model: Any = MODELS.build({"kind": kind, "outside_domain": "ignore"} if "_propagation" not in kind else kind)
        field = model.prepare(network, given, Bands.dominant(octaves=0.5 if "_propagation" not in kind else 0.0))
        near, far, itself = field.attenuation("table", np.array([self.near, self.far, at]))[:, :, 0]
        gains = np.stack([near, far])
        if is_strike:
            gains = gains / itself if itself.all() else np.ones_like(gains)
        return np.asarray(np.minimum(gains, 1.0))  # a session's limit


def level_errors_db(kind: str, rng: np.random.Generator) -> tuple[list[float], list[float]]:
    """Differences of rendered levels from the model, of a source and of a strike, at both hands [dB]."""
    draw = TableDraw(rng)
    config = {"propagation": kind, "skip": False}
    made = HapticSession(draw.snapshot, draw.bundle, config, hands=("itself", "near", "far"))
    hands = [Touch("near", "table", draw.near), Touch("far", "table", draw.far)]
    made.update(touches=[Touch("itself", "phone", draw.at), *hands])
    made.wait_prepared()
    made.update(touches=[Touch("itself", "phone", draw.at), *hands])
    source = [Excitation("phone", draw.hz, draw.hz, draw.plates["phone"].mass_kg)]
    of_source = differences_db(made.render(RATE)[RATE // 2 :], draw.gains(kind, source, draw.at)[:, 0])
    made.set_source("phone", on=False)
    made.update(touches=[Touch("itself", "table", draw.struck), *hands])
    made.wait_prepared()
    made.render(RATE)
    made.strike("table", draw.struck, speed_m_s=2.0)
    plate, corner = draw.plates["table"], draw.network.on_body("table", [draw.struck])[0]
    burst = burst_of(plate, (float(corner[0]), float(corner[1])), speed_m_s=2.0, is_finger=True)
    f = np.maximum(burst.frequencies_hz, 24.0)
    strikers = [Excitation(f"striker {i}", hz, hz, 1e-6) for i, hz in enumerate(f.tolist())]
    waves = [wave_of(hz, s, RATE) for hz, s in zip(burst.frequencies_hz.tolist(), burst.decays_s.tolist(), strict=True)]
    columns = np.zeros((RATE, len(waves)))
    for column, wave in zip(columns.T, waves, strict=True):
        column[: len(wave)] = wave
    weights = np.where(burst.frequencies_hz < 10.0, 0.0, burst.accelerations_m_s2)
    itself, near, far = (
        np.linalg.norm(columns @ (weights * g)) for g in (1.0, *draw.gains(kind, strikers, draw.struck))
    )
    of_strike = differences_db(made.render(RATE), np.array([near / itself, far / itself]))
    return of_source, of_strike


def differences_db(heard: Signal, gains: Signal) -> list[float]:
    """Level of hands (n, 3) relative to the first, compared with gains (2,), where either is over -54 dB [dB]."""
    level, peak = np.linalg.norm(heard.astype(np.float64), axis=0), np.abs(heard[:, 0]).max()
    found, least = np.maximum(level[1:] / level[0], 1e-6), 2e-3 / peak
    each = zip(found.tolist(), np.maximum(gains, 1e-6).tolist(), strict=True)
    return [20 * math.log10(one / other) for one, other in each if max(one, other) > least]


def levels(seed: int, draws: int | None) -> bool:
    rows, worst_db = [], 0.0
    for kind in MODELS.kinds():
        each = [level_errors_db(kind, np.random.default_rng((seed, draw))) for draw in range(draws or 6)]
        cells: list[object] = []
        for of_tables in zip(*each, strict=True):
            errors = [(abs(error_db), table) for table, one in enumerate(of_tables) for error_db in one]
            most_db, table = max(errors, default=(0.0, "-"))
            worst_db = max(worst_db, most_db)
            cells += [len(errors), f"{most_db:.2f}" if errors else "-", table]
        rows.append((kind, *cells))
    columns = "levels | off by at most [dB] | at table | levels of strikes | off by at most [dB] | at table"
    print_table(f"model | {columns}", rows)
    return worst_db <= MOST_OFF_DB


def print_table(head: str, rows: Iterable[Iterable[object]]) -> None:
    print(f"\n| {head} |\n|" + "---|" * (head.count("|") + 1))
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |", flush=True)


PARTS: dict[str, Callable[..., bool]] = {"clicks": clicks, "drift": drift, "latency": latency, "levels": levels}


def main() -> int:
    """Run the parts. Returns 1 if a bound is broken."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"{', '.join(PARTS)}; all by default")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--draws", type=int, help="of each part, instead of the numbers above")
    parser.add_argument("--hours", type=float, default=1.5, help="length of a life (1.5)")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    print(f"seed {given.seed}")
    parts = PARTS | {"drift": partial(drift, hours=given.hours)}
    broken = [name for name in given.parts or parts if not parts[name](given.seed, given.draws)]
    print(f"\nbroken: {', '.join(broken)}" if broken else "\nall within their bounds")
    return int(bool(broken))


if __name__ == "__main__":
    raise SystemExit(main())
