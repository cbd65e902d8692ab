"""Pictures of a law alone, as figures for the report and as files of their own."""
