"""A game and its audio thread run on while a worker solves the modes of a lattice."""

import threading
import time

import numpy as np
from scipy.linalg import eigh

from scene2hap.propagation.lattice.lattice_modes import all_modes


def matrices(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A stiffness and masses (n, n), both symmetric and positive definite."""
    made = np.random.default_rng(0).standard_normal((2, n, n))
    stiffness, masses = made @ made.swapaxes(1, 2) / n
    return stiffness, masses + np.eye(n)


def test_modes_are_those_of_scipy() -> None:
    stiffness, masses = matrices(60)
    k4, shapes = all_modes(stiffness, masses)
    np.testing.assert_allclose(k4, eigh(stiffness, masses, eigvals_only=True), rtol=1e-10, atol=1e-14)
    np.testing.assert_allclose(shapes.T @ masses @ shapes, np.eye(60), atol=1e-12)
    np.testing.assert_allclose(stiffness @ shapes, masses @ shapes * k4, atol=1e-10)


def longest_wait_share() -> float:
    """The longest wait of another thread while modes are solved, as a share of the time that this takes."""
    stiffness, masses = matrices(700)
    waits, is_over = [0.0], threading.Event()

    def wait() -> None:
        while not is_over.is_set():
            since = time.perf_counter()
            time.sleep(1e-3)
            waits.append(time.perf_counter() - since)

    other = threading.Thread(target=wait)
    other.start()
    began = time.perf_counter()
    all_modes(stiffness, masses)
    took = time.perf_counter() - began
    is_over.set()
    other.join()
    return max(waits) / took


def test_other_threads_run_while_modes_are_solved() -> None:
    # Several attempts: on a busy machine the other thread may wait for a processor.
    assert any(longest_wait_share() < 0.5 for _ in range(5))
