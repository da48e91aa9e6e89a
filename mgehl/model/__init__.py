"""What is computed: lubricant laws, Hertz contact, dimensionless groups, film formulas."""
