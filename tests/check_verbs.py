#!/usr/bin/env python3
"""Does each verb of the table in step/advance.cpp stand in the file of its name, and does step/verbs.hpp declare it in the order of the table?"""
import pathlib
import re
import sys
import tempfile

STEP = pathlib.Path(__file__).resolve().parent.parent / "src" / "crampon" / "step"
SUFFIX = ".cpp"
NOT_VERBS = {"once", "blocks", "series", "in_task", "in_task_once", "run_where"}  # what the table is written with


def verbs_of_table(text):
    table = text[text.index("stages() {"):text.index("void advance(")]
    found = [name for name in re.findall(r"\b([a-z]\w*)<Dim\b", table) if name not in NOT_VERBS]
    return list(dict.fromkeys(name for name in found if not name.endswith("_comes_first")))


def complaints_about(step):
    complaints = []
    verbs = verbs_of_table((step / "advance.cpp").read_text())
    files = {path.stem for path in (step / "verbs").glob("*" + SUFFIX)}
    for name in verbs:
        path = step / "verbs" / (name + SUFFIX)
        if name not in files:
            complaints.append("%s: no file of this name in step/verbs" % name)
        elif not re.search(r"^void %s\(" % name, path.read_text(), re.M):
            complaints.append("%s: %s does not define it" % (name, path.relative_to(step)))
    complaints += ["step/verbs/%s: no verb of the table has this name" % (name + SUFFIX) for name in sorted(files - set(verbs))]
    declared = re.findall(r"^void (\w+)\(", (step / "verbs.hpp").read_text(), re.M)
    if declared != verbs:
        place = next((i for i, (a, b) in enumerate(zip(declared + [""], verbs + [""])) if a != b), 0)
        complaints.append("step/verbs.hpp: number %d is %s, in the table it is %s" % (place + 1, (declared + ["nothing"])[place], (verbs + ["nothing"])[place]))
    return complaints, len(verbs)


def self_test():
    """Does each way to go wrong bring exactly the complaint about it?"""
    table = "stages() {\n  return {once<Dim, first<Dim>, second<Dim, Shape>>(\"name\")};\n}\nvoid advance("
    whole = {"advance" + SUFFIX: table, "verbs/first": "void first(int) {}\n", "verbs/second": "void second(int) {}\n",
             "verbs.hpp": "void first(int);\nvoid second(int);\n"}
    wrong = [({}, []),
             ({"verbs/second": None}, ["second: no file"]),
             ({"verbs/second": "void other(int) {}\n"}, ["second: verbs/second" + SUFFIX + " does not define it"]),
             ({"verbs/third": "void third(int) {}\n"}, ["step/verbs/third" + SUFFIX + ": no verb"]),
             ({"verbs.hpp": "void second(int);\nvoid first(int);\n"}, ["step/verbs.hpp: number 1 is second, in the table it is first"]),
             ({"verbs.hpp": "void first(int);\n"}, ["step/verbs.hpp: number 2 is nothing, in the table it is second"])]
    failures = 0
    for change, expected in wrong:
        with tempfile.TemporaryDirectory() as folder:
            step = pathlib.Path(folder)
            (step / "verbs").mkdir()
            for name, text in {**whole, **change}.items():
                if text is not None:
                    (step / (name if "." in name else name + SUFFIX)).write_text(text)
            found, count = complaints_about(step)
        if count != 2 or len(found) != len(expected) or not all(f.startswith(e) for f, e in zip(found, expected)):
            print("%s: complaints %s, expected %s" % (sorted(change), found, expected))
            failures += 1
    print("%d of %d as expected" % (len(wrong) - failures, len(wrong)))
    return 1 if failures else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    complaints, count = complaints_about(STEP)
    for complaint in complaints:
        print(complaint)
    print("%d verbs" % count)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
