"""Memory that conversions take again, in a new process, whose allocator has no history."""

import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile

CONVERT_AGAIN = """
import resource, statistics, sys
from scene2hap.audio import convert
pages = []
for _ in range(8):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    convert(*sys.argv[1:], overwrite=True)
    pages.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
print(round(statistics.median(pages[2:])))
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc returns freed memory by this rule")
def test_a_later_conversion_takes_the_memory_of_an_earlier_one(tmp_path: Path) -> None:
    """Without `keep_freed_memory`, the system gives and clears some 8000 pages for five seconds of stereo.

    With old libraries it still gives some in every other conversion.
    """
    sound, felt = str(tmp_path / "hiss.wav"), str(tmp_path / "felt.wav")
    soundfile.write(sound, 0.1 * np.random.default_rng(1).standard_normal((240_000, 2)), 48_000)
    as_a_user = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    command = [sys.executable, "-c", CONVERT_AGAIN, sound, felt]
    run = subprocess.run(command, env=as_a_user, capture_output=True, text=True, check=True)
    assert int(run.stdout) < 1000
