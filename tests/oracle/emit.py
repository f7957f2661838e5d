"""A case of the oracle as a Crampon input: <name>.toml and a CSV of particles per body."""
import csv
import os


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"%s"' % value
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join("%s = %s" % (k, toml(v)) for k, v in value.items()) + " }"
    return repr(value)


def formula(value):
    """A function of time and place as the input writes it."""
    if isinstance(value, (list, tuple)):
        return [formula(v) for v in value]
    return {"expression": value} if isinstance(value, str) else value


def table(header, entries):
    return ["", header] + ["%s = %s" % (k, toml(v)) for k, v in entries.items()]


def rectangle(spec):
    return {"kind": "rectangle", "low": spec["low"], "high": spec["high"]}


def emit(case, folder):
    """Writes <name>.toml and its particle files into folder; returns the path of the input."""
    os.makedirs(folder, exist_ok=True)
    lines = ["title = %s" % toml(case["name"]), "analysis = %s" % toml(case.get("analysis", "plane_strain"))]
    grid = case["grid"]
    lines += table("[grid]", {"origin": grid["origin"], "size": grid["size"], "cell": grid["cell"]})
    lines += table("[time]", {"steps": case["steps"], "step": case["dt"]})
    lines += table("[method]", {
        "stress_update": case.get("stress_update", "usavg"), "positions": case.get("positions", "strain"),
        "shape_functions": case.get("shape", "linear"),
        "damping": formula(case.get("damping", 0.0)), "body_force": formula(case.get("body_force", (0.0, 0.0))),
        "boundary_order": case.get("order", "contact_first"), "fixed_force": case.get("fixed_force", "incremental")})
    lines += table("[contact]", dict({"reference_volume": "cell"}, **case.get("contact", {})))
    for name, spec in case["materials"].items():
        lines += table("[[material]]", dict({"name": name}, **spec))
    for i, body in enumerate(case["bodies"]):
        file = "%s_%d.csv" % (case["name"], i)
        with open(os.path.join(folder, file), "w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow(["x", "y", "volume", "vx", "vy"])
            writer.writerows([repr(v) for v in row] for row in body["particles"])
        lines += table("[[body]]", {"name": "body%d" % i, "material": body["material"], "particles": file,
                                    "particles_per_cell": [case.get("ppc", 2)], "thickness": body.get("thickness", 1.0)})
    for i, crack in enumerate(case.get("cracks", [])):
        contact = {"law": crack["law"]}
        if "friction" in crack:
            contact["friction"] = crack["friction"]
        lines += table("[[crack]]", {"name": "crack%d" % i, "points": crack["points"], "max_segment": 1000.0,
                                     "fixed": crack.get("fixed", False), "contact": contact})
    for i, b in enumerate(case.get("boundaries", [])):
        lines += table("[[boundary]]", dict({"name": "boundary%d" % i, "region": rectangle(b)},
                                            **{key: formula(b[key]) for key in ("vx", "vy", "start", "end") if key in b}))
    for i, s in enumerate(case.get("symmetries", [])):
        entries = {"name": "plane%d" % i, "axis": "xy"[s["axis"]], "at": s["at"], "side": "above" if s.get("side", 1) > 0 else "below"}
        for key, name in (("low", "from"), ("high", "to")):
            if key in s:
                entries[name] = [0.0, s[key]] if s["axis"] == 0 else [s[key], 0.0]
        lines += table("[[symmetry]]", entries)
    for i, load in enumerate(case.get("loads", [])):
        lines += table("[[load]]", {"name": "load%d" % i, "kind": load["kind"], "region": rectangle(load), "value": formula(load["value"])})
    plastic = ["plastic_strain"] if any(spec["law"] == "j2_plasticity" for spec in case["materials"].values()) else []
    lines += table("[output]", {"every_steps": 1, "full_precision": True,
                                "quantities": ["velocity", "stress", "displacement"] + plastic})
    target = os.path.join(folder, case["name"] + ".toml")
    with open(target, "w") as stream:
        stream.write("\n".join(lines) + "\n")
    return target
