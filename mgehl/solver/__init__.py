"""Newton's method, the partition into film, cavity and contact, nested iteration, verification."""
