"""The law file: its schema, the plain data that it holds, and how it is read."""

from timelaw.law_file.document import from_document, to_document
from timelaw.law_file.read import read_law

__all__ = ["from_document", "read_law", "to_document"]
