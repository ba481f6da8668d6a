"""Bakes that clients requested, each in a separate process."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import secrets
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from scene2hap.bridge.hosted_session import error_message
from scene2hap.bridge.pictures import temporary_files
from scene2hap.bridge.session_warnings import Tell
from scene2hap.bridge.temporary_folder import TemporaryFolder
from scene2hap.common.files import write_whole
from scene2hap.common.worker_processes import can_start_python
from scene2hap.errors import BridgeError

MAX_RUNNING = 4
"""Most bakes at the same time, over all clients; assumed: more would only slow each other down."""
N_KEPT = 32
"""Number of bundles of ended jobs that are kept for `play`, besides saved ones."""
LONGEST_LINE = 1 << 24
"""Most bytes of one answer of the process; assumed: some hundred thousand objects."""


class Jobs:
    """All bakes of a server. Unsaved bundles are in a temporary folder until the server ends."""

    def __init__(self) -> None:
        self._temporary: TemporaryFolder | None = None
        # Starts at a random number, so that a job number from before a restart does not match another client's bake.
        self._job_numbers, self._numbers = itertools.count(1 + secrets.randbelow(1 << 30)), itertools.count(1)
        self._tasks: dict[int, asyncio.Task[None]] = {}
        self._tells: dict[int, Tell] = {}
        self._baked: dict[int, tuple[Path, dict[str, Any]]] = {}

    @property
    def folder(self) -> Path:
        """The folder for files that jobs read and write. Raises: BridgeError: it cannot be made."""
        if self._temporary is None:
            with temporary_files():
                self._temporary = TemporaryFolder()
        return self._temporary.path

    @property
    def temporary(self) -> Path | None:
        """That folder, None if no job has needed it yet."""
        return None if self._temporary is None else self._temporary.path

    def require_place(self) -> None:
        """Raise a BridgeError if no bake can start now: too many run, or this program cannot start Python."""
        if not can_start_python():
            raise BridgeError(
                "a bake needs a Python of its own, and the bridge's program is frozen or embeds Python, so that it "
                "would start itself again. Bake before you ship the program, and play the bundle."
            )
        if len(self._tasks) >= MAX_RUNNING:
            raise BridgeError(f"{MAX_RUNNING} bakes are running already; wait for one to end, or cancel one.")

    def write(self, text: str) -> Path:
        """Write a scene file for a job, which removes it at its end. Raises: BridgeError: it cannot be written."""
        path = self.folder / f"scene-{next(self._numbers)}.json"
        with temporary_files():
            write_whole(path, text)
        return path

    def start(self, wanted: Mapping[str, Any], target: Path | None, tell: Tell) -> int:
        """Begin a bake. Returns its number; `tell` receives its messages.

        Parameters: wanted : as `bake_process` reads it, without the target; target : folder of the bundle, None to keep
        it only as long as the server runs.
        """
        job = next(self._job_numbers)
        folder = target or self.folder / f"job-{job}.bundle"
        self._tells[job] = tell
        self._tasks[job] = asyncio.create_task(self._bake(job, {**wanted, "target": str(folder)}, folder))
        return job

    def follow(self, job: int, tell: Tell) -> dict[str, Any]:
        """Send the further messages of a bake to another client. Returns its present state.

        Raises: BridgeError: no such job, or it failed.
        """
        if job in self._tasks:
            self._tells[job] = tell
            return {"type": "baking", "job": job}
        self.bundle(job)
        return self._baked[job][1]

    def bundle(self, job: int) -> Path:
        """Return the folder of a bundle. Raises: BridgeError: no such job, or it has no bundle."""
        if job in self._tasks:
            raise BridgeError(f"job {job} is still baking; wait for its `baked`.")
        if job not in self._baked:
            raise BridgeError(f"there is no job {job} with a bundle; bake again.")
        return self._baked[job][0]

    async def cancel(self, job: int) -> None:
        """End a bake. Raises: BridgeError: it is not running."""
        if job not in self._tasks:
            raise BridgeError(f"job {job} is not running.")
        task = self._tasks[job]
        task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await task

    async def close(self) -> None:
        """End all bakes, and remove unsaved bundles."""
        for job in [*self._tasks]:
            await self.cancel(job)
        if self._temporary is not None:
            await asyncio.to_thread(self._temporary.delete)

    async def _bake(self, job: int, wanted: Mapping[str, Any], folder: Path) -> None:
        process: asyncio.subprocess.Process | None = None
        try:
            process = await asyncio.create_subprocess_exec(
                *(sys.executable, "-m", "scene2hap.bridge.bake_process"),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                limit=LONGEST_LINE,
            )
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(json.dumps(wanted).encode())
            process.stdin.close()
            last: dict[str, Any] = {}
            async for line in process.stdout:
                last = json.loads(line)
                if "progress" in last:
                    stage, item, done, of = last["progress"]
                    self._tells[job](
                        {"type": "progress", "job": job, "stage": stage, "item": item, "done": done, "of": of}
                    )
                elif "warning" in last:
                    self._tells[job]({"type": "warning", "job": job, "message": last["warning"]})
            await process.wait()
            if "objects" in last:
                answer = {"type": "baked", "job": job, "objects": last["objects"]}
                self._keep(job, folder, answer)
                self._tells[job](answer)
            else:
                status = f"it ended with status {process.returncode}, and the server's log has the details"
                kind, message = last.get("error", ("BridgeError", f"the bake failed: {status}."))
                self._tells[job]({"type": "error", "error": kind, "message": message, "job": job})
        except (OSError, ValueError) as cause:
            self._tells[job]({**error_message(BridgeError(f"the bake failed: {cause}.")), "job": job})
        finally:
            if process is not None and process.returncode is None:
                process.kill()
                # Shielded, since the process must be reaped even while the server ends.
                await asyncio.shield(process.wait())
            self._remove_inputs(wanted)
            del self._tasks[job], self._tells[job]

    def _remove_inputs(self, wanted: Mapping[str, Any]) -> None:
        scene = Path(wanted["scene"])
        if self._is_temporary(scene):
            scene.unlink(missing_ok=True)
        if wanted["pictures"] is not None:
            shutil.rmtree(wanted["pictures"], ignore_errors=True)

    def _keep(self, job: int, folder: Path, answer: dict[str, Any]) -> None:
        self._baked[job] = folder, answer
        while len(self._baked) > N_KEPT:
            forgotten, _ = self._baked.pop(next(iter(self._baked)))
            if self._is_temporary(forgotten):
                shutil.rmtree(forgotten, ignore_errors=True)

    def _is_temporary(self, path: Path) -> bool:
        return self.temporary is not None and path.is_relative_to(self.temporary)
