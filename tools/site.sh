#!/bin/sh
# Builds the manual as a site, build/site/index.html, and checks its links.
#
#   site.sh BUILD    BUILD: a build folder with the programs `chasles` and those of examples/, whose pages the site shows
#
# Tools come from the package indexes of Python and npm, in the versions that site/requirements.txt and
# site/package-lock.json name, into build/site-tools. The site needs no network: it has its own scripts, styles and fonts.
set -eu
cd "$(dirname "$0")/.."
build=$1
tools=$PWD/build/site-tools
made=$PWD/build/site-made
site=$PWD/build/site

# The tools, again only if a list of versions has changed.
stamp=$tools/installed
versions=$(cat site/requirements.txt site/package-lock.json | cksum)
if [ "$(cat "$stamp" 2>/dev/null || true)" != "$versions" ]; then
    echo "chasles: installing Sphinx and TypeDoc"
    rm -rf "$tools"
    mkdir -p "$tools"
    python3 -m venv "$tools/environment"
    "$tools/environment/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps -r site/requirements.txt
    cp site/package.json site/package-lock.json "$tools"
    (cd "$tools" && npm ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error >/dev/null)
    echo "$versions" >"$stamp"
fi
python=$tools/environment/bin/python

# What is made: pages and pictures by the programs, and the references.
stubs=$(tools/python_stubs.sh "$build")
"$python" site/assemble.py "$made/source" "$stubs"
node "$tools/node_modules/typedoc/bin/typedoc" --options site/typedoc.json --out "$made/source/api/javascript" --logLevel Warn
"$python" site/reference_javascript.py "$made/source/api/javascript"
"$python" site/pictures.py "$build" "$made"

CHASLES_SITE=$made "$tools/environment/bin/sphinx-build" --quiet --fail-on-warning --keep-going -j auto -E -d "$made/doctrees" \
    -c site -b html "$made/source" "$site.new"
rm -rf "$site"
mv "$site.new" "$site"
"$python" tools/check_site.py "$site"
echo "the site is build/site/index.html"
