"""When the scene around touched objects is prepared again for impacts."""

from __future__ import annotations

import time
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

import pytest

from scene2hap.session.impacts.preparation import ImpactPreparation


def test_scene_is_prepared_again_when_its_contacts_rest_and_once_a_second_while_they_change(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now_s, ordered_s = [100.0], list[float]()
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])

    def submit(work: Any) -> Future[None]:
        ordered_s.append(now_s[0])
        done: Future[None] = Future()
        done.set_result(None)
        return done

    state: Any = SimpleNamespace(
        graph=SimpleNamespace(version=0),
        bodies={"table": None},
        touches_a_body=lambda object_id: True,
        network=lambda touched: None,
    )
    ahead = ImpactPreparation(None, state, submit)  # type: ignore[arg-type]
    for frame in range(500):  # of 10 ms
        now_s[0] = 100.0 + 0.01 * frame
        if frame == 50 or 200 <= frame < 350:
            state.graph.version += 1
        ahead.expect(("table",))
    # At once; 50 ms after the change at 0.5 s; while contacts change, a second after the last; when they rest again.
    assert ordered_s == pytest.approx([100.0, 100.55, 102.0, 103.0, 103.54], abs=0.011)
