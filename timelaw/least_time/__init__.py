"""Least times that physics allows, in closed form: what every law is measured by."""
