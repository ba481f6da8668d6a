"""Bytes on a wire, as pure functions; docs/serial-protocol.md is the written form."""
