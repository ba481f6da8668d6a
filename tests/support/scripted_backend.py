"""A scripted LLM backend that answers each component from the request, and a scene of three objects."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from scene2hap import LLMReply, LLMRequest
from scene2hap.llm.chain import Inference, infer_scene
from scenes import box, scene

SCENE = scene(
    box("table", (1.6, 0.02, 0.8), (0.8, 0.71, 0.4)),
    box("phone", (0.1, 0.01, 0.1), (0.1, 0.725, 0.4)),
    box("cup", (0.1, 0.1, 0.1), (5.0, 0.05, 5.0)),
)


class Scripted:
    """Answer each component by a fixed rule, modified by `changes`; keep the requests in `asked`."""

    def __init__(self, **changes: Any) -> None:
        self.asked: list[LLMRequest] = []
        self.changes = changes

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.asked.append(request)
        await asyncio.sleep(0)
        answer = getattr(self, request.component)(request)
        change = self.changes.get(request.component)
        if callable(change):
            changed = change(request, answer)
            return changed if isinstance(changed, LLMReply) else LLMReply(json.dumps(changed), "scripted")
        return LLMReply(json.dumps(answer), "scripted")

    def scene_analyzer(self, request: LLMRequest) -> dict[str, Any]:
        return {"scene_category": "living room"}

    def object_analyzer(self, request: LLMRequest) -> dict[str, Any]:
        phone = request.facts["object_name"] == "phone"
        states = [{"name": n, "intensity": 0.5, "needs_contact": None} for n in ("ringing", "alarm")] if phone else []
        return {
            "object_category": request.facts["object_name"],
            "category_reason": "c",
            "material_category": "Glass" if phone else "oak",
            "estimated_length_m": request.facts["length_m"],
            "estimated_width_m": request.facts["width_m"],
            "estimated_thickness_m": 0.025,
            "size_reason": "s",
            "usage": "used",
            "vibrates": phone,
            "vibration_reason": "v",
            "states": states,
            "confidence": 0.9,
        }

    def material_estimator(self, request: LLMRequest) -> dict[str, Any]:
        density, modulus = (2500.0, 70.0) if request.facts["material_category"] == "glass" else (700.0, 10.0)
        return {
            "density_kg_m3": density,
            "youngs_modulus_gpa": modulus,
            "poisson_ratio": 0.3,
            "damping_ratio": 0.005,
        }

    def vibration_describer(self, request: LLMRequest) -> dict[str, Any]:
        return {"sentence": f"phone {request.facts['state']}", "keywords": "phone buzzing"}


def run(backend: Scripted, config: dict[str, Any] | None = None) -> Inference:
    """Run the chain on the scene."""
    return asyncio.run(infer_scene(SCENE, backend, config=config))
