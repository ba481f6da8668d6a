"""What the demo kitchen is made of: shapes, the things built from them, and the file they are written to."""
