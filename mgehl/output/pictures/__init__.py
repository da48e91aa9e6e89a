"""Pictures of runs: centre lines, maps, histories, comparisons; one style."""
