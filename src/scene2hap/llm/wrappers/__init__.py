"""Backends around backends: each adds one behaviour to whatever it is given as `inner`.

Outermost first, a good order is cache, repair, budget, retry, model: a cache then keeps repaired answers only, every
repair is paid for within the budget, and a call that never came about is not. In a configuration `inner` is again a
kind or a mapping with one, so that the whole stack is data.
"""

from scene2hap.llm.wrappers.budget import BudgetBackend, Price
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.retry import RetryBackend

__all__ = ["BudgetBackend", "CacheBackend", "Price", "RepairBackend", "RetryBackend"]
