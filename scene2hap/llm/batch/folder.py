"""Batches on disk: the questions of each batch, its state, and its answers.

FOLDER/0001.json           one batch: its requests, its ids, its stage
FOLDER/0001.input.jsonl    requests to send; deleted once the server has them
FOLDER/0001.output.jsonl   results, as received
FOLDER/0001.error.jsonl    failed requests, as received

Every file is written whole or not at all. The state of each request follows from these files alone, so reading them
again changes nothing.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, BinaryIO, ClassVar, Literal

from pydantic import ConfigDict, Field, TypeAdapter, ValidationError

from scene2hap.common import checks
from scene2hap.common.files import opened_regular, read_small, write_whole
from scene2hap.errors import ConfigError, reason_of, unwritable
from scene2hap.llm.backends.http_client import MAX_REPLY_BYTES
from scene2hap.llm.batch.service import COMPLETIONS, MOST_BYTES, MOST_REQUESTS

Stage = Literal["written", "uploaded", "begun", "collected"]

_PART_BYTES, _PART_REQUESTS = MOST_BYTES * 9 // 10, MOST_REQUESTS // 5
"""Our limits of one batch. A batch that fails as a whole then costs less, and its answers fit the reader's limit."""


@dataclass(frozen=True)
class BatchRow:
    """One batch.

    Parameters: number : its place in the folder; requests : keys of questions; stage : "written" on disk, "uploaded" as
    a file, "begun" on the server, "collected" with results on disk; estimate_usd : estimated cost, None if unknown;
    status : last status from the server; faults : errors of the batch as a whole.
    """

    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    number: Annotated[int, Field(ge=1)]
    requests: tuple[str, ...]
    stage: Stage = "written"
    estimate_usd: Annotated[float, Field(ge=0.0)] | None = None
    input_file: str = ""
    batch: str = ""
    status: str = ""
    completed: int = 0
    failed: int = 0
    faults: tuple[str, ...] = ()


_row: TypeAdapter[BatchRow] = TypeAdapter(BatchRow)


@dataclass(frozen=True)
class Outcome:
    """Result of a request: status and body of the server's answer, or the code of an error."""

    status: int
    body: Any
    code: str = ""
    message: str = ""


