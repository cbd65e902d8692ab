"""`python -m timelaw`."""

from timelaw.cli import main

main()
