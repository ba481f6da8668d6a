"""The propagation field in use: live, or prepared by a worker."""
