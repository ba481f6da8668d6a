"""BudgetBackend: counts calls, tokens and cost, and stops at a limit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.warning import warn_of
from scene2hap.errors import BackendError, BudgetExceeded, ConfigError
from scene2hap.llm.answers.usable import UnusableAnswer
from scene2hap.llm.protocol import BackendWarning, LLMReply, LLMRequest
from scene2hap.llm.stack import Spec, Wrapper, identity, is_remote
from scene2hap.llm.wrappers.prices import Given, Price, PriceList, price_list


@clear_construction
class BudgetBackend(Wrapper):
    """Pass calls on while the limits hold. A limit of None means no limit.

    prices : model name -> `Price`, or (input, output) or (input, output, cached input) [US dollars per million
    tokens]. They add to the dated list (`price_list()`) and override it. A model in neither has an unknown price,
    never a price of 0.
    Limits are checked before each call, with the usage known by then. Whether a service reports usage shows in its
    first answer only. Concurrent calls can exceed a limit on tokens or
    cost by their own usage, but never a limit on calls.
    Raises: ConfigError: a negative limit or an invalid price.
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

    def __getstate__(self) -> dict[str, Any]:
        for name, limit in self._limits.items():
            if limit is not None:
                raise ConfigError(
                    f"a BudgetBackend with max_{name} = {limit:g} cannot be copied or pickled: each copy could spend "
                    "as much again. Make one in each process, with its share of the limit."
                )
        return vars(self)

    @property
    def cost(self) -> float | None:
        """Cost of the answers so far; None once an answer had no usage or its model no price."""
        return None if self._unpriced or self._blind else self._cost

    @property
    def tokens(self) -> int | None:
        """Tokens read and written so far; None once an answer came without its usage."""
        return None if self._blind else self._input + self._output

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Return the inner backend's answer. Raises: BudgetExceeded: no call was made; errors of the inner backend."""
        self._check()
        self._warn_of_unknown_price()
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

        Answers that were cut short, refused or empty count as failed calls, and they are billed. The sums leave out
        calls without any answer, although a service may bill some, and answers without usage. Input in the service's
        prompt cache, and cheaper service tiers, have their own prices.
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
                    f"max_{name} = {limit:g} cannot be kept: the use so far is unknown without {lacks}. "
                    "Add it to prices, or limit calls instead."
                )
            if used >= limit:
                raise BudgetExceeded(f"{used:g} {name} used of max_{name} = {limit:g}. Raise the limit to go on.")

    def _warn_of_unknown_price(self) -> None:
        """Warn before the first call that a limit on cost may end the run after it. Warns: BackendWarning."""
        limit = self._limits["cost"]
        if limit is None or self._calls or not is_remote(self.inner):
            return
        model = identity(self.inner).get("model")
        if not isinstance(model, str) or self._prices.of(model) is not None:
            return
        warn_of(
            f"max_cost = {limit:g} can only be kept if answers name a model with a price: the price of {model!r} is "
            "unknown. Without one the run stops after its first answers. Add it to prices, or limit calls instead.",
            BackendWarning,
        )

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
