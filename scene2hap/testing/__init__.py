"""Contracts for parts that others write: functions that raise AssertionError where a part breaks its protocol."""

from scene2hap.testing.engine_adapter import check_engine_adapter

__all__ = ["check_engine_adapter"]
