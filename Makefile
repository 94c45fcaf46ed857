# Thin: every target is what you could type yourself with the CMake presets.
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 10

.PHONY: help demo quick check python-check facts attack install bench asan tsan fuzz tidy format clean

help:
	@echo "make demo     install what is missing, build, and let Chasles show itself"
	@echo "make check    install what is missing, build with checks, and run every test"
	@echo "make python-check  install the Python package into a fresh environment and run its tests"
	@echo "make facts    print what real inputs give: known answers, exact queries, nuts, CAD motions, a large pair"
	@echo "make attack   ten million elementary queries and 100,000 mesh pairs against exact arithmetic (a night)"
	@echo "make install  install the library and the command line to PREFIX (default $(PREFIX))"
	@echo "make bench    install what is compared with, build and run the benchmarks, and plot them"
	@echo "make asan     every test but the largest nuts under the address and undefined-behaviour sanitizers"
	@echo "make tsan     the tests that share bodies between threads, under the thread sanitizer"
	@echo "make fuzz     run each fuzzer for FUZZ_SECONDS (default $(FUZZ_SECONDS))"
	@echo "make tidy     clang-tidy over the library, the scenes and the command line"
	@echo "make format   lay out every source file"

demo:
	@tools/install_dependencies.sh demo
	cmake --preset demo
	cmake --build --preset demo -j $(JOBS)
	build/release/bin/chasles demo

check:
	@tools/install_dependencies.sh check fuzz python
	cmake --preset dev
	cmake --build --preset dev -j $(JOBS)
	ctest --preset dev -j $(JOBS)
	tools/python_check.sh build/dev
	tools/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

python-check:
	@tools/install_dependencies.sh python
	tools/python_check.sh

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
	@tools/install_dependencies.sh check
	cmake --preset asan
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)

tsan:
	@tools/install_dependencies.sh check
	cmake --preset tsan
	cmake --build --preset tsan --target chasles_query_tests -j $(JOBS)
	ctest --preset tsan -j $(JOBS)

fuzz:
	@tools/install_dependencies.sh fuzz
	tools/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

tidy:
	@tools/install_dependencies.sh check tidy
	cmake --preset dev
	tools/tidy.sh build/dev

format:
	@tools/install_dependencies.sh format
	tools/format.sh

clean:
	rm -rf build
