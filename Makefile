# Thin: every target is what you could type yourself with the CMake presets.
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 10

# `make quick` runs the unit tests of these layers, `make tidy-core` reads those without findings.
QUICK = algebra motion elementary hierarchy mesh culling contact search query
TIDY = algebra base hierarchy io mesh
empty :=
one_of = ^($(subst $(empty) ,|,$(strip $(1))))$$

.PHONY: help demo quick check check-builds check-night builds python-check wasm playground wasm-check site facts attack install \
	bench variants asan asan-core tsan fuzz tidy tidy-core abuse format clean

help:
	@echo "make demo     install what is missing, build, and let Chasles show itself"
	@echo "make quick    build and run the unit tests of the layers, without the slow ones: a minute where little has changed"
	@echo "make check    install what is missing, build with checks, and test all behaviour"
	@echo "make check-builds  test other builds: variants, consumers, sanitizers of the core, fuzzers, WebAssembly, clang-tidy"
	@echo "make check-night   what takes hours: every test under sanitizers, abuse, attack, ten minutes of each fuzzer"
	@echo "make python-check  install the Python package into a fresh environment and run its tests"
	@echo "make wasm     build the npm package: the library for WebAssembly, in build/wasm/package"
	@echo "make playground    build the page to drag bodies in a browser: build/playground/index.html"
	@echo "make wasm-check  install it, packed, into an empty project and test it there; test the page in a browser"
	@echo "make site     build the manual as a site, with the playground: build/site/index.html"
	@echo "make facts    print what real inputs give: known answers, exact queries, nuts, CAD motions, a large pair"
	@echo "make attack   ten million elementary queries and 100,000 mesh pairs against exact arithmetic (a night)"
	@echo "make install  install the library and the command line to PREFIX (default $(PREFIX))"
	@echo "make bench    install what is compared with, build and run the benchmarks, and plot them"
	@echo "make variants the same bits from other compiler options, consumers of the library, headers alone"
	@echo "make asan     every test but the largest nuts by Clang under the address and undefined-behaviour sanitizers"
	@echo "make asan-core     so built, a small attack on all that computes an answer, every fuzzer for FUZZ_SECONDS (default $(FUZZ_SECONDS)), a demo"
	@echo "make tsan     the tests that share bodies between threads, under the thread sanitizer"
	@echo "make fuzz     of these, the fuzzers alone"
	@echo "make tidy     clang-tidy over the library, the scenes and the command line"
	@echo "make tidy-core     clang-tidy over the layers that have no findings"
	@echo "make abuse    kill, interrupt and starve every command, and give it damaged files (an hour)"
	@echo "make format   lay out every source file"

# A build folder that is new is compiled once: then batches of sources take a third of the time.
in_batches = $(if $(wildcard $(1)/CMakeCache.txt),,-D CHASLES_UNITY=ON)

demo:
	@tools/install_dependencies.sh demo
	cmake --preset demo $(call in_batches,build/release)
	cmake --build --preset demo -j $(JOBS)
	build/release/bin/chasles demo

check:
	@tools/install_dependencies.sh check python
	cmake --preset dev -D CHASLES_TEST_BUILDS=OFF $(call in_batches,build/dev)
	cmake --build --preset dev -j $(JOBS)
	ctest --preset dev -j $(JOBS)
	tools/python_check.sh build/dev

# What the continuous integration runs one by one after `make check`, what matters most first.
BUILDS = asan-core wasm-check variants tidy-core

check-builds: $(BUILDS)

builds:
	@echo $(BUILDS)

check-night: asan tsan tidy abuse attack
	@$(MAKE) fuzz FUZZ_SECONDS=600

variants:
	@tools/install_dependencies.sh check
	cmake --preset dev -D CHASLES_TEST_BUILDS=ON $(call in_batches,build/dev)
	cmake --build --preset dev -j $(JOBS)
	ctest --preset variants -j $(JOBS)

