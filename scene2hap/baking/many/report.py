"""The report of a run over many scenes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from scene2hap.common.calls import clear_attributes
from scene2hap.common.counted import counted

Outcome = Literal["baked", "kept", "failed"]


@clear_attributes
@dataclass(frozen=True)
class SceneReport:
    """The result of one scene.

    Parameters: outcome : "baked"; "kept" if file and settings are unchanged since an earlier run; or "failed";
    seconds : by stage: "baking" in a worker, and with a model also "reading" and "inference"; calls : number of
    questions; kept : number answered from the cache; cost_usd : None if unknown.
    """

    scene: str
    bundle: str
    outcome: Outcome
    n_objects: int = 0
    n_sources: int = 0
    n_unknown: int = 0
    calls: int = 0
    kept: int = 0
    cost_usd: float | None = 0.0
    seconds: dict[str, float] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    error: str = ""

    def __str__(self) -> str:
        return self.outcome


@clear_attributes
@dataclass(frozen=True)
class ManyReport:
    """Report of `bake_many`: all scenes in the order given, the duration [s], and the counts of a model's wrappers."""

    scenes: Sequence[SceneReport]
    seconds: float = 0.0
    stack: dict[str, Any] = field(default_factory=dict)

    def count(self, outcome: Outcome) -> int:
        """Return the number of scenes with an outcome."""
        return sum(one.outcome == outcome for one in self.scenes)

    @property
    def failed(self) -> tuple[SceneReport, ...]:
        """Scenes without a bundle."""
        return tuple(one for one in self.scenes if one.outcome == "failed")

    @property
    def calls(self) -> int:
        """Number of questions to the model in all scenes."""
        return sum(one.calls for one in self.scenes)

    @property
    def kept(self) -> int:
        """Number of questions answered from the cache, such as repeated ones of another scene."""
        return sum(one.kept for one in self.scenes)

    @property
    def cost_usd(self) -> float | None:
        """Cost of all answers [US dollars]; None if unknown."""
        costs = [one.cost_usd for one in self.scenes]
        return None if None in costs else sum(cost for cost in costs if cost is not None)

    def to_data(self) -> dict[str, Any]:
        """Return plain data, for JSON."""
        return {
            "seconds": self.seconds,
            "baked": self.count("baked"),
            "kept": self.count("kept"),
            "failed": self.count("failed"),
            "calls": self.calls,
            "calls_kept": self.kept,
            "cost_usd": self.cost_usd,
            "stack": {name: {key: str(value) for key, value in layer.items()} for name, layer in self.stack.items()},
            "scenes": [asdict(one) | _portable(scene=one.scene, bundle=one.bundle) for one in self.scenes],
        }

    def __str__(self) -> str:
        cost = "unknown cost" if self.cost_usd is None else f"{self.cost_usd:.2f} dollars"
        baked, calls = counted(self.count("baked"), "scene"), counted(self.calls, "call")
        scenes = f"{baked} baked, {self.count('kept')} kept, {self.count('failed')} failed in {self.seconds:.0f} s"
        return f"{scenes}; {calls}, {self.kept} answered from the cache, {cost}"


def _portable(**paths: str) -> dict[str, str]:
    """Return paths with slashes, as a report that was written on Windows is read elsewhere."""
    return {name: Path(path).as_posix() for name, path in paths.items()}
