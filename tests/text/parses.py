# Is every Python file of the project valid Python? Most of them run in few tests, or in none of the quick ones.
# parses.py SOURCE
import ast
import os
import sys


def python_files(source):
    for folder, folders, names in os.walk(source):
        folders[:] = [name for name in folders if name not in ("build", "out", "node_modules") and not name.startswith(".")]
        yield from (os.path.join(folder, name) for name in names if name.endswith(".py"))


def main():
    files, broken = 0, 0
    for path in python_files(sys.argv[1]):
        files += 1
        try:
            with open(path, encoding="utf-8") as file:
                ast.parse(file.read(), path)
        except SyntaxError as error:
            broken += 1
            print("%s:%s: %s" % (path, error.lineno, error.msg))
    if broken or not files:
        sys.exit("%d of %d Python files are not valid" % (broken, files))


if __name__ == "__main__":
    main()
