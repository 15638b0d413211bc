#!/usr/bin/env python3
"""An independent judge: what Khronos' glTF validator calls an error in indices, accessors, buffer views or the node
graph, the loader refuses or repairs with a warning; what this project writes, the validator calls valid.

    validator_test.py LOAD_SCENE_MAIN GNOMON_PROGRAM WORK_DIR SHARED_DIR

GNOMON_PROGRAM may be empty. Exits 77 (skipped) where npm, node or the registry is not there.
"""
import base64
import concurrent.futures
import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys

VERSION = "2.0.0-dev.3.10"
SKIPPED = 77
# What is judged: indices, accessors, buffer views, the node graph. Not the looks of materials, names, animations.
JUDGED = re.compile(r"^/(accessors|bufferViews|buffers|nodes|scenes|scene|meshes|skins)\b")
NOT_READ = re.compile(r"^(ACCESSOR_INVALID_IBM|MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY|MESH_PRIMITIVE_TOO_FEW_TEXCOORDS)$")


def skip(why):
    print("skipped:", why)
    sys.exit(SKIPPED)


def installed_validator(work):
    if not shutil.which("npm") or not shutil.which("node"):
        skip("no npm or no node here")
    if not (work / "node_modules/gltf-validator").is_dir():
        done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--prefix", work, f"gltf-validator@{VERSION}"],
                              capture_output=True, text=True, timeout=120)
        if done.returncode != 0:
            skip("npm cannot install gltf-validator: " + done.stderr.strip().split("\n")[-1])
    # node looks for packages beside the script.
    shutil.copy(pathlib.Path(__file__).parent / "judge.js", work / "judge.js")


def judged(work, files):
    done = subprocess.run(["node", work / "judge.js", *files], capture_output=True, text=True, timeout=300, check=True)
    return {v["file"]: v["errors"] for v in map(json.loads, done.stdout.splitlines())}


def triangle():
    data = struct.pack("<9f3H", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 2) + b"\0\0"
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "buffers": [{"byteLength": 44, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}


# One break each, by path and value.
BREAKS = {
    "whole": [],
    "accessor_beyond_view": [("accessors/0/count", 4)],
    "accessor_offset": [("accessors/1/byteOffset", 4)],
    "view_beyond_buffer": [("bufferViews/1/byteLength", 60)],
    "view_of_no_buffer": [("bufferViews/0/buffer", 3)],
    "accessor_of_no_view": [("accessors/0/bufferView", 7)],
    "indices_of_no_accessor": [("meshes/0/primitives/0/indices", 9)],
    "index_out_of_range": [("accessors/0/count", 2)],
    "float_indices": [("accessors/1/componentType", 5126), ("accessors/1/count", 1)],
    "negative_count": [("accessors/0/count", -3)],
    "stride_too_small": [("bufferViews/0/byteStride", 8)],
    "node_loop": [("nodes/0/children", [0])],
    "node_loop_of_two": [("nodes", [{"mesh": 0, "children": [1]}, {"children": [0]}])],
    "two_parents": [("nodes", [{"children": [2]}, {"children": [2]}, {"mesh": 0}]), ("scenes/0/nodes", [0, 1])],
    "node_of_no_mesh": [("nodes/0/mesh", 5)],
    "scene_of_no_node": [("scenes/0/nodes", [4])],
    "short_buffer": [("buffers/0/byteLength", 80)],
    "sparse_beyond": [("accessors/0/sparse", {"count": 9, "indices": {"bufferView": 1, "componentType": 5123},
                                              "values": {"bufferView": 0}})],
}


def generated(folder):
    files = []
    for name, changes in BREAKS.items():
        document = triangle()
        for path, value in changes:
            *way, last = path.split("/")
            at = document
            for step in way:
                at = at[int(step)] if isinstance(at, list) else at[step]
            at[int(last) if isinstance(at, list) else last] = value
        file = folder / f"{name}.gltf"
        file.write_text(json.dumps(document))
        files.append(str(file))
    return files


def loaded(loader, file):
    done = subprocess.run([loader, file], capture_output=True, text=True, errors="replace", timeout=60)
    if done.returncode == 2:
        return "refused", done.stderr.strip()
    warnings = [line for line in done.stdout.splitlines() if line.startswith("warning ")]
    return ("warned" if warnings else "taken") if done.returncode == 0 else f"exit {done.returncode}", "; ".join(warnings)


def main():
    loader, program, work, shared = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
    work.mkdir(parents=True, exist_ok=True)
    installed_validator(work)
    files = generated(work)
    broken = [str(f) for kind in ("gltf", "glb") for f in sorted((shared / "gltf-robustness").rglob(f"*.{kind}"))]
    if not broken:
        print("no shared broken files here: only generated ones are judged")
    verdicts = judged(work, files + broken)
    matter = {file: [e for e in errors if (JUDGED.match(e["at"]) or not e["at"]) and not NOT_READ.match(e["code"])]
              for file, errors in verdicts.items()}
    asked = [file for file in verdicts if matter[file] or file == files[0]]  # each a process: only those that tell
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        answers = dict(zip(asked, pool.map(lambda f: loaded(loader, f), asked)))
    failed, agreed = [], 0
    for file, (answer, words) in answers.items():
        if answer.startswith("exit") or (matter[file] and answer == "taken"):
            failed.append(f"{file}: {answer} {words}; the validator: {matter[file][:3]}")
        agreed += bool(matter[file]) and answer in ("refused", "warned")
    if answers[files[0]][0] != "taken" or verdicts[files[0]]:
        failed.append(f"{files[0]}: is whole, but {answers[files[0]]}, {verdicts[files[0]]}")
    if agreed < len(BREAKS) - 1:
        failed.append(f"only {agreed} files are broken for both: this test judges nothing")
    if program:
        scenes = json.loads(subprocess.run([program, "scenes", "--json"], capture_output=True, text=True, check=True).stdout)
        written = []
        for scene in scenes["scenes"]:
            written.append(str(work / f"{scene['name']}.glb"))
            subprocess.run([program, "scenes", "--write", scene["name"], written[-1]], check=True)
        for file, errors in judged(work, written).items():
            failed += [f"{file}: written by us: {e}" for e in errors[:3]]
        print(f"{len(written)} scenes of ours are valid" if not failed else "")
    print(f"{len(verdicts)} files judged; {agreed} broken for the validator, all of them refused or repaired with a warning"
          if not failed else "\n".join(failed))
    sys.exit(1 if failed else 0)


main()
