"""Sphinx: the pages of this folder and the reference from the docstrings, as one site."""

import re

from docutils.utils.math.latex2mathml import tex2mathml

import loadflow

project = "loadflow"
author = "The loadflow developers"
version = release = loadflow.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc", "sphinxcontrib.mermaid"]
exclude_patterns = ["_build"]
nitpicky = False  # types of signatures need not be pages
myst_enable_extensions = ["dollarmath", "fieldlist"]
myst_heading_anchors = 3
myst_fence_as_directive = ["mermaid"]
numpydoc_show_class_members = False  # autodoc lists them
autodoc_member_order = "bysource"
html_theme = "furo"
html_title = "loadflow"
html_math_renderer = "mathml"

CODE = re.compile(r"(``.*?``|`[^`]*`)")


def escape_bars(app, what, name, obj, options, lines):
    """|x| in a docstring is a magnitude, no substitution of reStructuredText."""
    for number, line in enumerate(lines):
        if ">>>" not in line:
            parts = CODE.split(line)
            parts[::2] = (re.sub(r"(?<!\\)\|", r"\\|", part) for part in parts[::2])
            lines[number] = "".join(parts)


def inside(app, page, text):
    """What lies beside this folder has a page of the site in it."""
    text[0] = text[0].replace("(../CONTRIBUTING.md)", "(contributing.md)")


def math(as_block):
    """Equations as MathML, which browsers draw by themselves, without scripts of other hosts."""

    def visit(self, node):
        from docutils import nodes

        self.body.append(tex2mathml(node.astext(), as_block=as_block))
        raise nodes.SkipNode

    return visit, None


def setup(app):
    """What Sphinx calls before it reads the pages."""
    app.connect("autodoc-process-docstring", escape_bars, priority=900)  # after numpydoc
    app.connect("source-read", inside)
    app.add_html_math_renderer("mathml", math(False), math(True))
