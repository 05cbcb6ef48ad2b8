"""Every structure check finds what it is there to find, and leaves a good tree alone."""

import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import docs
import headers
import layers
import listed
import options
import program
import style
import tree

COMPILER = os.environ.get("CXX", "c++")


class CheckTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, path, text, executable=False):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        if executable:
            file.chmod(0o755)

    def expect(self, check, *places):
        """The check finds faults at exactly these places, each "file:line"."""
        found = [":".join(finding.split(":")[:2]) for finding in check(self.root)]
        self.assertEqual(sorted(found), sorted(places))


class Layers(CheckTest):
    def test_allows_what_lies_below(self):
        self.write("src/relax/a.cpp", '#include "dual/b.hpp"\n#include "nda/types.hpp"\n#include <vector>\n')
        self.expect(layers.source_layers)

    def test_finds_an_include_upwards(self):
        self.write("src/dual/a.cpp", '#include <vector>\n#include "relax/b.hpp"\n')
        self.expect(layers.source_layers, "src/dual/a.cpp:2")

    def test_finds_an_include_sideways(self):
        self.write("src/io/a.hpp", '#include "dual/b.hpp"\n')
        self.expect(layers.source_layers, "src/io/a.hpp:1")

    def test_ignores_an_include_in_a_comment(self):
        self.write("src/io/a.hpp", '/*\n#include "dual/b.hpp"\n*/\n// #include "dual/b.hpp"\n')
        self.expect(layers.source_layers)

    def test_finds_baselines_that_share_code_with_what_they_judge(self):
        self.write("src/baselines/a.cpp", '#include "core/b.hpp"\n#include "decompose/b.hpp"\n')
        self.expect(layers.source_layers, "src/baselines/a.cpp:2")

    def test_finds_a_folder_without_level(self):
        self.write("src/novel/a.cpp", "")
        self.expect(layers.source_layers, "src/novel/a.cpp:1")

    def test_finds_a_header_that_is_not_named_by_its_folder(self):
        self.write("src/solve/a.cpp", '#include "b.hpp"\n')
        self.expect(layers.source_layers, "src/solve/a.cpp:1")

    def test_finds_each_library_outside_its_folder(self):
        foreign = ("boost/graph/x.hpp", "coin/x.hpp", "lemon/x.h", "nlopt.hpp", "Eigen/Core", "tbb/x.h", "oneapi/tbb.h",
                   "nlohmann/json.hpp", "zlib.h", "CLI/CLI.hpp")
        self.assertEqual(len(foreign), len(layers.LIBRARY))
        self.write("src/core/a.cpp", "".join(f"#include <{header}>\n" for header in foreign))
        self.expect(layers.source_layers, *(f"src/core/a.cpp:{n}" for n in range(1, len(foreign) + 1)))

    def test_finds_the_operating_system_where_it_has_no_business(self):
        text = "#include <unistd.h>\n#include <sys/stat.h>\n"
        self.write("src/io/a.cpp", text)
        self.expect(layers.source_layers)
        self.write("src/dual/a.cpp", text)
        self.expect(layers.source_layers, "src/dual/a.cpp:1", "src/dual/a.cpp:2")

    def test_finds_an_unknown_library(self):
        self.write("src/core/a.cpp", "#include <absl/status.h>\n")
        self.expect(layers.source_layers, "src/core/a.cpp:1")

    def test_finds_a_second_adapter(self):
        self.write("src/dual/a.cpp", "#include <nlopt.h>\n#include <nlopt.hpp>\n")
        self.expect(layers.single_adapters)
        self.write("src/dual/b.cpp", "#include <vector>\n#include <nlopt.hpp>\n")
        self.expect(layers.single_adapters, "src/dual/b.cpp:2")

    def test_finds_what_is_not_public_in_a_public_header(self):
        self.write("include/nda/a.hpp", '#include <span>\n#include <fmt/core.h>\n#include "core/b.hpp"\n')
        self.expect(layers.public_headers, "include/nda/a.hpp:2", "include/nda/a.hpp:3")

    def test_finds_a_public_header_missing_in_the_umbrella(self):
        self.write("include/nda/nda.hpp", '#include "nda/a.hpp"\n')
        self.write("include/nda/a.hpp", "")
        self.expect(layers.complete_umbrella)
        self.write("include/nda/b.hpp", "")
        self.expect(layers.complete_umbrella, "include/nda/nda.hpp:1")


