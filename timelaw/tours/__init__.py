"""Tours: orders in which the orientations are visited, each with the certificate of its length."""

from timelaw.tours.tour import Tour, sharpened, tour

__all__ = ["Tour", "sharpened", "tour"]
