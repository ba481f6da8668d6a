"""The stack that a model behind a network deserves, in one call or one piece of configuration."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Awaitable, Callable, Mapping

from scene2hap.llm import BACKENDS
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.wrappers.budget import BudgetBackend
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.prices import Given, Price
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.retry import RetryBackend
from scene2hap.llm.wrappers.stack import Spec, Wrapper

RETRIES = 6
"""Assumed: waits of 0.5, 1, 2, 4, 8 and 8 s outlast a model that still loads."""
TOLD_RETRIES = 30
"""Assumed: ten minutes at the 20 s that a limit of three requests a minute requires."""


def standard_stack(
    inner: Spec,
    cache_folder: str | os.PathLike[str] | None = None,
    *,
    repairs: int = 2,
    retries: int = RETRIES,
    told_retries: int = TOLD_RETRIES,
    max_calls: int | None = None,
    max_tokens: int | None = None,
    max_cost: float | None = None,
    prices: Mapping[str, Price | Given] | None = None,
    sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
) -> LLMBackend:
    """Cache, repair, budget, retry, and then the model: `inner`, a backend or what builds one.

    cache_folder : where answers are kept, None for nowhere; repairs, retries, told_retries (after waits that the
    server stated) : most of each, per call; max_calls, max_tokens, max_cost [US dollars] : limits, None for none;
    prices : beside the dated list; sleep : for tests.
    A cache keeps repaired answers only, each repair is paid for within the budget, and a call that never came about
    is not. What happened is in `reports`.
    Raises: ConfigError: a setting that cannot work.
    """
    retried = RetryBackend(inner, retries, told_retries=told_retries, sleep=sleep)
    paid = BudgetBackend(retried, max_calls, max_tokens, max_cost, prices)
    valid = RepairBackend(paid, repairs)
    return valid if cache_folder is None else CacheBackend(valid, cache_folder)


def build_backend(
    spec: object,
    cache_folder: str | os.PathLike[str] | None = None,
    *,
    max_cost: float | None = None,
    prices: Mapping[str, Price | Given] | None = None,
) -> object:
    """Make the backend of a configuration, with the standard stack around it where it needs one.

    That is where it is given as a kind or mapping and builds a backend that reaches a service by its address. What was
    given ready made, wrappers, the lexicon, recordings and functions are taken as they are.
    "openai:gpt-4o" is a kind with its model, as on the command line.
    Raises: ConfigError: as `BACKENDS.build`.
    """
    if isinstance(spec, str) and ":" in spec:
        kind, _, model = spec.partition(":")
        spec = {"kind": kind, "model": model}
    built = BACKENDS.build(spec)
    if built is spec or isinstance(built, Wrapper) or not isinstance(built, LLMBackend):
        return built
    identity = getattr(built, "identity", None)
    if isinstance(identity, Mapping) and "base_url" in identity:
        return standard_stack(built, cache_folder, max_cost=max_cost, prices=prices)
    return built
