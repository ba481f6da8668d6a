"""The dominant surface of a mesh: how it is found and measured, and its outline."""
