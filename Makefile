# make demo, make test, make lint: each sets up all that it needs, on a machine with make and
# Python 3.11 or later. make bench measures the speed, make peers compares with other programs;
# make lock renews the locked dependencies; make clean forgets what was made.

VENV := .venv
BIN := $(VENV)/bin
PYTHON := $(shell for p in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
DRAW := $(BIN)/python -c 'from lumiar.card import open_context; open_context()'


.NOTPARALLEL:
.PHONY: demo test lint bench peers style driver glslang apt lock clean

demo: $(VENV)/run driver
	@mkdir -p demo
	@$(BIN)/lumiar capture demo -o demo/lumiar.png >/dev/null
	@echo "Look at demo/lumiar.png. One of its scenes alone: $(BIN)/lumiar capture teapot"
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ] || [ "$$(uname)" = Darwin ]; then \
		echo "and a window: F1 tells its keys, Esc closes it"; \
		$(BIN)/lumiar view teapot --set samples=4 || true; fi

test: $(VENV)/dev driver glslang style
	$(BIN)/python -m pytest -n auto

lint: $(VENV)/dev driver glslang style
	$(BIN)/python -m pytest tests/test_house.py tests/test_compose.py

bench: $(VENV)/dev driver
	$(BIN)/python tests/benchmarks/bench.py

# Mitsuba and tmm, hundreds of megabytes: only these tests need them.
peers: $(VENV)/dev
	@$(PIP) install uv && $(BIN)/uv pip install --quiet --python $(BIN)/python --group peers
	$(BIN)/python -m pytest tests/test_reference.py tests/test_daylight.py tests/test_surroundings.py

style: $(VENV)/dev
	$(BIN)/ruff check
	$(BIN)/ruff format --check

# The virtual environment, with the locked dependencies: to run, and to develop.
$(VENV)/run $(VENV)/dev: $(VENV)/%: requirements-%.lock pyproject.toml $(BIN)/python
	@echo "installing what $< names into $(VENV)"
	@$(PIP) install --require-hashes -r $<
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@$(BIN)/python -m compileall -q app $(VENV)/lib >/dev/null || true  # starts sooner
	@touch $@

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "lumiar: needs Python 3.11 or later; install it first" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || $(MAKE) --no-print-directory apt PACKAGES="$$( \
		$(PYTHON) -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])')"
	@$(PYTHON) -m venv $(VENV)

# OpenGL without a window, and the Khronos reference compiler for the checks.
driver: | $(BIN)/python
	@$(DRAW) 2>/dev/null || $(MAKE) --no-print-directory apt PACKAGES="libegl1 libgl1 libgl1-mesa-dri"
	@$(DRAW) 2>/dev/null || { $(DRAW) 2>&1 | tail -n 1 >&2; exit 1; }

glslang:
	@command -v glslangValidator >/dev/null || \
		$(MAKE) --no-print-directory apt PACKAGES=glslang-tools

# Install PACKAGES as root or through sudo; where neither may, say the one line to type.
apt:
	@if [ "$$(id -u)" = 0 ]; then as=; \
	elif sudo -n true 2>/dev/null || { command -v sudo >/dev/null && [ -t 0 ]; }; then as=sudo; \
	else as=no; fi; \
	if [ "$$as" = no ] || ! command -v apt-get >/dev/null; then \
		echo "lumiar: please type: sudo apt-get install -y $(PACKAGES)" >&2; exit 1; fi; \
	echo "installing $(PACKAGES)"; \
	$$as apt-get update -qq && $$as env DEBIAN_FRONTEND=noninteractive \
		apt-get install -y -qq --no-install-recommends $(PACKAGES) >/dev/null

# The locks: every package, every hash, no address of a registry.
lock: $(VENV)/dev
	@$(PIP) install uv
	@for set in run dev; do groups="--group build"; [ $$set = run ] || groups="--group dev"; \
		$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
		--no-emit-index-url --no-header --no-annotate pyproject.toml $$groups \
		-o requirements-$$set.lock || exit 1; done

clean:
	rm -rf $(VENV) demo build dist .pytest_cache .ruff_cache .hypothesis
