"""The inference report of a bake as rows of text: calls, tokens, cost, and saved questions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from scene2hap.errors import ConfigError

_SAVED = {
    "copies": "copies of another object",
    "silent": "silent objects, whose vibration needs no words",
    "same_material": "materials that were answered already",
    "unknown_material": "materials that were not recognised",
    "table_material": "materials that were looked up",
    "unreached_material": "materials that no source reaches",
}
"""Reasons of `InferenceReport.skipped`, as text."""


def account_table(account: Mapping[str, Any]) -> dict[str, Any]:
    """Return rows of a label and a text, and problems by object or material word.

    Parameters: account : as of `InferenceReport.as_json`, optionally with `cost_usd` and `ended`.
    Raises: ConfigError: it has another shape.
    """
    try:
        return {"rows": _rows(account), "problems": _problems(account)}
    except (ArithmeticError, AttributeError, KeyError, TypeError, ValueError) as cause:
        raise ConfigError(
            f"the account of the bake has another shape: {cause!r}. Give what InferenceReport.as_json returns, or "
            "remove the file beside the bundle."
        ) from cause


def _rows(account: Mapping[str, Any]) -> list[list[str]]:
    calls = {str(name): int(number) for name, number in account["calls"].items()}
    parts = ", ".join(f"{number} {name.replace('_', ' ')}" for name, number in calls.items())
    rows = [
        ["baked", str(account.get("ended", "")).replace("T", " ").replace("+00:00", " UTC")],
        ["calls", f"{sum(calls.values())}" + (f": {parts}" if parts else "")],
        ["answered from a cache", str(int(account["kept"]))],
    ]
    for reason, number in account["skipped"].items():
        if int(number):
            rows.append(["skipped", f"{int(number)}: {_SAVED.get(reason, str(reason).replace('_', ' '))}"])
    for model, used in account["tokens"].items():
        read, said, cached = (int(used.get(f"{kind}_tokens", 0)) for kind in ("prompt", "completion", "cached"))
        rows.append(
            [f"tokens of {model}", f"{read:,} read, {cached:,} of them at the price of cached input; {said:,} written"]
        )
    if account["tokens"]:
        cost = account.get("cost_usd")
        rows.append(["cost", "unknown" if cost is None else f"{float(cost):.3f} US dollars"])
    elif sum(calls.values()):
        rows.append(["tokens", "none were reported"])
    return [row for row in rows if row[1]]


def _problems(account: Mapping[str, Any]) -> list[list[str]]:
    found = [[str(what) or "the scene", str(problem)] for what, problem in account.get("errors", {}).items()]
    for part in ("flags", "doubts"):
        found += [[str(what), "; ".join(map(str, said))] for what, said in account.get(part, {}).items()]
    return found
