#!/usr/bin/env python3
"""Does everything exist that comments and pages cite?

Checked are: pages (docs/theory/step.md), their sections (step.md, time of positions), conventions (conventions 29), decisions
(decision 18), validation rows, source files (step/advance.hpp), tests named in pages, links of pages, and the numbers of equations,
sections, figures and tasks of the papers N03 and N13.
    check_citations.py             checks the repository
    check_citations.py --self-test shows that each kind of broken citation is found
"""
import pathlib
import posixpath
import re
import subprocess
import sys
import tempfile

# What the two papers have. Ranges include both ends.
PAPERS = {
    "N03": {"Eq": (1, 36), "Fig": (1, 6), "Task": (0, 8), "sec": "1 2 2.1 2.2 2.3 3 3.1 3.2 3.3 3.4 3.5 4".split()},
    "N13": {"Eq": (1, 16), "Fig": (1, 1), "Task": (0, 8),
            "sec": "1 1.1 1.2 2 2.1 2.2 2.3 2.4 2.5 2.6 2.7 2.8 2.9 3 3.1 3.2".split()},
}
ENDINGS = {".hpp", ".cpp", ".py", ".md", ".txt", ".cmake", ".sh", ".toml", ".in", ""}
SKIPPED = {"tests/check_citations.py", "tests/check_includes.py", "tests/add_shape_function.py", "LICENSE"}  # they have samples that do not exist
CONVENTIONS, VALIDATION = "docs/theory/conventions.md", "docs/theory/validation.md"

LIST = r"(\d+(?:\.\d+)?(?:(?:-| to |, | and )\d+(?:\.\d+)?)*)"
FORBIDDEN = re.compile(r"\b(CONVENTIONS|DESIGN)\b")
PAGE = re.compile(r"(?<![\w/.*])((?:\.\./)*[\w./-]*\w\.md)\b(#[\w-]+)?(?:`?(?:, | \()([A-Za-z][^;:.()|`]*))?")
LINK = re.compile(r"\]\(([^)#\s:]*)(#[\w-]+)?\)")
CONVENTION = re.compile(r"\bconventions(?:\.md)?`? " + LIST)
OWN_SECTION = re.compile(r"(?<!N03 )(?<!N13 )\bsections? " + LIST)
DECISION = re.compile(r"\b[Dd]ecisions?[ /]" + LIST)
SHORT_DECISION = re.compile(r"(?<![\d.])(0\d{3})\b(?!-)")
ROW = re.compile(r"\b[Vv]alidation rows? " + LIST)
SOURCE = re.compile(r"(?<![\w/.*<{$-])((?:[\w.-]+/)*\w+\.[hc]pp|(?:[\w.-]+/)+\w+\.(?:py|cmake|toml))\b(?![/*])")
TEST = re.compile(r"`([a-z0-9_]+_test)`")
PAPER = re.compile(r"\b(N03|N13)(?:'s)?,? \(?(Eq|sec|Fig|Task)(?:uation|tion|ure)?s?\.? " + LIST)
BARE_EQUATION = re.compile(r"(?<!N03 )(?<!N13 )\bEqs?\. " + LIST)


def numbers_of(text, between=()):
    """'13, 14' and '15-17' as lists of texts; ranges of whole numbers, or of the given names, are written out."""
    found = []
    for part in re.split(r", | and ", text):
        ends = re.split(r"-| to ", part)
        if len(ends) == 2 and all(end in between for end in ends):
            found += between[between.index(ends[0]):between.index(ends[1]) + 1]
        elif len(ends) == 2 and all(end.isdigit() for end in ends):
            found += [str(n) for n in range(int(ends[0]), int(ends[1]) + 1)]
        else:
            found += ends
    return found


def prose(path, text):
    """Lines of a file as citations see them: code left out, the sign of a comment too. Yields (line number, text of a paragraph,
    where in it each of its lines begins)."""
    sign = {".hpp": "//", ".cpp": "//", ".cmake": "#", ".txt": "#", ".in": "#"}.get(path.suffix)
    lines, starts, first = [], [], 1
    for number, line in enumerate(text.split("\n") + [""], 1):
        code, _, rest = line.partition(sign) if sign else ("", "", line)
        piece = rest.strip().lstrip("/#<").strip()
        joins = piece and not code.strip() and not piece.startswith("|")
        if lines and not joins:
            yield first, " ".join(lines), starts
            lines, starts = [], []
        if piece:
            if not lines:
                first = number
            starts.append(sum(len(a) + 1 for a in lines))
            lines.append(piece)
    if lines:
        yield first, " ".join(lines), starts


