"""The chain of questions that infers haptics from a scene; its settings, its report and its cost in advance."""

from scene2hap.llm.chain.inference import Inference, infer_haptics, infer_scene

__all__ = ["Inference", "infer_haptics", "infer_scene"]
