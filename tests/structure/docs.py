"""The documents tell the truth about the tree: links lead somewhere, commands and examples exist."""

import os
import re

import tree

_LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
_MENTION = re.compile(r"(?<![\w/.-])docs/[\w./-]+\.md\b(#[\w-]+)?")
_FENCE = re.compile(r"^```(\w*)$(.*?)^```$", re.MULTILINE | re.DOTALL)
_FOLDER = re.compile(r"^(?:scripts|data|docs|examples|bench|tests|python)/[\w./-]+$")


def anchors(text):
    """The anchors that a page of Markdown offers, as GitHub spells them."""
    titles = re.findall(r"^#+ +(.+)$", re.sub(_FENCE, "", text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def target_fault(root, folder, target):
    """What is wrong with a link `target` in a file of that folder, or None."""
    name, _, anchor = target.partition("#")
    path = root / folder / name
    if not path.exists():
        return f"{target} leads nowhere"
    if anchor and path.suffix == ".md" and anchor not in anchors(path.read_text(encoding="utf-8")):
        return f"{target}: no such heading"
    return None


def links(root):
    findings = []
    for path in tree.files(root, (".md",)):
        text = tree.read(root, path)
        for number, line in tree.lines(re.sub(_FENCE, lambda m: "\n" * m[0].count("\n"), text)):
            for target in _LINK.findall(line):
                if "://" in target or target.startswith("mailto:"):
                    continue
                whole = path.name + target if target.startswith("#") else target
                fault = target_fault(root, path.parent, whole)
                if fault:
                    findings.append(f"{path}:{number}: {fault}")
    return findings


def mentions(root):
    """Comments and scripts name pages of docs/ from the root of the tree."""
    findings = []
    for path in tree.files(root, tree.CPP + (".py", ".sh", ".cmake", ".txt", ".in")):
        if path.parts[:2] == ("tests", "structure"):
            continue
        for number, line in tree.lines(tree.read(root, path)):
            for match in _MENTION.finditer(line):
                fault = target_fault(root, ".", match[0])
                if fault:
                    findings.append(f"{path}:{number}: {fault}")
    return findings


def blocks(text, *languages):
    """Pairs (line number of the first line, content) of the fenced blocks in these languages."""
    return [(text.count("\n", 0, match.start(2)) + 2, match[2].strip("\n"))
            for match in _FENCE.finditer(text) if match[1] in languages]


def command_faults(root, command):
    """Programs of the tree must be there and executable, its files must be there."""
    words = command.removeprefix("$ ").split("#")[0].split()
    faults = [f"{word} does not exist" for word in words
              if _FOLDER.match(word) and not (root / word).exists()]
    if words and not faults and _FOLDER.match(words[0]) and not os.access(root / words[0], os.X_OK):
        faults.append(f"{words[0]} is not executable")
    return faults


def commands(root):
    findings = []
    for path in tree.files(root, (".md",)):
        for first, block in blocks(tree.read(root, path), "sh", "console"):
            for number, line in enumerate(block.split("\n"), start=first):
                findings += [f"{path}:{number}: {fault}" for fault in command_faults(root, line)]
    return findings


def readme_example(root):
    """The C++ of the README is examples/hello_nda.cpp, to the letter."""
    readme, example = root / "README.md", root / "examples/hello_nda.cpp"
    if not readme.exists():
        return []
    found = blocks(readme.read_text(encoding="utf-8"), "cpp")
    if not found:
        return ["README.md:1: shows no example of the library"]
    number, shown = found[0]
    if not example.exists() or shown != example.read_text(encoding="utf-8").strip("\n"):
        return [f"README.md:{number}: differs from examples/hello_nda.cpp"]
    return []


if __name__ == "__main__":
    tree.main(links, mentions, commands, readme_example)
