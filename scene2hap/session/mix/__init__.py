"""The mix: sources, their loops, starts and stops, and the output that plays them."""
