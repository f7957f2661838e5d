#!/usr/bin/env python3
"""Do the inputs of docs/tutorials run, and do they meet what they expect? The blocks marked toml of each page make one input.

  tutorials_test.py PROGRAM"""
import pathlib
import re
import subprocess
import sys
import tempfile

PAGES = pathlib.Path(__file__).resolve().parent.parent / "docs" / "tutorials"


def main():
    program = sys.argv[1]
    failed = 0
    pages = sorted(PAGES.glob("*.md"))
    assert pages, "there are no tutorials in %s" % PAGES
    for page in pages:
        blocks = re.findall(r"^```toml\n(.*?)^```", page.read_text(), re.M | re.S)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / (page.stem + ".toml")
            path.write_text("\n".join(blocks))
            assert "[[expect]]" in path.read_text(), "%s expects nothing" % page.name
            done = subprocess.run([program, "run", str(path), "--quiet", "--output", folder + "/out"], capture_output=True, text=True)
            print("%s: %s" % (page.name, "ok" if done.returncode == 0 else "failed\n" + done.stdout + done.stderr))
            failed += done.returncode != 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
