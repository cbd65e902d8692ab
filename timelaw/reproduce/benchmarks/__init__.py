"""How fast timelaw is, beside its peers: one part after the other, each a table of the page `speed`."""