quick:
	@tools/install_dependencies.sh check
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target $(QUICK:%=chasles_%_tests)
	ctest --preset quick -j $(JOBS) -L '$(call one_of,$(QUICK))'

python-check:
	@tools/install_dependencies.sh python
	tools/python_check.sh

wasm:
	@tools/install_dependencies.sh wasm
	cmake --preset wasm
	cmake --build --preset wasm -j $(JOBS)

playground: wasm
	cmake --build --preset wasm -j $(JOBS) --target chasles_playground

wasm-check: playground
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target chasles_native_answers chasles_cli
	tools/wasm_check.sh build/wasm/package build/dev/bin/chasles_native_answers
	tools/playground_check.sh build/wasm/page build/playground/index.html build/dev/bin/chasles

# The programs whose pages the site shows.
PAGES = chasles_cli pulled_nut key_in_maze piano_through_door turning_gears dominoes box_of_bolts
PLAYGROUND := $(shell grep -o '^playground:' Makefile | tr -d :)

site: $(PLAYGROUND)
	@tools/install_dependencies.sh site
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target $(PAGES)
	tools/site.sh build/dev

facts:
	@tools/install_dependencies.sh check
	cmake --preset dev
	cmake --build --preset dev --target chasles_data_tests -j $(JOBS)
	build/dev/bin/chasles_data_tests --gtest_brief=1

attack:
	@tools/install_dependencies.sh check
	cmake --preset dev
	cmake --build --preset dev --target chasles_attack -j $(JOBS)
	build/dev/bin/chasles_attack --certain --threads $(JOBS)

install:
	@tools/install_dependencies.sh install
	cmake --preset release
	cmake --build --preset release -j $(JOBS)
	cmake --install build/release --prefix $(PREFIX)

bench:
	@tools/install_dependencies.sh bench
	@bench/registry/install.sh build/bench/registry
	cmake --preset bench
	cmake --build --preset bench -j $(JOBS)
	build/bench/bin/chasles_bench

asan:
	@tools/install_dependencies.sh check fuzz
	cmake --preset asan $(call in_batches,build/asan)
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)

asan-core:
	@tools/install_dependencies.sh check fuzz
	cmake --preset asan $(call in_batches,build/asan) -D CHASLES_FUZZ_SECONDS=$(FUZZ_SECONDS)
	cmake --build --preset asan -j $(JOBS) --target chasles_cli chasles_attack chasles_fuzzers
	build/asan/bin/chasles_attack --certain --threads $(JOBS) --elementary 20000 --mesh-pairs 600 --margins 600 --least 300 \
		--trajectories 4
	ctest --preset asan -j $(JOBS) -L fuzz
	build/asan/bin/chasles demo

tsan:
	@tools/install_dependencies.sh check
	cmake --preset tsan
	cmake --build --preset tsan --target chasles_query_tests -j $(JOBS)
	ctest --preset tsan -j $(JOBS)

abuse:
	@tools/install_dependencies.sh check
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS) --target chasles_cli
	python3 tests/abuse build/dev/bin/chasles --jobs $(JOBS)

fuzz:
	@tools/install_dependencies.sh check fuzz
	cmake --preset asan $(call in_batches,build/asan) -D CHASLES_FUZZ_SECONDS=$(FUZZ_SECONDS)
	cmake --build --preset asan -j $(JOBS) --target chasles_fuzzers
	ctest --preset asan -j $(JOBS) -L fuzz

tidy:
	@tools/install_dependencies.sh install fuzz tidy
	cmake --preset tidy
	tools/tidy.sh build/tidy

tidy-core:
	@tools/install_dependencies.sh install fuzz tidy
	cmake --preset tidy
	tools/tidy.sh build/tidy 'chasles/$(patsubst ^%$$,%,$(call one_of,$(TIDY)))/'

format:
	@tools/install_dependencies.sh format
	tools/format.sh

clean:
	rm -rf build