class Listed(CheckTest):
    def test_finds_a_source_that_is_not_built(self):
        self.write("src/core/CMakeLists.txt", "target_sources(nda PRIVATE a.cpp)  # b.cpp\n")
        self.write("src/core/a.cpp", "")
        self.expect(listed.sources)
        self.write("src/core/b.cpp", "")
        self.write("tests/core/b_test.cpp", "")
        self.expect(listed.sources, "src/core/b.cpp:1", "tests/core/b_test.cpp:1")

    def test_finds_a_folder_that_is_not_built(self):
        self.write("CMakeLists.txt", "add_subdirectory(tests)\n")
        self.write("tests/CMakeLists.txt", "foreach(folder core io)\n")
        self.write("tests/io/CMakeLists.txt", "")
        self.expect(listed.folders)
        self.write("tests/mip/CMakeLists.txt", "")
        self.expect(listed.folders, "tests/mip/CMakeLists.txt:1")


@unittest.skipUnless(shutil.which("ctags"), "ctags is not installed")
class FunctionLengths(CheckTest):
    def test_finds_a_function_over_the_limit_and_counts_braces_in_strings_as_text(self):
        body = '  const char* brace = "}";\n' * (style.LONGEST_FUNCTION - 2)
        self.write("src/core/a.cpp", "int short_one() { return 1; }\n" * 9 + "void f() {\n" + body + "}\n")
        self.expect(style.function_lengths)
        self.write("src/core/a.cpp", "int short_one() { return 1; }\n" * 9 + "void f() {\n\n" + body + "}\n")
        self.expect(style.function_lengths, "src/core/a.cpp:10")

    def test_measures_tests_too(self):
        self.write("tests/core/a_test.cpp", "TEST(A, B) {\n" + "\n" * style.LONGEST_FUNCTION + "}\n")
        self.expect(style.function_lengths, "tests/core/a_test.cpp:1")

    def test_finds_a_median_over_the_limit(self):
        self.write("src/core/a.cpp", "void f() {\n" + "\n" * style.LARGEST_MEDIAN + "}\n")
        self.expect(style.function_lengths, "src:0")


class Style(CheckTest):
    def test_finds_a_file_over_the_limit(self):
        self.write("src/core/a.cpp", "\n" * style.LONGEST_FILE)
        self.expect(style.file_lengths)
        self.write("src/core/a.cpp", "\n" * (style.LONGEST_FILE + 1))
        self.expect(style.file_lengths, f"src/core/a.cpp:{style.LONGEST_FILE + 1}")

    def test_finds_unfinished_work(self):
        self.write("docs/a.md", "fine\nTO" "DO: more\n")
        self.write("src/core/a.cpp", "// FIX" "ME\n")
        self.expect(style.unfinished, "docs/a.md:2", "src/core/a.cpp:1")

    def test_finds_calls_that_print_end_or_look_around(self):
        bad = ("std::cout << 1;", "std::cerr << 1;", 'printf("x");', 'std::fprintf(file, "x");', "puts(text);",
               "abort();", "std::exit(1);", 'getenv("HOME");', "std::terminate();", 'fmt::print("x");')
        self.write("src/core/a.cpp", "".join(f"{line}\n" for line in bad))
        self.expect(style.forbidden_calls, *(f"src/core/a.cpp:{n}" for n in range(1, len(bad) + 1)))

    def test_allows_formatting_and_the_program(self):
        self.write("src/core/a.cpp", 'std::snprintf(text, 9, "printf(1)");  // no abort() here\nloop.exit();\n')
        self.write("src/cli/a.cpp", "std::cout << 1;\n")
        self.expect(style.forbidden_calls)

    def test_finds_code_that_was_commented_out(self):
        dead = ("// return x;", "  // if (x) {", "//}", "// for (int i = 0; i < n; ++i) f(i);", "//f(x);",
                "// std::vector<int> x = g();", "// x += 2;", "// #include <vector>")
        self.write("src/core/a.cpp", "".join(f"{line}\n" for line in dead))
        self.expect(style.dead_code, *(f"src/core/a.cpp:{n}" for n in range(1, len(dead) + 1)))

    def test_allows_prose_and_examples_in_contracts(self):
        self.write("src/core/a.cpp", "// The bound holds; see f().\n///     f(x);\n// q(u) = sum of u; concave\n"
                                     'f("// return x;");\n')
        self.expect(style.dead_code)


class Headers(CheckTest):
    def check(self, root):
        return headers.alone(root, COMPILER, [root / "include"])

    def test_finds_a_header_that_needs_another(self):
        self.write("include/nda/a.hpp", "#pragma once\n#include <vector>\ninline std::vector<int> a;\n")
        self.expect(self.check)
        self.write("include/nda/b.hpp", "#pragma once\ninline std::vector<int> b;\n")
        self.expect(self.check, "include/nda/b.hpp:1")

    def test_finds_a_header_without_guard(self):
        self.write("include/nda/a.hpp", "struct A {};\n")
        self.expect(self.check, "include/nda/a.hpp:1")


