# Does the text that people read use the field's words, in short sentences, and is what it names there?
# check.py SOURCE [PROGRAM...] reads headers, pages, shaders, test names, and what the programs print.
import os
import re
import subprocess
import sys
import tempfile

import names
import pages
import sentences

HERE = os.path.dirname(os.path.abspath(__file__))
BEGINNINGS = re.compile(r"\b(Of|What|So far|Such)\b")
# Libraries whose strings become errors, tables and pages.
MESSAGES = ("casefile", "render", "report", "scene", "stress", "tool", "trace")
CODE_SUFFIXES = (".hpp", ".h", ".cpp", ".glsl", ".vert", ".frag", ".def", ".inc")


def read_words(path):
    words = []
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                pattern, instead = line.rstrip("\n").split("\t")
                words.append((re.compile(r"(?<![\w-])(?:" + pattern.replace(" ", r"\s+") + r")(?![\w-])", re.I), instead))
    return words


def blank(match):
    """As many characters and line ends, and no words."""
    return re.sub(r"[^\n]", " ", match.group(0))


def text_of_markdown(text):
    text = re.sub(r"```.*?```", blank, text, flags=re.S)
    text = re.sub(r"\]\([^)\s]*\)", blank, text)
    return re.sub(r"`[^`\n]*`", blank, text)


def text_of_code(text):
    """Comments, and in lists of words the strings; all else is blank."""
    out = []
    for part in re.split(r"(//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\")", text, flags=re.S):
        if part.startswith("//"):
            body = re.sub(r"^//[/!]?<?", lambda m: " " * len(m.group(0)), part)
            out.append(re.sub(r"`[^`\n]*`", blank, body))
        elif part.startswith("/*"):
            out.append("  " + part[2:-2] + "  ")
        else:
            out.append(re.sub(r"[^\n]", " ", part))
    return "".join(out)


def text_of_registry(text):
    return text_of_code(re.sub(r"\"((?:\\.|[^\"\\\n])*)\"", r"//\1", text))


def text_of_messages(text):
    """Strings with a space in them, which people may read; comments and names of files and keys are not among them."""
    out = []
    for part in re.split(r"(//[^\n]*|\"(?:\\.|[^\"\\\n])*\")", text):
        if part.startswith('"') and " " in part:
            out.append(" " + part[1:-1].replace("\\n", ". ") + " ")
        else:
            out.append(re.sub(r"[^\n]", " ", part))
    return "".join(out)


def test_names(text):
    """The names of tests and of their suites as words, each on its line."""
    lines = []
    for line in text.split("\n"):
        name = re.match(r"\s*(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP)\((\w+),\s*(\w+)", line)
        suite = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name.group(1)) if name else ""
        lines.append(suite + ", " + name.group(2).replace("_", " ") if name else "")
    return "\n".join(lines)


def files_below(source, folder, suffixes):
    for where, folders, names in os.walk(os.path.join(source, folder)):
        folders.sort()
        for name in sorted(names):
            if name.endswith(suffixes):
                yield os.path.relpath(os.path.join(where, name), source)


