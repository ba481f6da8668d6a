"""The modes of a single plate, and bodies made of them."""
