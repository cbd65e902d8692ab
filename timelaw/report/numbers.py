"""Numbers as people write them."""

GREATEST = 1e9  # from here on with a power of ten


def write_number(value: float, digits: int = 5) -> str:
    """To so many digits, and whole where it has more before the point."""
    short = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in short and abs(value) < GREATEST else short
