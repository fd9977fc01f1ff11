"""Settings of Sphinx, which scripts/html.sh runs over the top folder: READMEs are pages, too."""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "html"))

project = "USER-RBC"
author = "USER-RBC developers"
project_copyright = author

extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx.ext.autosectionlabel", "rbc_pages"]
root_doc = "doc/index"
include_patterns = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "doc/*.rst",
                    "bench/README.md", "potentials/README.md",
                    "examples/README.md", "examples/*/README.md"]
exclude_patterns = ["build*", ".git", "src", "tests", "fluid", "cmake", "scripts"]
autosectionlabel_prefix_document = True
myst_heading_anchors = 4
highlight_language = "none"

html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 2, "collapse_navigation": False, "titles_only": True}
html_title = "USER-RBC"
html_static_path = ["html/custom.css"]
html_css_files = ["custom.css"]
templates_path = ["html"]
html_additional_pages = {"index": "redirect.html"}
html_copy_source = False
html_show_sphinx = False
html_domain_indices = False

# Debian's MathJax, which rbc_pages copies beside the pages: they need no network.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
mathjax2_config = {"showMathMenu": False, "messageStyle": "none"}
