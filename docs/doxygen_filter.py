# What Doxygen reads in place of a header: the comment of a line such as `int width = 0, height = 0;  ///< texels` stands
# at each of its names, where Doxygen alone would give it to one of them.
import re
import sys

DECLARATION = re.compile(r"^(\s+)((?:static |constexpr |const )*[\w:]+(?:<[^;=]*>)?(?: const)?\*?)\s+(\w+[^;()]*,[^;()]*|\w+\{[^;]*,[^;]*);(\s*///<\s*(.*))?$")


def parts_of(names):
    """`a = 0, b{1, 2}` in parts, at the commas outside of brackets."""
    parts, depth = [""], 0
    for c in names:
        depth += (c in "({[<") - (c in ")}]>")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts]


def main():
    with open(sys.argv[1], encoding="utf-8") as header:
        lines = header.read().split("\n")
    before = []
    for line in lines:
        comment = re.match(r"^\s*///(?!<)\s?(.*)$", line)
        match = DECLARATION.match(line)
        parts = parts_of(match.group(3)) if match else []
        if len(parts) > 1:
            indent, kind, text = match.group(1), match.group(2), match.group(5) or ""
            above = "/** %s */ " % " ".join(before) if before else ""
            after = " /**< %s */" % text if text else ""
            first = "%s %s;%s" % (kind, parts[0], after)
            rest = "".join(" %s%s %s;%s" % (above, kind, part, after) for part in parts[1:-1])
            last = " %s%s %s;%s" % (above, kind, parts[-1], " ///< " + text if text else "")
            line = indent + first + rest + last
        print(line)
        before = before + [comment.group(1)] if comment else []


if __name__ == "__main__":
    main()
