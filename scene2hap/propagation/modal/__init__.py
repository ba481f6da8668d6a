"""The modes of a single plate and its near field."""
