"""The report of a motion along Bézier curves."""
