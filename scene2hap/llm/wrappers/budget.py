"""BudgetBackend: counts calls, tokens and cost, and stops before a limit is passed by a further call."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scene2hap import checks
from scene2hap.calls import clear_construction
from scene2hap.errors import BackendError, BudgetExceeded, ConfigError
from scene2hap.llm.chat import UnusableAnswer
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.wrappers.prices import Given, Price, PriceList, price_list
from scene2hap.llm.wrappers.stack import Spec, Wrapper


@clear_construction
class BudgetBackend(Wrapper):
    """Passes calls on as long as the limits hold; None is no limit.

    prices : model name -> `Price`, or (input, output) or (input, output, cached input) [US dollars per million
    tokens], beside or instead of those of the dated list (`price_list()`); a model in neither has an unknown price,
    never none.
    Limits are checked before each call, with the usage known by then. Concurrent calls can exceed a limit on tokens or
    cost by their own usage, a limit on calls never.
    Raises: ConfigError: a limit that is negative or a price that is none.
    """

    def __init__(
        self,
        inner: Spec,
        max_calls: int | None = None,
        max_tokens: int | None = None,
        max_cost: float | None = None,
        prices: Mapping[str, Price | Given] | None = None,
    ) -> None:
        super().__init__(inner)
        self._limits = {"calls": max_calls, "tokens": max_tokens, "cost": max_cost}
        for name, limit in self._limits.items():
            if limit is not None:
                checks.number(f"max_{name}", limit, "-", at_least=0, error=ConfigError)
        self._prices: PriceList = price_list(prices)
        self._calls = self._failed = self._blind = self._input = self._cached = self._output = 0
        self._cost = 0.0
        self._unpriced: set[str] = set()

    @property
    def cost(self) -> float | None:
        """Cost of the answers so far; None as soon as one came without its usage or from a model without a price."""
        return None if self._unpriced or self._blind else self._cost

    @property
    def tokens(self) -> int | None:
        """Tokens read and written so far; None as soon as an answer came without its usage."""
        return None if self._blind else self._input + self._output

    async def complete(self, request: LLMRequest) -> LLMReply:
        """The inner backend's answer. Raises: BudgetExceeded: the call was not made; and as the inner backend."""
        self._check()
        self._calls += 1
        try:
            reply = await self.inner.complete(request)
        except BackendError as problem:
            self._failed += 1
            if isinstance(problem, UnusableAnswer):
                self._meter(problem)
            raise
        if reply.is_kept:
            self._calls -= 1  # an inner cache answered it
        else:
            self._meter(reply)
        return reply

    def report(self) -> dict[str, Any]:
        """Return calls, tokens and cost [US dollars] (None: unknown), the date of the prices, and missing items.

        Answers that were cut short, refused or empty are failed calls that are billed. Calls without any answer are in
        no sum, though a service may bill some; neither are answers without their usage. Input in the service's prompt
        cache, and cheaper service tiers, have their own prices.
        """
        return {
            "calls": self._calls,
            "failed_calls": self._failed,
            "calls_without_usage": self._blind,
            "input_tokens": self._input,
            "cached_input_tokens": self._cached,
            "output_tokens": self._output,
            "cost": self.cost,
            "prices_of": self._prices.date,
            "models_without_price": sorted(self._unpriced),
        }

    def _check(self) -> None:
        spent = {"calls": self._calls, "tokens": self.tokens, "cost": self.cost}
        for name, used in spent.items():
            limit = self._limits[name]
            if limit is None:
                continue
            if used is None:
                lacks = "the usage of an answer" if self._blind else f"a price for {', '.join(sorted(self._unpriced))}"
                raise BudgetExceeded(
                    f"max_{name} = {limit:g} cannot be kept: what was used is unknown, for want of {lacks}. "
                    "Add it to prices, or limit calls instead."
                )
            if used >= limit:
                raise BudgetExceeded(f"{used:g} {name} used of max_{name} = {limit:g}. Raise the limit to go on.")

    def _meter(self, reply: LLMReply | UnusableAnswer) -> None:
        read, written = reply.usage.get("prompt_tokens"), reply.usage.get("completion_tokens")
        if read is None or written is None:
            self._blind += 1
            return
        self._input += read
        self._output += written
        self._cached += reply.usage.get("cached_tokens", 0)
        cost = self._prices.cost_usd(reply.model, reply.usage, reply.service_tier)
        if cost is None:
            self._unpriced.add(reply.model)
        else:
            self._cost += cost
