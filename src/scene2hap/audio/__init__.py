"""Sound: clips, their analysis and choice, loops, and their conversion into touch."""
