"""Wrappers: backends that add one behaviour to an `inner` backend.

A good order, outermost first, is cache, repair, budget, retry, model. The cache then stores repaired answers only, the
budget counts every repair, and calls without an answer are not counted. `standard_stack` builds this order. In a
configuration, `inner` is again a kind or a mapping with a kind, so that the whole stack is data.
"""

from scene2hap.llm.stack import identity, innermost, is_remote, reports
from scene2hap.llm.wrappers.budget import BudgetBackend
from scene2hap.llm.wrappers.cache import CacheBackend
from scene2hap.llm.wrappers.prices import Price, PriceList, price_list
from scene2hap.llm.wrappers.repair import RepairBackend
from scene2hap.llm.wrappers.retry import RetryBackend
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
