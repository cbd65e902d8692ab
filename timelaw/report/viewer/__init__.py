"""The motion in the page: a law's own numbers, and the script that evaluates and draws them there."""
