"""Which figures and tables of a publication a text names, and which of them a page has or says that it cannot have."""
import re

from files import read

NUMBER = r"(?:[A-Z]\.|\d+\.)?\d+"
NAMED = re.compile(rf"(Figure|Table)s? ({NUMBER}(?:(?:, and |, | and | to ){NUMBER})*)")


def named(text):
    """["Figure 7.1", ...] in the order of the text; "Figures 5.9 to 5.11" are three."""
    found = []
    for kind, numbers in NAMED.findall(text):
        words = re.split(r"(?:, and |, | and )", numbers)
        for word in words:
            first, _, last = word.partition(" to ")
            before, _, number = first.rpartition(".")
            for each in range(int(number), int((last or first).rpartition(".")[2]) + 1):
                found.append(f"{kind} {before}{'.' if before else ''}{each}")
    return found


def order(title):
    """By the publication's first figure that the title names, those of appendices behind, then its tables; what names none comes last."""
    first = next(iter(named(title)), None)
    if not first:
        return ("~", " ", 0, 0)
    kind, number = first.split()
    chapter, _, each = number.rpartition(".")
    return (kind, chapter if chapter.isalpha() else " ", int(chapter) if chapter.isdigit() else 0, int(each))


def is_beside(title):
    """Whether the title tells of something that the publication has not, beside one of its figures."""
    return title.startswith("Beside ")


def on_page(here):
    """Figures and tables of the publication that the page of HERE shows: titles of charts and pictures, and sources of published values."""
    titles = [entry.get("title", "") for entry in [*read(f"{here}/page.toml")["figures"].values(), *read(f"{here}/pictures.toml").get("pictures", [])]]
    sources = [row["source"] for row in read(f"{here}/published.csv")]
    return {each for text in [title for title in titles if not is_beside(title)] + sources for each in named(text)}


def not_made(here):
    """Those of which the page says what it would need."""
    return {each for entry in read(f"{here}/page.toml").get("not_made", []) if entry["needs"] for each in named(entry["what"])}
