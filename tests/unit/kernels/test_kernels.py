"""Every kernel has a compiled twin, and a test that compares both."""

from __future__ import annotations

from pathlib import Path

from kernels import PACKAGE
from scene2hap.compiled import KERNELS


def test_every_kernel_has_a_twin_in_the_source() -> None:
    assert len(KERNELS) > 10
    for name in KERNELS:
        home, _, kernel = name.rpartition(".")
        room, _, module = home.removeprefix("scene2hap.").rpartition(".")
        text = (PACKAGE / room.replace(".", "/") / f"_{module}.pyx").read_text(encoding="utf-8")
        assert f"def {kernel}(" in text or f"cdef class {kernel}:" in text, name


def test_every_kernel_is_compared_with_its_twin() -> None:
    contracts = [path.read_text(encoding="utf-8") for path in Path(__file__).parent.glob("test_*_kernels.py")]
    names = [name.removeprefix("scene2hap.") for name in KERNELS]
    assert [name for name in names if not any(f'both("{name}")' in text for text in contracts)] == []
