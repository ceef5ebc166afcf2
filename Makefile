# The commands of the project. Each installs the system packages it needs (tools/deps.sh), configures and builds.
.PHONY: help deps run demo test test-long validation bench paper format lint clean
JOBS ?= $(shell nproc)

help:
	@echo "make run        push a wire through a vessel; report.html, shape, forces, picture in out/run"
	@echo "make test       everything that is checked, at most 45 minutes on 2 cores"
	@echo "make test-long  sweeps that take longer"
	@echo "make validation docs/validation.md and its pictures, from the code that the tests assert"
	@echo "make bench      speed"
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
	@for binary in $$(find build/bench/bench -maxdepth 1 -type f -perm -u+x -name 'bench_*'); do $$binary || exit 1; done

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
