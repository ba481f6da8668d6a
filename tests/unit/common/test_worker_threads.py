"""Worker threads carry out tasks, end with their pool, and do not keep Python from exiting."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from concurrent.futures import wait
from pathlib import Path
from threading import Barrier, Event
from weakref import ref

import pytest

from scene2hap.common.worker_threads import WorkerPool

SUPPORT = str(Path(__file__).parents[2] / "support")


def test_tasks_are_carried_out_in_order_and_errors_are_kept() -> None:
    pool, done = WorkerPool(1, "test"), list[int]()
    futures = [pool.submit(lambda k=k: done.append(k)) for k in range(20)]
    failed = pool.submit(lambda: 1 / 0)
    assert pool.submit(lambda: "last").result(10) == "last"
    assert done == list(range(20))
    assert all(one.done() for one in futures)
    with pytest.raises(ZeroDivisionError):
        failed.result(0)


def test_threads_start_as_tasks_need_them_and_end_with_the_pool() -> None:
    before = set(threading.enumerate())
    pool = WorkerPool(3, "test")
    for _ in range(5):
        pool.submit(lambda: None).result(10)
    assert len(set(threading.enumerate()) - before) <= 2  # a result comes before its future is done
    meeting, go_on = Barrier(3), Event()
    futures = [pool.submit(lambda: (meeting.wait(10), go_on.wait(10))) for _ in range(6)]
    go_on.set()
    assert not wait(futures, 10).not_done
    assert all(one.exception() is None for one in futures)
    threads = set(threading.enumerate()) - before
    assert len(threads) == 3
    del pool
    for one in threads:
        one.join(10)
        assert not one.is_alive()


def test_an_idle_thread_refers_to_no_task() -> None:
    class Large:
        def work(self) -> None: ...

    pool, large = WorkerPool(1, "test"), Large()
    gone = ref(large)
    pool.submit(large.work).result(10)
    del large
    until = time.monotonic() + 10
    while gone() is not None and time.monotonic() < until:
        time.sleep(0.001)
    assert gone() is None


SLOW = """
import sys, time
sys.path.insert(0, {support!r})
from scene2hap import HapticSession, Touch
from scene2hap.common import worker_threads
from scene2hap.session.mix import prepared_loops
from scenes import table_with_two_phones, tone_loop

worker_threads.LAST_S = 0.5
begun = []

class Model:
    source_ids = ("alarm", "phone")

    def prepare(self, network, excitations, bands):
        if not {{"phone", "alarm"}} & {{x.source_id for x in excitations}}:  # for an impact
            begun.append(1)
            time.sleep(30)
        return self

    def attenuation(self, object_id, points_m):
        import numpy as np
        return np.ones((len(points_m), 2, 1))

def slow(*given):
    begun.append(1)
    time.sleep(30)

{work}
while not begun:
    time.sleep(0.01)
print("end")
"""
IMPACT = """
session = HapticSession(*table_with_two_phones(), {"propagation": Model()})
session.update(touches=[Touch("left", "table", (0.5, 0.72, 0.4))])
for striker in (None, "cup", "block"):
    session.strike("table", (0.4, 0.72, 0.4), with_object=striker)
"""
LOOP = """
prepared_loops._made = slow
for f in (100.0, 120.0, 140.0):
    prepared_loops.order(tone_loop(f).tactile, (), 8000)
"""


@pytest.mark.parametrize("work", [IMPACT, LOOP], ids=["impacts", "loops"])
def test_python_exits_while_a_worker_is_busy_and_more_tasks_wait(work: str) -> None:
    begin = time.monotonic()
    program = SLOW.format(support=SUPPORT, work=work)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")
    assert time.monotonic() - begin < 20


def test_a_task_that_ends_its_thread_ends_its_future() -> None:
    def leave() -> None:
        raise SystemExit

    with pytest.raises(SystemExit):
        WorkerPool(1, "test").submit(leave).result(10)
