"""Wrappers: backends that add one behaviour to an `inner` backend.

Outermost first, a good order is cache, repair, budget, retry, model: a cache then keeps repaired answers only, every
repair is paid for within the budget, and a call that never came about is not. `standard_stack` builds just that. In a
configuration `inner` is again a kind or a mapping with one, so that the whole stack is data.
"""

from scene2hap.llm.wrappers.budget import BudgetBackend
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.prices import Price, PriceList, price_list
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.retry import RetryBackend
from scene2hap.llm.wrappers.stack import identity, innermost, is_remote, reports
from scene2hap.llm.wrappers.standard import build_backend, standard_stack

__all__ = [
    "BudgetBackend",
    "CacheBackend",
    "Price",
    "PriceList",
    "RepairBackend",
    "RetryBackend",
    "build_backend",
    "identity",
    "innermost",
    "is_remote",
    "price_list",
    "reports",
    "standard_stack",
]
