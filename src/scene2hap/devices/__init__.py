"""Actuators: where the mix goes."""
