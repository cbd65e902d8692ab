"""Programs that some tests want: without them they are skipped, or fail where all are required."""

import os
import shutil

import pytest

REQUIRED = "TIMELAW_TOOLS"  # set to "required", as .ci/run does, a missing program is a failure


def miss(message: str) -> None:
    """Skip, or fail if nothing may be skipped."""
    if os.environ.get(REQUIRED) == "required":
        pytest.fail(message)
    pytest.skip(message)


def need(program: str) -> None:
    """Go on if the program is there."""
    if shutil.which(program) is None:
        miss(f"{program} is not installed")
