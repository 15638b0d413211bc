"""Do the shipped captures, and the one that the page shows, follow the schema, and does the program read them?

    schema_test.py PROJECT GNOMON
"""
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

project, program = pathlib.Path(sys.argv[1]), sys.argv[2]
schema = json.loads((project / "docs/captures/capture.schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
captures = {file.name: json.loads(file.read_text()) for file in sorted((project / "samples/capture").rglob("*.json"))}
assert len(captures) >= 6, captures.keys()
page = (project / "docs/captures.md").read_text()
captures["docs/captures.md"] = json.loads(re.search(r"```json\n(.*?)```", page, re.S).group(1))


def taken(capture):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(capture, file)
        file.flush()
        run = subprocess.run([program, "judge", file.name, "--json"], capture_output=True, text=True)
    assert run.returncode in (0, 2), run
    assert run.returncode == 0 or run.stderr.count("\n") == 1, run
    return run.returncode == 0


for name, capture in captures.items():
    errors = list(validator.iter_errors(capture))
    assert not errors, (name, errors[0].message)
    assert taken(capture), name

# What the schema refuses, the program refuses.
sound = captures["ogre_pssm.json"]
for key, value in {"format": "gnomon-capture/2", "maps": [], "lights": [], "selection": "nearest", "matrices": "rows", "atlas": [0, 1],
                   "frames": [], "points": [[1, 2]], "depth_picture": {"width": 2, "height": 2},
                   "bias": {"depth": 2}, "receivers": [{"min": [0, 0, 0]}], "clip_space": {"ndc_depth": "one"},
                   "nonsense": 1}.items():
    broken = {**sound, key: value}
    assert list(validator.iter_errors(broken)), key
    assert not taken(broken), key
for key in ("format", "camera", "lights", "maps"):
    broken = {k: v for k, v in sound.items() if k != key}
    assert list(validator.iter_errors(broken)), key
    assert not taken(broken), key
print(f"{len(captures)} captures follow the schema")
