"""Which limits are active where: those that a segment uses up, as it was proved."""

from collections import defaultdict

from timelaw.certificate import Certificate

ACTIVE = 0.999  # of a limit; solvers leave a millionth, what is used to this part is what bounds the law


def list_active(certificate: Certificate) -> dict[int, list[str]]:
    """By the index of a segment the limits that it uses up."""
    found: dict[int, list[str]] = defaultdict(list)
    for peak in certificate.peaks:
        if peak.used >= ACTIVE:
            found[peak.index].append(peak.label)
    return found
