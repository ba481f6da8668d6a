"""Earlier bundles beside a bundle, for undo and redo: `BUNDLE.before`, the one before the last edit, `BUNDLE.before-2`,
the one before that, and so on. `BUNDLE.after`, `BUNDLE.after-2`, ... are those that an undo took back.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.folder_replacement import require_replaceable
from scene2hap.bundle.foreign_files import discard
from scene2hap.bundle.manifest import MANIFEST
from scene2hap.common.files import rename
from scene2hap.common.warning import warn_of
from scene2hap.errors import BundleError, reason_of

MOST_STEPS = 5
"""Most steps back. An edit drops the oldest one beyond (assumed: more than that is a bundle to copy by hand)."""

Kind = Literal["before", "after"]


def step_beside(bundle: Path, kind: Kind) -> Path:
    """Return the folder of the nearest step back ("before") or forward ("after"), whether or not it exists."""
    folder = bundle.resolve()
    return folder.with_name(f"{folder.name}.{kind}")


def steps_beside(bundle: Path, kind: Kind) -> list[Path]:
    """Return the folders of the steps that exist, the nearest first."""
    return [folder for folder in _places(step_beside(bundle, kind)) if os.path.lexists(folder)]


def require_steps(bundle: Path) -> None:
    """Check that the folders of a bundle's steps can be replaced. Raises: BundleError: as `require_replaceable`."""
    for step in [*steps_beside(bundle, "before"), *steps_beside(bundle, "after")]:
        require_replaceable(step)


def push(old: Path, nearest: Path) -> None:
    """Keep the folder `old`, which `nearest` has replaced, as the step behind it. Drops the one beyond `MOST_STEPS`.

    Raises: OSError, BundleError: a folder cannot be moved or removed.
    """
    if not os.path.lexists(old / MANIFEST):  # an empty folder
        discard(old, nearest)
        return
    places = _places(nearest)
    free = next((number for number, place in enumerate(places) if number and not os.path.lexists(place)), None)
    if free is None:
        discard(places[-1], nearest)
        free = MOST_STEPS - 1
    for number in range(free, 1, -1):
        rename(places[number - 1], places[number])
    rename(old, places[1])
    shutil.copymode(nearest, places[1])


def pop(bundle: Path, kind: Kind) -> None:
    """Remove the nearest step and move the others up. A person's files in it move to the next one, or to the bundle.

    Raises: OSError, BundleError: a folder cannot be moved or removed.
    """
    steps = steps_beside(bundle, kind)
    discard(steps[0], steps[1] if len(steps) > 1 else bundle.resolve())
    for place, step in zip(_places(step_beside(bundle, kind)), steps[1:], strict=False):
        if step != place:
            rename(step, place)


@contextmanager
def warned_of_steps(bundle: Path) -> Iterator[None]:
    """Report a step that the block cannot remove as a BundleWarning, since the bundle is written."""
    try:
        yield
    except (OSError, BundleError) as cause:
        warn_of(
            f"{bundle} is written, but an earlier step beside it cannot be removed: {reason_of(cause)}", BundleWarning
        )


def _places(nearest: Path) -> list[Path]:
    later = [nearest.with_name(f"{nearest.name}-{number}") for number in range(2, MOST_STEPS + 1)]
    return [nearest, *later]
