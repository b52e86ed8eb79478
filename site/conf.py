# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Sphinx, for scripts/site, which sets RONDEL_SITE_BUILD to the folder with Doxygen's output and the globes."""

import os
import pathlib

HERE = pathlib.Path(__file__).parent
BUILD = pathlib.Path(os.environ["RONDEL_SITE_BUILD"])

project = "Rondel"
author = copyright = "The Rondel authors"  # noqa: A001 (Sphinx calls it so)
release = version = (HERE.parent / "VERSION").read_text(encoding="utf-8").strip()

extensions = [
    "breathe",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
]
root_doc = "index"

# Markdown
myst_enable_extensions = ["attrs_inline", "colon_fence", "dollarmath", "html_image"]
myst_fence_as_directive = ["math"]  # as a fenced block that GitHub shows as a formula, too
myst_heading_anchors = 6
myst_dmath_double_inline = True
myst_update_mathjax = False

# Cells are run when the site is made, and an error in one is an error of the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True

# C
breathe_projects = {"c": str(BUILD / "doxygen" / "xml")}
breathe_default_project = "c"
breathe_domain_by_extension = {"h": "c"}

# Python
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings say them
napoleon_google_docstring = False
napoleon_use_rtype = False
# Sections "Attributes" of a class name what its properties document, too.
napoleon_use_ivar = True
napoleon_use_admonition_for_examples = False

# Everything that a page needs lies beside it, and works from file://.
mathjax_path = "tex-svg.js"
mathjax3_config = {"options": {"enableMenu": False}}
html_theme = "furo"
html_title = f"Rondel {release}"
html_static_path = ["_static", str(BUILD / "static")]
html_extra_path = [str(BUILD / "extra")]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # would ask a server for every page that it found
html_theme_options = {"navigation_with_keys": True}
pygments_style = "a11y-high-contrast-light"
suppress_warnings = [
    "duplicate_declaration.c",  # a struct that is declared first and defined later
    "myst.header",  # TypeDoc skips levels
    "ref.python",  # the word shape in a type is no link, though two classes have such a property
]
