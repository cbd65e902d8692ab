"""Past every node without a stop: rational segments whose node states a cone program chooses."""
