# Where do the fields of the C structs lie? Reads include/gnomon/c/gnomon.h, and writes the tables that bindings read:
#   layout.py            writes bindings/js/layout.js and bindings/python/src/gnomon/_layout.py
#   layout.py --check    1 where either is not what it would write
# A compiler of C confirms the sizes and offsets: tests/c/layout_test.py.
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
HEADER = os.path.join(HERE, "..", "include", "gnomon", "c", "gnomon.h")
JS = os.path.join(HERE, "js", "layout.js")
PYTHON = os.path.join(HERE, "python", "src", "gnomon", "_layout.py")

# C type: name here, bytes.
SCALARS = {"int32_t": ("i32", 4), "uint32_t": ("u32", 4), "int64_t": ("i64", 8), "uint64_t": ("u64", 8),
           "float": ("f32", 4), "double": ("f64", 8), "uint8_t": ("u8", 1), "char": ("char", 1)}


def read_header():
    """The constants, of each struct its fields as (name, C type, pointer, dimensions), and of each call what it returns and
    its parameters as (name, C type)."""
    with open(HEADER, encoding="utf-8") as file:
        text = re.sub(r"//[^\n]*", "", file.read())
    constants = {}
    for body in re.findall(r"enum \{([^}]*)\}", text):
        for name, value in re.findall(r"(GNOMON_\w+) = (-?\d+)", body):
            constants[name] = int(value)
    structs = {}
    for name, body in re.findall(r"typedef struct (gnomon_\w+) \{([^}]*)\} \1;", text):
        fields = []
        for declaration in filter(None, (part.strip() for part in body.split(";"))):
            kind, names = re.match(r"(?:const )?(\w+)(\*?\s.*)$", declaration, re.S).groups()
            for one in names.split(","):
                pointer, field, dimensions = re.match(r"\s*(\*?)\s*(\w+)((?:\s*\[\w+\])*)$", one).groups()
                sizes = [constants.get(d) or int(d) for d in re.findall(r"\[(\w+)\]", dimensions)]
                fields.append((field, kind, bool(pointer), sizes))
        structs[name] = fields
    calls = {}
    for returns, name, parameters in re.findall(r"^(?:GNOMON_API|GNOMON_EXPERIMENTAL) ((?:const )?\w+\*?) (gnomon_\w+)\(([^;]*)\);", text, re.M):
        rows = []
        for one in ([] if parameters == "void" else parameters.split(",")):
            kind, parameter, array = re.match(r"\s*(.*?)\s*(\w+)(\[\w+\])?\s*$", one, re.S).groups()
            rows.append((parameter, kind.replace(" ", "") + ("*" if array else "")))
        calls[name] = (returns, rows)
    return constants, structs, calls


def lay_out(structs, pointer_bytes):
    """Of each struct: (size, alignment, [(name, kind, offset, count)]); kind is a scalar, `ptr` or a struct's name."""
    done = {}
    for name, fields in structs.items():
        at, alignment, rows = 0, 1, []
        for field, kind, pointer, dimensions in fields:
            if pointer:
                kind, size, align = "ptr", pointer_bytes, pointer_bytes
            elif kind in SCALARS:
                kind, size = SCALARS[kind]
                align = size
            else:
                size, align = done[kind][0], done[kind][1]
            count = 1
            for dimension in dimensions:
                count *= dimension
            at = (at + align - 1) // align * align
            rows.append((field, kind, at, count if dimensions else 0))
            at += size * count
            alignment = max(alignment, align)
        done[name] = ((at + alignment - 1) // alignment * alignment, alignment, rows)
    return done


def short(name):
    return name.removeprefix("gnomon_")


def js_text(constants, structs):
    lines = ["// Where the fields of the C structs lie in the memory of the module. Written by bindings/layout.py.",
             "// [offset, kind, count]: count 0 is one value, else an array.", "export const structs = {"]
    for name, (size, _, rows) in lay_out(structs, 4).items():
        lines.append("  %s: {" % short(name))
        lines.append("    bytes: %d," % size)
        lines.append("    fields: {")
        for field, kind, offset, count in rows:
            lines.append("      %s: [%d, '%s', %d]," % (field, offset, short(kind), count))
        lines += ["    },", "  },"]
    lines += ["};", "", "export const constants = {"]
    lines += ["  %s: %d," % (name.removeprefix("GNOMON_"), value) for name, value in constants.items()]
    return "\n".join(lines + ["};", ""])


CTYPES = {"i32": "c_int32", "u32": "c_uint32", "i64": "c_int64", "u64": "c_uint64", "f32": "c_float", "f64": "c_double",
          "u8": "c_uint8", "char": "c_char", "ptr": "c_void_p"}


def python_kind(kind):
    """How ctypes passes a C type; None returns nothing."""
    if kind in SCALARS:
        return "ctypes." + CTYPES[SCALARS[kind][0]]
    if kind == "void":
        return "None"
    return "ctypes.c_char_p" if kind.replace(" ", "") == "constchar*" else "ctypes.c_void_p"


def python_text(constants, structs, calls):
    lines = ['"""The structs and constants of the C header. Written by bindings/layout.py."""', "import ctypes", ""]
    lines += ["%s = %d" % (name.removeprefix("GNOMON_"), value) for name, value in constants.items()]
    for name, (size, _, rows) in lay_out(structs, 8).items():
        lines += ["", "", "class %s(ctypes.Structure):" % short(name), "    _fields_ = ["]
        for field, kind, _, count in rows:
            kind = "ctypes." + CTYPES[kind] if kind in CTYPES else short(kind)
            lines.append('        ("%s", %s%s),' % (field, kind, " * %d" % count if count else ""))
        lines += ["    ]", "", "", "assert ctypes.sizeof(%s) == %d" % (short(name), size)]
    lines += ["", "# What each call returns, and its parameters.", "calls = {"]
    for name, (returns, parameters) in calls.items():
        lines.append('    "%s": (%s, [%s]),' % (name, python_kind(returns), ", ".join('("%s", %s)' % (p, python_kind(k)) for p, k in parameters)))
    lines.append("}")
    return "\n".join(lines + [""])


def main():
    constants, structs, calls = read_header()
    if len(structs) < 20 or len(constants) < 80 or len(calls) < 60:
        sys.exit("the header's structs and calls were not found")
    stale = []
    for path, text in ((JS, js_text(constants, structs)), (PYTHON, python_text(constants, structs, calls))):
        if not os.path.isdir(os.path.dirname(path)):
            continue
        old = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
        if old == text:
            continue
        stale.append(os.path.relpath(path, os.path.join(HERE, "..")))
        if "--check" not in sys.argv:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    if stale and "--check" in sys.argv:
        sys.exit("not what include/gnomon/c/gnomon.h has; run python3 bindings/layout.py: %s" % ", ".join(stale))


if __name__ == "__main__":
    main()