class Repository:
    def __init__(self, top, files):
        self.top, self.files, self.names = top, files, {f.name for f in files}
        self.paths = {str(f) for f in files}
        self.headings, self.found, self.cited = {}, [], 0
        self.conventions = {h.split(".")[0] for h in self.headings_of(CONVENTIONS) if re.match(r"\d+\. ", h)}
        self.rows = set(re.findall(r"^\| (\d+) \|", self.read(VALIDATION), re.M))
        self.decisions = {int(f.name[:4]) for f in files if re.match(r"docs/decisions/\d{4}-", str(f))}

    def read(self, path):
        return (self.top / path).read_text(encoding="utf-8") if str(path) in self.paths else ""

    def headings_of(self, page):
        """Headings of a page, and the words in bold that a paragraph begins with."""
        if page not in self.headings:
            self.headings[page] = [a or b for a, b in re.findall(r"^#+ (.+)$|^\*\*([^*]+)\*\*", self.read(page), re.M)]
        return self.headings[page]

    def resolve(self, cited, citing):
        """The path in the repository that a citation means, or None. By its path, from the place of the citing file, as sources are
        included, or by its name alone where that is the name of one page."""
        for folder in (".", citing.parent, "src", "src/crampon", "tests", "apps"):
            path = posixpath.normpath(f"{folder}/{cited}")
            if path in self.paths:
                return path
        same = [str(f) for f in self.files if f.name == cited]
        return same[0] if len(same) == 1 or (same and cited.endswith(("pp", ".py", ".toml"))) else None

    def check(self, path):
        page = path.suffix == ".md"
        for first, text, starts in prose(path, self.read(path)):
            def say(match, what, to_do, first=first, starts=starts):
                line = first + sum(start <= match.start() for start in starts) - 1
                self.found.append(f"{path}:{line}: {what}: {to_do}")

            def need(pattern, known, what, to_do, text=text):
                for match in pattern.finditer(text):
                    for number in numbers_of(match.group(1)):
                        self.cited += 1
                        if not known(number):
                            say(match, f"{what} {number} does not exist", to_do)

            for match in FORBIDDEN.finditer(text):
                say(match, f"{match.group(1)} is no page of the repository", "cite docs/theory/conventions.md or another page of docs")
            for match in PAGE.finditer(text):
                if "NNNN" not in match.group(1):
                    self.check_page(match, path, say)
            need(CONVENTION, self.conventions.__contains__, "convention", f"cite a number that {CONVENTIONS} has")
            if str(path) == CONVENTIONS:
                need(OWN_SECTION, self.conventions.__contains__, "section", "cite a number of this page")
            need(DECISION, lambda n: int(float(n)) in self.decisions, "decision", "cite a page of docs/decisions")
            if page:
                need(SHORT_DECISION, lambda n: int(n) in self.decisions, "decision", "cite a page of docs/decisions")
                need(TEST, lambda name: name + ".cpp" in self.names, "test", "name a file under tests")
                for match in LINK.finditer(text):
                    self.cited += 1
                    if match.group(1) and not (self.top / path.parent / match.group(1)).exists():
                        say(match, f"the link {match.group(1)} leads nowhere", "link a file, relative to this page")
            need(ROW, self.rows.__contains__, "validation row", f"cite a row of {VALIDATION}")
            for match in SOURCE.finditer(text):
                self.cited += 1
                if not self.resolve(match.group(1), path):
                    say(match, f"there is no file {match.group(1)}", "cite a file, from the root or from src/crampon")
            for match in PAPER.finditer(text):
                known = PAPERS[match.group(1)][match.group(2)]
                for number in numbers_of(match.group(3), known if match.group(2) == "sec" else ()):
                    self.cited += 1
                    if number not in known if match.group(2) == "sec" else not known[0] <= float(number) <= known[1]:
                        say(match, f"{match.group(1)} has no {match.group(2)}. {number}", "correct the number")
            need(BARE_EQUATION, lambda n: 1 <= float(n) <= PAPERS["N03"]["Eq"][1], "equation", "correct the number, or name the paper")

    def check_page(self, match, path, say):
        cited, anchor, words = match.group(1), match.group(2), match.group(3)
        self.cited += 1
        target = self.resolve(cited, path)
        if not target:
            say(match, f"there is no page {cited}", "cite a page of the repository")
            return
        headings = self.headings_of(target)
        if anchor and anchor[1:] not in (re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings):
            say(match, f"{cited} has no heading for {anchor}", "correct the anchor")
        if words and target.startswith(("docs/theory/", "docs/architecture")):
            for section in re.split(r", | and ", words.strip()):
                if not any(section.lower() in heading.lower() for heading in headings):
                    say(match, f"{cited} has no section '{section}'", "cite a heading of that page")


