"""What Sphinx does not know: LAMMPS's pages and input scripts, folders that stand for their README.

When all is written, every link to a page, a place in it, a picture or a file is looked up; one that
leads nowhere is a warning.
"""
import os
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from docutils import nodes
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, Operator, String, Text
from sphinx.util import logging

LAMMPS = "https://docs.lammps.org"
MATHJAX = Path("/usr/share/javascript/mathjax")
# of MathJax, what TeX-AMS_CHTML loads
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_CHTML.js", "extensions", "jax/element",
                 "jax/input/TeX", "jax/output/CommonHTML", "fonts/HTML-CSS/TeX/woff")
# folders whose files pages name in `code`
NAMED = re.compile(r"(?:\.\./)*(?:bench|cmake|doc|examples|fluid|potentials|scripts|src|tests)/"
                   r"[\w./-]+")
IMPLIED = ("tests", "src/USER-RBC")    # what CONTRIBUTING.md leaves out of paths

logger = logging.getLogger(__name__)


class LammpsLexer(RegexLexer):
    """Input scripts of LAMMPS."""

    name = "LAMMPS"
    aliases = ["LAMMPS", "lammps"]
    tokens = {
        "root": [
            (r"^[ \t]*(?=\S)", Text, "command"),
            (r"\s+", Text),
        ],
        "command": [
            (r"(variable|fix|compute|group|region|molecule|dump)([ \t]+)([^\s#&]+)",
             bygroups(Keyword, Text, Name.Variable), "words"),
            (r"[A-Za-z_]\w*(?:/\w+)*", Keyword, "words"),
            (r"", Text, "words"),
        ],
        "words": [
            (r"&[ \t]*\n", Operator),
            (r"\n", Text, "#pop:2"),
            (r"#.*", Comment),
            (r'"""(?:.|\n)*?"""', String),
            (r"\"[^\"\n]*\"|'[^'\n]*'", String),
            (r"\$\{\w+\}|\$\([^)\n]*\)|\$\w", Name.Variable),
            (r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w./])", Number),
            (r"[^\s#&\"'$]+", Text),
            (r"[ \t]+", Text),
            (r".", Text),
        ],
    }


def lammps_pages():
    """Names of LAMMPS's pages, None where its source is not at hand."""
    folder = Path(os.environ.get("LAMMPS_SOURCE_DIR", "/nonexistent")) / "doc" / "src"
    return {path.stem for path in folder.glob("*.rst")} if folder.is_dir() else None


def name_readmes(app, name, source):
    """Links of a README to a folder lead to the README in it."""
    here = Path(app.env.doc2path(name)).parent

    def link(match):
        return f"]({match[1]}/README.md)" if (here / match[1] / "README.md").is_file() else match[0]

    if Path(app.env.doc2path(name)).suffix == ".md":
        source[0] = re.sub(r"\]\(([\w./-]+)\)", link, source[0])


def link_to_lammps(app, env, node, text):
    """Where Sphinx finds no page for :doc: it is one of LAMMPS's."""
    target = node["reftarget"]
    if node["reftype"] != "doc" or not re.fullmatch(r"\w+", target):
        return None
    if app.rbc_lammps_pages is not None and target not in app.rbc_lammps_pages:
        return None
    return nodes.reference("", "", text, internal=False, refuri=f"{LAMMPS}/{target}.html")


class Page(HTMLParser):
    """Links and places of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.places |= {attrs[key] for key in ("id", "name") if attrs.get(key)}
        self.links += [attrs[key] for key in ("href", "src") if attrs.get(key)]


def dead_links(folder):
    """(page, link) of all that lead to no file or place in the folder."""
    pages = {path.resolve(): Page(path) for path in sorted(folder.rglob("*.html"))
             if "mathjax" not in path.parts}
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = unquote(parts.fragment)
            if not target.is_file() or (
                    place and target in pages and place not in pages[target].places):
                yield path.relative_to(folder), link


def missing_files(app):
    """(page, name) of files of the repository that a page names in `code` and that do not exist."""
    top = Path(app.srcdir)
    for name in sorted(app.env.all_docs):
        folders = ((top / name).parent, top, *(top / folder for folder in IMPLIED))
        for literal in app.env.get_doctree(name).findall(nodes.literal):
            for word in literal.astext().split():
                if NAMED.fullmatch(word) and not any(
                        (folder / word).exists() for folder in folders):
                    yield name, word


def begin(app):
    app.rbc_lammps_pages = lammps_pages()
    if app.rbc_lammps_pages is None:
        logger.info("LAMMPS_SOURCE_DIR has no pages of LAMMPS: links to them are not checked")


def finish(app, error):
    if error or app.builder.format != "html":
        return
    folder = Path(app.outdir).resolve()
    for part in MATHJAX_PARTS:
        source, copy = MATHJAX / part, folder / "_static" / "mathjax" / part
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy, dirs_exist_ok=True)
        else:
            shutil.copy(source, copy)
    for page, link in dead_links(folder):
        logger.warning("%s: link to %s, which is not there", page, link)
    for page, word in missing_files(app):
        logger.warning("%s: names %s, which is not there", page, word)


def setup(app):
    app.add_lexer("LAMMPS", LammpsLexer)
    app.connect("builder-inited", begin)
    app.connect("source-read", name_readmes)
    app.connect("missing-reference", link_to_lammps)
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
