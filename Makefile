# The commands of the project. Each installs the system packages it needs (tools/deps.sh), configures and builds.
.PHONY: help deps run demo python test test-long validation bench bench-compare references paper format lint clean
JOBS ?= $(shell nproc)

help:
	@echo "make run        push a wire through a vessel; report.html, shape, forces, picture in out/run"
	@echo "make test       everything that is checked, at most 45 minutes on 2 cores"
	@echo "make test-long  sweeps that take longer"
	@echo "make validation docs/validation.md and its pictures, from the code that the tests assert"
	@echo "make python     the module of Python in build/release/python"
	@echo "make bench      speed: parts and whole procedures, kept in bench/results"
	@echo "make bench-compare BASE=<git revision>   is this tree faster, and does it give the same states?"
	@echo "make references shapes and forces that the tests compare with, after a change that is meant"
	@echo "make paper      tries the claims of the paper: docs/paper.md, ten minutes"
	@echo "make format     clang-format over all sources"
	@echo "make lint       clang-tidy over the library"
	@echo "make deps       install the system packages of all of these"
	@echo "make clean      remove build/ and out/"

deps:
	@tools/deps.sh test
	@tools/deps.sh bench

run:
	@tools/deps.sh run
	@cmake --preset release > /dev/null
	@cmake --build --preset release --parallel $(JOBS) --target endowire check_crossings
	@tools/run.sh build/release

demo: run

python:
	@tools/deps.sh python
	@cmake --preset release > /dev/null
	@cmake --build --preset release --parallel $(JOBS) --target endowire_python
	@echo "PYTHONPATH=build/release/python"

test:
	@tools/deps.sh test
	cmake --preset check
	cmake --build --preset check --parallel $(JOBS)
	ctest --preset check --parallel $(JOBS)

test-long:
	@tools/deps.sh test
	cmake --preset check
	cmake --build --preset check --parallel $(JOBS)
	ctest --preset long --parallel $(JOBS)

validation:
	@tools/deps.sh test
	cmake --preset check
	cmake --build --preset check --parallel $(JOBS) --target validation

bench:
	@tools/deps.sh bench
	cmake --preset bench
	cmake --build --preset bench --parallel $(JOBS)
	tools/bench.sh build/bench/bench

# Is this tree faster than the revision BASE? Ratios of runs in turns; ROUNDS and SCENARIOS may be given.
bench-compare:
	@tools/deps.sh bench
	@tools/compare_builds.sh $(or $(BASE),$(error make bench-compare BASE=<git revision>)) $(or $(ROUNDS),5) $(SCENARIOS)

# After a change of numbers that is meant: what `test_references` compares with.
references:
	@tools/deps.sh test
	cmake --preset check
	cmake --build --preset check --parallel $(JOBS) --target write_references
	build/check/tests/write_references

paper:
	@tools/deps.sh bench
	cmake --preset bench
	cmake --build --preset bench --parallel $(JOBS) --target write_paper
	build/bench/bench/paper/write_paper docs

format:
	@cmake -DFIX=ON -P tests/ground/format.cmake

lint:
	@tools/deps.sh test
	cmake --preset check
	cmake -DBUILD=build/check -P tests/ground/tidy.cmake

clean:
	rm -rf build out
