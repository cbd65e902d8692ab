"""Searches for tours: pure combinatorics over costs, neighbours and runs."""
