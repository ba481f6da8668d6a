"""Save a bundle over another with a fault at each step in turn, as SQLite is tested. Prints the results as JSON.

A step is a file operation of Python, seen by an audit hook before it happens. There the process ends, or the operation
is refused. Each try runs in a child process, because an audit hook cannot be removed.

Run by tests/integration/test_bundle_faults.py: python bundle_faults.py FOLDER kill|refuse exchange|renames [STRIDE]
Most steps write files into a draft. With a stride n, only every nth of these steps is tried, but always all steps at
the end, which put the draft in the bundle's place.
"""

import json
import os
import shutil
import sys
import warnings
from collections.abc import Callable
from functools import cache
from pathlib import Path

from scene2hap import HapticBundle
from scene2hap.bundle import folder_replacement
from scenes import table_with_two_phones

OPERATIONS = ("open", "os.", "shutil.", "tempfile.")
NEVER = 7
N_AT_THE_END = 40
WORK = Path(sys.argv[1])
ROOM = WORK / "room"
BEFORE = WORK.with_name("before")
THESIS = {"thesis.txt": b"ten years", "sounds/mine.txt": b"of mine", "notes/a/b.txt": b"deep"}


@cache
def old_and_new() -> tuple[HapticBundle, HapticBundle]:
    bundle = table_with_two_phones()[1]
    return bundle, bundle.override("phone", gain_db=-7.0)


def begin() -> None:
    shutil.rmtree(WORK, ignore_errors=True)
    if not BEFORE.exists():
        old_and_new()[0].save(BEFORE)
        for name, content in THESIS.items():
            (BEFORE / name).parent.mkdir(parents=True, exist_ok=True)
            (BEFORE / name).write_bytes(content)
    WORK.mkdir()
    shutil.copytree(BEFORE, ROOM)


def save_with_fault(step: int, kind: str) -> int:
    """Save the new bundle in a child process, with a fault at a step. Returns its exit status.

    0 saved, 9 killed, 3 an error of the library, `NEVER` saved before that step, 1 anything else.
    """
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    status = 1
    try:
        seen = 0

        def hook(event: str, arguments: tuple[object, ...]) -> None:
            nonlocal seen
            if not is_step(event, arguments):
                return
            seen += 1
            if seen == step:
                if kind == "kill":
                    os._exit(9)
                raise OSError(28, "No space left on device")

        new = old_and_new()[1]
        sys.addaudithook(hook)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            new.save(ROOM)
        status = 0 if seen >= step else NEVER
    except ValueError as error:  # a BundleError or an AudioError is one
        status = 3 if type(error).__module__ == "scene2hap.errors" else 1
    finally:
        os._exit(status)


def count_steps() -> int:
    """Count the steps of a save without faults."""
    seen, is_counting = 0, True

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        nonlocal seen
        seen += is_counting and is_step(event, arguments)

    begin()
    new = old_and_new()[1]
    sys.addaudithook(hook)
    new.save(ROOM)
    is_counting = False
    return seen


def is_step(event: str, arguments: tuple[object, ...]) -> bool:
    return event.startswith(OPERATIONS) and str(WORK) in "".join(map(str, arguments))


def which() -> str:
    """Load the bundle at the path: "new" or "old", with ", recovered" for each warning of recovery."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        bundle = HapticBundle.load(ROOM)
    name = "new" if bundle.overrides else "old"
    return name + ("".join(", recovered" for warning in told if "being replaced" in str(warning.message)))


def attempt(look: Callable[[], str]) -> str:
    try:
        return look()
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def thesis_is_there() -> bool:
    return all((ROOM / name).is_file() and (ROOM / name).read_bytes() == THESIS[name] for name in THESIS)


def main() -> None:
    kind = sys.argv[2]
    if sys.argv[3] == "renames":
        vars(folder_replacement)["exchange"] = lambda one, other: False  # as without exchange
    stride, n_steps = int(sys.argv[4]) if len(sys.argv) > 4 else 1, count_steps()
    rows = []
    for step in sorted({*range(1, n_steps, stride), *range(max(1, n_steps - N_AT_THE_END), n_steps + 2)}):
        begin()
        status = save_with_fault(step, kind)
        is_missing = not ROOM.exists()
        thesis_before = thesis_is_there()
        row: dict[str, object] = {"step": step, "status": status, "was_missing": is_missing, "found": attempt(which)}
        row["thesis"] = thesis_is_there() and (thesis_before or is_missing)
        row["left"] = sorted(path.name for path in WORK.iterdir() if path != ROOM)
        row["again"] = attempt(lambda: str(old_and_new()[1].save(ROOM)) and which())
        row["thesis_again"] = thesis_is_there()
        row["left_again"] = sorted(path.name for path in WORK.iterdir() if path != ROOM)
        row["odd"] = sorted(path.name for path in ROOM.rglob("*") if "kept" in path.name or ".part" in path.name)
        rows.append(row)
    print(json.dumps(rows))


main()
