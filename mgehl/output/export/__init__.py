"""A run's fields for other programs."""
