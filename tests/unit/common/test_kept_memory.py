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
import resource, sys
from scene2hap.audio import convert
for _ in range(3):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    convert(*sys.argv[1:], overwrite=True)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc returns freed memory by this rule")
def test_a_later_conversion_takes_the_memory_of_an_earlier_one(tmp_path: Path) -> None:
    """Without `keep_freed_memory`, the system gives and clears 8000 pages for five seconds of stereo."""
    sound, felt = str(tmp_path / "hiss.wav"), str(tmp_path / "felt.wav")
    soundfile.write(sound, 0.1 * np.random.default_rng(1).standard_normal((240_000, 2)), 48_000)
    as_a_user = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    command = [sys.executable, "-c", CONVERT_AGAIN, sound, felt]
    run = subprocess.run(command, env=as_a_user, capture_output=True, text=True, check=True)
    assert int(run.stdout) < 1000
