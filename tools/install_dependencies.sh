#!/bin/sh
# Installs the Debian packages that are missing, and says nothing when none is.
#
#   install_dependencies.sh [check] [fuzz] [python] [bench] [tidy]    what `make demo` needs, and what the named targets add
#   install_dependencies.sh --list [check] ...        prints the packages instead
set -eu

clang_version=$(cat "$(dirname "$0")/clang-tools-version")

# The build: Boost.Multiprecision for the exact stage, oneTBB for batches, Assimp for mesh files of other formats, CLI11,
# fmt and nlohmann_json for the command line.
packages="make cmake ninja-build g++ libeigen3-dev libboost-dev libtbb-dev libassimp-dev libfmt-dev libcli11-dev nlohmann-json3-dev"

# The page of `chasles view` is made by npm packages. A Node.js from elsewhere brings its npm along, and does not go with
# Debian's.
command -v npm >/dev/null || packages="$packages nodejs npm"

# Debian 12's `cargo` is too old for Parry; the one for web browsers is kept up to date.
cargo_package() {
    VERSION_ID=""
    [ ! -r /etc/os-release ] || . /etc/os-release
    if [ "$VERSION_ID" = 12 ]; then echo cargo-web; else echo cargo; fi
}

list_only=false
for group in "$@"; do
    case $group in
        --list) list_only=true ;;
        # GMP is the exact arithmetic that the tests compare with, FCL the distances; zlib reads packed test data.
        check)
            packages="$packages libgtest-dev libgmp-dev libfcl-dev zlib1g-dev python3 clang-format-$clang_version"
            # The page of `chasles view` is tested in a browser.
            command -v chromium >/dev/null || packages="$packages chromium"
            ;;
        # libFuzzer and the sanitizers are in the runtime library.
        fuzz) packages="$packages clang-$clang_version libclang-rt-$clang_version-dev libgmp-dev" ;;
        # The rest comes from the package index into a virtual environment.
        python) packages="$packages python3-venv python3-dev" ;;
        # Highway is what the lanes are compared with, FCL and Bullet what whole queries are; other peers are brought by
        # Python and Rust.
        bench)
            packages="$packages libbenchmark-dev libhwy-dev libfcl-dev libbullet-dev python3-venv"
            command -v cargo >/dev/null || packages="$packages $(cargo_package)"
            ;;
        tidy) packages="$packages clang-tidy-$clang_version" ;;
        *)
            echo "install_dependencies.sh: unknown group \"$group\" (known: check, fuzz, python, bench, tidy)" >&2
            exit 2
            ;;
    esac
done

if $list_only; then
    echo "$packages"
    exit 0
fi

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "chasles: this is not a Debian system, so nothing is installed; needed are the likes of: $packages" >&2
    exit 0 # they may well be there under other names; CMake names the first that is not
fi

# dpkg-query fails for packages it has never heard of, which is no error here.
installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $packages 2>/dev/null || true)
missing=""
for package in $packages; do
    case "
$installed
" in
        *"
installed $package
"*) ;;
        *) missing="$missing $package" ;;
    esac
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
        echo "chasles: not root and no sudo; as root run: apt-get install$missing" >&2
        exit 1
    fi
    as_root=sudo
fi

echo "chasles: installing$missing"
$as_root apt-get -q update
$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends -o DPkg::Lock::Timeout=300 install $missing