class BatchFolder:
    """The batches of one run. Raises: ConfigError: the folder cannot be read or written."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            path.mkdir(parents=True, exist_ok=True)
        except OSError as cause:
            raise self.unwritable(cause) from cause

    # -- rows ---------------------------------------------------------------------------------------------------------

    def rows(self) -> list[BatchRow]:
        """Return all batches, in the order in which they were written."""
        found = []
        for path in sorted(self.path.glob("[0-9]*.json")):
            try:
                row = _row.validate_json(read_small(path))
                if path.name != f"{row.number:04d}.json":
                    raise ValueError(f"its number is {row.number}, and its name is that of another batch")
            except (OSError, ValueError) as cause:
                raise _unreadable(path, cause, "lists questions") from cause
            found.append(row)
        return found

    def save(self, row: BatchRow) -> BatchRow:
        """Write a row, and delete the file of its requests once the server has it."""
        self._write(f"{row.number:04d}.json", json.dumps(asdict(row), indent=1).encode())
        if row.stage in ("begun", "collected"):
            self.input_path(row).unlink(missing_ok=True)
        return row

    def input_path(self, row: BatchRow) -> Path:
        """Return the path of the file of requests."""
        return self.path / f"{row.number:04d}.input.jsonl"

    def requests(self, row: BatchRow) -> bytes:
        """Return the content of the file of requests. Raises: ConfigError: it cannot be read."""
        path = self.input_path(row)
        try:
            return read_small(path, MOST_BYTES)
        except (OSError, ValueError) as cause:
            raise ConfigError(
                f"{path} cannot be read: {reason_of(cause)}. Nothing of it was sent; restore it, or remove "
                f"{row.number:04d}.json beside it, and submit again."
            ) from cause

    def keep(self, row: BatchRow, output: str, error: str) -> BatchRow:
        """Store the results, and mark the row as collected."""
        for name, text in (("output", output), ("error", error)):
            if text:
                self._write(f"{row.number:04d}.{name}.jsonl", text.encode())
        return self.save(replace(row, stage="collected"))

    # -- outcomes -----------------------------------------------------------------------------------------------------

    def outcomes(self) -> Iterator[tuple[str, Outcome]]:
        """Yield the key and result of each request, in the order of the batches. Damaged lines are skipped."""
        for path in sorted(self.path.glob("[0-9]*.jsonl")):
            if not path.name.endswith(".input.jsonl"):
                try:
                    with opened_regular(path) as file:
                        yield from filter(None, map(_outcome, iter(partial(file.readline, MAX_REPLY_BYTES), b"")))
                except (OSError, ValueError) as cause:
                    raise _unreadable(path, cause, "holds answers") from cause

    # -- requests -----------------------------------------------------------------------------------------------------

    def discard_unfinished(self) -> None:
        """Remove files of requests without a row: their run ended before the files were complete."""
        known = {self.input_path(row) for row in self.rows()}
        for path in (*self.path.glob("*.input.jsonl"), *self.path.glob(".*.part*")):
            if path not in known:
                path.unlink(missing_ok=True)

    def _write(self, name: str, content: bytes) -> None:
        try:
            write_whole(self.path / name, content)
        except OSError as cause:
            raise self.unwritable(cause) from cause

    def unwritable(self, cause: OSError) -> ConfigError:
        """Return the error for a file that cannot be written."""
        return ConfigError(unwritable(f"the folder of batches {self.path}", cause, "Give a folder that is yours."))


class RequestWriter:
    """Write requests into files of limited size, and a row for each complete file."""

    def __init__(self, folder: BatchFolder) -> None:
        self._folder = folder
        self._number = max((row.number for row in folder.rows()), default=0)
        self._file: BinaryIO | None = None
        self._keys: list[str] = []
        self._n_bytes = 0
        self._estimate_usd: float | None = 0.0

    def add(self, key: str, body: dict[str, Any], estimate_usd: float | None) -> None:
        """Add one request with its estimated cost. Raises: ConfigError: it cannot be written."""
        line = {"custom_id": key, "method": "POST", "url": COMPLETIONS, "body": body}
        content = json.dumps(line, ensure_ascii=False, allow_nan=False).encode("utf-8", "replace") + b"\n"
        if self._n_bytes + len(content) > _PART_BYTES or len(self._keys) >= _PART_REQUESTS:
            self.close()
        try:
            if self._file is None:
                self._number += 1
                self._file = (self._folder.path / f"{self._number:04d}.input.jsonl").open("wb")
            self._file.write(content)
        except OSError as cause:
            raise self._folder.unwritable(cause) from cause
        self._keys.append(key)
        self._n_bytes += len(content)
        both = (self._estimate_usd, estimate_usd)
        self._estimate_usd = None if None in both else sum(cost for cost in both if cost is not None)

    def close(self) -> None:
        """End the file that is being written, if there is one."""
        if self._file is None:
            return
        try:
            with self._file as file:
                file.flush()
                os.fsync(file.fileno())
        except OSError as cause:
            raise self._folder.unwritable(cause) from cause
        self._folder.save(BatchRow(self._number, tuple(self._keys), estimate_usd=self._estimate_usd))
        self._file, self._keys, self._n_bytes, self._estimate_usd = None, [], 0, 0.0


def _unreadable(path: Path, cause: Exception, content: str) -> ConfigError:
    problem = checks.first_problem(cause) if isinstance(cause, ValidationError) else None
    reason = f"{problem.place or 'whole file'}: {problem.reason}" if problem else reason_of(cause)
    return ConfigError(
        f"{path} cannot be read: {reason[:300]}. It {content} that are paid for; restore it from a backup, or move the "
        "folder away to send all questions again."
    )


def _outcome(line: bytes) -> tuple[str, Outcome] | None:
    try:
        row = json.loads(line)
    except (ValueError, RecursionError):
        return None
    key = row.get("custom_id") if isinstance(row, dict) else None
    if not isinstance(key, str):
        return None
    response, error = row.get("response"), row.get("error")
    if isinstance(error, dict):
        return key, Outcome(0, None, str(error.get("code") or ""), str(error.get("message") or ""))
    status = response.get("status_code") if isinstance(response, dict) else None
    if not isinstance(response, dict) or not isinstance(status, int):
        return None
    return key, Outcome(status, response.get("body"))


def keys_in(rows: Iterable[BatchRow], *stages: Stage) -> frozenset[str]:
    """Return the keys of the questions in batches at the given stages."""
    return frozenset(key for row in rows if row.stage in stages for key in row.requests)
