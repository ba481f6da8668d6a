"""Files by others that this repository does not hold: scenes, recordings and tables in the folder `../shared`.

A test that is true of any scene always runs over the rooms of `tests/support/rooms`, and over scenes by others where
they are present. `there` leaves out the cases whose files are absent and counts them;
`tests/unit/test_without_shared.py` reports the count. A test of one such file alone calls `needed`, which skips.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

import pytest

SHARED = Path(__file__).parents[3] / "shared"
SCENES = SHARED / "scenes"
RECORDINGS = SHARED / "audio"
LEFT_OUT: Counter[str] = Counter()
"""How many cases of the tests collected so far were left out, by the folder within `shared`."""

Case = TypeVar("Case")


def there(cases: Iterable[Case], path_of: Callable[[Case], Path]) -> list[Case]:
    """The cases whose file or folder exists; counts the others in `LEFT_OUT`."""
    found = []
    for case in cases:
        path = path_of(case)
        if path.exists():
            found.append(case)
        else:
            LEFT_OUT[path.relative_to(SHARED).parts[0]] += 1
    return found


def needed(path: Path) -> Path:
    """Skip the test if this path within `shared`, which it cannot do without, is absent. Returns the path."""
    if not path.exists():
        pytest.skip(f"true of ../shared/{path.relative_to(SHARED).as_posix()} alone, which is not beside this checkout")
    return path
