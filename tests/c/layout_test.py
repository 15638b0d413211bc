# Do the tables of bindings say where the compiler puts the fields? layout_test.py CC WORK_DIR. Compiles for this machine, and
# with -m32's sizes of pointers only where clang-16 builds for WebAssembly.
import os
import shutil
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "bindings"))
import layout  # noqa: E402


def source(structs, pointer_bytes):
    lines = ['#include <stddef.h>', '#include "gnomon/c/gnomon.h"', "#define SAME(a, b) _Static_assert((a) == (b), #a)"]
    checks = 0
    for name, (size, _, rows) in layout.lay_out(structs, pointer_bytes).items():
        lines.append("SAME(sizeof(%s), %d);" % (name, size))
        for field, _, offset, _ in rows:
            lines.append("SAME(offsetof(%s, %s), %d);" % (name, field, offset))
            checks += 1
    return "\n".join(lines) + "\n", checks


def compiles(compiler, text, work):
    path = os.path.join(work, "layout.c")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return subprocess.run(compiler + ["-std=c11", "-I", os.path.join(ROOT, "include"), "-fsyntax-only", path], capture_output=True).returncode == 0


def main():
    compiler, work = sys.argv[1], sys.argv[2]
    os.makedirs(work, exist_ok=True)
    _, structs, _, _ = layout.read_header()
    targets = [([compiler], 8)]
    if shutil.which("clang-16") and os.path.isdir("/usr/include/wasm32-wasi"):
        targets.append((["clang-16", "--target=wasm32-wasi"], 4))
    for command, pointer_bytes in targets:
        text, checks = source(structs, pointer_bytes)
        assert checks > 250, checks
        if not compiles(command, text, work):
            sys.exit("%s puts fields elsewhere than bindings/layout.py" % " ".join(command))
        # A check that cannot fail is none.
        if compiles(command, text.replace("_Static_assert((a) == (b)", "_Static_assert((a) == (b) + 1"), work):
            sys.exit("the check itself passes anything")
    subprocess.run([sys.executable, "-B", os.path.join(ROOT, "bindings", "layout.py"), "--check"], check=True)


if __name__ == "__main__":
    main()