def own_files(top):
    """Files that git knows or would take; without git all but what a build or a run makes."""
    command = ["git", "-C", str(top), "ls-files", "--cached", "--others", "--exclude-standard"]
    try:
        listed = sorted(set(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\n")))
    except (OSError, subprocess.CalledProcessError):
        listed = sorted(str(f.relative_to(top)) for f in top.rglob("*"))
        listed = [f for f in listed if not re.match(r"(build|\.git)/|.*(\.results|__pycache__)/", f)]
    return [pathlib.Path(f) for f in listed if f and (top / f).is_file()]


def complaints(top):
    files = own_files(top)
    repository = Repository(top, files)
    checked = [f for f in files if f.suffix in ENDINGS and str(f) not in SKIPPED]
    for path in checked:
        repository.check(path)
    return repository.found, f"{len(checked)} files with {repository.cited} citations: all that they cite exists"


def self_test():
    pages = {CONVENTIONS: "# Conventions\n### 1. Signs\nSee section 1 and section 7.\n", VALIDATION: "| 3 | beam |\n",
             "docs/theory/step.md": "# Step\n**Time of positions**. Half a step.\n", "docs/decisions/0001-one.md": "# 1. One\n",
             "tests/unit/good_test.cpp": "// nothing\n", "src/crampon/step/good.hpp": "// (docs/theory/step.md, time of\n// positions)\n"}
    good = ["conventions 1", "N03 Eqs. 34-36", "N13 secs. 2.3, 3", "decision 1", "validation row 3", "step/good.hpp", "step.md", "Eq. 26",
            "N13 sec. 2.3-2.7", "docs/theory/step.md, time of positions", "[step](../theory/step.md#step)", "`good_test`"]
    bad = ["CONVENTIONS 1", "DESIGN section 2", "conventions 2", "conventions 1, 9", "N03 Eq. 37", "N03 section 5.1", "N13 Eq. 17", "N13 Task 9",
           "N03 Fig. 7", "Eq. 99", "decision 2", "decisions 1 and 4", "see 0009", "validation row 4", "step/bad.hpp", "bad.hpp", "away.md",
           "docs/theory/step.md, time of day", "[step](../theory/step.md#day)", "[a](a.png)", "`bad_test`"]
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        for name, text in list(pages.items()) + [("docs/notes/page.md", "\n\n".join(good + bad) + "\n")]:
            (top / name).parent.mkdir(parents=True, exist_ok=True)
            (top / name).write_text(text, encoding="utf-8")
        found, _ = complaints(top)
    own = [f for f in found if f.startswith(CONVENTIONS)]
    assert len(own) == 1 and own[0].startswith(CONVENTIONS + ":3: section 7 does not exist"), own
    lines = sorted(int(f.split(":")[1]) for f in found if f not in own)
    wanted = [2 * (len(good) + k) + 1 for k in range(len(bad))]
    assert all(f.startswith("docs/notes/page.md:") for f in found if f not in own), found
    assert sorted(set(lines)) == wanted, (set(lines) ^ set(wanted), found)


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return 0
    found, summary = complaints(pathlib.Path(__file__).resolve().parent.parent)
    print("\n".join(found) if found else summary)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
