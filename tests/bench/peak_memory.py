#!/usr/bin/env python3
"""How much memory does each command take at its peak? Prints a table for docs/performance.md.

peak_memory.py GNOMON SCENE [COMMAND...]: runs each command, or those named, once on the scene with the sizes of its
defaults and few frames; waits for each, and reads the most that it had resident.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

CASE = pathlib.Path(__file__).parent.parent / "data" / "cases"


def commands(scene, out):
    one = ["--frames", "1", "--rounds", "1"]
    return {
        "plan": ["plan", str(sorted(CASE.glob("*.json"))[0])],
        "stress": ["stress", "--random", "20", "--out", f"{out}/stress"],
        "fly": ["fly", scene, "--frames", "2", "--out", f"{out}/fly"],
        "fly, 60 frames": ["fly", scene, "--frames", "60", "--out", f"{out}/fly60"],
        "fly, pages": ["fly", scene, "--frames", "2", "--pages", "resolution", "--out", f"{out}/pages"],
        "view, a picture": ["view", scene, "--out", f"{out}/view.png"],
        "diff": ["diff", f"{out}/view.png", f"{out}/view.png"],
        "compare": ["compare", scene, "--filters", "hard,pcf,vsm", *one, "--out", f"{out}/compare"],
        "merge": ["merge", f"{out}/compare", "--out", f"{out}/merged"],
        "report": ["report", f"{out}/compare"],
        "accumulate": ["accumulate", scene, "--frames", "1,8"],
        "bias": ["bias", scene, "--layers", "front,dual"],
        "panes": ["panes", "builtin:glass", *one],
        "filters, fit": ["filters", "--fit", scene, "--filters", "vsm"],
        "calibrate": ["calibrate", f"{out}/compare", "--model", f"{out}/model.json"],
        "scenes": ["scenes"],
        "doctor": ["doctor"],
    }


def peak_mib(program, arguments, log):
    """The most that the process had resident, and how it ended."""
    with open(log, "wb") as sink:
        process = subprocess.Popen([program, *arguments], stdout=sink, stderr=sink, stdin=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss / 1024.0, process.returncode


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, scene, chosen = sys.argv[1], sys.argv[2], sys.argv[3:]
    failed = False
    with tempfile.TemporaryDirectory() as out:
        print("| command | peak, MiB |\n|--|--:|")
        for name, arguments in commands(scene, out).items():
            if chosen and name not in chosen:
                continue
            log = f"{out}/log"
            mib, code = peak_mib(program, arguments, log)
            print(f"| {name} | {mib:.0f} |", flush=True)
            if code != 0:
                failed = True
                print(f"{name}: exit code {code}: {pathlib.Path(log).read_text()[-300:]}", file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
