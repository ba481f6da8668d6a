"""Hand labels of real scenes and the parts of `benchmarks/inference_eval.py`; see docs/inference-evaluation.md."""
