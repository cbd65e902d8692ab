"""Laws beside each other: what differs between their routes, numbers, rankings, and a page."""
