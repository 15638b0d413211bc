"""Do the schemas name each key that the readers know, and take the files that the program takes, and no others?

    schema_test.py PROJECT GNOMON [--values]   --values: tries values beyond the ends of every key, and no files
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed")
    sys.exit(77)

project, program, tries_values = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], "--values" in sys.argv[3:]
shared = project.parent / "shared"


def printed(name):
    run = subprocess.run([program, "schema", name], capture_output=True, text=True, check=True)
    schema = json.loads(run.stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    return schema


schemas = {name: printed(name) for name in ("case", "path", "state", "capture")}
assert schemas["capture"] == json.loads((project / "docs/captures/capture.schema.json").read_text())
for name, schema in schemas.items():
    assert not re.search(r'"\$(shared|names|plan_fields)"', json.dumps(schema)), f"{name}: a placeholder is left"


def follows(name, value):
    return jsonschema.Draft202012Validator(schemas[name]).is_valid(value)


def first_error(name, value):
    return next(iter(jsonschema.Draft202012Validator(schemas[name]).iter_errors(value)), None)


work = tempfile.TemporaryDirectory()


def error_of(name, value):
    """What the reader of the kind says to it; empty where it takes it. What is wrong with a plan is no matter of files."""
    file = pathlib.Path(work.name) / "tried.json"
    file.write_text(json.dumps(value))
    # Each ends before anything is drawn: by the file, or by what follows it.
    command = {"case": [program, "plan", file], "path": [program, "view", "builtin:fence", "--path", file, "--out", "/none/a.png"],
               "state": [program, "view", "--state", file, "--out", "/none/a.png"]}[name]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode in (0, 2), (command, run)
    if run.returncode == 0 or "--out" in run.stderr or '"status":"invalid_input"' in run.stdout:
        return ""
    assert run.stderr.count("\n") == 1, run.stderr
    return run.stderr


# The keys that the sources of each reader list.
def keys_in(files, pattern):
    found = set()
    for file in files:
        for match in re.findall(pattern, (project / file).read_text(), re.S):
            found.update(re.findall(r'"(\w+)"', match))
    return found


def keys_of(schema):
    keys = set()
    if isinstance(schema, dict):
        keys.update(schema.get("properties", {}))
        for value in schema.values():
            keys |= keys_of(value)
    elif isinstance(schema, list):
        for value in schema:
            keys |= keys_of(value)
    return keys


case_sources = ["src/casefile/casefile.cpp", "src/casefile/shared_fields.cpp"]
known = {
    "case": keys_in(case_sources, r"Fields \w+\(\s*[^;]*?\{([^}]*)\}\)") | keys_in(case_sources, r"keys\(\{([^}]*)\}\)")
    | keys_in(case_sources, r'known\.push_back\(("\w+")\)') | keys_in(case_sources, r"kOtherNames\{\s*\{(.*?)\};")
    | keys_in(["src/casefile/plan_fields.cpp"], r'\n      \{("\w+"),')
    | keys_in(case_sources, r"light_from\([^;]*?\{([^}]*)\}\)") | keys_in(["src/casefile/json_fields.cpp"], r"Fields \w+\([^;]*?\{([^}]*)\}\)"),
    "path": keys_in(["src/scene/camera_path_file.cpp"], r"refuse_unknown\([^;]*?\{([^}]*)\}\)"),
    "state": keys_in(["src/tool/view/state_text.cpp"], r'(?:read|read_name|take|read_key|read_keys)\((?:reader, )?("\w+")')
    | {"gnomon_view"},
}
assert len(known["case"]) > 80 and len(known["path"]) == 9 and len(known["state"]) > 60, {k: len(v) for k, v in known.items()}
for name, keys in known.items():
    missing = keys - keys_of(schemas[name])
    assert not missing, f"gnomon schema {name} lacks {sorted(missing)}"

def no_json(constant):
    raise ValueError(f"{constant} is no number of JSON")


# The examples of the page, and all files of each kind.
page = (project / "docs/files.md").read_text()
examples = {}
for name in ("case", "path", "state"):
    text = re.search(rf"\(`gnomon schema {name}`\).*?```json\n(.*?)```", page, re.S)
    assert text, f"docs/files.md shows no {name}"
    examples[name] = json.loads(text.group(1))
files = {"case": [], "path": [], "state": []}
folders = [project / "tests/data/cases", project / "tests/data/stress_random", project / "tests/fuzz/seeds/plan", project / "samples"]
if shared.is_dir():
    folders += [shared / "cases", shared / "reports"]
else:
    print("../shared is not there: its files are not checked")
for folder in folders:
    for file in sorted(folder.rglob("*")):
        if file.is_file() and (file.suffix == ".json" or file.parent.name == "plan"):
            try:
                value = json.loads(file.read_text(), parse_constant=no_json)
            except ValueError:
                continue
            if isinstance(value, dict) and "camera" in value and "format" not in value:
                files["case"].append((file, value))
files["path"] = [(file, json.loads(file.read_text())) for file in sorted((project / "tests/fuzz/seeds/camera_path").glob("*.json"))]
for name, value in examples.items():
    assert error_of(name, value) == "", (name, error_of(name, value))
    files[name].append(("docs/files.md", value))
counts = {name: len(each) for name, each in files.items()}


def taken_together(cases):
    """Those that one run takes all of; none where it takes not all, so that each is tried alone and named."""
    run = subprocess.run([program, "plan", *cases], capture_output=True, text=True)
    return set(cases) if run.stdout.count("\n") == len(cases) else set()


taken = set()
if not tries_values:
    taken = taken_together([file for file, value in files["case"] if isinstance(file, pathlib.Path) and follows("case", value)])
    assert len(taken) > 50, "each would be a process of its own"
for name, each in files.items() if not tries_values else ():
    for file, value in each:
        if file in taken:
            continue
        error = error_of(name, value)
        assert follows(name, value) == (error == ""), f"{file}: {error or 'is taken'}, and the schema: {first_error(name, value)}"
if not tries_values:
    assert counts["case"] > 80 and counts["path"] >= 3, counts
    print(f"{counts} files follow their schemas")
    sys.exit(0)

# Each key of a schema is known to its reader, and values beyond its ends are refused by both.
tried = 0


def resolved(schema, root):
    while "$ref" in schema:
        at = root
        for step in schema["$ref"][2:].split("/"):
            at = at[step]
        schema = at
    return schema


def values_against(schema):
    """Values that the schema does not take: of another type, and beyond each end."""
    if "enum" in schema or "const" in schema or schema.get("type") == "boolean":
        return ["nonesuch"]
    beyond = [schema[end] + sign * max(1, abs(schema[end])) for end, sign in (("minimum", -1), ("maximum", 1)) if end in schema]
    return beyond + [[["deep"]]]


def with_keys(whole, place, keys):
    changed = copy.deepcopy(whole)
    at = changed
    for step in place:
        at = at.setdefault(step, {})
    at.update({key: value for key, value in keys.items() if key not in at or value is not None})
    return changed


def try_keys(name, whole, place, schema):
    """Every key of the object at `place` in `whole`."""
    global tried
    root = schemas[name]
    properties = resolved(schema, root).get("properties", {})
    # Readers that take no null say so after they know the key. The type of a light decides which of its keys they know.
    error = error_of(name, with_keys(whole, place, {key: None for key in properties}))
    assert "unknown key" not in error or (name, place) == ("case", ["light"]), (name, place, error)
    unknown = with_keys(whole, place, {"nonesuch": 1})
    assert not follows(name, unknown) and "unknown key" in error_of(name, unknown), (name, place, "takes any key")
    for key, of_key in properties.items():
        of_key = resolved(of_key, root)
        for value in values_against(of_key):
            changed = with_keys(whole, place, {key: value})
            assert not follows(name, changed), (name, place, key, value)
            # Plans refuse numbers of cases, which are then read.
            if not (name == "case" and isinstance(value, (int, float))):
                assert error_of(name, changed), (name, place, key, value, "is taken")
            tried += 1
        # Cases have gone through the options already.
        if of_key.get("type") == "object" and key not in ("focus", "eye", "frozen", "b") and not (name == "state" and key == "options"):
            try_keys(name, whole, [*place, key], of_key)


for name, value in examples.items():
    try_keys(name, value, [], schemas[name])
assert tried > 150, tried
print(f"{tried} values tried")
