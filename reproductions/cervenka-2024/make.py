"""Functions, height fields, muscles and attachments, each in a file of its own."""
import areas
import functions
import heights
import muscles


def make(page):
    for part in (functions, heights, muscles, areas):
        part.tell(page)
