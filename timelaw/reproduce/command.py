"""How the commands of this room are run: what a user did wrong is said in one line."""

import sys
from collections.abc import Callable, Sequence

from timelaw.errors import TimelawError


def run_main(main: Callable[[Sequence[str]], None]) -> None:
    """Run a command with the arguments of the shell."""
    try:
        main(sys.argv[1:])
    except TimelawError as error:
        sys.exit(f"timelaw: {error}")
