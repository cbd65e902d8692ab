"""Tours: orders in which the orientations are visited, each with the certificate of its length."""

from timelaw.tours.tour import Tour, find_tour, sharpen

__all__ = ["Tour", "find_tour", "sharpen"]