class Docs(CheckTest):
    def test_finds_links_that_lead_nowhere(self):
        self.write("docs/b.md", "# The dual function\n")
        self.write("docs/a.md", "# Top\n[good](b.md#the-dual-function) [web](https://example.org) [here](#top)\n"
                                "[bad](c.md)\n[bad](b.md#primal)\n![bad](images/x.png)\n[bad](#bottom)\n"
                                "```\n[not a link](c.md)\n```\n")
        self.expect(docs.links, *(f"docs/a.md:{n}" for n in (3, 4, 5, 6)))

    def test_finds_comments_that_name_a_missing_page(self):
        self.write("docs/b.md", "# Title\n")
        self.write("src/core/a.cpp", "// docs/b.md\n// docs/c.md\n// docs/b.md#nothing\n")
        self.expect(docs.mentions, "src/core/a.cpp:2", "src/core/a.cpp:3")

    def test_finds_commands_that_do_not_exist(self):
        self.write("scripts/run", "", executable=True)
        self.write("scripts/asleep", "")
        self.write("README.md", "```sh\nscripts/run -x  # scripts/explained\nscripts/none\nscripts/asleep\n"
                                "scripts/run data/none.nda\n```\n")
        self.expect(docs.commands, *(f"README.md:{n}" for n in (3, 4, 5)))

    def test_finds_an_example_that_is_not_the_one_that_is_tested(self):
        self.write("examples/hello_nda.cpp", "int main() {}\n")
        self.write("README.md", "Look:\n```cpp\nint main() {}\n```\n")
        self.expect(docs.readme_example)
        self.write("README.md", "Look:\n```cpp\nint main() { }\n```\n")
        self.expect(docs.readme_example, "README.md:3")
        self.write("README.md", "Nothing to see\n")
        self.expect(docs.readme_example, "README.md:1")


class Program(CheckTest):
    def check(self, root):
        return program.commands(root, root / "fake")

    def test_finds_commands_that_readme_and_program_do_not_share(self):
        self.write("fake", "#!/bin/sh\nprintf 'Subcommands:\\n  solve  it\\n         well\\n  info   x\\n\\n  note x\\n'\n",
                   executable=True)
        self.write("README.md", "| `nda solve FILE` | solves |\n| `nda info FILE` | tells |\n")
        self.expect(self.check)
        self.write("README.md", "| `nda solve FILE` | solves |\n| `nda guess` | guesses |\n")
        self.expect(self.check, "README.md:1", "README.md:2")


class Options(CheckTest):
    def setUp(self):
        super().setUp()
        self.write("fake", "#!/bin/sh\nprintf 'seed=%s\\n    of a | b: whole\\nbranch.nodes=60\\n    at most: 1 or more\\n' "
                           "$([ $3 = exact ] && echo 2 || echo 1)\n", executable=True)
        self.program = self.root / "fake"

    def test_finds_a_page_that_is_stale_or_missing(self):
        check = lambda root: options.matches(root, self.program)
        self.expect(check, "docs/options.md:1")
        text = options.page(self.program)
        self.assertIn("\n| `seed` | 1 |  | 2 | of a \\| b | whole |\n", text)
        self.write("docs/options.md", text)
        self.expect(check)
        self.write("docs/options.md", text.replace("| whole |", "| a number |"))
        self.expect(check, f"docs/options.md:{text[:text.index('| whole |')].count(chr(10)) + 1}")
        self.write("docs/options.md", text + "more\n")
        self.expect(check, f"docs/options.md:{text.count(chr(10)) + 1}")
        self.write("docs/options.md", text[:-1])
        self.expect(check, "docs/options.md:1")

    def test_finds_a_field_that_the_program_does_not_list(self):
        check = lambda root: options.complete(root, self.program)
        fields = "struct BranchOptions {\n  int nodes = 60;  ///< at most\n};\nstruct Options {\n  int seed = 1;\n};\n"
        self.write("include/nda/options.hpp", fields)
        self.expect(check)
        self.write("include/nda/options.hpp", fields.replace("int nodes = 60;", "int nodes = 60;\n  int depth = 3;"))
        self.expect(check, "include/nda/options.hpp:1")


class Tree(CheckTest):
    def test_skips_what_is_built(self):
        self.write("build/release/a.cpp", "")
        self.write("src/core/a.cpp", "")
        self.assertEqual([str(path) for path in tree.files(self.root, tree.CPP)], ["src/core/a.cpp"])

    def test_tells_comments_from_text(self):
        text = 'a("// no"); // yes\nb = R"(/* no\n)"; int c = 1\'000; char d = \'"\'; /* yes\n */ e();\n'
        self.assertEqual(tree.without_comments(text),
                         'a("// no"); \nb = R"(/* no\n)"; int c = 1\'000; char d = \'"\'; \n e();\n')
        self.assertEqual(tree.code_only(text), 'a(""); \nb = ""\n; int c = 1\'000; char d = ""; \n e();\n')
        self.assertEqual(tree.comments_only(text), "// yes\n\n/* yes\n */")


if __name__ == "__main__":
    sys.exit(unittest.main())
