"""The contract of `LLMBackend`."""

from __future__ import annotations

import asyncio
import copy
import inspect
from collections import Counter

from scene2hap.common.run_coroutine import run_waiting
from scene2hap.llm import BACKENDS
from scene2hap.llm.answers.usable import question_of
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest
from scene2hap.llm.validation import find_fault
from scene2hap.plugins import lacking
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box
from scene2hap.scene.snapshot import SceneSnapshot

ROOM = SceneSnapshot.build(
    [
        SceneObject("wooden table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7))),
        SceneObject("smartphone", pose=Pose((0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15))),
        SceneObject("electric fan", pose=Pose((-0.3, 0.92, 0.1)), geometry=Box((0.3, 0.4, 0.3))),
    ],
    name="a study",
)


def check_llm_backend(backend: LLMBackend, scene: SceneSnapshot = ROOM) -> None:
    """Check a backend against its protocol: it gets all questions about a scene, and each answer must be valid.

    The backend gets several questions at the same time. Numbers that are merely implausible are accepted.
    Parameters: scene : the scene of the questions, three objects by default; a paid service bills some ten answers.
    Raises: AssertionError: names the broken promise; and the errors of the backend.
    """
    problem = lacking(backend, BACKENDS.members)
    assert not problem, problem
    watched = _Watched(backend)
    # Not `infer_haptics`, which warns of lost answers: the errors below name them.
    objects = run_waiting(infer_scene(scene, watched), "asyncio.to_thread(check_llm_backend, ...)").objects
    name = type(backend).__name__
    assert set(objects) == {item.id for item in scene.objects}
    unanswered = {key: haptics.provenance for key, haptics in objects.items() if haptics.object_category == "unknown"}
    assert len(unanswered) < len(objects), f"{name} has no answer for any object: {unanswered}"
    assert not watched.faults, f"{name} gives invalid answers: {'; '.join(watched.faults)}"
    for component in ("scene_analyzer", "object_analyzer"):
        assert watched.n_requests[component], f"{name} got no request for the {component}"


class _Watched:
    """Forward questions, and check the replies."""

    def __init__(self, backend: LLMBackend) -> None:
        self.n_requests: Counter[str] = Counter()
        self.faults: list[str] = []
        self._backend = backend

    async def complete(self, request: LLMRequest) -> LLMReply:
        """See `LLMBackend`."""
        by, facts = f"{type(self._backend).__name__}.complete", copy.deepcopy(request.facts)
        self.n_requests[request.component] += 1
        awaited = self._backend.complete(request)
        assert inspect.isawaitable(awaited), f"{by} gives a {type(awaited).__name__}; write it as 'async def complete'"
        reply = await asyncio.ensure_future(awaited)
        assert isinstance(reply, LLMReply), f"{by} gives a {type(reply).__name__}; it must give an LLMReply"
        assert isinstance(reply.text, str), f"{by} gives a text that is a {type(reply.text).__name__}"
        assert isinstance(reply.model, str), f"{by} gives a model that is a {type(reply.model).__name__}"
        assert reply.model, f"{by} does not say which model answered"
        assert request.facts == facts, f"{by} changed the facts of its request"
        fault = find_fault(request.component, reply.text, request.facts)
        if fault is not None and not fault.is_minor:
            self.faults.append(f"{question_of(request)}: {fault.reason}")
        return reply
