"""Cost of impacts on the game's thread, their latency, and whether they click, as tables in Markdown.

OMP_NUM_THREADS=1 python benchmarks/impacts.py
OMP_NUM_THREADS=1 python benchmarks/impacts.py --scene kitchen.glb --seed 2

*Struck*: the game strikes the touched object 100 times a second, within 0.6 m of the hand. *Landing*: cups fall on the
touched object again and again from 0.2 m; there are so many that 100 land each second, and all move in every update.
The time is the processor time of the whole update. Both run with default settings, at 90 updates a second, on a lone
table or on the floor of a scene.

The other tables are for models that need preparation, in the demo's kitchen or the scene. Strikes hit objects that a
hand touches at another point, and objects that are connected with the touched one. The tables show the number of felt
strikes, the number felt in the next block, and the time of `strike`. They also show the level difference between gains
prepared ahead and gains prepared for the impact itself. Components below 24 Hz count as components at 24 Hz.
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import time

import numpy as np
from numpy.typing import NDArray
from spawning import bundle_of, on_floor, on_table, thing

from scene2hap import HapticBundle, HapticSession, Plate, Pose, SceneSnapshot, Touch, bake, load_scene
from scene2hap.common.arrays import Floats
from scene2hap.demo import kitchen_path
from scene2hap.propagation import MODELS
from scene2hap.propagation.impact import burst_of
from scene2hap.propagation.protocol import PropagationModel
from scene2hap.session.impacts.gains import struck_later
from scene2hap.session.present_scene.scene_state import SceneState

UPDATES_HZ, IMPACTS_HZ, RATE_HZ, BLOCK, G = 90, 100, 48_000, 256, 9.81
LOWEST_HZ = 24.0
FALL_M, CUP_M = 0.2, 0.1


def struck(
    session: HapticSession, touches: list[Touch], seconds: float, seed: int
) -> tuple[Floats, NDArray[np.float32], int]:
    """Strike the touched object. Returns times [ms] of each update with its strikes, samples, and number of strikes."""
    rng, due, n_struck = np.random.default_rng(seed), 0.0, 0
    times, heard = [], []
    for _ in range(round(seconds * UPDATES_HZ)):
        due += IMPACTS_HZ / UPDATES_HZ
        begin = time.thread_time()
        session.update(touches=touches)
        while due >= 1:
            due, n_struck = due - 1, n_struck + 1
            (x, y, z), (r, angle) = touches[0].point_m, (rng.uniform(0.02, 0.6), rng.uniform(0, 2 * np.pi))
            point, speed = (x + r * np.cos(angle), y, z + r * np.sin(angle)), float(rng.uniform(0.2, 3.0))
            session.strike(touches[0].object_id, point, speed_m_s=speed)
        times.append(1e3 * (time.thread_time() - begin))
        heard.append(session.render_s(1 / UPDATES_HZ)[:, 0])
    return np.array(times), np.concatenate(heard), n_struck


def falling(
    session: HapticSession, touches: list[Touch], spots: list[Pose], seconds: float
) -> tuple[Floats, NDArray[np.float32], int]:
    """Let cups fall on the touched object. Returns times [ms] of each update, samples, and number of landings."""
    fall_s = (2 * FALL_M / G) ** 0.5
    period_s = 2 * fall_s + 0.2
    n_cups = min(len(spots), round(IMPACTS_HZ * period_s))
    prefab = bundle_of(thing("cup", (CUP_M,) * 3, (0.0, 0.0, 0.0)), "ceramic", None)
    for n in range(n_cups):
        session.spawn(prefab, f"cup {n}", spots[n])
    session.wait_prepared()
    times, heard, n_landed = [], [], 0
    for step in range(round(seconds * UPDATES_HZ)):
        poses = {}
        for n in range(n_cups):
            t, before = ((step - late) / UPDATES_HZ + n * period_s / n_cups for late in (0, 1))
            n_landed += (before % period_s) < 2 * fall_s <= (t % period_s)
            # A parabola up and down, then a pause at rest.
            flight = min(t % period_s, 2 * fall_s)
            x, y, z = spots[n].position_m
            poses[f"cup {n}"] = Pose((x, y + max(0.0, FALL_M - G * (flight - fall_s) ** 2 / 2), z))
        begin = time.thread_time()
        session.update(poses, touches)
        times.append(1e3 * (time.thread_time() - begin))
        heard.append(session.render_s(1 / UPDATES_HZ)[:, 0])
    return np.array(times), np.concatenate(heard), n_landed


def latency_frames(session: HapticSession, touches: list[Touch], block: int) -> int:
    """Largest number of frames from an impact to the first sample that is not 0, over many impacts into silence."""
    worst = 0
    for _ in range(50):
        session.render_s(1.0)
        session.update(touches=touches)
        before = session.position
        session.strike(touches[0].object_id, touches[0].point_m)
        mix = session.render(block)[:, 0]
        worst = max(worst, int(np.flatnonzero(mix)[0]) + session.position - before - block if mix.any() else 1 << 30)
    return worst


def prepared_ahead(kind: str, scene: SceneSnapshot, bundle: HapticBundle, seed: int, *, elsewhere: bool) -> str:
    """Row of the table of strikes on the touched object, or with `elsewhere` on objects that are connected with it.

    Half of the objects of `elsewhere` are direct neighbours of the touched object.
    """
    rng, model = np.random.default_rng(seed), MODELS.build({"kind": kind})
    assert isinstance(model, PropagationModel)
    session = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None})
    state, spent_ms, errors_db, n_next, n_felt = session._state, [], [], 0, 0
    ids = sorted(x for x in state.graph.beside if isinstance(state.bodies.get(x), Plate))
    session.update()
    session.wait_prepared()
    ahead = session._impacts._ahead
    assert ahead is not None
    for touched in rng.choice(ids, min(8, len(ids)), replace=False).tolist():
        hand = somewhere(state, touched, rng)
        session.update(touches=[Touch("left", touched, hand)])
        session.wait_prepared()
        beside = [x for x in ids if x in state.graph.beside[touched]] or ids
        felt = {"left": [(touched, hand)]}
        others = [x for x in ids if x != touched and ahead.answer(x, hand, felt, np.array([100.0]))]
        for n in range(6):
            object_id = str(rng.choice(beside if n % 2 else others or beside)) if elsewhere else touched
            point = somewhere(state, object_id, rng)
            session.render_s(2.0)  # into silence
            begin = time.thread_time()
            impact = session.strike(object_id, point, speed_m_s=3.0)
            spent_ms.append(1e3 * (time.thread_time() - begin))
            is_next = bool(session.render(BLOCK)[:, 0].any())
            session.wait_prepared()
            if not impact.felt:
                continue
            n_felt, n_next = n_felt + 1, n_next + is_next
            burst = burst_of(state.bodies[object_id], state.on_plate(object_id, point), speed_m_s=3.0, is_finger=True)
            f, weights = np.maximum(burst.frequencies_hz, LOWEST_HZ), burst.accelerations_m_s2**2
            told = ahead.answer(object_id, point, felt, f)
            if told is not None:
                own = struck_later(model, state, object_id, point, [[(touched, hand)]], f)()
                ratio = (weights * told.gains**2).sum() / (weights * own**2).sum()
                errors_db.append(abs(10 * np.log10(ratio)))
    p50, p99 = np.percentile(spent_ms, (50, 99))
    level = f"{np.percentile(errors_db, 90):.2f} | {max(errors_db):.2f}" if errors_db else "- | -"
    return f"| {kind} | {len(spent_ms)} | {n_felt} | {n_next} | {p50:.2f} | {p99:.2f} | {level} |"


def somewhere(state: SceneState, object_id: str, rng: np.random.Generator) -> tuple[float, float, float]:
    """Random point on an object's surface [m]."""
    surface, pose = state.objects[object_id].surface, state.poses[object_id]
    at = rng.uniform(0.05, 0.95, 3) * (surface.length_m, surface.width_m, 0.0)
    x, y, z = pose.to_world(surface.pose.to_world([at]))[0].tolist()
    return x, y, z


