"""The report of what a hand feels: paths of the sources, and causes of silence."""
