# `make` lists what there is.  Needs only make and Python >= 3.11.

.DEFAULT_GOAL := help
SHELL := /bin/sh

# The first Python on the path that is new enough.
PYTHON ?= $(shell for p in python3 python3.14 python3.13 python3.12 python3.11 python; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
FILE ?= problems/hoop.yaml
# Of jobs side by side each prints whole lines, where this make can do that.
WHOLE_LINES := $(if $(filter output-sync,$(.FEATURES)),--output-sync=line)

.PHONY: help
help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | awk -F '\t' '{printf "make %-11s %s\n", $$1, $$2}'

.PHONY: setup
setup: $(READY) ## make .venv with lagcli and the developers' tools in it

$(READY): pyproject.toml
	@test -n "$(PYTHON)" || { echo "lagcli needs Python >= 3.11: make setup PYTHON=/path/to/python3" >&2; exit 1; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV) || { \
		rm -rf $(VENV); echo "no venv: on Debian, apt-get install python3-venv" >&2; exit 1; }
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile --editable '.[dev,fast]'
	@# on all cores, without the packages' own tests; Python itself may not be allowed to keep bytecode
	@$(BIN)/python -m compileall -qq -j 0 -x '/(tests?|pip|setuptools|pkg_resources|mypyc?)/' $(VENV)/lib lagcli || true
	@touch $@

.PHONY: solve
solve: $(READY) ## the main job: make solve FILE=problems/hoop.yaml
	@$(BIN)/lagcli solve $(FILE)

.PHONY: check
check: $(READY) ## what one runs before a commit; a few minutes
	@$(MAKE) --no-print-directory -j 2 $(WHOLE_LINES) test library lint types layers

.PHONY: check-all
check-all: long certificate ## all the rest: long runs, every problem of the library, mutants, certificates

.PHONY: lint
lint: $(READY) ## format and style (ruff)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .

.PHONY: types
types: $(READY) ## types (mypy --strict)
	$(BIN)/mypy

.PHONY: layers
layers: $(READY) ## imports point one way (import-linter)
	$(BIN)/lint-imports

.PHONY: test
test: $(READY) ## the tests (pytest); make test ARGS="-k noether"
	$(BIN)/pytest -q -n auto --dist worksteal $(ARGS)

.PHONY: long
long: $(READY) ## the tests that `make test` leaves out
	$(BIN)/pytest -q -n auto --dist worksteal -m "long and not hours" $(ARGS)

.PHONY: certificate
certificate: $(READY) ## whether the errors of runs are what they claim, on some problems
	$(BIN)/python -m tests.bench.certificate --workers 2 --limit 20 $(wildcard problems/central/*.yaml)

.PHONY: library
library: $(READY) ## every problem of the library against its known answers
	$(BIN)/lagcli check problems/ --timeout 300

.PHONY: bench
bench: $(READY) ## whole-process times as ratios, kept in .bench/
	@$(BIN)/python -m compileall -q lagcli
	$(BIN)/python tests/bench/bench.py $(ARGS)

.PHONY: gallery
gallery: $(READY) ## a page of every problem in .gallery; make gallery ARGS=pendulums
	@$(BIN)/python tests/gallery.py .gallery $(ARGS)

.PHONY: format
format: $(READY) ## rewrite the code as ruff would have it
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

.PHONY: clean
clean: ## remove everything that was made here
	rm -rf $(VENV) .bench .gallery .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache dist build
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
