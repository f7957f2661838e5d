#!/usr/bin/env python3
"""The program from the outside: exit codes, messages, what is written and what is not.

    cli_test.py PROGRAM [unittest options]
"""
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = None

SMALL = """
title = "small block"
[grid]
origin = [0, 0]
size = [8, 8]
cell = 1
[time]
steps = 10
step = 0.001
[[material]]
name = "soft"
law = "elastic_small_strain"
E = 100
nu = 0.3
density = 1
[[body]]
name = "block"
material = "soft"
shape = { kind = "rectangle", low = [3, 3], high = [5, 5] }
velocity = [1, 0]
[output]
every_steps = 5
history_steps = 1
full_precision = true
[[expect]]
name = "momentum"
column = "momentum_x"
value = 4
tolerance = 1e-12
source = "mass 4 kg at 1 m/s"
"""

WALLS = """
[[rigid]]
name = "tool"
shape = { kind = "disk", centre = [6.5, 6.5], radius = 0.6 }
velocity = [0, -1]
[[wall]]
name = "floor"
point = [0, 2.9]
normal = [0, 1]
"""

NOTCHED = """
title = "notched plate"
[grid]
origin = [0, 0]
size = [24, 28]
cell = 1
[time]
steps = 40
[[material]]
name = "soft"
law = "elastic_small_strain"
E = 100
nu = 0.3
density = 1
[[body]]
name = "plate"
material = "soft"
shape = { kind = "rectangle", low = [2, 2], high = [22, 26] }
initial_stress = { kind = "components", xx = 0, yy = 1, xy = 0 }
[[load]]
name = "top"
kind = "traction"
face = "y+"
value = [0, 1]
[[load]]
name = "bottom"
kind = "traction"
face = "y-"
value = [0, -1]
[[crack]]
name = "notch"
points = [[0, 16], [8, 16]]
growth = { criterion = { law = "critical_j", toughness = 0.02 }, direction = "straight" }
[[crack]]
name = "left-most flaw"
points = [[13, 10], [18, 10]]
[fracture]
[output]
every_steps = 10
history_steps = 1
"""


