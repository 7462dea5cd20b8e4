"""The pages of the documentation, as the tests read them: blocks, tables, headings and links."""
import os
import re

# Pages in the order in which a reader uses them; the other pages follow. All commands run in this order in one
# directory.
FIRST = ["README.md", "docs/install.md", "docs/tutorials/powder2d.md", "docs/tutorials/beads.md",
         "docs/tutorials/your-packing.md", "docs/tutorials/oedometer.md", "docs/tutorials/your-test.md",
         "docs/tutorials/campaign.md", "docs/tutorials/pentagons.md",
         "docs/commands/index.md", "docs/commands/run.md", "docs/commands/scene.md"]
# These files are not pages of the site, but users read them too.
OTHERS = ["CONTRIBUTING.md", "CHANGELOG.md"]
# A number in a page or in the output of a command.
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def rounds_to(shown, value):
    """Returns whether a value rounds to the printed number."""
    mantissa, _, exponent = shown.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    digits = mantissa.lstrip("+-").replace(".", "").lstrip("0")
    unit = 10.0 ** (int(exponent or 0) - decimals)
    # Zeros at the end of a whole number may be rounded digits: "26590" has four or five significant digits, "440" two
    # or three.
    if decimals == 0 and not exponent:
        unit *= 10 ** (len(digits) - len(digits.rstrip("0"))) if digits else 1
    return abs(float(shown) - value) <= 0.5000001 * unit + 1e-12 * abs(value)


def page_names(source):
    """Returns the paths of all pages, relative to the root of the repository."""
    found = []
    for folder, _, files in os.walk(os.path.join(source, "docs")):
        found += [os.path.relpath(os.path.join(folder, name), source) for name in files if name.endswith(".md")]
    rest = sorted(name for name in found if name not in FIRST)
    return FIRST + rest + [name for name in OTHERS if os.path.exists(os.path.join(source, name))]


class Page:
    def __init__(self, source, name):
        self.name = name
        self.text = open(os.path.join(source, name), encoding="utf-8").read()
        self.lines = self.text.split("\n")
        self.blocks = []    # (language, text, line)
        self.tables = []    # (header, rows of cells, line)
        self.headings = []  # text
        self.prose = []     # (line without blocks, number)
        inside = None
        for number, line in enumerate(self.lines, 1):
            if line.startswith("```"):
                if inside is None:
                    inside = (line[3:], [], number)
                else:
                    self.blocks.append((inside[0], "\n".join(inside[1]) + "\n", inside[2]))
                    inside = None
                continue
            if inside is not None:
                inside[1].append(line)
                continue
            self.prose.append((line, number))
            if re.match(r"#{1,6} ", line):
                self.headings.append(line.lstrip("#").strip())
            if line.startswith("|") and number < len(self.lines) and re.fullmatch(r"[|\- :]+", self.lines[number]):
                self.tables.append((line, self.rows_below(number + 1), number))
        if inside is not None:
            raise AssertionError(f"{name}:{inside[2]}: the block has no end")

    def rows_below(self, first):
        rows = []
        for row in self.lines[first:]:
            if not row.startswith("|"):
                break
            rows.append([cell.strip() for cell in row.strip().strip("|").split("|")])
        return rows

    def anchors(self):
        """Returns the anchors of the headings, as Python-Markdown and GitHub make them."""
        return {re.sub(r"[\s-]+", "-", re.sub(r"[^\w\s-]", "", heading.replace("\\", "")).strip().lower())
                for heading in self.headings}

    def links(self):
        """Returns (target, line number) for every link and picture."""
        return [(target, number) for line, number in self.prose
                for target in re.findall(r"\]\(([^()\s]+)\)", line)]


class Documentation:
    def __init__(self, source):
        self.pages = [Page(source, name) for name in page_names(source)]

    def text(self):
        return "\n".join(page.text for page in self.pages)

    def block(self, part):
        found = {text for page in self.pages for _, text, _ in page.blocks if part in text}
        if len(found) != 1:
            raise AssertionError(f"the pages have {len(found)} different blocks with {part!r}, expected one")
        return found.pop()

    def table(self, part):
        found = [rows for page in self.pages for header, rows, _ in page.tables if part in header]
        if not found or any(rows != found[0] for rows in found):
            raise AssertionError(f"the pages have {len(found)} tables with {part!r}, expected one")
        return found[0]
