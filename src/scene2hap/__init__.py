"""scene2hap: scene-wide vibrotactile haptics for virtual reality."""
