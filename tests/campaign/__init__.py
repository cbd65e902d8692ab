"""A campaign of seeded random problems that looks for wrong answers: `python -m tests.campaign --help`.

Everything that judges an answer (`attitude`, `spec`, `bounds`, `least`, `leg_program`) imports nothing of
timelaw; only `judge` and what it calls to look at a law does.
"""
