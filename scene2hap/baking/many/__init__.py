"""Baking of thousands of scenes: reading and sounds on any executor, inference in one process."""

from scene2hap.baking.many.batch import BatchReport, batch_status, collect_batch, submit_batch
from scene2hap.baking.many.plan import ScenePlan, plan_many
from scene2hap.baking.many.report import ManyReport, SceneReport
from scene2hap.baking.many.run import abake_many, bake_many

__all__ = [
    "BatchReport",
    "ManyReport",
    "ScenePlan",
    "SceneReport",
    "abake_many",
    "bake_many",
    "batch_status",
    "collect_batch",
    "plan_many",
    "submit_batch",
]
