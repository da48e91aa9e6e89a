"""Studies: many runs, one table and the pictures that answer one question."""
