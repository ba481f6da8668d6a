"""A fork while a session plays: scene2hap works in the child, and the parent's session is the parent's alone."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")

BEGIN = """
import os, sys, threading, warnings
warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of each fork beside threads

def in_child(work):
    if os.fork() == 0:
        status = 1
        try:
            work()
            status = 0
        finally:
            os._exit(status)
    assert os.wait()[1] == 0
"""

SESSION = f"""
sys.path.insert(0, {str(Path(__file__).parents[1] / "support")!r})
from scene2hap import *
from with_tones import with_tones

objects = [SceneObject("wooden table", pose=Pose((0.0, 0.37, 0.0)), geometry=Box((1.4, 0.74, 0.8))),
           SceneObject("smartphone", pose=Pose((0.2, 0.744, 0.1)), geometry=Box((0.07, 0.008, 0.15)))]
bundle = with_tones(SceneSnapshot.build(objects, name="table"))
touch = Touch("left", "wooden table", (0.3, 0.74, 0.1))
"""


def run(code: str, *arguments: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", BEGIN + code, *arguments], capture_output=True, text=True, timeout=100, check=False
    )
    assert done.returncode == 0, done.stderr


def test_a_lock_that_another_thread_holds_is_open_in_the_child() -> None:
    run("""
from scene2hap.common import blas_threads
is_inside, end, libraries = threading.Event(), threading.Event(), blas_threads._libraries

def slow():
    is_inside.set()
    end.wait()
    return ()

blas_threads._libraries = slow
threading.Thread(target=blas_threads.one_blas_thread.__enter__, daemon=True).start()
is_inside.wait()

def work():
    blas_threads._libraries = libraries
    with blas_threads.one_blas_thread:
        assert {one.get_num_threads() for one in libraries()} <= {1}

in_child(work)
end.set()
""")


def test_the_child_makes_sessions_of_its_own() -> None:
    run(
        SESSION
        + """
def plays():
    with HapticSession(bundle, config={"propagation": "modal_plate"}) as session:
        assert session.wait_prepared(60)
        assert session.update(touches=[touch]).gain("left", "smartphone") > 0

plays()
in_child(plays)
"""
    )


def test_the_child_prepares_loops_that_are_added() -> None:
    run("""
import numpy as np
from scene2hap import AudioClip, Bands
from scene2hap.session.mix.prepared_loops import order

def prepares(seed):
    clip = AudioClip(np.random.default_rng(seed).normal(0.0, 0.1, 8000).astype(np.float32), 8000)
    assert order(clip, Bands.dominant(), 8000).result(30).bank.nbytes > 0

prepares(1)
in_child(lambda: prepares(2))
""")


def test_the_parents_session_refuses_the_child_and_plays_on(tmp_path: Path) -> None:
    run(
        SESSION
        + """
path = sys.argv[1]
sink = WavSink(path)
with HapticSession(bundle, sink=sink) as session:
    session.update(touches=[touch])
    sink.pull_s(0.5)

    def work():
        try:
            with session:
                session.update(touches=[touch])
        except SessionError as refusal:
            assert "fork" in str(refusal) and "spawn" in str(refusal)
        else:
            raise AssertionError("not refused")
        session.close()

    from scene2hap.errors import SessionError
    in_child(work)
    session.update(touches=[touch])
    sink.pull_s(0.5)

import soundfile
samples, rate = soundfile.read(path)
assert 1.0 <= len(samples) / rate < 1.1
assert abs(samples[-rate // 4 :]).max() > 0
""",
        str(tmp_path / "touch.wav"),
    )