def pages_of_tree(source):
    found = [name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md") if os.path.exists(os.path.join(source, name))]
    for folder in ("docs", "samples", "shaders", "packaging"):
        found += files_below(source, folder, (".md",))
    return found


def read(source, name):
    with open(os.path.join(source, name), encoding="utf-8") as file:
        return file.read()


def texts_of_tree(source):
    """(name, text) of every file that people read, as text in which lines are where they are in the file."""
    readers = [(page, text_of_markdown) for page in pages_of_tree(source)]
    readers += [(name, text_of_code) for name in files_below(source, "include", (".hpp", ".h"))]
    readers += [(name, text_of_registry) for name in files_below(source, "include", (".def",))]
    for folder in ("shaders", "samples"):
        readers += [(name, text_of_code) for name in files_below(source, folder, CODE_SUFFIXES)]
    readers += [(name, test_names) for name in files_below(source, "tests", (".cpp",))]
    for library in MESSAGES:
        readers += [(name, text_of_messages) for name in files_below(source, os.path.join("src", library), (".cpp", ".js"))]
    for name, reader in readers:
        yield name, reader(read(source, name))


def printed(program, *arguments):
    result = subprocess.run([program, *arguments], capture_output=True, text=True, check=True)
    return " ".join([os.path.basename(program), *arguments]), result.stdout


def texts_of_program(program):
    name, text = printed(program, "--help")
    yield name, text
    yield printed(program, "--manual")
    commands = re.findall(r"^  ([a-z]+) ", text.split("Commands:")[1].split("Options:")[0], re.M) if "Commands:" in text else []
    for command in commands:
        if re.search(r"^  %s .*not in this build" % command, text, re.M):
            continue
        yield printed(program, command, "--help")
        yield printed(program, "--manual", command)
        if command == "filters":
            listed = printed(program, command)
            yield listed
            for one in re.findall(r"^(\w+): ", listed[1], re.M):
                yield printed(program, command, one)


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def faults_of(name, text, words):
    for pattern, instead in words:
        for match in pattern.finditer(text):
            yield (line_of(text, match.start()), "%s:%d: '%s': write %s" %
                   (name, line_of(text, match.start()), " ".join(match.group(0).split()), instead))
    # A sentence begins a paragraph, or follows the end of another one.
    for match in BEGINNINGS.finditer(text):
        before = text[:match.start()].rstrip()
        gap = text[len(before):match.start()]
        begins = not before or re.search(r"\n[ \t]*\n", gap) or (gap and before[-1] in ".;:!?")
        sentence = re.match(r"[^.?!]*[.?!]?", text[match.start():]).group(0)
        if begins and not sentence.endswith("?"):
            line = line_of(text, match.start())
            yield line, "%s:%d: a sentence begins with '%s': put the subject first" % (name, line, match.group(0))


def faults_in(texts, words):
    for name, text in texts:
        for _, fault in sorted(set(faults_of(name, text, words))):
            yield fault


def write_tree(folder, files):
    for name, text in files.items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def faults_of_pages(source):
    yield from pages.faults_of_links(source, pages_of_tree(source))
    yield from pages.faults_of_files(source, pages_of_tree(source))
    yield from pages.faults_of_folders(source)
    yield from pages.faults_of_glossary(source)
    yield from pages.faults_of_front_page(source)


def faults_of_names(source):
    """`Type::member` in comments and pages. The change log may name what is gone."""
    sources = [name for folder in ("include", "src", "samples", "shaders", "tests") for name in files_below(source, folder, CODE_SUFFIXES)]
    registries = {os.path.relpath(name, "include"): re.findall(r"\w+", names.without_comments(read(source, name)))
                  for name in sources if name.endswith(".def")}
    members = names.members_of_types([read(source, name) for name in sources], registries)
    for name in sources + [page for page in pages_of_tree(source) if page != "CHANGELOG.md"]:
        text = read(source, name)
        for line, fault in names.faults_in(text if name.endswith(".md") else names.comments_of(text), members):
            yield "%s:%d: %s" % (name, line, fault)


def faults_of_sentences(source):
    for name in files_below(source, "include", (".hpp", ".h")):
        for line, fault in sentences.faults_in(sentences.blocks_of_header(read(source, name)), sentences.LONGEST_IN_HEADERS):
            yield "%s:%d: %s" % (name, line, fault)
    for name in pages_of_tree(source):
        for line, fault in sentences.faults_in(sentences.blocks_of_page(read(source, name)), sentences.LONGEST_IN_PAGES):
            yield "%s:%d: %s" % (name, line, fault)


def faults_of_tree(source):
    yield from faults_of_pages(source)
    yield from faults_of_names(source)
    yield from faults_of_sentences(source)


def check_planted(what, planted, faults_of, expected):
    """What `faults_of` finds in a tree of these files is what is expected, by the words before a quotation."""
    with tempfile.TemporaryDirectory() as folder:
        write_tree(folder, planted)
        found = {re.sub(r": '[^:]* \.\.\.'$", "", fault) for fault in faults_of(folder)}
    if found != expected:
        sys.exit("the check of %s itself: missed %s, and found %s where nothing was" % (what, sorted(expected - found), sorted(found - expected)))


def check_pages_themselves():
    """Dead links, files that are not there, a page without a question, folders that are not named or not there, and a term twice."""
    planted = {"docs/README.md": "# Map\n[a](a.md#what-is-it-a) [b](a.md#b)\n```\n[c](c.md)\n```\n[up](../README.md)\n",
               "docs/a.md": "# What is `it`, a?\n[here](#b)\n", "docs/other.md": "# Other\nSee `src/core/warp/w.cpp` and `src/core/w.cpp`.\nCreate `src/new.cpp`:\n", "README.md": "[gone](docs/gone.md)\n",
               "docs/glossary.md": "| term | meaning |\n|--|--|\n| map | A. |\n\n| term | meaning |\n|--|--|\n| page, map | B. |\n",
               "docs/architecture.md": "`src/core` `src/core/warp` `src/core/gone` `src/render/gl`\n",
               "src/core/warp/w.cpp": "", "src/core/split/s.cpp": "", "src/render/gl/g.cpp": ""}
    check_planted("pages", planted, faults_of_pages, {
        "README.md:1: the link leads nowhere: docs/gone.md", "docs/README.md:2: docs/a.md has no heading #b",
        "docs/a.md:2: docs/a.md has no heading #b", "docs/README.md: no question leads to docs/other.md",
        "docs/README.md: no question leads to docs/architecture.md", "docs/README.md: no question leads to docs/glossary.md",
        "docs/glossary.md:7: line 3 explains 'map' already",
        "docs/other.md:2: there is no src/core/w.cpp", "docs/architecture.md:1: there is no src/core/gone", "docs/architecture.md: does not name the folder src/core/split",
        "docs/architecture.md: does not name the folder src/render"})
    check_planted("the front page", {"README.md": "word " * 901}, pages.faults_of_front_page, {"README.md: 901 words, at most 900"})


def check_names_themselves():
    """A member that is gone, and a type; not those that a base, an alias, a registry or a block of GLSL has."""
    planted = {"include/a.hpp": "#include \"g/rules.def\"\nstruct A {\n  int size;  ///< as B::size, and A::gone\n  // A::gone is no member\n};\n"
               "struct B : A {};\nusing C = B;\nenum class Rule {\n#define RULE(name) name,\n#include \"g/rules.def\"\n};\n",
               "include/g/rules.def": "RULE(first)\n", "shaders/s.glsl": "layout(std140) uniform Block {\n  vec4 eye;\n};\n",
               "src/a.cpp": "// C::size, Rule::first, Rule::second\n/* Block::eye,\n Lost::eye */ int x = A::gone;\n// CLI::Range\n",
               "docs/a.md": "Set `A::size`.\n```rust\nA::new\n```\nSet `A::length`.\n"}
    check_planted("names", planted, faults_of_names, {
        "include/a.hpp:3: 'A::gone': A has no such member", "include/a.hpp:4: 'A::gone': A has no such member",
        "src/a.cpp:1: 'Rule::second': Rule has no such member", "src/a.cpp:3: 'Lost::eye': there is no type Lost",
        "docs/a.md:5: 'A::length': A has no such member"})


def check_sentences_themselves():
    """A sentence that is one word too long, on several lines; not two that are short, nor a table or code."""
    words, longest = "word " * 20, "word " * 25
    planted = {"include/a.hpp": "/// One. %s\n/// and five more words end.\nint a;  ///< %s.\nint b;  ///< %s\n        ///< more.\n// %s more.\n" %
               (words, longest.strip(), longest, longest),
               "docs/a.md": "# A\n- item\n- %s\n  `code of many words` %s.\n\n| %s%s |\n\n```\n%s%s\n```\n%s.\n%s.\n" %
               (words, "word " * 10, words, words, words, words, longest, longest)}
    check_planted("sentences", planted, faults_of_sentences, {
        "include/a.hpp:4: a sentence of 26 words, at most 25", "docs/a.md:3: a sentence of 31 words, at most 30"})


def check_itself(words):
    """A planted word must be found in each kind of file, with its line and the word to use."""
    planted = {"README.md": "Fine.\n\nThe lamp is `rim`.\n", "docs/page.md": "```\nrim\n```\nWhat it does.\nA rim.\n",
               "include/a.hpp": "int rim;\n/// Border.\nint lamp();  ///< of a lamp\n",
               "include/w.def": "// Fine.\nWORD(rim, \"keeps maps\\n\"\n  \"laid before\")\n",
               "shaders/library/l.glsl": "float rim; // lookup\n// stands\n//  still\n",
               "src/tool/t.cpp": "// A rim.\nf(\"rim\");\nfail(\"the rim\\n\");\n", "tests/t.cpp": "// A rim.\nTEST(MapRim, border)\nTEST(Map, is_laid_once) {\n", "samples/s/README.md": "Is this right? Such maps.\n"}
    expected = {("README.md", 3, "lamp"), ("docs/page.md", 5, "rim"), ("include/a.hpp", 3, "lamp"),
                ("include/w.def", 3, "laid"), ("tests/t.cpp", 2, "Rim"), ("tests/t.cpp", 3, "laid"), ("shaders/library/l.glsl", 2, "stands still"),
                ("samples/s/README.md", 1, "Such"), ("src/tool/t.cpp", 3, "rim")}
    with tempfile.TemporaryDirectory() as folder:
        write_tree(folder, planted)
        faults = list(faults_in(texts_of_tree(folder), words))
    found = {tuple(int(g) if g.isdigit() else g for g in re.match(r"([^:]+):(\d+): [^']*'([^']+)'", f).groups()) for f in faults}
    missed, extra = expected - found, found - expected
    # `What it does.` follows a code block, not a paragraph's end of its own.
    extra.discard(("docs/page.md", 4, "What"))
    if missed or extra:
        sys.exit("the check itself: missed %s, and found %s where nothing was" % (sorted(missed), sorted(extra)))


def main():
    source, programs = sys.argv[1], sys.argv[2:]
    words = read_words(os.path.join(HERE, "words.txt"))
    check_itself(words)
    check_pages_themselves()
    check_names_themselves()
    check_sentences_themselves()
    faults = list(faults_in(texts_of_tree(source), words)) + list(faults_of_tree(source))
    for program in programs:
        faults += faults_in(texts_of_program(program), words)
    for fault in faults:
        print(fault)
    if faults:
        sys.exit("%d places; tests/text/words.txt lists the words" % len(faults))


if __name__ == "__main__":
    main()
