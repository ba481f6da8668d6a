"""Broken scene files of many kinds: reading them may raise only scene2hap's errors, without a hang, in bounded memory.

python stress/fuzz_scenes.py [--files 2000] [--seed 0] [--seconds 5] [--megabytes 1024] [--kinds .meshopt.glb .urdf]

Seeds are the demo kitchen as GLB, glTF-like JSON, OBJ, PLY, STL and scene JSON, built in memory, a robot arm as URDF, a
laundry packed by gltfpack, a small USD scene if usd-core is installed, and a Habitat dataset in which one or two files
are broken. Each file is read in a child process with a limit on its data segment and an alarm, so that a hang or a
crash names the file that caused it. Prints a table of outcomes and exits with 1 if any outcome is neither success nor a
Scene2HapError.
"""

from __future__ import annotations

import argparse
import collections
import json
import multiprocessing.connection
import platform
import random
import re
import resource
import signal
import struct
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import trimesh

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from habitat_builder import mutated_dataset
from scene2hap import load_scene
from scene2hap.demo import kitchen_path
from scene2hap.errors import Scene2HapError
from stress.restarted_child import Child
from stress.usd_seeds import usd_files

HABITAT = ".scene_instance.json"
Mutation = Callable[[bytes, random.Random], bytes]


class Hang(BaseException):
    """The time limit has passed; not an Exception, so that no `except Exception` catches it."""


def seeds() -> dict[str, bytes]:
    """Small valid files by suffix."""
    box = trimesh.creation.box((1.0, 0.5, 0.2))
    kitchen = kitchen_path().read_bytes()
    packed = Path(__file__).parents[1] / "tests" / "data" / "meshopt" / "quantised.glb"
    return {
        ".glb": kitchen,
        ".meshopt.glb": packed.read_bytes(),
        ".urdf": _URDF.encode(),
        ".gltf": _as_gltf(box),
        ".obj": box.export(file_type="obj").encode(),
        ".ply": box.export(file_type="ply"),
        ".stl": box.export(file_type="stl"),
        ".json": load_scene(kitchen_path()).to_json().encode(),
        **usd_files(),
    }


_SHAPES = ("box size='1 2 3'", "cylinder radius='0.1' length='2'", "sphere radius='0.2'", "mesh filename='case.obj'")
_URDF = (
    "<robot name='arm'><material name='red'><color rgba='1 0 0 1'/></material>"
    + "".join(
        f"<link name='l{i}'><inertial><mass value='{i + 1}'/></inertial><visual><origin xyz='0 0 {i}' rpy='0 0.1 {i}'/>"
        f"<geometry><{shape}/></geometry><material name='red'/></visual></link>"
        for i, shape in enumerate(_SHAPES)
    )
    + "".join(
        f"<joint name='j{i}' type='revolute'><parent link='l{i}'/><child link='l{i + 1}'/>"
        "<origin xyz='0 0 1' rpy='1 2 3'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        for i in range(len(_SHAPES) - 1)
    )
    + "</robot>"
)


def _as_gltf(mesh: trimesh.Trimesh) -> bytes:
    import base64

    files = mesh.export(file_type="gltf")
    document = json.loads(files["model.gltf"])
    for buffer in document["buffers"]:
        data = base64.b64encode(files[buffer["uri"]]).decode()
        buffer["uri"] = f"data:application/octet-stream;base64,{data}"
    return json.dumps(document).encode()


def flip_bytes(data: bytes, rng: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice([1, 4, 32, 256])):
        changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed)


def truncate(data: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data))]


def repeat_a_stretch(data: bytes, rng: random.Random) -> bytes:
    begin = rng.randrange(len(data))
    end = min(len(data), begin + rng.randrange(1, 200))
    return data[:end] + data[begin:end] * rng.choice([1, 10, 1000]) + data[end:]


def blow_up_a_number(data: bytes, rng: random.Random) -> bytes:
    """Replace a number in text, JSON chunks included, by an absurd one; lengths may be wrong afterwards."""
    places = list(re.finditer(rb"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?", data[:200_000]))
    if not places:
        return flip_bytes(data, rng)
    place = rng.choice(places)
    absurd = rng.choice([b"999999999999", b"-1", b"1e308", b"1e-320", b"NaN", b"Infinity", b"9" * 5000, b"0", b'""'])
    return data[: place.start()] + absurd + data[place.end() :]


