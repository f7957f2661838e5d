#!/usr/bin/env python3
"""Does each verb of the table in step/advance.cpp stand in the file of its name, and does step/verbs.hpp declare it in the order of the table?"""
import pathlib
import re
import sys

STEP = pathlib.Path(__file__).resolve().parent.parent / "src" / "crampon" / "step"
SUFFIX = ".cpp"
NOT_VERBS = {"once", "blocks", "series", "in_task", "in_task_once", "run_where"}  # what the table is written with


def verbs_of_table():
    text = (STEP / "advance.cpp").read_text()
    table = text[text.index("stages() {"):text.index("void advance(")]
    found = [name for name in re.findall(r"\b([a-z]\w*)<Dim\b", table) if name not in NOT_VERBS]
    return list(dict.fromkeys(name for name in found if not name.endswith("_comes_first")))


def main():
    complaints = []
    verbs = verbs_of_table()
    files = {path.stem for path in (STEP / "verbs").glob("*" + SUFFIX)}
    for name in verbs:
        path = STEP / "verbs" / (name + SUFFIX)
        if name not in files:
            complaints.append("%s: no file of this name in step/verbs" % name)
        elif not re.search(r"^void %s\(" % name, path.read_text(), re.M):
            complaints.append("%s: %s does not define it" % (name, path.relative_to(STEP)))
    complaints += ["step/verbs/%s: no verb of the table has this name" % (name + SUFFIX) for name in sorted(files - set(verbs))]
    declared = re.findall(r"^void (\w+)\(", (STEP / "verbs.hpp").read_text(), re.M)
    if declared != verbs:
        place = next((i for i, (a, b) in enumerate(zip(declared + [""], verbs + [""])) if a != b), 0)
        complaints.append("step/verbs.hpp: number %d is %s, in the table it is %s" % (place + 1, (declared + ["nothing"])[place], (verbs + ["nothing"])[place]))
    for complaint in complaints:
        print(complaint)
    print("%d verbs, %d files" % (len(verbs), len(files)))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
