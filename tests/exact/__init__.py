"""An independent judge of law files: what they promise, decided in exact and ball arithmetic.

It shares no code with the package and reads the JSON alone: numbers are the exact rationals of their
doubles, polynomials have rational coefficients, and only roots, square roots, angles and rates of rational
segments are balls, of `PRECISION` bits or more. `bounds` and `mutations` are long commands; small samples of both are default tests.
"""