def nest_deeply(data: bytes, rng: random.Random) -> bytes:
    depth = rng.choice([100, 10_000, 200_000])
    place = data.find(b"[", rng.randrange(len(data)))
    return data[: place + 1] + b"[" * depth + b"]" * depth + b"," + data[place + 1 :] if place >= 0 else data


def change_a_length(data: bytes, rng: random.Random) -> bytes:
    """Replace a 32-bit word near the front, where GLB, PLY and STL have lengths and counts."""
    at = rng.randrange(0, min(len(data) - 4, 120))
    word = rng.choice([0, 1, 0x7FFFFFFF, 0xFFFFFFFF, len(data) * 2, rng.getrandbits(32)])
    return data[:at] + struct.pack("<I", word) + data[at + 4 :]


MUTATIONS: tuple[Mutation, ...] = (
    flip_bytes,
    truncate,
    repeat_a_stretch,
    blow_up_a_number,
    nest_deeply,
    change_a_length,
)


def read_one(path: Path, seconds: float) -> str:
    """Read one file. Returns "read", the name of scene2hap's error, or a text that begins with HANG or FOREIGN."""

    def ring(*_: object) -> None:
        raise Hang

    signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            load_scene(path)
        return "read"
    except Scene2HapError as error:
        return type(error).__name__
    except Hang:
        return f"HANG over {seconds:g} s"
    except BaseException as error:
        return f"FOREIGN {type(error).__name__}: {str(error)[:100]}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def reader(inbox: multiprocessing.connection.Connection, seconds: float, megabytes: int) -> None:
    """Child process: read the files whose paths arrive; send outcome, time and peak memory."""
    resource.setrlimit(resource.RLIMIT_DATA, (megabytes << 20, megabytes << 20))
    while (path := inbox.recv()) is not None:
        begin = time.perf_counter()
        outcome = read_one(path, seconds)
        # USD files are read in a child process of this one.
        peaks = [resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        peak_mb = max(peaks) / 1024
        inbox.send((outcome, time.perf_counter() - begin, peak_mb))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--megabytes", type=int, default=1024)
    parser.add_argument("--kinds", nargs="+", choices=[*seeds(), HABITAT], help="ends of file names; by default all")
    arguments = parser.parse_args()

    print(f"Python {platform.python_version()}, {arguments.files} files, seed {arguments.seed}")
    outcomes: dict[str, collections.Counter[str]] = collections.defaultdict(collections.Counter)
    bad: list[str] = []
    slowest, peak = (0.0, ""), 0.0
    originals = {kind: data for kind, data in {**seeds(), HABITAT: b""}.items() if kind in (arguments.kinds or [kind])}
    child = Child(reader, arguments.seconds, arguments.megabytes)
    with tempfile.TemporaryDirectory() as folder:
        # The mesh that the URDF names; an OBJ case overwrites it, valid or broken.
        (Path(folder) / "case.obj").write_bytes(seeds()[".obj"])
        for number in range(arguments.files):
            rng = random.Random(f"{arguments.seed}/{number}")
            suffix, mutation = rng.choice(list(originals)), rng.choice(MUTATIONS)
            data = originals[suffix]
            name = f"file {number}: {mutation.__name__}{suffix}"
            if suffix == HABITAT:
                path, name = mutated_dataset(Path(folder) / str(number), rng), f"file {number}: mutated_dataset"
            else:
                for _ in range(rng.choice([1, 1, 2])):
                    data = mutation(data, rng) or b"\0"
                path = Path(folder) / f"case{suffix}"
                path.write_bytes(data)
            replies, end = child.ask(path)
            outcome, seconds, peak_mb = replies[0] if replies else (f"CRASH {end}", 0.0, 0.0)
            outcomes[suffix][outcome.split(":")[0]] += 1
            slowest, peak = max(slowest, (seconds, name)), max(peak, peak_mb)
            if outcome.split()[0] in ("HANG", "FOREIGN", "CRASH"):
                bad.append(f"{name}: {outcome}")
    child.stop()
    for suffix, counts in outcomes.items():
        print(f"{suffix:20}", ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common()))
    print(f"slowest {slowest[0]:.2f} s ({slowest[1]}), peak memory {peak:.0f} MB")
    print(f"{len(bad)} bad outcomes", *bad, sep="\n")
    return bool(bad)


if __name__ == "__main__":
    raise SystemExit(main())
