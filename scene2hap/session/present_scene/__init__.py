"""The present scene: its objects, which of them a source reaches, and the input that a model gets."""
