"""Impacts: motions of objects, landings, and the bursts that each hand feels."""
