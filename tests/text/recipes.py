# Do the files that CONTRIBUTING shows compile? recipes.py SOURCE FOLDER COMPILER writes them into FOLDER, with registries that have
# their entries, and has the compiler check each one.
import os
import re
import subprocess
import sys

# Where headers are looked up, after FOLDER/include.
INCLUDE = ("include", "src", "src/core", "src/render", "src/scene", "src/scene/builtin", "tests", "tests/core", "tests/render", "src/stress",
           "src/stress/filter")


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    source, folder, compiler = sys.argv[1:4]
    with open(os.path.join(source, "CONTRIBUTING.md"), encoding="utf-8") as file:
        text = file.read()
    for path, line in re.findall(r"^Append to `([\w./]+\.def)`:\n\n```cpp\n(.*?)```", text, re.M | re.S):
        with open(os.path.join(source, path), encoding="utf-8") as file:
            write(os.path.join(folder, path), file.read() + line)
    files = re.findall(r"^Create `([\w./]+\.cpp)`:\n\n```cpp\n(.*?)```", text, re.M | re.S)
    if len(files) < 9:
        sys.exit("CONTRIBUTING shows %d files only: is the pattern right?" % len(files))
    command = [compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I" + os.path.join(folder, "include")]
    command += ["-I" + os.path.join(source, path) for path in INCLUDE]
    failed = []
    for path, code in files:
        write(os.path.join(folder, path), code)
        if subprocess.run(command + [os.path.join(folder, path)]).returncode != 0:
            failed.append(path)
    if failed:
        sys.exit("CONTRIBUTING shows what does not compile: " + ", ".join(failed))
    print("%d files compile" % len(files))


if __name__ == "__main__":
    main()
