#!/usr/bin/env python3
"""Does every member of a family that the input knows stand in the theory page of its family?

check_theory_pages.py PROGRAM              asks the program for its schema
check_theory_pages.py PROGRAM --self-test  shows that a missing name is found
"""
import json
import pathlib
import subprocess
import sys

THEORY = pathlib.Path(__file__).resolve().parent.parent / "docs" / "theory"


def names_of(family, schema):
    """Words that stand for the members of a family in an input."""
    if family == "shape_functions":
        return schema["properties"]["method"]["properties"]["shape_functions"]["enum"]
    choices = schema["properties"]["material"]["items"] if family == "material" else schema["definitions"][family]
    found = []
    for choice in choices.get("oneOf", choices.get("anyOf", [])):
        words = choice.get("properties", {}).get("law", {}).get("enum") or choice.get("enum") or []
        found += [word for word in words if word not in found]
    return found


# family: pages, each with what must stand there for a name
PAGES = {
    "material": [("materials.md", "`%s`")],
    "contact_law": [("contact.md", "`%s`")],
    "traction_law": [("traction.md", "`%s`")],
    "growth_criterion": [("fracture.md", "`%s`")],
    "shape_functions": [("step.md", "`%s`"), ("kinematics.md", "`shape/%s" + ".hpp`")],
}
NOT_LAWS = {"traction_law": {"none"}}


def complaints(schema):
    found = []
    for family, pages in PAGES.items():
        names = [name for name in names_of(family, schema) if name not in NOT_LAWS.get(family, ())]
        if len(names) < 3:
            found.append("the schema names only %s in the family %s" % (names, family))
        for page, mark in pages:
            text = (THEORY / page).read_text()
            found += ["docs/theory/%s: %s is missing (family %s)" % (page, mark % name, family) for name in names if mark % name not in text]
    return found


def self_test(schema):
    """A further word in each family must bring one complaint for each of its pages."""
    schema["properties"]["method"]["properties"]["shape_functions"]["enum"].append("unheard_of")
    for choices in [schema["properties"]["material"]["items"], schema["definitions"]["contact_law"], schema["definitions"]["traction_law"],
                    schema["definitions"]["growth_criterion"]]:
        choices.get("oneOf", choices.get("anyOf")).append({"properties": {"law": {"enum": ["unheard_of"]}}})
    found = complaints(schema)
    expected = sum(len(pages) for pages in PAGES.values())
    if len(found) != expected or not all("unheard_of" in complaint for complaint in found):
        print("\n".join(found))
        print("%d complaints, expected %d" % (len(found), expected))
        return 1
    return 0


def main():
    schema = json.loads(subprocess.run([sys.argv[1], "schema"], check=True, capture_output=True, text=True).stdout)
    if sys.argv[2:] == ["--self-test"]:
        return self_test(schema)
    found = complaints(schema)
    print("\n".join(found) if found else "every name has its place")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