class CliTest(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)
        (self.folder / "small.toml").write_text(SMALL)

    def call(self, *arguments, code=0, **options):
        """Runs the program in the test's folder; returns (stdout, stderr)."""
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300, **options)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done.stdout, done.stderr

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file())

    # --- help and misspellings

    def test_help_and_version(self):
        out, _ = self.call("--help")
        for word in ("run", "validate", "init", "info", "draw", "check", "schema", "Examples:", "Exit codes"):
            self.assertIn(word, out)
        self.assertEqual(self.call("--version")[0].split()[0], "crampon")
        self.assertIn("--set", self.call("run", "--help")[0])
        self.assertIn("--help", self.call()[0])

    def test_did_you_mean(self):
        self.assertIn('did you mean "run"', self.call("rnu", "small.toml", code=2)[1])
        self.assertIn('did you mean "validate"', self.call("valdate", code=2)[1])
        self.assertIn("crampon run small.toml", self.call("small.toml", code=2)[1])
        self.assertIn('did you mean "--threads"', self.call("run", "small.toml", "--thread", "2", code=2)[1])
        self.assertIn('did you mean "crack"', self.call("init", "carck", code=2)[1])
        self.assertIn("INPUT", self.call("run", code=2)[1].upper())
        self.call("run", "small.toml", "--threads", "none", code=2)

    # --- run

    def test_run_writes_one_folder(self):
        out, err = self.call("run", "small.toml", "--threads", "1")
        self.assertIn("small.results", out)
        self.assertNotIn("\x1b", out + err)  # no colours into a pipe
        top = {path.split("/")[1] for path in self.files() if path.startswith("small.results/")}
        self.assertEqual(top, {"particles.pvd", "particles", "history.csv", "input.resolved.toml", "input.original.toml", "run.json"})
        self.assertEqual({path.split("/")[0] for path in self.files()}, {"small.toml", "small.results"})
        self.assertEqual((self.folder / "small.results/input.original.toml").read_text(), SMALL)
        record = json.loads((self.folder / "small.results/run.json").read_text())
        self.assertEqual((record["status"], record["steps"], record["particles"], record["threads"]), ("finished", 10, 16, 1))
        rows = (self.folder / "small.results/history.csv").read_text().splitlines()
        self.assertEqual(len(rows), 12)  # header, start, ten steps
        self.assertTrue(rows[0].startswith("time[s],"))

    def test_existing_results_are_refused_and_forced(self):
        self.call("run", "small.toml", "--quiet")
        before = (self.folder / "small.results/run.json").read_text()
        self.assertIn("--force", self.call("run", "small.toml", "--set", "time.steps=3", code=2)[1])
        self.assertEqual((self.folder / "small.results/run.json").read_text(), before)
        self.call("run", "small.toml", "--set", "time.steps=3", "--force")
        self.assertEqual(json.loads((self.folder / "small.results/run.json").read_text())["steps"], 3)

    def test_force_costs_nothing_that_is_not_replaced(self):
        self.call("run", "small.toml", "--quiet")
        self.call("draw", "small.results", "-o", "small.results/pictures")
        mine = self.folder / "small.results/pictures/mine.png"
        mine.write_bytes(b"\x89PNG of a camera, which is longer than the mark of a picture that was drawn by the program")
        before = self.files()
        # What keeps the new run from starting: a wrong input, memory, a disk that is full.
        self.call("run", "small.toml", "--force", "--set", "time.steps=0", code=2)
        self.call("run", "small.toml", "--force", "--set", "grid.cell=1e-8", "--set", "time.step=1e-12", code=2)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        self.call("run", "small.toml", "--force", code=4, preexec_fn=limit)
        self.assertEqual(self.files(), before)
        self.call("check", "small.results")
        self.call("run", "small.toml", "--force", "--quiet")
        self.assertTrue(mine.exists())
        self.assertEqual([path.name for path in mine.parent.iterdir()], ["mine.png"])

    def test_a_missed_expectation_is_an_error(self):
        wrong = ("--set", "body[0].velocity=[2, 0]")
        out, err = self.call("run", "small.toml", *wrong, code=1)
        self.assertIn("MISSED", out)
        self.assertIn("1 of 1 expected numbers missed", err)
        out, err = self.call("run", "small.toml", *wrong, "--force", "--quiet", code=1)
        self.assertEqual(out, "")
        self.assertIn("crampon check small.results", err)
        out, _ = self.call("run", "small.toml", *wrong, "--force", "--no-check")
        self.assertNotIn("verdict", out)
        self.call("run", "small.toml", *wrong, "--force", "--steps", "5")  # shortened: nothing is judged

    def test_more_particles_or_cells_than_memory_are_refused_at_once(self):
        for settings, words in ((("grid.cell=1e-6", "time.step=1e-12"), ('"block" comes to about 1.6e+13 particles', "wrong.toml:19:1")),
                                (("grid.size=[8e6, 8e6]",), ("the grid has 6.4e+13 cells", "wrong.toml:6:1"))):
            start = time.monotonic()
            self.refused(SMALL, *words, "GB are free", arguments=[word for s in settings for word in ("--set", s)])
            self.assertLess(time.monotonic() - start, 2)  # of two calls

    def test_threads_beyond_the_cores(self):
        cores = len(os.sched_getaffinity(0))
        out, _ = self.call("run", "small.toml", "-j", "4000")
        self.assertIn("note: 4000 threads are asked for (--threads)", out)
        self.assertEqual(json.loads((self.folder / "small.results/run.json").read_text())["threads"], cores)
        self.assertIn("4000 threads", self.call("validate", "small.toml", "-j", "4000")[0])
        out, _ = self.call("run", "small.toml", "-f", env={**os.environ, "OMP_NUM_THREADS": "500"})
        self.assertIn("500 threads are asked for (OMP_NUM_THREADS)", out)
        self.assertNotIn("note", self.call("run", "small.toml", "-f", "-j", "1")[0])

    # --- notes

    def test_notes_are_told_before_the_run_and_kept(self):
        law = ("--set", 'contact.default="frictionless"')
        said = "contact.default: default has no effect (there is nothing that the body"
        out, _ = self.call("validate", "small.toml", *law)
        self.assertIn("note: --set contact.default", out)
        self.assertIn(said, out)
        self.assertIn("small.toml: valid, with 1 note", out)
        out, _ = self.call("run", "small.toml", *law)
        self.assertLess(out.index(said), out.index("finished"))
        self.assertEqual(out.count(said), 1)
        self.assertIn(said, self.call("info", "small.results")[0])

    def test_a_problem_that_would_stop_is_not_called_valid(self):
        out, err = self.call("validate", "small.toml", "--set", "time.step=100", "--set", "time.steps=5", code=3)
        self.assertNotIn("valid\n", out)
        self.assertIn("would stop", err)

    def test_quiet_says_nothing(self):
        self.assertEqual(self.call("run", "small.toml", "--quiet", "-o", "elsewhere/deep"), ("", ""))
        self.assertTrue((self.folder / "elsewhere/deep/run.json").exists())

    def test_set_changes_entries_one_at_a_time(self):
        self.call("run", "small.toml", "-q", "--set", "time.steps=4", "--set", "body[0].velocity=[2, 0]", "-o", "out", "--no-check")
        self.assertEqual(json.loads((self.folder / "out/run.json").read_text())["steps"], 4)
        out, _ = self.call("check", "out", code=1)
        self.assertIn("MISSED", out)
        self.assertIn("8", out)  # the momentum with the doubled velocity

    def test_resolved_input_gives_the_same_run(self):
        self.call("run", "small.toml", "-q")
        self.call("run", "small.results/input.resolved.toml", "-q", "-o", "again")
        self.assertEqual(self.call("info", "small.results", "--hash"), self.call("info", "again", "--hash"))

    def test_same_bits_for_any_number_of_threads(self):
        hashes = set()
        for threads in ("1", "2", "3"):
            self.call("run", "small.toml", "-q", "-j", threads, "-o", "out" + threads)
            hashes.add(self.call("info", "out" + threads, "--hash")[0])
        self.assertEqual(len(hashes), 1)

    # --- wrong inputs

    def refused(self, text, *parts, arguments=()):
        (self.folder / "wrong.toml").write_text(text)
        before = self.files()
        for subcommand in ("run", "validate"):
            _, err = self.call(subcommand, "wrong.toml", *arguments, code=2)
            for part in parts:
                self.assertIn(part, err)
        self.assertEqual(self.files(), before)  # nothing was written
        return err

    def test_all_errors_of_a_file_at_once_with_their_places(self):
        text = SMALL.replace("nu = 0.3", "mu = 0.3").replace("density = 1", "density = -1").replace("cell = 1", 'cell = "1 kg"')
        err = self.refused(text, "wrong.toml:6:", "wrong.toml:14:", "wrong.toml:15:", 'did you mean "nu"')
        self.assertIn("nothing was written", err)

    def test_wrong_inputs(self):
        self.refused("title = ", "wrong.toml:1:")
        self.refused(SMALL.replace("high = [5, 5]", "high = [50, 5]"), "wrong.toml:")  # particles outside the grid
        self.refused(SMALL.replace('"momentum_x"', '"momentum_xx"'), "wrong.toml:", 'did you mean "momentum_x"')
        self.refused(SMALL + "quantity = 3\n", "wrong.toml:")
        self.refused(SMALL.replace("every_steps = 5", "every = 1e-9"), "every_steps")
        self.refused(SMALL, "time", arguments=("--set", "time.stepz=3"))

    def test_missing_input(self):
        _, err = self.call("run", "nowhere.toml", code=2)
        self.assertIn("nowhere.toml", err)

    # --- runs that do not end well

    def test_a_stopped_run_keeps_its_good_frames(self):
        # The block flies out of the grid after 3 of 20 s.
        out, err = self.call("run", "small.toml", "--set", "time.steps=20000", code=3)
        self.assertIn("stopped", err)
        self.assertIn("particle", err)
        record = json.loads((self.folder / "small.results/run.json").read_text())
        self.assertTrue(record["status"].startswith("stopped: "))
        self.call("draw", "small.results", "--quantity", "velocity", "--frame", "1")
        self.call("info", "small.results")
        self.assertIn("NOT REACHED", self.call("check", "small.results", code=1)[0])

    def test_interrupt_ends_in_order(self):
        settings = ["--set", "time.steps=1000000000", "--set", "body[0].velocity=[0, 0]", "--set", "output.every_steps=1000000"]
        for number in (signal.SIGINT, signal.SIGTERM):
            name = f"out{int(number)}"
            process = subprocess.Popen([PROGRAM, "run", "small.toml", "-o", name, *settings], cwd=self.folder, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            history = self.folder / name / "history.csv"
            deadline = time.monotonic() + 60
            while not (history.exists() and history.stat().st_size > 2000) and time.monotonic() < deadline:
                time.sleep(0.01)
            process.send_signal(number)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130, err)
            record = json.loads((self.folder / name / "run.json").read_text())
            self.assertEqual(record["status"], "interrupted")
            self.assertIn(f"{record['end_time_s']:.4g}"[:3], err)
            frames = sorted((self.folder / name / "particles").iterdir())
            self.assertEqual(len(frames), 2)

    def test_full_disk_is_a_system_error_without_half_files(self):
        # Files may not grow beyond 3000 bytes: the history fails while the run goes on.
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
        _, err = self.call("run", "small.toml", "--set", "time.steps=1000", code=4, preexec_fn=limit)
        self.assertIn("small.results", err)
        self.assertIn("cannot write", err)
        self.assertEqual([name for name in self.files() if name.endswith(".partial")], [])
        rows = (self.folder / "small.results/history.csv").read_text()
        self.assertTrue(rows.endswith("\n"))
        self.assertTrue(json.loads((self.folder / "small.results/run.json").read_text())["status"].startswith("stopped: "))

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_no_permission(self):
        (self.folder / "locked").mkdir(mode=0o500)
        self.assertIn("locked", self.call("run", "small.toml", "-o", "locked/out", code=4)[1])

    # --- results

    def test_check_info_draw(self):
        self.call("run", "small.toml", "-q")
        out, _ = self.call("check", "small.results")
        self.assertIn("momentum", out)
        self.assertIn("mass 4 kg", out)
        out, _ = self.call("info", "small.results")
        for word in ("small block", "finished", "16", "history.csv", "momentum_x", "time by phase"):
            self.assertIn(word, out)
        self.assertRegex(self.call("info", "small.results", "--hash")[0], r"^[0-9a-f]{16}\n$")
        pictures = {
            (): 1,
            ("--quantity", "stress_xx", "--range", "-5 Pa", "5 Pa", "-o", "a.png"): 1,
            ("--all", "--quantity", "velocity_x", "-o", "several"): 3,
            ("--panel", "1x2", "--fringes", "-o", "b.png"): 1,
            ("--time", "5 ms", "--magnify", "2", "--palette", "grey", "-o", "c.png"): 1,
            ("--frame", "-1", "--window", "3", "5", "3", "5", "-o", "d.png"): 1,
            ("--history", "kinetic_energy", "momentum_x", "-o", "plot.png"): 1,
            ("--history", "power [W] = 2*kinetic_energy/(time + 1)", "--against", "twice [s] = 2*time", "-o", "power.png"): 1,
            ("--profile", "x", "--quantity", "velocity_x", "--window", "3", "5", "3", "5", "--mean", "--over", "line = 2*x + t",
             "-o", "profile.png"): 1,
            ("--profile", "y", "--all", "--quantity", "stress_yy", "-o", "profiles.png"): 1,
        }
        for arguments, count in pictures.items():
            out, _ = self.call("draw", "small.results", *arguments)
            made = out.split()
            self.assertEqual(len(made), count, arguments)
            for file in made:
                self.assertEqual((self.folder / file).read_bytes()[:4], b"\x89PNG", arguments)

    def test_draw_ignores_no_option_in_silence(self):
        self.call("run", "small.toml", "-q")
        history = ("--history", "kinetic_energy")
        profile = ("--profile", "x", "--quantity", "velocity_x")
        for arguments, words in (((*history, "--time", "5 ms"), "--time has no effect on a plot of histories"),
                                 ((*history, "--panel", "1x2"), "--panel has no effect on a plot of histories"),
                                 ((*history, "--quantity", "velocity"), "--quantity has no effect on a plot of histories"),
                                 ((*history, "--frame", "0"), "--frame"), ((*history, "--all"), "--all"),
                                 ((*history, "--range", "0", "1"), "--window"), ((*history, "--magnify", "3"), "--magnify"),
                                 ((*history, "--palette", "grey"), "--palette"), ((*history, "--symmetric"), "--symmetric"),
                                 ((*history, "--fringes"), "--fringes"), ((*profile, "--panel", "1x2"), "--panel has no effect on a profile"),
                                 ((*profile, "--magnify", "3"), "--magnify"), ((*profile, "--palette", "grey"), "--palette"),
                                 ((*profile, "--range", "0", "1"), "--window"), ((*profile, "--compare", "small.results"), "--compare"),
                                 (("--profile", "z", "--quantity", "velocity_x"), "in the plane"),
                                 (("--fringe-constant", "0.1"), "--fringes"), (("--compare", "small.results"), "--history"),
                                 (("--all", "-o", "a.png"), "a.png: a file is named for 3 pictures"),
                                 (("--frame", "0", "1", "-o", "a.png"), "2 pictures"), (("--all", "--panel", "1x2"), "no room for 3 frames"),
                                 (("--fringes", "--quantity", "velocity"), "both given")):
            self.assertIn(words, self.call("draw", "small.results", *arguments, code=2)[1], arguments)
        for option in (("--range", "0", "1"), ("--symmetric",), ("--palette", "grey")):  # of numbers that are names
            self.assertIn(f"{option[0]} has no effect on", self.call("draw", "small.results", "--quantity", "body", *option, code=2)[1])
        self.assertIn("names", self.call("draw", "small.results", "--profile", "x", "--quantity", "body", code=2)[1])
        self.assertFalse((self.folder / "a.png").exists())
        # A name without an extension is a folder, for one picture too.
        for arguments in (("--frame", "1"), ("--panel", "1x2"), history, profile):
            made, _ = self.call("draw", "small.results", *arguments, "-o", "into")
            self.assertTrue(made.startswith("into/") and made.endswith(".png\n"), made)

    def test_draw_of_walls_and_tools(self):
        (self.folder / "flat.toml").write_text(SMALL + WALLS)
        self.call("run", "flat.toml", "-q")
        for arguments in (("--quantity", "body"), ("--all",), ("--panel", "1x3"), ("--magnify", "3"), ("--profile", "x"), ("--quantity", "velocity_y")):
            out, err = self.call("draw", "flat.results", *arguments)
            self.assertEqual(err, "", arguments)
            self.assertTrue(out.endswith(".png\n"))
        # Results whose input this program cannot read are drawn all the same, and it says what is missing.
        resolved = self.folder / "flat.results/input.resolved.toml"
        resolved.write_text("future = true\n" + resolved.read_text())
        self.assertIn("walls and the shapes of rigid bodies are not drawn", self.call("draw", "flat.results")[1])

    def test_tips_of_cracks(self):
        (self.folder / "notched.toml").write_text(NOTCHED)
        self.assertIn('end of "notch", start of "left-most flaw", end of "left-most flaw"', self.call("validate", "notched.toml")[0])
        self.call("run", "notched.toml", "-q")
        out, _ = self.call("info", "notched.results")
        table = out[out.index("tips of cracks at t = "):].splitlines()
        for word in ("crack", "end", "x [m]", "grown [m]", "status", "J [J/m2]", "K_II [Pa m^(1/2)]"):
            self.assertIn(word, table[1])
        self.assertEqual(len(table), 5)
        notch = table[2].split()
        self.assertEqual((notch[0], notch[1], notch[5]), ("notch", "end", "grows"))
        # The tip began at x = 8 m and runs straight on; strain of a hundredth moves it less than a tenth.
        self.assertAlmostEqual(float(notch[2]), 8 + float(notch[4]), delta=0.1)
        self.assertGreater(float(notch[4]), 0)
        self.assertGreater(float(notch[6]), 0)
        self.assertRegex(table[3], r"^    left-most flaw  start .* 0  waits ")
        # The small block has no crack, and the notch without [fracture] no tips that are known.
        self.call("run", "small.toml", "-q")
        self.assertNotIn("tips", self.call("info", "small.results")[0])
        (self.folder / "plain.toml").write_text(NOTCHED.replace("[fracture]", "").replace("growth", "# growth"))
        self.call("run", "plain.toml", "-q", "--steps", "2")
        self.assertNotIn("tips", self.call("info", "plain.results")[0])
        self.assertIn("tell of no tips", self.call("draw", "plain.results", "--tip-names", code=2)[1])
        for arguments in (("--tip-names", "--magnify", "5"), ("--all", "--tip-names"), ("--panel", "1x2"), ("--history", "J", "K_I", "crack_length"),
                          ("--history", "J", "--against", "crack_length"), ("--history", "J.notch.end", "--against", "grown.notch.end"),
                          ("--history", "sum [J/m2] = J.notch.end + J.left-most flaw.end"), ("--history", "J", "--compare", "notched.results")):
            out, err = self.call("draw", "notched.results", *arguments)
            self.assertEqual(err, "", arguments)
            self.assertTrue(out.endswith(".png\n"))
        for arguments, words in ((("--history", "J.noch.end"), 'did you mean "J.notch.end"'), (("--history", "a = 2*J.noch.end"), 'did you mean "J.notch.end"'),
                                 (("--history", "J.end"), "choose from: J.notch.end, J.left-most flaw.start, J.left-most flaw.end"),
                                 (("--history", "crack_lenght"), 'did you mean "crack_length"'),
                                 (("--history", "total_energy", "--against", "crack_length"), "belongs to none of crack_length.notch"),
                                 (("--history", "J", "--tip-names"), "--tip-names has no effect on a plot of histories")):
            self.assertIn(words, self.call("draw", "notched.results", *arguments, code=2)[1], arguments)

    def test_draw_says_what_is_wrong(self):
        self.call("run", "small.toml", "-q")
        self.assertIn('did you mean "velocity"', self.call("draw", "small.results", "--quantity", "velocty", code=2)[1])
        self.assertIn('did you mean "momentum_x"', self.call("draw", "small.results", "--history", "momentum_xx", code=2)[1])
        self.assertIn("3 frames", self.call("draw", "small.results", "--frame", "7", code=2)[1])
        self.assertIn("2x3", self.call("draw", "small.results", "--panel", "two", code=2)[1])
        self.call("draw", "small.results", "--time", "5 kg", code=2)
        for arguments, word in ((("--history", "a [J] = 2*tame"), '"tame"'), (("--history", "a [mm] = 2*time"), "SI"),
                                (("--history", "time = 2"), "another name"), (("--history", "= 2"), "no name"),
                                (("--against", "time"), "--history"), (("--over", "a = x"), "--profile"), (("--profile", "r"), "x,y,z"),
                                (("--profile", "x", "--quantity", "velocity", "--over", "x"), "label = formula"),
                                (("--profile", "x", "--quantity", "velocity", "--over", "a = y"), '"y"'),
                                (("--profile", "x", "--quantity", "velocity", "--window", "90", "91", "90", "91"), "nothing to plot")):
            self.assertIn(word, self.call("draw", "small.results", *arguments, code=2)[1])
        self.assertIn("nowhere", self.call("draw", "nowhere", code=4)[1])
        self.assertIn("nowhere", self.call("check", "nowhere", code=4)[1])
        self.assertIn("nowhere", self.call("info", "nowhere", code=4)[1])

    def test_partial_check_of_a_shortened_run(self):
        self.call("run", "small.toml", "-q", "--steps", "5")
        self.assertEqual(json.loads((self.folder / "small.results/run.json").read_text())["status"], "shortened")
        self.call("check", "small.results", code=1)
        self.call("check", "small.results", "--partial")

    def test_damaged_results_are_told(self):
        self.call("run", "small.toml", "-q")
        frame = self.folder / "small.results/particles/particles_000002.vtp"
        data = bytearray(frame.read_bytes())
        data[len(data) // 2] ^= 1
        frame.write_bytes(data)
        self.assertIn("particles_000002.vtp", self.call("draw", "small.results", code=4)[1])

    # --- templates, schema, reference

    def test_init(self):
        out, _ = self.call("init")
        names = [line.split()[0] for line in out.splitlines() if line.startswith("  ")]
        self.assertEqual(names, ["bar3d", "beam", "block", "collision", "crack"])
        for name in names:
            self.call("init", name)
            self.assertIn("valid", self.call("validate", name + ".toml")[0])
            self.assertEqual(self.call("init", name, "-o", "-")[0], (self.folder / (name + ".toml")).read_text())
            self.call("run", name + ".toml", "-q", "--steps", "20")
            self.call("check", name + ".results", "--partial")
        self.assertIn("--force", self.call("init", "block", code=2)[1])
        self.call("init", "block", "--force")

    def test_every_example_runs_for_a_few_steps(self):
        inputs = sorted((pathlib.Path(__file__).resolve().parent.parent / "examples").rglob("*.toml"))
        self.assertTrue(inputs)
        for path in inputs:
            with self.subTest(path.name):
                results = path.parent.name + "-" + path.stem
                self.call("run", str(path), "-q", "--steps", "20", "-o", results)
                self.call("check", results, "--partial")

    def test_bodies_have_names_in_frames(self):
        self.call("run", "small.toml", "-q")
        frame = (self.folder / "small.results/particles/particles_000000.vtp").read_bytes()
        self.assertIn(b"body_names", frame)

    def test_hash_is_of_what_is_on_disk(self):
        self.call("run", "small.toml", "-q")
        self.call("run", "small.toml", "-q", "-o", "again")
        before = self.call("info", "again", "--hash")[0]
        self.assertEqual(self.call("info", "small.results", "--hash")[0], before)
        record = self.folder / "again/run.json"
        record.write_text(record.read_text().replace('"state_hash": "', '"state_hash": "0'))
        self.assertEqual(self.call("info", "again", "--hash")[0], before)
        last = self.folder / "again/particles/particles_000002.vtp"
        last.write_bytes((self.folder / "again/particles/particles_000001.vtp").read_bytes())
        self.assertNotEqual(self.call("info", "again", "--hash")[0], before)

    def test_schema_and_reference(self):
        self.assertIn("`energy_closure`", self.call("quantities")[0])
        schema = json.loads(self.call("schema")[0])
        self.assertIn("grid", schema["properties"])
        self.assertIn("particles_per_cell", self.call("reference")[0])

    def test_validate_tells_what_would_run(self):
        before = self.files()
        out, _ = self.call("validate", "small.toml")
        for word in ("valid", "particles", "16", "steps", "10", "memory", "expected time"):
            self.assertIn(word, out)
        self.assertEqual(self.files(), before)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
