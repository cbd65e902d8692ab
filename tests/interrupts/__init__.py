"""Signals at random moments: `python -m tests.interrupts --count 300 --seed 1`.

Commands that design, write and sweep get SIGINT, SIGTERM, SIGKILL or SIGINT twice at a random moment, and are
judged by what is left: old or new results whole, exit code, one object on stdout, nobody left running.
"""
