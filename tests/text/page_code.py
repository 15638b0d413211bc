# Does the C++ that pages show compile? page_code.py SOURCE OUT writes it into one source file, a function for each page.
# Names that a page takes for granted (camera, light, renderer ...) are those of tests/text/page_code.hpp. Later blocks of a page
# lie in the scope of earlier ones. CONTRIBUTING's blocks are files of their own (recipes.py), and shaders/README.md shows the inside of
# the renderer: neither is read.
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check


def blocks_of(text):
    """(line, code) of each block of C++."""
    for match in re.finditer(r"^```cpp\n(.*?)^```", text, re.M | re.S):
        yield text.count("\n", 0, match.start()) + 2, match.group(1)


def function_of(source, page):
    text, depth = "", 0
    for line, code in blocks_of(check.read(source, page)):
        # Headers lie above: tests/text/page_code.hpp has all of them.
        code = re.sub(r"^#include[^\n]*", "", code, flags=re.M)
        text += '{\n#line %d "%s"\n%s' % (line, os.path.join(source, page), code)
        depth += 1
    name = re.sub(r"\W", "_", page)
    return "void %s() {\n%s%s}\n" % (name, text, "}\n" * depth) if depth else ""


def main():
    source, out = sys.argv[1:3]
    pages = [page for page in check.pages_of_tree(source) if page not in ("CONTRIBUTING.md", "shaders/README.md")]
    functions = [function for function in (function_of(source, page) for page in pages) if function]
    if len(functions) < 5:
        sys.exit("only %d pages show C++: is the pattern for blocks right?" % len(functions))
    with open(out, "w", encoding="utf-8") as file:
        file.write('#include "page_code.hpp"\n\nnamespace gnomon::pages {\n%s}\n' % "".join(functions))


if __name__ == "__main__":
    main()