def above_1_khz_db(heard: NDArray[np.float32]) -> float:
    """Energy above 1 kHz relative to the total energy of the rendered samples [dB]."""
    power = np.abs(np.fft.rfft(heard.astype(np.float64) * np.hanning(len(heard)))) ** 2
    f = np.fft.rfftfreq(len(heard), 1 / RATE_HZ)
    return float(10 * np.log10(power[f > 1000].sum() / power.sum()))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--scene", help="a scene file with y up and a floor")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()

    print(
        f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores; {given.seconds:g} s each\n"
    )
    print("| impacts | reported | detected | felt | update p50 [ms] | p99 [ms] | worst [ms] | above 1 kHz [dB] |")
    print("|---|---|---|---|---|---|---|---|")
    for name in ("struck", "landing"):
        session, touches, spots = on_floor(given.scene, given.seed, FALL_M) if given.scene else on_table(200)
        for source_id in session.source_ids:
            session.set_source(source_id, on=False)
        session.update(touches=touches)
        gc.collect()
        gc.freeze()
        if name == "struck":
            times, heard, told = struck(session, touches, given.seconds, given.seed)
        else:
            times, heard, told = falling(session, touches, spots, given.seconds)
        p50, p99 = np.percentile(times, (50, 99))
        stats = session.stats
        cells = f"{told} | {stats.impacts} | {stats.impacts_felt}"
        print(f"| {name} | {cells} | {p50:.2f} | {p99:.2f} | {times.max():.2f} | {above_1_khz_db(heard):.0f} |")
    session, touches, _ = on_table(1)
    print(f"\nfrom the impact to its first sample: {latency_frames(session, touches, BLOCK)} frames of the next block")

    scene = load_scene(given.scene or kitchen_path())
    bundle = bake(scene)
    for elsewhere in (False, True):
        where = "hand on another object" if elsewhere else "hand on the struck object"
        columns = "struck | felt | next block | strike p50 [ms] | p99 [ms] | off by p90 [dB] | most"
        print(f"\n| {where}, in {scene.name} | {columns} |")
        print("|---|---|---|---|---|---|---|---|")
        for kind in ("modal_plate", "auto", "infinite_plate", "mass_spring_damper"):
            print(prepared_ahead(kind, scene, bundle, given.seed, elsewhere=elsewhere), flush=True)


if __name__ == "__main__":
    main()
