"""The standard stack of wrappers for a model behind a network, in one call or one piece of configuration."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Awaitable, Callable, Mapping
from typing import cast

from scene2hap.llm import BACKENDS
from scene2hap.llm.protocol import LLMBackend
from scene2hap.llm.stack import Spec, Wrapper, is_remote
from scene2hap.llm.wrappers.budget import BudgetBackend
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.prices import Given, Price
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.retry import RetryBackend

RETRIES = 6
"""Assumed: waits of 0.5, 1, 2, 4, 8 and 8 s are enough for a server to load its model."""
RATE_LIMIT_RETRIES = 30
"""Assumed: ten minutes in waits of 20 s, as a limit of three requests a minute requires."""


def standard_stack(
    inner: Spec,
    cache_folder: str | os.PathLike[str] | None = None,
    *,
    repairs: int = 2,
    retries: int = RETRIES,
    rate_limit_retries: int = RATE_LIMIT_RETRIES,
    max_calls: int | None = None,
    max_tokens: int | None = None,
    max_cost: float | None = None,
    prices: Mapping[str, Price | Given] | None = None,
    sleep: Callable[[float], Awaitable[object]] = asyncio.sleep,
) -> LLMBackend:
    """Wrap a model in cache, repair, budget and retry. `inner` is a backend or a specification of one.

    cache_folder : folder of stored answers, None for no cache; repairs, retries, rate_limit_retries (after waits that
    the server stated) : most of each, per call; max_calls, max_tokens, max_cost [US dollars] : limits, None for none;
    prices : additions to the dated list; sleep : for tests.
    The cache stores repaired answers only, the budget counts every repair, and calls without an answer are not
    counted. `reports` returns the counts of each layer.
    Raises: ConfigError: a setting that cannot work.
    """
    retried = RetryBackend(inner, retries, rate_limit_retries=rate_limit_retries, sleep=sleep)
    paid = BudgetBackend(retried, max_calls, max_tokens, max_cost, prices)
    valid = RepairBackend(paid, repairs)
    return valid if cache_folder is None else CacheBackend(valid, cache_folder)


def build_backend(
    spec: object,
    cache_folder: str | os.PathLike[str] | None = None,
    *,
    max_cost: float | None = None,
    prices: Mapping[str, Price | Given] | None = None,
) -> LLMBackend:
    """Build the backend of a configuration, and add the standard stack if it needs one.

    The stack is added if `spec` is a kind or mapping, and the backend has a network address. Ready-made backends,
    wrappers, the lexicon, recordings and functions stay unchanged.
    "openai:gpt-4o" is a kind with its model, as on the command line.
    Raises: ConfigError: as `BACKENDS.build`.
    """
    if isinstance(spec, str) and ":" in spec:
        kind, _, model = spec.partition(":")
        spec = {"kind": kind, "model": model}
    built = cast("LLMBackend", BACKENDS.build(spec))  # `build` checks it
    if built is spec or isinstance(built, Wrapper) or not is_remote(built):
        return built
    return standard_stack(built, cache_folder, max_cost=max_cost, prices=prices)
