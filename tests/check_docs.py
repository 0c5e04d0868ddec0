#!/usr/bin/env python3
"""Checks that the files and names that the documents point to exist. Usage: check_docs.py [PROJECT_ROOT]

Looked up are links to files, `folder/File.cpp` (also with a function: `folder/File.cpp: name`), `name()`,
`Class::name` and `NameTest`; of the changelog, which tells of names that are gone, files alone."""
import pathlib
import re
import sys

LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)")
FILE = re.compile(r"`([\w./-]+\.(?:h|cpp|py|cmake))(?::\s*([\w:~]+)(?:\(\))?)?`")
NAME = re.compile(r"`(?=[\w:]*(?:\(\)|Test|::\w+)`)([\w:]+)(?:\(\))?`")
WORD = re.compile(r"\w+")
TOP = {"base", "scenegraph", "importance", "radiosity", "io", "comparison", "viewer", "tools", "tests", "bench",
       "scenes", "scripts", "cmake", "docs"}


def sources(root):
    return {path.name: path for top in TOP for path in sorted((root / top).rglob("*.*")) if path.is_file()}


def words_of(root):
    """The words of each source."""
    return [{path.stem, *WORD.findall(path.read_text(encoding="utf-8"))} for top in TOP
            for path in (root / top).rglob("*") if path.suffix in {".h", ".cpp", ".py"}]


def faults(root):
    known = sources(root)
    words = words_of(root)
    documents = [*root.glob("*.md"), *root.glob("docs/*.md"), *root.glob("scenes/*.md")]
    for document in sorted(documents):
        name = document.relative_to(root).as_posix()
        for number, line in enumerate(document.read_text(encoding="utf-8").split("\n"), 1):
            for target in LINK.findall(line):
                if not (document.parent / target).exists():
                    yield f"{name}:{number}: there is no {target}"
            for path, word in FILE.findall(line):
                found = root / path if path.split("/")[0] in TOP and "/" in path else known.get(path.split("/")[-1])
                if found is None or not found.exists():
                    yield f"{name}:{number}: there is no {path}"
                elif word and word.split("::")[-1] not in WORD.findall(found.read_text(encoding="utf-8")):
                    yield f"{name}:{number}: {path} does not mention {word}"
            for symbol in NAME.findall(line) if name != "CHANGELOG.md" else []:
                if not any(one.issuperset(symbol.split("::")) for one in words):
                    yield f"{name}:{number}: there is no {symbol}"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "docs: all files and names that they point to exist")
    sys.exit(1 if found else 0)
