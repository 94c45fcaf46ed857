"""Settings of Sphinx for the site. tools/site.sh sets CHASLES_SITE, the folder with what was made for this build."""

import os
import pathlib
import re
import sys

sys.path[:0] = [str(pathlib.Path(__file__).parent), os.environ["CHASLES_SITE"] + "/python"]

ROOT = pathlib.Path(__file__).resolve().parent.parent
MADE = pathlib.Path(os.environ["CHASLES_SITE"])

project = "Chasles"
author = "the authors of Chasles"
version = release = re.search(r"^  VERSION ([0-9.]+)$", (ROOT / "CMakeLists.txt").read_text("utf-8"), re.MULTILINE)[1]
copyright = "the authors of Chasles. Apache License 2.0"

extensions = [
    "myst_parser",
    "breathe",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "docstring_text",
    "repairs",
]
language = "en"
smartquotes = False  # "-" and quotes stand in formulas and in code

# Markdown as the repository has it: links to headings, and indented blocks that are formulas or output, in no language.
myst_enable_extensions = ["colon_fence", "html_image", "attrs_block"]
myst_heading_anchors = 6
highlight_language = "text"
suppress_warnings = ["misc.highlighting_failure"]
copybutton_prompt_text = r"^(\$ |>>> |\.\.\. )"
copybutton_prompt_is_regexp = True
copybutton_exclude = ".linenos, .gp, .go"

breathe_projects = {"chasles": str(MADE / "doxygen" / "xml")}
breathe_default_project = "chasles"
cpp_maximum_signature_line_length = 88

autodoc_mock_imports = ["OCP", "coal", "mujoco", "ompl", "pinocchio", "pydrake", "pyarrow", "dask", "tqdm", "lerobot", "torch"]
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
python_maximum_signature_line_length = 88
python_use_unqualified_type_names = True
add_module_names = False
napoleon_google_docstring = False

html_theme = "furo"
html_title = f"Chasles {version}"
html_static_path = ["_static"]
html_css_files = ["style.css"]
html_extra_path = [str(MADE / "extra")]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b5fa5", "color-brand-content": "#0b5fa5"},
    "dark_css_variables": {"color-brand-primary": "#7cc4ff", "color-brand-content": "#7cc4ff"},
}
