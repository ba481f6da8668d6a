"""Wire formats as pure functions; specified in docs/serial-protocol.md."""
