"""Bodies of a scene, coupled at their contacts: joints, forces, and the gain at a touched point."""
