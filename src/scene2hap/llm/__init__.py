"""Inference: language models and what stands in for them."""
