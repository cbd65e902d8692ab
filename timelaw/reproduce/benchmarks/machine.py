"""On what is measured: processor, system, versions."""

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from timelaw import __version__

PACKAGES = ("numpy", "scipy", "casadi", "clarabel")
CPU_FILE = Path("/proc/cpuinfo")  # Linux


def describe_machine() -> str:
    """One line: processor, cores, system, versions of Python, timelaw and what it stands on."""
    own = [f"Python {platform.python_version()}", f"timelaw {__version__}"]
    others = [f"{name} {found}" for name in PACKAGES if (found := find_version(name))]
    return ", ".join([_name_processor(), f"{os.cpu_count()} cores", platform.system(), *own, *others])


def find_version(package: str) -> str | None:
    """The version of a package, None where it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _name_processor() -> str:
    if CPU_FILE.exists():
        for line in CPU_FILE.read_text(encoding="utf-8").splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                return value.strip()
    return platform.processor() or platform.machine()
