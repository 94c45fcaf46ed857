#!/bin/sh
# Installs the Debian packages that are missing, and says nothing when none is.
#
#   install_dependencies.sh [GROUP...]           what the make targets of these names need (default: install)
#   install_dependencies.sh --list [GROUP...]    prints the packages instead
#
# Groups: demo, install, check, fuzz, python, wasm, site, bench, tidy, format.
set -eu

clang_version=$(cat "$(dirname "$0")/clang-tools-version")

# Adds each package that is not on the list yet.
packages=""
add() {
    for package in "$@"; do
        case " $packages " in
            *" $package "*) ;;
            *) packages="${packages:+$packages }$package" ;;
        esac
    done
}

# Boost.Multiprecision is for the exact stage, oneTBB for batches, tinyxml2, zlib and nlohmann_json for files; CLI11, fmt
# and yaml-cpp for the command line.
add_demo() {
    add make cmake ninja-build g++ libeigen3-dev libboost-dev libtbb-dev libtinyxml2-dev zlib1g-dev libfmt-dev libcli11-dev nlohmann-json3-dev libyaml-cpp-dev
}

# The page of `chasles view` is made by npm packages; a Node.js from elsewhere brings its npm along, and does not go with
# Debian's.
add_install() {
    add_demo
    command -v npm >/dev/null || add nodejs npm
}

# Debian 12's `cargo` is too old for Parry; the one for web browsers is kept up to date.
cargo_package() {
    VERSION_ID=""
    [ ! -r /etc/os-release ] || . /etc/os-release
    if [ "$VERSION_ID" = 12 ]; then echo cargo-web; else echo cargo; fi
}

add_group() {
    case $1 in
        demo) add_demo ;;
        install) add_install ;;
        # GMP is the exact arithmetic that the tests compare with, FCL the distances; yaml-cpp reads planning scenes.
        check)
            add_install
            add libgtest-dev libgmp-dev libfcl-dev libyaml-cpp-dev libompl-dev python3 "clang-format-$clang_version"
            # The page of `chasles view` is tested in a browser.
            command -v chromium >/dev/null || add chromium
            ;;
        # libFuzzer and the sanitizers are in the runtime library.
        fuzz)
            add_demo
            add "clang-$clang_version" "libclang-rt-$clang_version-dev" libgmp-dev
            ;;
        # The rest comes from the package index into a virtual environment.
        python)
            add_install
            add python3-venv python3-dev
            ;;
        # The compiler comes from the package index; the native answers to compare with are built with the tests.
        wasm)
            add_group check
            add python3-venv
            ;;
        # Doxygen reads the headers; the rest comes from the package indexes of Python and npm. The browser makes pictures.
        site)
            add_group check
            add_group python
            add doxygen
            ;;
        # Highway is what the lanes are compared with, FCL and Bullet what whole queries are; other peers are brought by
        # Python and Rust.
        bench)
            add_demo
            add libbenchmark-dev libhwy-dev libfcl-dev libbullet-dev libyaml-cpp-dev libompl-dev python3-venv
            command -v cargo >/dev/null || add "$(cargo_package)"
            ;;
        tidy) add "clang-tidy-$clang_version" ;;
        format) add "clang-format-$clang_version" ;;
        *)
            echo "install_dependencies.sh: unknown group \"$1\" (known: demo, install, check, fuzz, python, wasm, site, bench, tidy, format)" >&2
            exit 2
            ;;
    esac
}

list_only=false
if [ "${1:-}" = --list ]; then
    list_only=true
    shift
fi
[ $# -gt 0 ] || set -- install
for group in "$@"; do
    add_group "$group"
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
